// A moment of a session as the start of an experiment.
#include "core/live/moment_experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "core/run/setup/prepared_experiment.h"
#include "tests/live/game_files.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr::test {
namespace {

using testing::HasSubstr;

TEST(MomentExperiments, LearnWhatMovesTheRobot) {
  std::optional<Session> session(std::in_place, dogs(), host());
  GameController longer = *session->game().robots.at("red1").controller;
  longer.settings["duration_s"] = 600;
  session->apply(ControllerAct{"red1", longer});
  session->apply(ParameterAct{"red1", "length_m", 0.04});
  run(*session, 50);
  const TemporaryFolder folder;
  const std::string file = folder.file("from-here.json");
  writeExperiment(experimentOf(*session, host()), file);
  session.reset();  // a process has one world
  const ExperimentSpec experiment = loadExperiment(file);
  EXPECT_EQ(experiment.controller.name, "walk");
  EXPECT_EQ(experiment.fitness.name, "walk_speed");
  EXPECT_EQ(experiment.scene, "from-here.scene.json");
  EXPECT_FALSE(experiment.controller.settings.contains("duration_s"));  // not ten minutes a trial
  ASSERT_TRUE(experiment.start);
  EXPECT_EQ(experiment.start->parameters.at("length_m"), 0.04);
  // As a run would begin.
  const PreparedExperiment prepared = prepareFromFiles(experiment, host());
  EXPECT_EQ(prepared.sceneSpec.robots.size(), 2u);
}

TEST(MomentExperiments, SeeTheWorldFromTheRobotThatLearns) {
  Session session(dogs(), host());
  run(session, 5);
  const Eigen::Vector3d ball = session.world().ballPose(0).translation();
  const auto blue = session.world().linkPoses(1).front();
  const MomentExperiment moment = experimentOf(session, host(), "blue1");
  ASSERT_EQ(moment.scene.robots.front().name, "blue1");
  const RobotSpec& first = moment.scene.robots.front();
  EXPECT_NEAR(first.position_m[0], 0, 1e-12);
  EXPECT_NEAR(first.position_m[1], 0, 1e-12);
  EXPECT_NEAR(first.position_m[2], blue.translation().z(), 1e-12);
  EXPECT_FALSE(first.jointStart.empty());
  // Blue looks against x: what lies before it has now a positive x.
  const auto& at = moment.scene.balls.front().position_m;
  EXPECT_GT(at[0], 0.5);
  EXPECT_NEAR(std::hypot(at[0], at[1]), (ball - blue.translation()).head<2>().norm(), 1e-9);
  // It has no controller, and there is a ball.
  EXPECT_EQ(moment.experiment.controller.name, "kick");
  EXPECT_EQ(moment.experiment.fitness.name, "kick_distance");
}

TEST(MomentExperiments, WithoutABallWalk) {
  Session session(dogs(), host());
  session.apply(RemoveAct{"ball"});
  EXPECT_EQ(experimentOf(session, host(), "blue1").experiment.controller.name, "walk");
}

TEST(MomentExperiments, AreRefusedInOneSentence) {
  Session session(dogs(), host());
  EXPECT_THAT(refusal([&] { experimentOf(session, host(), "green1"); }), HasSubstr("green1"));
  session.apply(RemoveAct{"red1"});
  session.apply(RemoveAct{"blue1"});
  EXPECT_THAT(refusal([&] { experimentOf(session, host()); }), HasSubstr("a robot"));
}

}  // namespace
}  // namespace btr::test
