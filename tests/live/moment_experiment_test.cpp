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
  EXPECT_TRUE(moment.experiment.stages.contains("begins"));
  const auto& at = moment.scene.balls.front().position_m;
  EXPECT_GT(at[0], 0.5);
  EXPECT_NEAR(std::hypot(at[0], at[1]), (ball - blue.translation()).head<2>().norm(), 1e-9);
  // It has no controller, and there is a ball.
  EXPECT_EQ(moment.experiment.controller.name, "kick");
  EXPECT_EQ(moment.experiment.fitness.name, "kick_distance");
}

/// Where things are at the start of a trial, and how fast.
void expectStart(const Scene& scene, const SceneSpec& moment) {
  const World world(scene, 1);
  const RobotReadings first = world.robot(0);
  const RobotSpec& robot = moment.robots.front();
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(axis);
    EXPECT_NEAR(first.base.translation()[axis], robot.position_m[at], 1e-9);
    EXPECT_NEAR(first.baseVelocity_m_s[axis], robot.velocity_m_s[at], 1e-9);
    EXPECT_NEAR(world.ball(0).position_m[axis], moment.balls.front().position_m[at], 1e-9);
  }
  for (const auto& [joint, position] : robot.jointStart) {
    const int j = scene.robots[0].model.findJoint(joint);
    EXPECT_NEAR(world.jointPositions(0)[static_cast<std::size_t>(j)], position, 1e-9) << joint;
  }
}

TEST(MomentExperiments, BeginInTheMomentsState) {
  const TemporaryFolder folder;
  for (const char* robot : {"red1", "blue1"}) {  // walks, kicks
    std::optional<Session> session(std::in_place, dogs(), host());
    run(*session, 75);
    const std::string file = folder.file(std::string(robot) + ".json");
    writeExperiment(experimentOf(*session, host(), robot), file);
    session.reset();  // a process has one world
    ExperimentSpec experiment = loadExperiment(file);
    const PreparedExperiment prepared = prepareFromFiles(experiment, host());
    expectStart(prepared.scene(prepared.spec.simulator), prepared.sceneSpec);
    const TrialResult result =
        prepared.trial(prepared.scene(prepared.spec.simulator), resolve(prepared.genotype, {}, "parameters"), 1, false);
    EXPECT_EQ(result.outcome, TrialResult::Outcome::finished) << result.detail;

    // Where the experiment asks for it, as before: in the controller's posture, over the origin.
    experiment.stages["begins"] = 0;
    const PreparedExperiment posed = prepareFromFiles(experiment, host());
    const Scene scene = posed.scene(posed.spec.simulator);
    EXPECT_EQ(scene.robots[0].startVelocity_m_s.norm(), 0);
    EXPECT_EQ(scene.robots[0].start.translation().head<2>().norm(), 0);
  }
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
