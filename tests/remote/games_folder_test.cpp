// No file path of a client leads out of the server's folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/refusal.h"
#include "tests/remote/remote_folder.h"

namespace {

using namespace btr;
using namespace btr::remote;
using btr::test::refusal;
using testing::HasSubstr;
namespace fs = std::filesystem;

class Paths : public testing::Test {
 protected:
  Paths() : folder(files.server().string(), true) {
    std::ofstream(files.file("secret.json")) << "{}";
    fs::create_directories(files.server() / "deep");
    fs::create_symlink(files.file("secret.json"), files.server() / "link.json");
    fs::create_symlink(files.outside(), files.server() / "way-out");
    fs::create_symlink(files.file("not-yet.json"), files.server() / "dangling.json");
    mkfifo((files.server() / "pipe.json").c_str(), 0600);
  }
  btr::test::RemoteFolder files;
  GamesFolder folder;
};

const std::vector<std::string> tricks{"",
                                      ".",
                                      "..",
                                      "/etc/passwd",
                                      "/etc/passwd.json",
                                      "../secret.json",
                                      "deep/../../secret.json",
                                      "deep/../ball.json",
                                      "./../secret.json",
                                      "link.json",
                                      "way-out/secret.json",
                                      "way-out/server/../secret.json",
                                      "deep",
                                      "pipe.json",
                                      "ball.json/",
                                      "ball.json\n",
                                      "..\\secret.json",
                                      "deep/\x01/ball.json",
                                      std::string("ball.json\0.json", 15),
                                      std::string("/MS/../secret.json"),
                                      std::string(5000, 'a') + ".json",
                                      "robots/ers7.wrl",
                                      "file:///etc/passwd",
                                      "~/secret.json",
                                      "none.json"};

TEST_F(Paths, OutsideAndAbsentOnesSoundTheSame) {
  for (const std::string& trick : tricks)
    EXPECT_THAT(refusal([&] { folder.file(trick, {".json"}, "game"); }), HasSubstr("a file below the server's folder"))
        << trick;
  EXPECT_EQ((files.server() / "ball.json").string(), folder.file("ball.json", {".json"}, "game"));
  EXPECT_EQ((files.server() / "robots/ers7.wrl").string(), folder.file("robots/ers7.wrl", {".wrl"}, "game"));
}

TEST_F(Paths, ToWriteToLeadNowhereElse) {
  for (const std::string& trick : tricks) {
    if (trick == "none.json" || trick.starts_with("~")) continue;  // names like any other
    EXPECT_NE("accepted", refusal([&] { folder.toWrite(trick, "file"); })) << trick;
  }
  EXPECT_NE("accepted", refusal([&] { folder.toWrite("dangling.json", "file"); }));
  EXPECT_NE("accepted", refusal([&] { folder.toWrite("new.txt", "file"); }));
  EXPECT_NE("accepted", refusal([&] { folder.toWrite("way-out/new.json", "file"); }));
  EXPECT_EQ((fs::canonical(files.server()) / "new/one.json").string(), folder.toWrite("new/one.json", "file"));
  EXPECT_FALSE(fs::exists(files.server() / "new"));
  const GamesFolder readOnly(files.server().string(), false);
  EXPECT_THAT(refusal([&] { readOnly.toWrite("new.json", "file"); }), HasSubstr("not given a folder to write to"));
}

TEST_F(Paths, InsideAGamesTextAreJudgedToo) {
  const auto said = [&](const std::string& text, const std::string& directory = "") {
    return refusal(
        [&] { folder.judgeGame(nlohmann::json::parse(text), folder.folder(directory, "directory"), "game"); });
  };
  EXPECT_EQ("accepted", said(R"({"scene": {"robots": [{"model": "robots/ers7.wrl"}]}})"));
  EXPECT_EQ("accepted", said(R"({"scene": {"robots": [{"model": "../robots/ers7.wrl"}]}})", "deep"));
  EXPECT_EQ("accepted", said(R"({"scene": "scenes/kick.json"})"));
  for (const char* bad :
       {R"({"scene": {"robots": [{"model": "../secret.json"}]}})", R"({"scene": "../secret.json"})",
        R"({"scene": "/etc/passwd"})", R"({"scene": {}, "field": "way-out/secret.json"})",
        R"({"robots": [{"model": "/etc/passwd"}]})", R"({"scene": {"robots": [{"model": "pipe.json"}]}})"})
    EXPECT_THAT(said(bad), HasSubstr("a file below the server's folder")) << bad;
  EXPECT_NE("accepted", said("{}", "way-out"));
  EXPECT_NE("accepted", said("{}", ".."));
}

TEST(Json, InMoreLevelsThanAnyGameHasIsRefusedBeforeItIsRead) {
  EXPECT_EQ("accepted", refusal([] { requireShallow(R"({"a": [[["[[[\"]]]", 1]]]})", "x"); }));
  EXPECT_EQ("accepted", refusal([] { requireShallow("\"" + std::string(1000, '[') + "\"", "x"); }));
  EXPECT_THAT(refusal([] { requireShallow(std::string(1000000, '['), "x"); }), HasSubstr("64 levels"));
}

}  // namespace
