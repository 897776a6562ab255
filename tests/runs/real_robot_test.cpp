// Where real fitness comes from: programs that answer, die, hang or answer nonsense, and a folder of files.
#include "core/run/robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>

#include "core/spec/error.h"
#include "tests/runs/small_kick_run.h"

namespace btr::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class RealRobots : public ::testing::Test {
 protected:
  RealRobots() { std::signal(SIGPIPE, SIG_IGN); }

  /// A program of one line of shell for each request that it reads.
  std::string program(const std::string& answering) {
    const std::string path = folder_.file("robot.sh");
    writeFile(path, "#!/bin/sh\nwhile read -r request; do\n" + answering + "\ndone\n");
    ::chmod(path.c_str(), 0755);
    return path;
  }
  SmallKickRun measuredBy(const nlohmann::json& reality) {
    return SmallKickRun(6, 2, [&](nlohmann::json& text) { text["reality"] = reality; });
  }
  static nlohmann::json byProgram(const std::string& path, double timeout_s = 60) {
    return {{"name", "program"}, {"settings", {{"program", path}, {"timeout_s", timeout_s}}}};
  }
  /// What a run says that cannot use the program's answers; nothing of them may be stored.
  std::string refusalOf(const std::string& answering, double timeout_s = 60) {
    SmallKickRun run = measuredBy(byProgram(program(answering), timeout_s));
    try {
      run.goOn();
    } catch (const InputError& error) {
      EXPECT_TRUE(run.database_.measurements(run.run_).empty());
      return error.what();
    }
    return "(none)";
  }
  TemporaryFolder folder_;
};

TEST_F(RealRobots, AProgramAnswersAndEachValueSaysFromWhere) {
  SmallKickRun run = measuredBy(byProgram(program("echo '{\"fitness\": 0.25, \"note\": \"arm 7\"}'")));
  ASSERT_EQ(RunEnd::finished, run.goOn());
  const auto measured = run.database_.measurements(run.run_);
  ASSERT_EQ(4u, measured.size());
  for (const MeasurementRecord& value : measured) {
    EXPECT_EQ(0.25, value.value);
    EXPECT_EQ("arm 7", value.note);
    EXPECT_EQ("program", value.source);
  }
  EXPECT_EQ("program", run.database_.run(run.run_).reality);
}

TEST_F(RealRobots, AProgramThatDiesIsSaidWithItsExitCode) {
  EXPECT_THAT(refusalOf("exit 3"), HasSubstr("robot.sh has ended without an answer (exit code 3)"));
}

TEST_F(RealRobots, AProgramThatHangsIsEndedAfterItsTime) {
  EXPECT_THAT(refusalOf("exec tail -f /dev/null", 1), HasSubstr("robot.sh: no answer within 1 s"));
}

TEST_F(RealRobots, RubbishAndImpossibleValuesAreNoAnswers) {
  EXPECT_THAT(refusalOf("echo hello"), HasSubstr("answer of"));
  EXPECT_THAT(refusalOf("echo '{\"fitness\": 1e300}'"), HasSubstr("fitness"));
  EXPECT_THAT(refusalOf("echo '{\"void\": false}'"), HasSubstr("fitness"));
  EXPECT_THAT(refusalOf("echo '{\"error\": \"the battery is empty\"}'"), HasSubstr("the battery is empty"));
}

TEST_F(RealRobots, AProgramThatIsNotThereIsRefusedBeforeTheRun) {
  EXPECT_THROW(measuredBy(byProgram("/nowhere/robot")), InputError);
  EXPECT_THROW(measuredBy({{"name", "program"}}), InputError);
  EXPECT_THROW(measuredBy("dream"), InputError);
}

TEST_F(RealRobots, AFolderIsAskedAndWaitedFor) {
  SmallKickRun run = measuredBy(
      {{"name", "csv_folder"}, {"settings", {{"folder", fs::path(folder_.file("x")).parent_path().string()}}}});
  ASSERT_EQ(RunEnd::waiting, run.goOn());
  const auto answer = [&](const std::string& text) {
    for (const MeasurementTask& task : run.database_.measurementTasks(run.run_)) {
      const std::string name = "run-" + std::to_string(run.run_) + "-individual-" + std::to_string(task.individual);
      EXPECT_TRUE(fs::exists(folder_.file(name + ".wanted.csv")));
      writeFile(folder_.file(name + "-trial-1.csv"), text);
    }
  };
  // Not yet whole, then wrong, then right.
  answer("value,note\n0.5,do");
  ASSERT_EQ(RunEnd::waiting, run.goOn());
  answer("value\nfar\n");
  EXPECT_THROW(run.goOn(), InputError);
  EXPECT_TRUE(run.database_.measurements(run.run_).empty());
  answer("value,note\n0.5,\"done, well\"\n");
  ASSERT_EQ(RunEnd::waiting, run.goOn());  // of the second stage nothing was measured yet
  const auto measured = run.database_.measurements(run.run_);
  ASSERT_EQ(2u, measured.size());
  EXPECT_EQ(0.5, measured[0].value);
  EXPECT_EQ("done, well", measured[0].note);
  EXPECT_EQ("csv_folder", measured[0].source);
}

}  // namespace
}  // namespace btr::test
