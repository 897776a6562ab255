// Bodies and joints against mechanics.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

TEST(World, FreeFallIsTheParabolaWhateverTheStep) {
  for (const double step : {0.00025, 0.001, 0.008}) {
    Scene scene = sceneOf(robot(bodyModel(2, {0.1, 0.2, 0.3}, {}), true), step);
    scene.robots[0].start.translation() << 0, 0, 10;
    BallSpec ball;
    ball.position_m = {5, 0, 10};
    ball.velocity_m_s = {1, 0, 2};
    scene.balls = {ball};
    World world(scene, 1);
    world.advance(commands(scene, 0), 0.8);
    EXPECT_NEAR(10 - g * 0.8 * 0.8 / 2, world.robot(0).base.translation().z(), 1e-9);
    EXPECT_NEAR(-g * 0.8, world.robot(0).baseVelocity_m_s.z(), 1e-9);
    EXPECT_NEAR(5.8, world.ball(0).position_m.x(), 1e-9);
    EXPECT_NEAR(10 + 2 * 0.8 - g * 0.8 * 0.8 / 2, world.ball(0).position_m.z(), 1e-9);
  }
}

TEST(World, AThrownBodyBeginsWithItsVelocityAndSpin) {
  Scene scene = sceneOf(robot(bodyModel(2, {0.1, 0.1, 0.3}, {}), true), 0.001);
  scene.robots[0].start.translation() << 0, 0, 10;
  scene.robots[0].startVelocity_m_s << 1, -0.5, 3;
  scene.robots[0].startSpin_rad_s << 0, 0, 2;
  World world(scene, 1);
  EXPECT_EQ(world.robot(0).baseVelocity_m_s, scene.robots[0].startVelocity_m_s);
  world.advance(commands(scene, 0), 0.8);
  const Eigen::Isometry3d base = world.robot(0).base;
  EXPECT_NEAR(0.8, base.translation().x(), 1e-9);
  EXPECT_NEAR(-0.4, base.translation().y(), 1e-9);
  EXPECT_NEAR(10 + 3 * 0.8 - g * 0.8 * 0.8 / 2, base.translation().z(), 1e-9);
  EXPECT_NEAR(1.6, std::atan2(base.linear()(1, 0), base.linear()(0, 0)), 1e-6);
}

TEST(World, AFallingAccelerometerFeelsNothing) {
  RobotModel model = bodyModel(2, {0.1, 0.2, 0.3}, {});
  model.sensors = {Sensor{.name = "ACCEL"}};
  Scene scene = sceneOf(robot(model, true), 0.001);
  World world(scene, 1);
  EXPECT_NEAR(g, world.robot(0).accelerometer_m_s2.z(), 1e-12) << "before the fall it rests";
  world.advance(commands(scene, 0), 0.008);
  EXPECT_NEAR(0, world.robot(0).accelerometer_m_s2.norm(), 1e-9);
}

// Time between two upward crossings of zero, interpolated.
double periodOf(double amplitude, double step) {
  const double mass = 0.5, length = 0.3, inertia = 0.004;
  Scene scene = sceneOf(robot(pendulumModel(mass, length, inertia), false), step, step);
  scene.robots[0].jointStart = {amplitude};
  World world(scene, 1);
  double before = amplitude, first = -1;
  for (;;) {
    world.advance(commands(scene, 0), step);
    const double now = world.robot(0).position[0];
    if (before < 0 && now >= 0) {
      const double crossing = world.time() - step * now / (now - before);
      if (first >= 0) return crossing - first;
      first = crossing;
    }
    before = now;
  }
}

TEST(World, PendulumSwingsWithItsPeriodAtAnyAmplitude) {
  const double mass = 0.5, length = 0.3, inertia = 0.004;
  const double small = 2 * M_PI * std::sqrt((inertia + mass * length * length) / (mass * g * length));
  for (const double amplitude : {0.02, 0.5, 1.5, 2.5}) {
    // T = T0 · 2/π · K(sin(amplitude/2)): the complete elliptic integral.
    const double expected = small * 2 / M_PI * std::comp_ellint_1(std::sin(amplitude / 2));
    EXPECT_NEAR(expected, periodOf(amplitude, 0.0005), 3e-5 * expected) << amplitude;
    if (amplitude < 2) {
      EXPECT_NEAR(expected, periodOf(amplitude, 0.004), 1e-3 * expected) << amplitude;
    }
  }
}

TEST(World, APendulumThatTurnsOverCountsItsTurns) {
  Scene scene = weightless(sceneOf(robot(wheelModel(0.01), false), 0.001));
  scene.robots[0].jointStartRate = {10};
  World world(scene, 1);
  world.advance(commands(scene, 0), 2);
  EXPECT_NEAR(20, world.robot(0).position[0], 1e-6);
  EXPECT_NEAR(10, world.robot(0).rate[0], 1e-9);
}

// A leg: hip of two crossed axes with a round rotor between them, and a knee.
RobotModel legModel() {
  RobotModel model;
  model.name = "leg";
  model.links = {link("trunk", 0.6, {0.01, 0, 0}, {9e-4, 2.6e-3, 2.7e-3}),
                 link("rotor", 0.5, {0, -0.012, 0}, {1.7e-4, 3.06e-4, 1.7e-4}),
                 link("upper", 0.074, {0.004, 0.0047, -0.03}, {4.7e-5, 4.7e-5, 1.6e-5}),
                 link("lower", 0.074, {-0.006, 0, -0.037}, {5.2e-5, 5.7e-5, 2.0e-5})};
  model.joints = {joint("J1", 0, {0, -1, 0}, {0.065, 0.0625, 0}), joint("J2", 1, {1, 0, 0}),
                  joint("J3", 2, {0, -1, 0}, {0.009, 0.0047, -0.0695})};
  return model;
}

// The same with a rotor that is just not round enough to be merged.
RobotModel legInFourBodies() {
  RobotModel model = legModel();
  model.joints[1].origin.translation().y() = 1e-5;
  model.joints[1].origin.translation().z() = 1e-5;
  return model;
}

TEST(World, AHipAsOneUniversalJointMovesAsTwoHinges) {
  std::vector<double> ends[2];
  for (const int way : {0, 1}) {
    Scene scene = weightless(sceneOf(robot(way ? legInFourBodies() : legModel(), true), 0.00002, 0.0001));
    scene.robots[0].jointStart = {0.4, 0.5, 0.9};
    scene.robots[0].jointStartRate = {6, -4, 5};
    Drive torque{.kind = Drive::Kind::torque};
    scene.robots[0].drives = {torque, torque, torque};
    World world(scene, 1);
    auto inputs = commands(scene, 0);
    for (int i = 0; i < 2000; ++i) {
      inputs[0][0].command = 0.05;
      inputs[0][1].command = -0.03;
      inputs[0][2].command = 0.01 * std::cos(20 * world.time());
      world.advance(inputs, 0.0001);
    }
    const auto readings = world.robot(0);
    ends[way] = readings.position;
    ends[way].insert(ends[way].end(), readings.rate.begin(), readings.rate.end());
    for (int i = 0; i < 3; ++i) ends[way].push_back(10 * readings.base.translation()[i]);
    for (int i = 0; i < 3; ++i) ends[way].push_back(readings.baseSpin_rad_s[i]);
  }
  // Positions, then rates of up to 30 rad/s, then the base: what the step's own error leaves.
  for (std::size_t i = 0; i < ends[0].size(); ++i) EXPECT_NEAR(ends[1][i], ends[0][i], i < 3 ? 0.005 : 0.05) << i;
}

TEST(World, AFreeLegKeepsItsMomentumAndEnergy) {
  Scene scene = weightless(sceneOf(robot(legModel(), true), 0.0002, 0.002));
  scene.robots[0].jointStart = {0.4, 0.5, 0.9};
  scene.robots[0].jointStartRate = {3, -2, 4};
  World world(scene, 1);
  const double before = world.energy();
  const Eigen::Vector3d start = world.robot(0).base.translation();
  world.advance(commands(scene, 0), 0.5);
  EXPECT_NEAR(before, world.energy(), 0.01 * before);
  // The centre of mass of a body that nobody pushes goes straight on: the trunk only trembles about it.
  EXPECT_LT((world.robot(0).base.translation() - start).norm(), 0.1);
}

TEST(World, StartAngleAndLinkPosesAgreeForEveryJoint) {
  Scene scene = sceneOf(robot(legModel(), true), 0.001);
  scene.robots[0].jointStart = {0.7, 0.3, 1.1};
  World world(scene, 1);
  const auto readings = world.robot(0);
  EXPECT_NEAR(0.7, readings.position[0], 1e-12);
  EXPECT_NEAR(0.3, readings.position[1], 1e-12);
  EXPECT_NEAR(1.1, readings.position[2], 1e-12);
  const auto poses = world.linkPoses(0);
  // By hand: the chain of the model's frames.
  Eigen::Isometry3d hip = Eigen::Isometry3d(Eigen::Translation3d(0.065, 0.0625, 0));
  hip.rotate(Eigen::AngleAxisd(0.7, -Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(poses[1].isApprox(hip, 1e-12));
  Eigen::Isometry3d upper = hip;
  upper.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(poses[2].isApprox(upper, 1e-12));
  upper.translate(Eigen::Vector3d(0.009, 0.0047, -0.0695));
  upper.rotate(Eigen::AngleAxisd(1.1, -Eigen::Vector3d::UnitY()));
  EXPECT_TRUE(poses[3].isApprox(upper, 1e-12));
}

TEST(World, JointStopHoldsFiveDegreesBeyondTheLimitAndReturnsNoEnergyToSpeakOf) {
  RobotModel model = wheelModel(0.001);
  model.joints[0].lower = -0.5;
  model.joints[0].upper = 0.5;
  for (const double step : {0.0005, 0.008}) {
    Scene scene = weightless(sceneOf(robot(model, false), step));
    scene.robots[0].jointStartRate = {5};
    World world(scene, 1);
    const double before = world.energy();
    double furthest = 0;
    for (int i = 0; i < 60; ++i) {
      world.advance(commands(scene, 0), 0.008);
      furthest = std::max(furthest, world.robot(0).position[0]);
      EXPECT_LE(world.energy(), before * (1 + 1e-9));
    }
    EXPECT_GT(furthest, 0.5 + 0.0873 - 0.04);
    EXPECT_LT(furthest, 0.5 + 0.0873 + 5 * step + 0.01);
    EXPECT_LT(world.energy(), 0.2 * before);
  }
}

TEST(World, FixedPartsMergedOrNotMoveTheSame) {
  RobotModel model = pendulumModel(0.5, 0.3, 0.004);
  model.links.push_back(link("weight", 0.2, {0.02, 0, 0}, {1e-4, 2e-4, 3e-4}));
  model.joints.push_back(joint("glue", 1, {0, 0, 1}, {0, 0.05, -0.35}, Joint::Type::fixed));
  double ends[2];
  for (const bool merge : {true, false}) {
    Scene scene = sceneOf(robot(model, false), 0.0005, 0.0005);
    scene.robots[0].mergeFixed = merge;
    scene.robots[0].jointStart = {1, 0};
    World world(scene, 1);
    world.advance(commands(scene, 0), 1);
    ends[merge] = world.robot(0).position[0];
  }
  EXPECT_NEAR(ends[0], ends[1], 1e-3);
}

}  // namespace
}  // namespace btr::test
