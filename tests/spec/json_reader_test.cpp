#include "core/spec/json_reader.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/spec/error.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using test::refusal;

std::string parseRefusal(const std::string& text) {
  return refusal([&] { JsonReader::parse(text, "a.json"); });
}

TEST(Json, SyntaxErrorsSayLineAndColumn) {
  EXPECT_EQ(0u, parseRefusal("{\n  \"a\": 1,\n  \"b\" 2\n}").find("a.json:3:7: not JSON"))
      << parseRefusal("{\n\"a\" 2}");
  EXPECT_EQ(0u, parseRefusal("").find("a.json:1:1: not JSON")) << parseRefusal("");
  EXPECT_EQ(0u, parseRefusal("{} x").find("a.json:1:4: not JSON")) << parseRefusal("{} x");
}

TEST(Json, ANumberBeyondTheLargestSaysLineAndColumn) {
  EXPECT_EQ("a.json:2:8: 1e400 is not allowed; numbers up to 1.7976931348623157e+308",
            parseRefusal("{\n  \"a\": 1e400}"));
}

TEST(Json, RefusesAKeyThatIsThereTwice) {
  EXPECT_EQ("a.json: key \"a\" is there twice in one object", parseRefusal(R"({"a": 1, "a": 2})"));
  EXPECT_EQ("a.json: key \"a\" is there twice in one object",
            parseRefusal(R"({"x": [{"a": 1, "b": {"a": 3}, "a": 2}]})"));
  EXPECT_EQ("accepted", parseRefusal(R"({"a": {"a": 1}, "b": [{"a": 1}, {"a": 2}]})"));
}

TEST(Json, RefusesEndlessNesting) {
  const std::string expected = "a.json: nested deeper than the allowed 100 levels";
  EXPECT_EQ(expected, parseRefusal(std::string(1000000, '[')));
  std::string objects;
  for (int i = 0; i < 1000000; ++i) objects += "{\"a\":";
  EXPECT_EQ(expected, parseRefusal(objects));
}

TEST(Json, NothingReadIsEverNotFinite) {
  for (const char* text : {R"({"a": NaN})", R"({"a": Infinity})", R"({"a": 1e999})", R"({"a": -1e999})"})
    EXPECT_NE("accepted", parseRefusal(text)) << text;
}

TEST(Json, RefusesBytesThatAreNotUtf8) {
  EXPECT_NE("accepted", parseRefusal("{\"\xff\xfe\": 1}"));
  EXPECT_NE("accepted", parseRefusal(std::string("{\"a\": 1}\0", 9)));
}

TEST(Json, RootMustBeAnObject) { EXPECT_EQ("a.json: [1] is not allowed; an object { … }", parseRefusal("[1]")); }

TEST(JsonReader, AnErrorNamesFileKeyValueAndWhatIsAllowed) {
  auto reader = JsonReader::parse(R"({"robots": [{"x": "left"}], "n": 2.5, "m": 11})", "a.json");
  reader.array("robots", [](JsonReader robot) {
    EXPECT_EQ("a.json /robots/0/x: \"left\" is not allowed; a number 0 to 1",
              refusal([&] { robot.number("x", 0, 1); }));
    EXPECT_EQ("a.json /robots/0/y: is missing", refusal([&] { robot.number("y", 0, 1); }));
  });
  EXPECT_EQ("a.json /n: 2.5 is not allowed; whole numbers 1 to 9", refusal([&] { reader.integer("n", 1, 9); }));
  EXPECT_EQ("a.json /m: 11 is not allowed; 1 to 9", refusal([&] { reader.number("m", 1, 9); }));
}

TEST(JsonReader, RefusesKeysThatNobodyAskedFor) {
  auto reader = JsonReader::parse(R"({"size": 1, "sise": 2})", "a.json");
  reader.number("size", 0, 9);
  EXPECT_EQ("a.json: key \"sise\" is not known; known keys: size", refusal([&] { reader.finish(); }));
}

TEST(JsonReader, WholeNumbersMayBeWrittenWithAPoint) {
  auto reader = JsonReader::parse(R"({"a": 50.0, "b": 5e1, "big": 18446744073709551615, "minus": -1})", "a.json");
  EXPECT_EQ(50, reader.integer("a", 0, 100));
  EXPECT_EQ(50, reader.integer("b", 0, 100));
  EXPECT_EQ(18446744073709551615u, reader.seed("big", 0));
  EXPECT_THROW(reader.integer("big", 0, 100), InputError);
  EXPECT_THROW(reader.seed("minus", 0), InputError);
}

TEST(JsonReader, ChoicesAreWords) {
  const std::vector<Parameter> declared{{"coding", "", "bits", 0, 1, 0, {}, false, {"binary", "gray"}}};
  auto reader = JsonReader::parse(R"({"a": {"coding": "gray"}, "b": {"coding": 1}})", "a.json");
  const Values values = reader.values("a", declared);
  EXPECT_EQ((Values{{"coding", 1}}), values);
  EXPECT_EQ("gray", toJson(values, declared)["coding"]);
  EXPECT_EQ("a.json /b/coding: 1 is not allowed; one of binary, gray", refusal([&] { reader.values("b", declared); }));
}

class Files : public testing::Test {
 protected:
  const TemporaryFolder temporary;
  const std::string folder = temporary.path();
};

TEST_F(Files, WritingReplacesTheWholeContentAndLeavesNothingBeside) {
  const std::string path = folder + "/a.txt";
  writeFile(path, std::string(100000, 'x'));
  writeFile(path, std::string("a\0b", 3));
  EXPECT_EQ(std::string("a\0b", 3), readFile(path));
  EXPECT_EQ(1, std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST_F(Files, AFailedWriteLeavesTheOldContent) {
  const std::string path = folder + "/a.txt";
  writeFile(path, "old");
  EXPECT_THROW(writeFile(folder + "/none/a.txt", "new"), InputError);
  EXPECT_THROW(writeFile(folder, "new"), InputError);
  EXPECT_EQ("old", readFile(path));
}

TEST_F(Files, WritingKeepsLinksAndPermissions) {
  writeFile(folder + "/target", "old");
  ::chmod((folder + "/target").c_str(), 0640);
  std::filesystem::create_symlink(folder + "/target", folder + "/link");
  writeFile(folder + "/link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder + "/link"));
  EXPECT_EQ("new", readFile(folder + "/target"));
  struct stat status {};
  ::stat((folder + "/target").c_str(), &status);
  EXPECT_EQ(0640u, status.st_mode & 0777);
}

TEST_F(Files, OnlyRegularFilesOfAllowedSizeAreRead) {
  EXPECT_THROW(readFile(folder), InputError);
  EXPECT_THROW(readFile(folder + "/none"), InputError);
  EXPECT_THROW(readFile("/dev/zero"), InputError);
  ASSERT_EQ(0, ::mkfifo((folder + "/pipe").c_str(), 0600));
  EXPECT_THROW(readFile(folder + "/pipe"), InputError);
  writeFile(folder + "/ten", "0123456789");
  EXPECT_EQ(10u, readFile(folder + "/ten", 10).size());
  EXPECT_THROW(readFile(folder + "/ten", 9), InputError);
}

}  // namespace
}  // namespace btr
