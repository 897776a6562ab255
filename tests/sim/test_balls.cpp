// Balls and contacts against mechanics.
#include <gtest/gtest.h>

#include <cmath>

#include "core/sim/contact/contact_builder.h"
#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

using Eigen::Vector3d;

std::vector<std::vector<JointInput>> nobody(const Scene& scene) { return commands(scene, 0); }

TEST(Floor, ASlidingBoxStopsAfterItsWay) {
  for (const double step : {0.001, 0.004}) {
    const double friction = 0.6, speed = 1.5;
    Scene scene = sceneOf(robot(bodyModel(0.8, {0.004, 0.004, 0.006}, {box({0.3, 0.3, 0.02})}), true), step);
    scene.floor = FloorSpec{.friction = friction};
    scene.robots[0].start.translation().z() = 0.01 - 0.8 * g / 4 / 2e4;
    World world(scene, 1);
    world.setRobot(0, scene.robots[0].start, {speed, 0, 0}, Vector3d::Zero(), {}, {});
    world.advance(nobody(scene), 1.2);
    EXPECT_NEAR(speed * speed / (2 * friction * g), world.robot(0).base.translation().x(),
                0.02 * 0.19 + speed * step / 2);
    EXPECT_LT(world.robot(0).baseVelocity_m_s.norm(), 1e-6);
  }
}

TEST(Floor, SlipGivesASpeedProportionalToTheForce) {
  // A box on a slope (tilted gravity) creeps at slip·force along each of the floor's directions, each with its own
  // slip; the four contacts share the force.
  Scene scene = sceneOf(robot(bodyModel(1, {0.004, 0.004, 0.006}, {box({0.4, 0.4, 0.02})}), true), 0.001);
  scene.floor = FloorSpec{.friction = 2, .slip1_m_s_n = 0.02, .slip2_m_s_n = 0.05};
  scene.gravity_m_s2 << 1.2, 0.8, -9.6;
  scene.robots[0].start.translation().z() = 0.01 - 9.6 / 4 / 2e4;
  World world(scene, 1);
  world.advance(nobody(scene), 0.8);
  EXPECT_NEAR(0.02 * 1.2 / 4, world.robot(0).baseVelocity_m_s.x(), 1e-4);
  EXPECT_NEAR(0.05 * 0.8 / 4, world.robot(0).baseVelocity_m_s.y(), 1e-4);
}

TEST(Floor, CarriesTheWeight) {
  RobotModel model = bodyModel(1.65, {0.004, 0.004, 0.006}, {box({0.2, 0.1, 0.05})});
  model.sensors = {Sensor{.name = "ACCEL"}};
  for (const double step : {0.0005, 0.008}) {
    Scene scene = sceneOf(robot(model, true), step);
    scene.floor = FloorSpec{};
    scene.robots[0].start.translation().z() = 0.03;
    World world(scene, 1);
    world.advance(nobody(scene), 2);
    EXPECT_NEAR(0, world.robot(0).baseVelocity_m_s.norm(), 1e-6);
    // Static: each of four corners sinks by weight/(4·stiffness).
    EXPECT_NEAR(0.025 - 1.65 * g / 4 / 2e4, world.robot(0).base.translation().z(), 1e-6);
    EXPECT_NEAR(g, world.robot(0).accelerometer_m_s2.z(), 1e-4);
    EXPECT_TRUE(world.robot(0).contact[0]);
  }
}

BallSpec shell() {
  BallSpec ball;
  ball.position_m = {0, 0, ball.radius_m - ball.mass_kg * g / 2e4};
  return ball;
}

TEST(Ball, ASlidingBallEndsAtFiveSeventhsOrThreeFifthsOfItsSpeed) {
  for (const double factor : {0.4, 2.0 / 3.0})
    for (const double heading : {0.0, 0.5, 2.3}) {
      BallSpec ball = shell();
      ball.inertiaFactor = factor;
      ball.velocity_m_s = {2 * std::cos(heading), 2 * std::sin(heading), 0};
      Scene scene = ballScene(ball, 0.001);
      scene.floor->friction = 0.4;
      World world(scene, 1);
      world.advance(nobody(scene), 0.6);
      EXPECT_NEAR(2 / (1 + factor), world.ball(0).velocity_m_s.norm(), 2e-3);
      EXPECT_NEAR(heading, std::atan2(world.ball(0).velocity_m_s.y(), world.ball(0).velocity_m_s.x()), 1e-6);
      EXPECT_NEAR(2 / (1 + factor) / ball.radius_m, world.ball(0).spin_rad_s.norm(), 0.05);
    }
}

// A ball that rolls without sliding from the start.
BallState rolling(const BallSpec& ball, double speed, double heading) {
  BallState state;
  state.position_m << ball.position_m[0], ball.position_m[1], ball.position_m[2];
  state.velocity_m_s << speed * std::cos(heading), speed * std::sin(heading), 0;
  state.spin_rad_s = Vector3d::UnitZ().cross(state.velocity_m_s) / ball.radius_m;
  return state;
}

TEST(Ball, RollsAsFarAsItsDecelerationAllowsAndStaysThere) {
  for (const double step : {0.001, 0.008})
    for (const double heading : {0.0, 0.7}) {
      BallSpec ball = shell();
      ball.rollingDeceleration_m_s2 = 0.4;
      Scene scene = ballScene(ball, step);
      World world(scene, 1);
      world.setBall(0, rolling(ball, 1.2, heading));
      world.advance(nobody(scene), 4);
      const double way = 1.2 * 1.2 / (2 * 0.4);
      const Vector3d end = world.ball(0).position_m;
      EXPECT_NEAR(way * std::cos(heading), end.x(), 0.005 * way);
      EXPECT_NEAR(way * std::sin(heading), end.y(), 0.005 * way);
      EXPECT_LT(world.ball(0).velocity_m_s.norm(), 1e-6);
      world.advance(nobody(scene), 2);
      EXPECT_NEAR(0, (world.ball(0).position_m - end).norm(), 1e-6);
    }
}

// Rolling resistance a turns against the motion alone. Pulled aside by s, a ball bends its way at once, however small s
// is: y = s·t²/2 as long as it has hardly turned. With s = a (the block thrown across a slope that just holds it)
// d|v|/dt = −a·(1 − v_y/|v|) and dv_y/dt = a·(1 − v_y/|v|): |v| + v_y is kept, and |v| goes to half of what it was.
TEST(Ball, WhatPullsARollingBallAsideBendsItsWay) {
  constexpr double speed = 1.2, a = 0.4;
  for (const double step : {0.0005, 0.002, 0.008})
    for (const double heading : {0.0, 0.7})
      for (const double share : {0.25, 1.0}) {
        BallSpec ball = shell();
        ball.rollingDeceleration_m_s2 = a;
        Scene scene = ballScene(ball, step);
        const double pull = share * a * (1 + ball.inertiaFactor);
        const Vector3d aside(-std::sin(heading), std::cos(heading), 0);
        scene.gravity_m_s2 << pull * aside.x(), pull * aside.y(), -9.7;
        World world(scene, 1);
        world.setBall(0, rolling(ball, speed, heading));
        world.advance(nobody(scene), 0.4);
        EXPECT_NEAR(0.5 * share * a * 0.4 * 0.4, world.ball(0).position_m.dot(aside), 0.04 * share * a * 0.4 * 0.4)
            << step << " s, " << share;
        if (share < 1) continue;
        for (int k = 0; k < 8; ++k) {
          const Vector3d v = world.ball(0).velocity_m_s;
          EXPECT_NEAR(speed, v.norm() + v.dot(aside), 0.01 * speed) << step << " s";
          world.advance(nobody(scene), 2);
        }
        EXPECT_NEAR(speed / 2, world.ball(0).velocity_m_s.norm(), 0.01 * speed) << step << " s";
      }
}

TEST(Ball, BouncesToTheSquareOfItsRestitution) {
  BallSpec ball;
  ball.restitution = 0.7;
  ball.position_m = {0, 0, ball.radius_m + 0.5};
  Scene scene = ballScene(ball, 0.0005);
  World world(scene, 1);
  const double fall = std::sqrt(2 * 0.5 / g);
  double highest = 0;
  while (world.time() < fall * (1 + 2 * 0.7)) {
    world.advance(nobody(scene), 0.0005);
    if (world.time() > fall * 1.1) highest = std::max(highest, world.ball(0).position_m.z() - ball.radius_m);
  }
  EXPECT_NEAR(0.5 * 0.49, highest, 0.01);
}

// In a hit the floor creeps by slip·momentum over the hit's time, and the ball's underside with it: of its speed u the
// momentum m·u/(1 + 1/f + m·slip/time) is taken, whatever the step.
TEST(Ball, AHitOnACreepingFloorDoesNotDependOnTheStep) {
  constexpr double speed = 1.5, slip = 0.5;
  for (const double step : {0.0001, 0.0005, 0.002, 0.008}) {
    BallSpec ball = shell();
    ball.restitution = 0.6;
    ball.position_m = {0, 0, 0.3};
    ball.velocity_m_s = {speed, 0, -1};
    Scene scene = ballScene(ball, step);
    scene.floor->friction = 10;
    scene.floor->slip1_m_s_n = scene.floor->slip2_m_s_n = slip;
    World world(scene, 1);
    world.advance(nobody(scene), 0.25);
    ASSERT_GT(world.ball(0).velocity_m_s.z(), 0);
    const double taken = speed / (1 + 1 / ball.inertiaFactor + ball.mass_kg * slip / hitDuration_s);
    EXPECT_NEAR(speed - taken, world.ball(0).velocity_m_s.x(), 0.005 * taken) << step << " s";
  }
}

TEST(Ball, ACollisionOfTwoKeepsMomentumAndTheRestitution) {
  for (const double restitution : {0.0, 0.6, 1.0}) {
    BallSpec one, two;
    one.name = "one";
    two.name = "two";
    two.mass_kg = 0.11;
    one.restitution = two.restitution = restitution;
    one.position_m = {0, 0, 1};
    two.position_m = {0.2, 0, 1};
    one.velocity_m_s = {2, 0, 0};
    Scene scene = weightless(ballScene(one, 0.0005));
    scene.floor.reset();
    scene.balls.push_back(two);
    World world(scene, 1);
    const double before = world.energy();
    world.advance(nobody(scene), 0.2);
    const double v1 = world.ball(0).velocity_m_s.x(), v2 = world.ball(1).velocity_m_s.x();
    EXPECT_NEAR(0.055 * 2, 0.055 * v1 + 0.11 * v2, 1e-9);
    EXPECT_LE(world.energy(), before * (1 + 1e-9));
    EXPECT_NEAR(restitution, (v2 - v1) / 2, restitution > 0 ? 1e-9 : 0.15);
  }
}

TEST(Ball, HitByARobotKeepsTheMomentumOfBoth) {
  BallSpec ball;
  ball.position_m = {0.2, 0, 1};
  Scene scene = weightless(sceneOf(robot(bodyModel(0.5, {0.001, 0.001, 0.001}, {box({0.1, 0.1, 0.1})}), true), 0.0005));
  scene.balls = {ball};
  scene.robots[0].start.translation().z() = 1;
  World world(scene, 1);
  world.setRobot(0, scene.robots[0].start, {1, 0, 0}, Vector3d::Zero(), {}, {});
  world.advance(nobody(scene), 0.4);
  EXPECT_NEAR(0.5, 0.5 * world.robot(0).baseVelocity_m_s.x() + 0.055 * world.ball(0).velocity_m_s.x(), 1e-9);
  EXPECT_GE(world.ball(0).velocity_m_s.x(), world.robot(0).baseVelocity_m_s.x() - 1e-9);
  EXPECT_FALSE(world.ballTouched(0));
}

TEST(Ball, AtRestGainsNoEnergy) {
  BallSpec ball = shell();
  ball.rollingDeceleration_m_s2 = 0.4;
  for (const double step : {0.0005, 0.008}) {
    Scene scene = ballScene(ball, step);
    World world(scene, 1);
    world.advance(nobody(scene), 1);
    const double before = world.energy();
    world.advance(nobody(scene), 5);
    EXPECT_NEAR(before, world.energy(), 1e-9);
  }
}

TEST(Ball, RollingResistanceHoldsItOnAGentleSlopeOnly) {
  BallSpec ball = shell();
  ball.rollingDeceleration_m_s2 = 0.4;
  for (const double slope : {0.3, 0.9}) {
    Scene scene = ballScene(ball, 0.002);
    // On a slope a ball is pulled by g·sin; what it needs to roll is that over 1+f.
    scene.gravity_m_s2 << slope * (1 + ball.inertiaFactor), 0, -9.7;
    World world(scene, 1);
    world.advance(nobody(scene), 2);
    if (slope < 0.4)
      EXPECT_NEAR(0, world.ball(0).position_m.x(), 1e-3);
    else
      EXPECT_NEAR((slope - 0.4) * 2, world.ball(0).velocity_m_s.x(), 0.02);
  }
}

TEST(Collision, MeshAsHullTouchesLikeTheBoxItIs) {
  Shape cube;
  cube.kind = Shape::Kind::mesh;
  Surface corners;
  for (int i = 0; i < 8; ++i)
    corners.vertices.emplace_back(i & 1 ? 0.05f : -0.05f, i & 2 ? 0.05f : -0.05f, i & 4 ? 0.05f : -0.05f);
  corners.triangles = {{0, 1, 2}, {1, 3, 2}};
  cube.surface = std::make_shared<const Surface>(corners);
  double heights[2], pushed[2];
  for (const bool mesh : {false, true}) {
    Scene scene =
        sceneOf(robot(bodyModel(0.5, {0.001, 0.001, 0.001}, {mesh ? cube : box({0.1, 0.1, 0.1})}), true), 0.001);
    scene.robots[0].collision = "mesh";
    scene.robots[0].start.translation().z() = 0.06;
    scene.floor = FloorSpec{};
    BallSpec ball = shell();
    ball.position_m[0] = 0.3;
    ball.velocity_m_s = {-2, 0, 0};
    scene.balls = {ball};
    World world(scene, 1);
    world.advance(nobody(scene), 0.8);
    heights[mesh] = world.robot(0).base.translation().z();
    pushed[mesh] = world.robot(0).base.translation().x();
  }
  EXPECT_NEAR(heights[0], heights[1], 1e-5);
  EXPECT_NEAR(pushed[0], pushed[1], 1e-4);
  EXPECT_LT(pushed[0], -1e-4);
}

TEST(Collision, ACylinderRestsOnItsSideAndOnItsEnd) {
  Shape can;
  can.kind = Shape::Kind::cylinder;
  can.size_m << 0.03, 0.1, 0;
  for (const bool upright : {false, true}) {
    Scene scene = sceneOf(robot(bodyModel(0.2, {3e-4, 1e-4, 3e-4}, {can}), true), 0.001);
    scene.floor = FloorSpec{};
    scene.robots[0].start.translation().z() = 0.06;
    if (upright) scene.robots[0].start.rotate(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()));
    World world(scene, 1);
    world.advance(nobody(scene), 2);
    EXPECT_NEAR(upright ? 0.05 : 0.03, world.robot(0).base.translation().z(), 1e-4);
    EXPECT_LT(world.robot(0).baseVelocity_m_s.norm(), 1e-4);
  }
}

}  // namespace
}  // namespace btr::test
