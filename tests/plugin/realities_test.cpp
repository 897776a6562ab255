// Where real fitness comes from: programs that answer, die, hang or answer nonsense, and a folder of files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>

#include "core/plugin/plugin_host.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "tests/plugin/built_plugins.h"
#include "tests/temporary_folder.h"

namespace btr::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

RealityContext contextOf(const std::map<std::string, std::string>& texts, const Values& settings = {}) {
  RealityContext context;
  context.database = "a.db";
  context.run = 3;
  context.texts = texts;
  context.settings = settings;
  return context;
}

class Realities : public ::testing::Test {
 protected:
  Realities() { std::signal(SIGPIPE, SIG_IGN); }

  /// A program of some lines of shell for each request that it reads.
  std::unique_ptr<RealRobot> robot(const std::string& answering, double timeout_s = 60) {
    const std::string path = folder_.file("robot.sh");
    writeFile(path, "#!/bin/sh\nwhile read -r request; do\n" + answering + "\ndone\n");
    ::chmod(path.c_str(), 0755);
    return host().reality("program")->open(contextOf({{"program", path}}, {{"timeout_s", timeout_s}}));
  }
  /// What is said of a program whose answer cannot be used.
  std::string refusalOf(const std::string& answering, double timeout_s = 60) {
    const auto opened = robot(answering, timeout_s);
    try {
      opened->measure(task_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "(none)";
  }

  TemporaryFolder folder_;
  RealTask task_{3, 17, 0, 0, {0.25, -1}};
};

TEST_F(Realities, AreThoseThatAnExperimentMayName) {
  for (const char* name : {"csv_folder", "person", "program", "stand_in"}) {
    EXPECT_NO_THROW(host().reality(name)) << name;
    EXPECT_FALSE(host().reality(name)->meaning().empty()) << name;
  }
  EXPECT_EQ(nullptr, host().reality("person")->open(contextOf({})));
  EXPECT_TRUE(host().reality("stand_in")->records({}));
}

TEST_F(Realities, AProgramGetsTheRequestAndGivesTheAnswer) {
  const auto opened = robot("echo \"$request\" >> " + folder_.file("requests") +
                            "\necho '{\"fitness\": 0.25, \"void\": true, \"note\": \"arm 7\"}'");
  const auto answer = opened->measure(task_);
  ASSERT_TRUE(answer);
  EXPECT_EQ(0.25, answer->fitness);
  EXPECT_TRUE(answer->isVoid);
  EXPECT_EQ("arm 7", answer->note);
  JsonReader request = JsonReader::parse(readFile(folder_.file("requests")), "request");
  EXPECT_EQ((std::vector<double>{0.25, -1}), request.numbers("parameters", 2));
  EXPECT_EQ(0, request.integer("repeat", 0, 100));
}

TEST_F(Realities, AVoidTrialOfAProgramNeedsNoNumber) {
  const auto answer = robot("echo '{\"void\": true, \"note\": \"it fell\"}'")->measure(task_);
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->isVoid);
  EXPECT_EQ("it fell", answer->note);
}

TEST_F(Realities, AProgramThatDiesIsSaidWithItsExitCode) {
  EXPECT_THAT(refusalOf("exit 3"), HasSubstr("robot.sh has ended without an answer (exit code 3)"));
}

TEST_F(Realities, AProgramThatHangsIsEndedAfterItsTime) {
  EXPECT_THAT(refusalOf("exec tail -f /dev/null", 1), HasSubstr("robot.sh: no answer within 1 s"));
}

TEST_F(Realities, RubbishAndImpossibleValuesAreNoAnswers) {
  EXPECT_THAT(refusalOf("echo hello"), HasSubstr("answer of"));
  EXPECT_THAT(refusalOf("echo '{\"fitness\": 1e300}'"), HasSubstr("fitness"));
  EXPECT_THAT(refusalOf("echo '{\"void\": false}'"), HasSubstr("fitness"));
  EXPECT_THAT(refusalOf("echo '{\"error\": \"the battery is empty\"}'"), HasSubstr("the battery is empty"));
}

TEST_F(Realities, AProgramThatCannotBeStartedIsNamed) {
  try {
    host().reality("program")->open(contextOf({{"program", "/nowhere/robot"}}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/robot: cannot be started"));
  }
}

TEST_F(Realities, AFolderIsAskedAndWaitedFor) {
  const std::string folder = fs::path(folder_.file("x")).parent_path().string();
  RealityContext context = contextOf({{"folder", folder}});
  context.genotype = {{"angle_rad", "rad", "an angle", 0, 1, 0}, {"points", "", "points", -2, 2, 0}};
  const auto opened = host().reality("csv_folder")->open(context);
  EXPECT_FALSE(opened->measure(task_));
  EXPECT_EQ("parameter,value,unit\nangle_rad,0.25,rad\npoints,-1,\n",
            readFile(folder_.file("run-3-individual-17.wanted.csv")));
  const auto answered = [&](const std::string& text) {
    writeFile(folder_.file("run-3-individual-17-trial-1.csv"), text);
    return opened->measure(task_);
  };
  // Still being written.
  EXPECT_FALSE(answered("value,note\n0.5,do"));
  EXPECT_FALSE(answered("value,note\n"));
  for (const char* wrong : {"value\nfar\n", "value\n1e300\n", "value\n1\n2\n", "value,value\n1,1\n", "height\n1\n",
                            "value,void\n1,perhaps\n", "value,void\n1\n", "void\n0\n"})
    EXPECT_THROW(answered(wrong), InputError) << wrong;
  const auto answer = answered("value,void,note\n0.5,0,\"done, well\"\n");
  ASSERT_TRUE(answer);
  EXPECT_EQ(0.5, answer->fitness);
  EXPECT_FALSE(answer->isVoid);
  EXPECT_EQ("done, well", answer->note);
  EXPECT_TRUE(answered("value,void\n,1\n")->isVoid);
  task_.trial = 1;
  EXPECT_FALSE(opened->measure(task_));
}

TEST_F(Realities, AFilesValueMayHaveADecimalCommaAndAUnit) {
  RealityContext context = contextOf({{"folder", fs::path(folder_.file("x")).parent_path().string()}});
  context.unit = "m";
  const auto opened = host().reality("csv_folder")->open(context);
  const auto valueIn = [&](const std::string& text) {
    writeFile(folder_.file("run-3-individual-17-trial-1.csv"), text);
    return opened->measure(task_)->fitness;
  };
  EXPECT_EQ(0.415, valueIn("value [cm];note\r\n41,5;straight\r\n"));
  EXPECT_EQ(0.415, valueIn("value_mm\n415\n"));
  EXPECT_EQ(0.5, valueIn("value\n0,5\n"));
  EXPECT_THROW(valueIn("value [kg]\n1\n"), InputError);
  EXPECT_THROW(valueIn("value,note\n0,53\n"), InputError) << "a decimal comma, or a note";
}

}  // namespace
}  // namespace btr::test
