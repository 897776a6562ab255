// Inline may reach only regular files in the folder of the main file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/model/model_texts.h"
#include "tests/temporary_folder.h"

namespace btr::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A folder of its own for each test, with a file beside it that must not be read.
class Inline : public testing::Test {
 protected:
  Inline() {
    fs::create_directories(outside_ / "robot" / "parts");
    write("../secret.wrl", vrmlHeader + sphere);
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(outside_ / "robot" / name) << text;
  }
  RobotModel load(const std::string& children, const ModelBudget& budget = {}) const {
    write("main.wrl", robotWith(children));
    return loadModel((outside_ / "robot" / "main.wrl").string(), budget);
  }
  /// The only warning; nothing must have been read.
  std::string warningOf(const std::string& url) const {
    const RobotModel model = load("Inline { url \"" + url + "\" }");
    EXPECT_TRUE(model.links.at(0).shapes.empty()) << url;
    EXPECT_EQ(1u, model.warnings.size()) << url;
    return model.warnings.empty() ? "" : model.warnings[0].text;
  }

  const std::string sphere = "Shape { geometry Sphere { radius 0.5 } }\n";
  const TemporaryFolder temporary_;
  const fs::path outside_ = temporary_.path();
};

TEST_F(Inline, ReadsPartsBelowTheFolderWithOrWithoutHeader) {
  write("parts/leg.wrl", vrmlHeader + sphere + "Inline { url \"foot.wrl\" }");
  write("parts/foot.wrl", sphere);
  const auto model = load("Transform { translation 0 0 1 children Inline { url [ \"parts/leg.wrl\" ] } }");
  ASSERT_EQ(2u, model.links.at(0).shapes.size());
  EXPECT_EQ(Eigen::Vector3d(0, 0, 1), model.links[0].shapes[1].pose.translation());
  EXPECT_TRUE(model.warnings.empty());
}

TEST_F(Inline, WarningsNameTheInlinedFile) {
  write("part.wrl", vrmlHeader + "\nOdd { }");
  EXPECT_THAT(load("Inline { url \"part.wrl\" }").warnings.at(0).text, HasSubstr("part.wrl:3: the node Odd"));
}

TEST_F(Inline, ErrorsNameTheInlinedFile) {
  write("part.wrl", vrmlHeader + "\nGroup { odd 1 }");
  EXPECT_THAT(refusal([&] { load("Inline { url \"part.wrl\" }"); }), HasSubstr("part.wrl:3: Group has no field odd"));
}

TEST_F(Inline, RefusesEverythingOutside) {
  EXPECT_THAT(warningOf("/etc/passwd"), HasSubstr("only a relative path"));
  EXPECT_THAT(warningOf("/dev/zero"), HasSubstr("only a relative path"));
  EXPECT_THAT(warningOf("http://example.org/x.wrl"), HasSubstr("no address"));
  EXPECT_THAT(warningOf("file:///etc/passwd"), HasSubstr("no address"));
  EXPECT_THAT(warningOf("../secret.wrl"), HasSubstr("\"..\" may not be used"));
  EXPECT_THAT(warningOf("parts/../../secret.wrl"), HasSubstr("\"..\" may not be used"));
  EXPECT_THAT(warningOf("nothing.wrl"), HasSubstr("no such file"));
  EXPECT_THAT(warningOf("parts"), HasSubstr("not a regular file"));
  EXPECT_THAT(warningOf(""), HasSubstr("not a file name"));
}

TEST_F(Inline, RefusesLinksThatLeadOutAndDevices) {
  fs::create_symlink("../secret.wrl", outside_ / "robot" / "link.wrl");
  fs::create_symlink("/dev/zero", outside_ / "robot" / "zero.wrl");
  EXPECT_THAT(warningOf("link.wrl"), HasSubstr("leads out of the folder"));
  EXPECT_THAT(warningOf("zero.wrl"), HasSubstr("leads out of the folder"));
}

TEST_F(Inline, AFileMayNotContainItself) {
  EXPECT_THAT(refusal([&] { load("Inline { url \"main.wrl\" }"); }), HasSubstr("a file may not contain itself"));
  write("a.wrl", "Inline { url \"b.wrl\" }");
  write("b.wrl", "Inline { url \"a.wrl\" }");
  EXPECT_THAT(refusal([&] { load("Inline { url \"a.wrl\" }"); }),
              HasSubstr("b.wrl:1: Inline \"a.wrl\": a file may not contain itself"));
}

TEST_F(Inline, DepthFilesAndBytesAreLimited) {
  for (int i = 0; i < 20; ++i)
    write("d" + std::to_string(i) + ".wrl", "Inline { url \"d" + std::to_string(i + 1) + ".wrl\" }");
  EXPECT_THAT(refusal([&] { load("Inline { url \"d0.wrl\" }"); }), HasSubstr("Inline deeper than 8"));
  write("part.wrl", sphere);
  EXPECT_THAT(refusal([&] { load(repeated("Inline { url \"part.wrl\" } ", 65)); }),
              HasSubstr("more than 64 inlined files"));
  write("big.wrl", sphere + repeated(" ", 5000));
  ModelBudget budget;
  budget.bytes = 6000;
  EXPECT_THAT(refusal([&] { load(repeated("Inline { url \"big.wrl\" } ", 2), budget); }),
              HasSubstr("more than 6000 bytes"));
}

TEST_F(Inline, ExternProtoIsNotFetchedAndFallsBackToTheVocabulary) {
  write("main.wrl", vrmlHeader + "EXTERNPROTO Joint [ field SFString jointType ] \"/etc/passwd#Foo\"\n" +
                        "EXTERNPROTO Foo [ ] [ \"../secret.wrl#Foo\" ]\nFoo { }\n" +
                        robotWith("").substr(vrmlHeader.size()));
  const auto model = loadModel((outside_ / "robot" / "main.wrl").string());
  ASSERT_EQ(3u, model.warnings.size());
  EXPECT_THAT(model.warnings[0].text, HasSubstr("EXTERNPROTO Joint was not followed"));
  EXPECT_EQ(model.warnings[0].loss, Warning::Loss::none);  // the Joint of the vocabulary stands for it
  EXPECT_EQ(model.warnings[2].loss, Warning::Loss::collision) << model.warnings[2].text;  // and nothing for Foo
  EXPECT_EQ("BASE", model.links.at(0).name);
}

TEST_F(Inline, IsRefusedInTextsFromMemory) {
  const auto model = parseVrml(robotWith("Inline { url \"robot/main.wrl\" }"), "memory");
  EXPECT_THAT(model.warnings.at(0).text, HasSubstr("was not followed"));
  // What it held collides with nothing: that is said where the robot is simulated.
  EXPECT_EQ(model.warnings.at(0).loss, Warning::Loss::collision);
}

TEST_F(Inline, UrlGivenThroughAProtoIsCheckedToo) {
  write("main.wrl", robotWith("From { where \"/etc/passwd\" }",
                              "PROTO From [ field MFString where [ ] ] { Inline { url IS where } }"));
  const auto model = loadModel((outside_ / "robot" / "main.wrl").string());
  EXPECT_THAT(model.warnings.at(0).text, HasSubstr("only a relative path"));
}

TEST_F(Inline, OnlyKnownEndingsAreLoaded) {
  write("main.obj", "x");
  EXPECT_THAT(refusal([&] { loadModel((outside_ / "robot" / "main.obj").string()); }),
              HasSubstr("robots are .wrl (VRML97) or .urdf"));
  EXPECT_NE("accepted", refusal([&] { loadModel((outside_ / "robot" / "missing.wrl").string()); }));
}

}  // namespace
}  // namespace btr::test
