// A controller that never answers again, or crashes, is named; the log is complete up to the last act.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>

#include "core/live/session_log.h"
#include "core/spec/json_reader.h"
#include "tests/live/game_files.h"
#include "tests/temporary_folder.h"

namespace btr::test {
namespace {

using testing::HasSubstr;

struct Ended {
  int code;
  std::string out, err;
};

/// btr live with these words, the lines on standard input; a plugin "spin" drives red1.
Ended live(const TemporaryFolder& folder, const std::string& settings, const std::string& words,
           const std::string& lines = "") {
  const std::string at = folder.file("stuck.");
  std::string text = dogsText();
  const std::string walk = R"("plugin": "walk")";
  text.replace(text.find(walk), walk.size(), R"("plugin": "spin", "settings": {)" + settings + "}");
  std::ofstream(at + "json") << text;
  std::ofstream(at + "in") << lines;
  const std::string command = "UCHILSIM_PLUGINS='" STUCK_DIR "' '" BTR_PROGRAM "' " + words + " live '" + at +
                              "json' --log '" + at + "log' " + (lines.empty() ? "" : "--steered") +
                              " --patience 0.1 < '" + at + "in' > '" + at + "out' 2> '" + at + "err'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(at + "out"), readFile(at + "err")};
}

TEST(HangingController, IsNamedAndEndsTheSessionWithItsLogWhole) {
  const TemporaryFolder folder;
  const Ended end = live(folder, "", "",
                         R"({"do": "step", "periods": 3})"
                         "\n"
                         R"({"act": "throw", "object": "ball", "velocity_m_s": [1, 0, 0]})"
                         "\n"
                         R"({"do": "step", "periods": 100})"
                         "\n");
  EXPECT_EQ(end.code, 1);
  EXPECT_THAT(end.err, HasSubstr("red1's controller \"spin\" has not answered for 0.1 s"));
  EXPECT_THAT(end.err, HasSubstr("the world stopped: red1's controller \"spin\" has not answered for 1"));
  EXPECT_THAT(end.out, HasSubstr(R"({"hangs":"red1's controller \"spin\" has not answered for 0.1 s"})"));
  EXPECT_THAT(end.out, HasSubstr(R"({"fault":"red1's controller \"spin\" has not answered for 1)"));
  const SessionLog log = loadSessionLog(folder.file("stuck.log"));
  ASSERT_EQ(log.acts.size(), 1u);
  EXPECT_EQ(log.acts[0].period, 3);
}

TEST(HangingController, ThatAnswersInTheEndOnlyGetsItsName) {
  const TemporaryFolder folder;
  const Ended end = live(folder, R"("pause_s": 0.3, "after_s": 9.98)", "--json");
  EXPECT_EQ(end.code, 0);
  EXPECT_THAT(end.err, HasSubstr("red1's controller \"spin\" has not answered for 0.1 s"));
  EXPECT_THAT(end.out, HasSubstr("trace_sha256"));
}

TEST(HangingController, ThatCrashesIsNamed) {
  const TemporaryFolder folder;
  const Ended end = live(folder, R"("how": 1)", "");
  EXPECT_THAT(end.err, HasSubstr("the controller plugin \"spin\" crashed (signal 6)"));
}

}  // namespace
}  // namespace btr::test
