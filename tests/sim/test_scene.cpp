// From a scene file's values and a model to a scene that can be built.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/sim/world/scene_build.h"
#include "tests/refusal.h"
#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Scene made(const RobotModel& model, const std::string& base, bool mergeFixed = true) {
  SceneSpec spec;
  RobotSpec robot;
  robot.name = "rig";
  robot.model = "rig.urdf";
  robot.base = base;
  robot.mergeFixed = mergeFixed;
  spec.robots = {robot};
  return makeScene(spec, {{"rig.urdf", std::make_shared<const RobotModel>(model)}}, {}, {});
}

std::string refusal(const RobotModel& model, const std::string& base, bool mergeFixed = true) {
  return test::refusal([&] { made(model, base, mergeFixed); });
}

TEST(SceneBase, ARootWithoutMassIsRefusedOnAFreeBaseOnly) {
  RobotModel model = pendulumModel(0.5, 0.2, 0.001);
  model.links[0].inertial = {};
  EXPECT_THAT(refusal(model, "free"), AllOf(HasSubstr("robots.rig.base"), HasSubstr("free"), HasSubstr("fixed"),
                                            HasSubstr("stand"), HasSubstr("no mass")));
  EXPECT_EQ(refusal(model, "fixed"), "accepted");
  EXPECT_EQ(refusal(pendulumModel(0.5, 0.2, 0.001), "free"), "accepted");
}

TEST(SceneBase, WhatIsRigidlyFixedToTheRootGivesItItsMass) {
  RobotModel model = bodyModel(0, {0, 0, 0}, {});
  model.links.push_back(link("ballast", 1, {0, 0, 0}, {0.01, 0.01, 0.01}));
  model.joints.push_back(joint("bolt", 0, {0, 0, 1}, {0, 0, 0}, Joint::Type::fixed));
  EXPECT_EQ(refusal(model, "free"), "accepted");
  EXPECT_THAT(refusal(model, "free", false), HasSubstr("no mass"));
  World world(made(model, "free"), 1);
  world.advance({{JointInput{}}}, 0.1);
  EXPECT_EQ("", world.fault());
}

TEST(SceneServo, TakesItsNoLoadSpeedFromTheModelAndFromTheScene) {
  RobotModel model = pendulumModel(0.5, 0.2, 0.001);
  EXPECT_EQ(0, made(model, "fixed").robots[0].drives[0].noLoadSpeed_rad_s);
  model.joints[0].servo.noLoadSpeed_rad_s = 5.28;
  EXPECT_EQ(5.28, made(model, "fixed").robots[0].drives[0].noLoadSpeed_rad_s);

  SceneSpec spec;
  RobotSpec robot;
  robot.name = "rig";
  robot.model = "rig.urdf";
  robot.base = "fixed";
  const ModelSet models{{"rig.urdf", std::make_shared<const RobotModel>(model)}};
  robot.servos["hinge"].numbers = {{"no_load_speed_rad_s", 3}};
  spec.robots = {robot};
  EXPECT_EQ(3, makeScene(spec, models, {}, {}).robots[0].drives[0].noLoadSpeed_rad_s);
  SimulatorSpec simulator;
  simulator.values = {{"robots.rig.servos.hinge.no_load_speed_rad_s", 4}};
  EXPECT_EQ(4, makeScene(spec, models, simulator, {}).robots[0].drives[0].noLoadSpeed_rad_s);
  // Other drives have no such line.
  spec.robots[0].servos["hinge"] = ServoSpec{};
  spec.robots[0].servos["hinge"].drive = "dc_motor";
  EXPECT_EQ(0, makeScene(spec, models, {}, {}).robots[0].drives[0].noLoadSpeed_rad_s);
}

RobotModel kneeFrom(double lower, double upper) {
  RobotModel model = pendulumModel(0.5, 0.2, 0.001);
  model.joints[0].lower = lower;
  model.joints[0].upper = upper;
  return model;
}

Scene startedAt(const RobotModel& model, const std::string& joint, double start) {
  SceneSpec spec;
  RobotSpec robot;
  robot.name = "rig";
  robot.model = "rig.urdf";
  robot.base = "fixed";
  robot.jointStart = {{joint, start}};
  spec.robots = {robot};
  return makeScene(spec, {{"rig.urdf", std::make_shared<const RobotModel>(model)}}, {}, {});
}

TEST(SceneStart, AJointWhoseStopExcludesZeroStartsAtItsNearestLimitAndStaysThere) {
  const Scene scene = made(kneeFrom(-2.7, -0.92), "fixed");
  EXPECT_EQ(-0.92, scene.robots[0].jointStart[0]);
  EXPECT_EQ(0.5, made(kneeFrom(0.5, 2), "fixed").robots[0].jointStart[0]);
  // Zero beyond the limit, but before the stop, is where it always was: an ERS-7's mouth.
  EXPECT_EQ(0, made(kneeFrom(-0.96, -0.0524), "fixed").robots[0].jointStart[0]);
  EXPECT_EQ(0, made(kneeFrom(-1, 1), "fixed").robots[0].jointStart[0]);

  World world(weightless(scene), 1);
  for (int i = 0; i < 20; ++i) world.advance(commands(scene, scene.robots[0].jointStart[0]), 0.008);
  EXPECT_NEAR(-0.92, world.robot(0).position[0], 1e-9);
  EXPECT_NEAR(0, world.robot(0).rate[0], 1e-9);
}

TEST(SceneStart, AFollowerStartsWhereItsLeaderPutsIt) {
  RobotModel model = kneeFrom(0.5, 2);
  model.links.push_back(link("tip", 0.1, {0, 0, -0.1}, {1e-4, 1e-4, 1e-4}));
  model.joints.push_back(joint("tip", 1, {0, 1, 0}));
  model.joints[1].mimic = Mimic{0, 2, 0.1};
  EXPECT_EQ(std::vector<double>({0.5, 1.1}), made(model, "fixed").robots[0].jointStart);
}

TEST(SceneStart, BeyondAStopIsRefusedAndBetweenLimitAndStopIsNot) {
  const RobotModel knee = kneeFrom(-2.7, -0.92);
  EXPECT_EQ(-0.85, startedAt(knee, "hinge", -0.85).robots[0].jointStart[0]);
  EXPECT_EQ("accepted", test::refusal([&] { startedAt(knee, "hinge", -2.7873); }));
  EXPECT_EQ(
      "scene robots.rig.joint_start.hinge: 0 is not allowed; -2.7873 to -0.8327 rad, where the mechanical stops "
      "of the model rig are",
      test::refusal([&] { startedAt(knee, "hinge", 0); }));
  RobotModel rail = carriageModel(1);
  rail.joints[0].lower = 0;
  rail.joints[0].upper = 0.04;
  EXPECT_EQ("accepted", test::refusal([&] { startedAt(rail, "rail", 0.04); }));
  EXPECT_THAT(test::refusal([&] { startedAt(rail, "rail", 0.05); }),
              AllOf(HasSubstr("joint_start.rail: 0.05 is not allowed"), HasSubstr("0 to 0.04 m")));
}

}  // namespace
TEST(ScenePaths, LeadToLimitsOfJointsAndToObstacles) {
  RobotModel model = pendulumModel(0.5, 0.2, 0.001);
  model.joints[0].lower = -1;
  model.joints[0].upper = 2;
  Scene scene = made(model, "fixed");
  scene.obstacles.push_back({.name = "wall"});
  const std::string joint = "robots.rig.joints." + model.joints[0].name;
  EXPECT_EQ(numberByPath(scene, joint + ".upper_rad"), 2);
  setByPath(scene, joint + ".lower_rad", -0.4);
  EXPECT_EQ(scene.robots[0].model.joints[0].lower, -0.4);
  setByPath(scene, "obstacles.wall.restitution", 0.55);
  setByPath(scene, "obstacles.wall.friction", 0.2);
  EXPECT_EQ(scene.obstacles[0].restitution, 0.55);
  EXPECT_EQ(scene.obstacles[0].friction, 0.2);
  EXPECT_THAT(test::refusal([&] { setByPath(scene, "obstacles.post.friction", 0.2); }),
              AllOf(HasSubstr("obstacles.post.friction"), HasSubstr("wall")));
  EXPECT_NE("accepted", test::refusal([&] { setByPath(scene, joint + ".upper_m", 0.2); }));
  EXPECT_THAT(test::refusal([&] { setByPath(scene, joint + ".viscous_friction_n_s_m", 0.2); }),
              HasSubstr("one of coulomb_friction_nm, viscous_friction_nm_s_rad"));
  scene.robots[0].model.joints[0].upper = 1e9;
  EXPECT_NE("accepted", test::refusal([&] { setByPath(scene, joint + ".upper_rad", 0.2); })) << "there is no limit";
}

}  // namespace btr::test
