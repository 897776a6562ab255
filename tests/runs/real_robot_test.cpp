// Where real fitness comes from is settled before a run begins; what a robot answers is looked at before it counts.
#include "core/run/loop/robot.h"
#include "core/run/loop/waiting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "core/spec/error.h"
#include "tests/refusal.h"
#include "tests/runs/small_kick_run.h"

namespace btr::test {
namespace {

SmallKickRun measuredBy(const nlohmann::json& reality) {
  return SmallKickRun(2, 2, [&](nlohmann::json& text) { text["reality"] = reality; });
}

TEST(RealRobots, WhatIsNotThereIsRefusedBeforeTheRun) {
  EXPECT_THROW(measuredBy("dream"), InputError);
  EXPECT_THROW(measuredBy({{"name", "program"}}), InputError);
  EXPECT_THROW(measuredBy({{"name", "program"}, {"settings", {{"program", "/nowhere/robot"}}}}), InputError);
  EXPECT_THROW(measuredBy({{"name", "csv_folder"}, {"settings", {{"folder", "/nowhere"}}}}), InputError);
  EXPECT_THROW(measuredBy({{"name", "person"}, {"settings", {{"patience", 1}}}}), InputError);
}

/// A robot that answers with these fitnesses, one after another, and with the last one from then on.
class Rig {
 public:
  Rig() { std::signal(SIGPIPE, SIG_IGN); }
  void answers(const std::vector<std::string>& all) {
    std::string text = "#!/bin/sh\n";
    const auto say = [](const std::string& answer) { return "echo '{\"fitness\": " + answer + "}'\n"; };
    for (const std::string& answer : all) text += "read -r request && " + say(answer);
    folder_.write("rig", text + "while read -r request; do " + say(all.back()) + "done\n");
    std::filesystem::permissions(path(), std::filesystem::perms::owner_all);
  }
  std::string path() const { return folder_.file("rig"); }
  nlohmann::json asReality() const { return {{"name", "program"}, {"settings", {{"program", path()}}}}; }

 private:
  TemporaryFolder folder_;
};

TEST(RealRobots, AnImpossibleValueIsRefusedAndTheOthersStay) {
  Rig rig;
  rig.answers({"0.4", "-1"});
  SmallKickRun run = measuredBy(rig.asReality());
  const std::string said = refusal([&] { run.goOn(); });
  EXPECT_THAT(said, testing::HasSubstr("measured by program: -1 m is not possible"));
  EXPECT_EQ(1u, run.database_.measurements(run.run_).size());
  // Who looks at the run later reads why it waits.
  EXPECT_EQ(RunState::waiting, run.database_.run(run.run_).state);
  EXPECT_EQ(said, run.database_.run(run.run_).message);
}

TEST(RealRobots, WhatARobotThatFailedSaidIsKeptWithTheRunUntilItGoesOn) {
  Rig rig;
  rig.answers({"\"far\""});
  SmallKickRun run = measuredBy(rig.asReality());
  const std::string said = refusal([&] { run.goOn(); });
  EXPECT_THAT(said, testing::HasSubstr("/fitness: \"far\" is not allowed"));
  EXPECT_EQ(said, run.database_.run(run.run_).message);
  rig.answers({"0.4"});
  EXPECT_EQ(RunEnd::finished, run.goOn());
  EXPECT_EQ("", run.database_.run(run.run_).message);
}

TEST(RealRobots, WhatARobotThatFailedSaidHoldsUntilAValueIsEntered) {
  Rig rig;
  rig.answers({"\"far\""});
  SmallKickRun run = measuredBy(rig.asReality());
  const std::string said = refusal([&] { run.goOn(); });
  const auto saysNow = [&] { return messageNow(run.database_, run.database_.run(run.run_)); };
  EXPECT_EQ(said, saysNow());
  const auto enter = [&](const MeasurementTask& task) {
    run.database_.addMeasurement(
        {.run = run.run_, .individual = task.individual, .value = 0.4, .enteredAt = "2099-01-01T00:00:00Z"});
  };
  const std::vector<MeasurementTask> tasks = run.database_.measurementTasks(run.run_, 1);
  enter(tasks[0]);
  EXPECT_EQ("measurement stage 1: 1 of 2 individuals wait for real fitness", saysNow());
  enter(tasks[1]);
  EXPECT_EQ("measurement stage 1: all values are entered; btr run goes on", saysNow());
}

TEST(RealRobots, ADoubtfulValueWaitsForAPersonWhoConfirmsIt) {
  Rig rig;
  rig.answers({"0.4", "41"});
  SmallKickRun run = measuredBy(rig.asReality());
  const std::string said = refusal([&] { run.goOn(); });
  EXPECT_THAT(said, testing::HasSubstr("41 m is about 100 times larger"));
  EXPECT_THAT(said, testing::HasSubstr("; nothing was stored; if it is right: btr fitness enter --db "));
  EXPECT_THAT(said, testing::HasSubstr(" --value 41 --yes"));
  ASSERT_EQ(1u, run.database_.measurements(run.run_).size());

  // It was a slip of the rig's: asked again it answers what can be.
  rig.answers({"0.41"});
  EXPECT_EQ(RunEnd::finished, run.goOn());
  for (const MeasurementRecord& m : run.database_.measurements(run.run_)) EXPECT_LT(m.value, 1);
}

}  // namespace
}  // namespace btr::test
