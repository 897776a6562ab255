#include "core/spec/comparison_spec.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/spec/json_reader.h"
#include "core/spec/spec_head.h"

namespace btr {

std::vector<std::uint64_t> seedsFrom(JsonReader& reader) {
  std::vector<std::uint64_t> seeds;
  for (const double seed : reader.numberList("seeds")) {
    constexpr double largest = 9007199254740991;  // every whole number up to it is a double
    if (!(seed >= 0) || seed > largest || seed != static_cast<double>(static_cast<std::uint64_t>(seed)) ||
        std::ranges::count(seeds, static_cast<std::uint64_t>(seed)) > 0)
      reader.refuse("seeds", "whole numbers from 0 to 2^53 − 1, each once");
    seeds.push_back(static_cast<std::uint64_t>(seed));
  }
  if (seeds.empty()) reader.refuse("seeds", "at least one seed");
  return seeds;
}

ComparisonSpec comparisonFromJson(const std::string& text, const std::string& place, const std::string& directory) {
  JsonReader reader = JsonReader::parse(text, place);
  ComparisonSpec spec;
  spec.place = place;
  spec.directory = directory;
  spec.name = nameOfSpec(reader, "uchilsim-comparison-1");
  reader.array("arms", [&](JsonReader arm) {
    ComparisonSpec::Arm read{arm.text("name"), arm.text("experiment")};
    if (read.name.empty() || std::ranges::any_of(spec.arms, [&](const auto& a) { return a.name == read.name; }))
      arm.refuse("name", "a name that no other arm has");
    if (read.experiment.empty()) arm.refuse("experiment", "the path of an experiment file");
    arm.finish();
    spec.arms.push_back(std::move(read));
  });
  if (spec.arms.empty()) reader.refuse("arms", "at least one arm");
  spec.seeds = seedsFrom(reader);
  reader.finish();
  return spec;
}

ComparisonSpec loadComparison(const std::string& path) {
  return comparisonFromJson(readFile(path), path, std::filesystem::path(path).parent_path().string());
}

}  // namespace btr
