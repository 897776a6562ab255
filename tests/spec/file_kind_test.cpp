// What a file is, by its content, and the sentence about a wrong one.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/spec/error.h"
#include "core/spec/file_kind.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

class FileKinds : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return (folder_ / name).string();
  }
  const TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

TEST_F(FileKinds, AreToldByContentWhateverTheName) {
  EXPECT_EQ(kindOfFile(file("a.txt", R"({"name": "x", "format": "uchilsim-experiment-1"})")), FileKind::experiment);
  EXPECT_EQ(kindOfFile(file("b.wrl", R"({ "format" : "uchilsim-scene-1" })")), FileKind::scene);
  EXPECT_EQ(kindOfFile(file("c", R"({"format": "uchilsim-gait-1"})")), FileKind::otherFormat);
  EXPECT_EQ(kindOfFile(file("d.json", "{\"x\": 1}")), FileKind::json);
  EXPECT_EQ(kindOfFile(file("e.json", "#VRML V2.0 utf8\n")), FileKind::robot);
  EXPECT_EQ(kindOfFile(file("f.json", "<?xml version=\"1.0\"?>\n<robot name=\"r\"/>")), FileKind::robot);
  EXPECT_EQ(kindOfFile(file("g.dat", "time_s;q\n0,5;1\n")), FileKind::recording);
  EXPECT_EQ(kindOfFile(file("h.csv", "Dear all,\nnothing.\n")), FileKind::text);
  EXPECT_EQ(kindOfFile(file("i", std::string("SQLite format 3\0x", 17))), FileKind::database);
  EXPECT_EQ(kindOfFile(file("j", std::string("\x7f\0\1", 3))), FileKind::binary);
  EXPECT_EQ(kindOfFile(file("k", "")), FileKind::text);
  EXPECT_EQ(kindOfFile(folder_.string()), FileKind::folder);
  EXPECT_EQ(kindOfFile((folder_ / "none").string()), FileKind::missing);
  file("report.json", "{}");
  EXPECT_EQ(kindOfFile(folder_.string()), FileKind::report);
}

TEST_F(FileKinds, AWrongOneIsCalledWhatItIsAndWhatIsExpected) {
  const std::string robot = file("dog.wrl", "#VRML V2.0 utf8\n");
  try {
    requireKind(robot, FileKind::scene);
    FAIL() << "a robot was taken for a scene";
  } catch (const InputError& wrong) {
    EXPECT_EQ(wrong.what(), robot +
                                " is a robot model (VRML97); expected: a scene (JSON with \"format\": "
                                "\"uchilsim-scene-1\")");
  }
  EXPECT_NO_THROW(requireKind(robot, FileKind::robot));
  // Reading these names the place, or that there is no such file.
  EXPECT_NO_THROW(requireKind(file("x.json", "{}"), FileKind::scene));
  EXPECT_NO_THROW(requireKind((folder_ / "none").string(), FileKind::scene));
}

}  // namespace
}  // namespace btr
