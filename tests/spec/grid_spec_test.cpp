// Grid files: what is read, and that what makes no sense is refused with its place and what is allowed.
#include "core/spec/grid_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/spec/error.h"

namespace btr {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

json smallGrid() {
  return {{"format", "uchilsim-grid-1"},    {"name", "g"},
          {"experiment", "kick.json"},      {"distances_m", {0.14, 0.18}},
          {"bearings_rad", {-0.5, 0, 0.5}}, {"directions_rad", {-1, 0, 1}},
          {"methods", {"similarity"}},      {"seeds", {1, 7}}};
}

std::string complaint(const std::string& key, const json& value) {
  json text = smallGrid();
  text[key] = value;
  try {
    gridFromJson(text.dump(), "g.json");
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("g.json"));
    return error.what();
  }
  return "accepted";
}

TEST(GridSpec, IsReadWithDefaultsForWhatIsAbsent) {
  const GridSpec grid = gridFromJson(smallGrid().dump(), "folder/g.json");
  EXPECT_EQ(grid.name, "g");
  EXPECT_EQ(grid.file, "folder/g.json");
  EXPECT_THAT(grid.axes[0], ElementsAre(0.14, 0.18));
  EXPECT_THAT(grid.axes[2], ElementsAre(-1, 0, 1));
  EXPECT_TRUE(grid.mirroredDerived);
  EXPECT_THAT(grid.methods, ElementsAre(GridSpec::Method::similarity));
  EXPECT_THAT(grid.seeds, ElementsAre(1u, 7u));
  EXPECT_EQ(valueOf(gridParameters(), grid.settings, "contamination_share"), 0.8);
  EXPECT_EQ(valueOf(gridParameters(), grid.settings, "points"), 200);
}

TEST(GridSpec, AFileThatIsWrittenIsTheSameGrid) {
  const GridSpec grid = gridFromJson(smallGrid().dump(), "folder/g.json");
  const GridSpec again = gridFromJson(gridFileText(grid), "other.json");
  EXPECT_EQ(gridFileText(again), gridFileText(grid));
  EXPECT_EQ(toJsonText(again), toJsonText(grid));
  EXPECT_EQ(again.methods, grid.methods);
  EXPECT_EQ(again.seeds, grid.seeds);
  EXPECT_EQ(again.axes, grid.axes);
}

TEST(GridSpec, IsStoredWithoutMethodsAndSeedsAndReadBack) {
  const GridSpec grid = gridFromJson(smallGrid().dump(), "g.json");
  const GridSpec again = storedGrid(toJsonText(grid), "stored");
  EXPECT_EQ(again.axes, grid.axes);
  EXPECT_EQ(toJsonText(again), toJsonText(grid));
  json other = smallGrid();
  other["methods"] = {"independent", "contamination"};
  other["seeds"] = {3};
  EXPECT_EQ(toJsonText(gridFromJson(other.dump(), "g.json")), toJsonText(grid));
}

TEST(GridSpec, WhatMakesNoSenseIsRefusedWithItsPlaceAndWhatIsAllowed) {
  EXPECT_EQ(complaint("name", "g"), "accepted");
  EXPECT_THAT(complaint("name", ""), HasSubstr("at least one letter"));
  EXPECT_THAT(complaint("experiment", ""), HasSubstr("experiment"));
  EXPECT_THAT(complaint("distances_m", json::array()), HasSubstr("distances_m"));
  EXPECT_THAT(complaint("distances_m", {0.18, 0.14}), HasSubstr("ascending"));
  EXPECT_THAT(complaint("distances_m", {0.14, 0.14}), HasSubstr("each once"));
  EXPECT_THAT(complaint("distances_m", {0.14, nullptr}), HasSubstr("distances_m"));
  EXPECT_THAT(complaint("bearings_rad", {-0.5, 0.4}), HasSubstr("symmetric about 0"));
  EXPECT_THAT(complaint("directions_rad", {0, 1}), HasSubstr("directions_rad"));
  EXPECT_THAT(complaint("mirrored", "no"), HasSubstr("derived, learned"));
  EXPECT_THAT(complaint("methods", json::array()), HasSubstr("at least one of independent"));
  EXPECT_THAT(complaint("methods", {"similar"}), HasSubstr("independent, contamination, similarity"));
  EXPECT_THAT(complaint("methods", {"similarity", "similarity"}), HasSubstr("each once"));
  EXPECT_THAT(complaint("seeds", {1, 1}), HasSubstr("each once"));
  EXPECT_THAT(complaint("settings", {{"contamination_share", 1.5}}), HasSubstr("0 to 1"));
  EXPECT_THAT(complaint("settings", {{"replace_failed", "perhaps"}}), HasSubstr("no, yes"));
  EXPECT_THAT(complaint("setings", json::object()), HasSubstr("setings"));
}

TEST(GridSpec, AnAsymmetricGridMayBeLearnedWhole) {
  json text = smallGrid();
  text["mirrored"] = "learned";
  text["bearings_rad"] = {0, 0.5};
  EXPECT_FALSE(gridFromJson(text.dump(), "g.json").mirroredDerived);
}

TEST(GridSpec, ThereIsALimitToTheCells) {
  json text = smallGrid();
  text["distances_m"] = json::array();
  for (int i = 0; i < 100; ++i) text["distances_m"].push_back(i);
  text["directions_rad"] = {-2, -1, 0, 1, 2};
  try {
    gridFromJson(text.dump(), "g.json");
    FAIL() << "1500 cells were accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("1500 cells"));
    EXPECT_THAT(error.what(), HasSubstr("at most 1000"));
  }
}

TEST(GridSpec, TheExamplesAreSound) {
  int read = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SOURCE_DIR "/resources/grids")) {
    const GridSpec grid = loadGrid(entry.path().string());
    EXPECT_TRUE(std::filesystem::exists(entry.path().parent_path() / grid.experiment)) << entry.path();
    ++read;
  }
  EXPECT_EQ(read, 2);
  const GridSpec paper = loadGrid(SOURCE_DIR "/resources/grids/kick-grid.json");
  EXPECT_EQ(paper.axes[0].size() * paper.axes[1].size() * paper.axes[2].size(), 30u);
}

}  // namespace
}  // namespace btr
