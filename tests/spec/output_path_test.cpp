#include "core/spec/system/output_path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "core/spec/json_reader.h"
#include "tests/refusal.h"

namespace btr {
namespace {

namespace fs = std::filesystem;
using test::refusal;
using testing::HasSubstr;

class OutputPath : public testing::Test {
 protected:
  OutputPath() {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~OutputPath() override { fs::remove_all(folder_); }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  const fs::path folder_ = fs::temp_directory_path() / ("output_path_" + std::to_string(getpid()));
};

TEST_F(OutputPath, AFileIsTheSameByWhateverName) {
  writeFile(at("a"), "x");
  fs::create_symlink("a", at("soft"));
  fs::create_hard_link(at("a"), at("hard"));
  for (const char* name : {"a", "./a", "soft", "hard"}) EXPECT_TRUE(isSameFile(at("a"), at(name))) << name;
  EXPECT_FALSE(isSameFile(at("a"), at("b")));
  EXPECT_TRUE(isSameFile(at("later"), at("./later"))) << "also before it is there";
}

TEST_F(OutputPath, WhatAJsonFileNamesIsReadWithItAndSoOn) {
  fs::create_directories(at("robots"));
  writeFile(at("robots/robot.urdf"), "x");
  writeFile(at("scene.json"), R"({"robots": [{"model": "robots/robot.urdf"}], "none": "not there"})");
  writeFile(at("experiment.json"), R"({"scene": "scene.json", "self": "experiment.json"})");
  writeFile(at("broken.json"), "{");
  const auto real = [&](const char* name) { return fs::canonical(at(name)).string(); };
  EXPECT_THAT(withNamedFiles({at("experiment.json"), at("broken.json"), at("absent.json"), ""}),
              testing::UnorderedElementsAre(real("experiment.json"), real("scene.json"), real("robots/robot.urdf"),
                                            real("broken.json")));
}

TEST_F(OutputPath, AFileThatThisProgramHasOpenIsNotEvenLookedInto) {
  writeFile(at("open.csv"), "x");
  std::FILE* held = std::fopen(at("open.csv").c_str(), "r");
  EXPECT_THAT(refusal([&] { writeFile(at("open.csv"), "y"); }), HasSubstr("open.csv: is in use by this program"));
  std::fclose(held);
  EXPECT_EQ("accepted", refusal([&] { writeFile(at("open.csv"), "y"); }));
}

TEST_F(OutputPath, AResultReplacesNeitherInputNorDatabaseNorFolder) {
  writeFile(at("in.csv"), "x");
  writeFile(at("x.db"), std::string("SQLite format 3\0 and so on", 26));
  const std::vector<std::string> inputs{at("in.csv")};
  EXPECT_EQ("accepted", refusal([&] { checkOutputFile(at("out.csv"), inputs); }));
  EXPECT_EQ("accepted", refusal([&] { checkOutputFile("/dev/null", inputs); }));
  EXPECT_THAT(refusal([&] { checkOutputFile(at("in.csv"), inputs); }), HasSubstr("is read by this command"));
  EXPECT_THAT(refusal([&] { checkOutputFile(at("x.db"), inputs); }), HasSubstr("x.db: is a database"));
  EXPECT_THAT(refusal([&] { writeFile(at("x.db"), "y"); }), HasSubstr("x.db: is a database"));
  EXPECT_THAT(refusal([&] { checkOutputFile(folder_.string(), inputs); }), HasSubstr("is a folder"));
  EXPECT_THAT(refusal([&] { checkOutputFile(at("none/out.csv"), inputs); }), HasSubstr("there is no folder"));
  EXPECT_THAT(refusal([&] { checkOutputFile(at("in.csv/out.csv"), {}); }), HasSubstr("in.csv is a file"));
}

TEST_F(OutputPath, AFolderOfResultsIsMadeAndItsFilesAreNoInputs) {
  EXPECT_EQ("accepted", refusal([&] { checkOutputFolder(at("new/report"), {"report.json"}, {}); }));
  EXPECT_TRUE(fs::is_directory(at("new/report")));
  writeFile(at("new/report/simulator.json"), "{}");
  const std::vector<std::string> inputs{at("new/report/simulator.json")};
  EXPECT_EQ("accepted", refusal([&] { checkOutputFolder(at("new/report"), {"report.json"}, inputs); }));
  EXPECT_THAT(refusal([&] { checkOutputFolder(at("new/report"), {"simulator.json"}, inputs); }),
              HasSubstr("is read by this command"));
  writeFile(at("file"), "");
  EXPECT_THAT(refusal([&] { checkOutputFolder(at("file/below"), {}, {}); }), HasSubstr("(Not a directory)"));
}

TEST_F(OutputPath, NothingIsWrittenBesideADatabaseUnderItsOwnNames) {
  const std::string database = at("x.db");
  for (const char* name : {"x.db", "x.db-wal", "x.db-shm", "x.db-journal", "x.db.run-1.lock", "x.db.grid-20.lock"})
    EXPECT_THAT(refusal([&] { checkNotBesideDatabase(at(name), database); }), HasSubstr("belongs to the database"))
        << name;
  for (const char* name : {"x.db.csv", "x.csv", "x.db-wal.csv", "y.db"})
    EXPECT_EQ("accepted", refusal([&] { checkNotBesideDatabase(at(name), database); })) << name;
}

TEST_F(OutputPath, ALinkToNothingYetStaysALink) {
  fs::create_symlink("target", at("link"));
  writeFile(at("link"), "x");
  EXPECT_TRUE(fs::is_symlink(at("link")));
  EXPECT_EQ("x", readFile(at("target")));
}

}  // namespace
}  // namespace btr
