// Obstacles, and robots that run into them and each other, against mechanics.
#include <gtest/gtest.h>

#include <cmath>

#include "core/sim/contact/obstacle_shape.h"
#include "core/sim/contact/solid_contacts.h"
#include "core/sim/engine/ode_session.h"
#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

std::vector<std::vector<JointInput>> nothing(const Scene& scene) { return commands(scene, 0); }

ObstacleSpec obstacleOf(const std::string& name, const std::string& shape, std::array<double, 3> size, double mass,
                        std::array<double, 3> position) {
  ObstacleSpec spec;
  spec.name = name;
  spec.shape = shape;
  spec.size_m = size;
  spec.mass_kg = mass;
  spec.position_m = position;
  return spec;
}

Scene fieldWith(std::vector<ObstacleSpec> obstacles, double step = 0.001) {
  Scene scene;
  scene.step_s = step;
  scene.controlPeriod_s = 0.008;
  scene.floor = FloorSpec{};
  scene.obstacles = std::move(obstacles);
  return scene;
}

Scene withRobot(Scene scene, double mass, const Vector3d& size, const Vector3d& at, const std::string& name = "body") {
  SceneRobot added = robot(bodyModel(mass, Vector3d(0.004, 0.004, 0.006), {box(size)}), true);
  added.name = name;
  added.start.translation() = at;
  scene.robots.push_back(added);
  return scene;
}

/// A touching pair of solids, placed in the world.
struct Pair {
  OdeSession session{1};
  SolidGeom first, second;
  std::vector<ContactPoint> points;
  Pair(const ObstacleSpec& a, const ObstacleSpec& b)
      : first(makeCollider(obstacleShape(a), Isometry3d::Identity(), -1)),
        second(makeCollider(obstacleShape(b), Isometry3d::Identity(), -1)) {
    place(first, a);
    place(second, b);
    solidContacts(first, second, points);
  }
  static void place(SolidGeom& geom, const ObstacleSpec& spec) {
    const auto& q = spec.orientation_wxyz;
    geom.place(Eigen::Translation3d(spec.position_m[0], spec.position_m[1], spec.position_m[2]) *
               Eigen::Quaterniond(q[0], q[1], q[2], q[3]));
  }
};

// Whatever lies flat on something is held at more than one point, all as deep as it dips in, pushed upwards.
TEST(SolidContacts, WhatLiesFlatHasAsManyPointsAsHoldIt) {
  struct Case {
    std::string shape;
    std::array<double, 3> size;
    double radius, height;  ///< of its middle above what it lies on
    std::size_t points;
    std::array<double, 4> orientation = {1, 0, 0, 0};
  };
  const double root = std::sqrt(0.5);
  const std::vector<Case> cases{{"box", {0.1, 0.06, 0.04}, 0, 0.02, 4},
                                {"ramp", {0.1, 0.06, 0.04}, 0, 0.02, 4},
                                {"cylinder", {0, 0, 0.1}, 0.03, 0.05, 4},
                                {"cylinder", {0, 0, 0.1}, 0.03, 0.03, 2, {root, root, 0, 0}},
                                {"sphere", {}, 0.03, 0.03, 1}};
  const double dip = 1e-3;
  for (const std::string below : {"box", "ramp", "cylinder"}) {
    ObstacleSpec table = obstacleOf("table", below, {1, 1, 0.2}, 0, {0, 0, -0.1});
    table.radius_m = 0.5;
    // A ramp lies on its slope: here it is turned round, so that its lower face is the table's top.
    if (below == "ramp") table.orientation_wxyz = {0, 1, 0, 0};
    for (const Case& each : cases) {
      ObstacleSpec thing = obstacleOf("thing", each.shape, each.size, 1, {0.02, 0.01, each.height - dip});
      thing.radius_m = each.radius;
      thing.orientation_wxyz = each.orientation;
      const Pair pair(thing, table);
      ASSERT_EQ(pair.points.size(), each.points) << each.shape << " on " << below;
      for (const ContactPoint& point : pair.points) {
        EXPECT_NEAR(point.depth_m, dip, 2e-5) << each.shape << " on " << below;
        EXPECT_NEAR(point.normal.z(), 1, 1e-3) << each.shape << " on " << below;
        EXPECT_NEAR(point.position_m.z(), 0, dip + 1e-9);
      }
    }
  }
}

TEST(SolidContacts, NormalsPointToTheFirstAndNothingTouchesFromAfar) {
  const ObstacleSpec left = obstacleOf("left", "box", {0.1, 0.1, 0.1}, 1, {0, 0, 0});
  ObstacleSpec right = obstacleOf("right", "box", {0.1, 0.1, 0.1}, 1, {0.099, 0.03, 0.02});
  {
    const Pair pair(left, right);
    ASSERT_EQ(pair.points.size(), 4u);
    for (const ContactPoint& point : pair.points) {
      EXPECT_NEAR(point.normal.x(), -1, 1e-9);
      EXPECT_NEAR(point.depth_m, 1e-3, 1e-9);
      EXPECT_GE(point.position_m.y(), -0.02 - 1e-9);  // within the part that both faces share
      EXPECT_LE(point.position_m.y(), 0.05 + 1e-9);
      EXPECT_GE(point.position_m.z(), -0.03 - 1e-9);
      EXPECT_LE(point.position_m.z(), 0.05 + 1e-9);
    }
  }
  right.position_m[0] = 0.101;
  EXPECT_TRUE(Pair(left, right).points.empty());
}

TEST(ObstacleInertia, OfARampIsThatOfItsSlices) {
  const ObstacleSpec ramp = obstacleOf("ramp", "ramp", {0.3, 0.2, 0.1}, 2, {0, 0, 0});
  const Inertial inertial = obstacleInertial(ramp);
  // Midpoint rule over the wedge.
  const int n = 200;
  double volume = 0;
  Vector3d moment = Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double u = (i + 0.5) / n, w = (k + 0.5) / n;
      if (w > u) continue;
      const Vector3d p(0.3 * (u - 0.5), 0, 0.1 * (w - 0.5));
      volume += 1;
      moment += p;
      second += p * p.transpose();
    }
  second(1, 1) = volume * 0.2 * 0.2 / 12;
  const Vector3d centre = moment / volume;
  second = second / volume - Eigen::Matrix3d(centre * centre.transpose());
  const Eigen::Matrix3d expected = 2 * (second.trace() * Eigen::Matrix3d::Identity() - second);
  EXPECT_LT((inertial.centreOfMass_m - centre).norm(), 1e-3);
  EXPECT_LT((inertial.inertia_kg_m2 - expected).norm(), 2e-2 * expected.norm());
}

TEST(Obstacles, AStackComesToRestAndCarriesItsWeight) {
  for (const double step : {0.001, 0.008}) {
    const double mass = 0.5, size = 0.1;
    Scene scene = fieldWith({}, step);
    for (int i = 0; i < 3; ++i)
      scene.obstacles.push_back(
          obstacleOf("box" + std::to_string(i), "box", {size, size, size}, mass, {0.003 * i, 0, 0.05 + 0.101 * i}));
    World world(scene, 1);
    world.advance(nothing(scene), 2);
    EXPECT_EQ(world.fault(), "");
    for (std::size_t i = 0; i < 3; ++i) {
      // Each layer of four springs sinks by what stands on it.
      double sinks = 0;
      for (std::size_t below = 0; below <= i; ++below) sinks += static_cast<double>(3 - below) * mass * g / 4 / 2e4;
      EXPECT_NEAR(world.obstacle(i).pose.translation().z(), 0.05 + 0.1 * static_cast<double>(i) - sinks, 1e-4);
      EXPECT_LT(world.obstacle(i).velocity_m_s.norm(), 1e-4) << i << " at a step of " << step;
    }
  }
}

TEST(Obstacles, ABoxSlidesDownASlopeOnlyWhereFrictionLetsIt) {
  // Slope 1:4. tan = 0.25: friction of 0.3 holds, of 0.1 does not; a = g·(sin − μ·cos).
  const double slope = std::atan2(0.25, 1.0);
  for (const double friction : {0.3, 0.1}) {
    ObstacleSpec ramp = obstacleOf("ramp", "ramp", {2, 1, 0.5}, 0, {0, 0, 0.25});
    ramp.friction = friction;
    ObstacleSpec thing = obstacleOf("thing", "box", {0.1, 0.1, 0.1}, 0.4, {0, 0, 0});
    thing.friction = 1;
    // On the middle of the slope, its lower face against it.
    const Vector3d up(-std::sin(slope), 0, std::cos(slope));
    const Vector3d at = Vector3d(0, 0, 0.25) + 0.05 * up;
    thing.position_m = {at.x(), at.y(), at.z()};
    thing.orientation_wxyz = {std::cos(slope / 2), 0, -std::sin(slope / 2), 0};
    const Scene scene = fieldWith({ramp, thing});
    World world(scene, 1);
    world.advance(nothing(scene), 0.2);
    const Vector3d start = world.obstacle(1).pose.translation(), speed = world.obstacle(1).velocity_m_s;
    world.advance(nothing(scene), 0.4);
    const Vector3d way = world.obstacle(1).pose.translation() - start;
    if (friction > 0.25) {
      EXPECT_LT(way.norm(), 1e-3);
    } else {
      const double a = g * (std::sin(slope) - friction * std::cos(slope));
      EXPECT_NEAR(way.norm(), speed.norm() * 0.4 + a * 0.08, 0.03 * way.norm());
      EXPECT_LT(way.z(), 0);
      EXPECT_LT(way.x(), 0);
    }
  }
}

TEST(Obstacles, ABallRollsDownASlopeWithItsInertia) {
  BallSpec ball;
  ball.name = "ball";
  ball.inertiaFactor = 2.0 / 3;
  const double slope = std::atan2(0.1, 1.0);
  const Vector3d at = Vector3d(0.5, 0, 0.15) + ball.radius_m * Vector3d(-std::sin(slope), 0, std::cos(slope));
  ball.position_m = {at.x(), at.y(), at.z()};
  Scene scene = fieldWith({obstacleOf("ramp", "ramp", {2, 1, 0.2}, 0, {0, 0, 0.1})});
  scene.balls = {ball};
  World world(scene, 1);
  world.advance(nothing(scene), 0.4);
  const double speed = world.ball(0).velocity_m_s.norm();
  EXPECT_NEAR(speed, g * std::sin(slope) / (1 + 2.0 / 3) * 0.4, 0.02 * speed);
}

TEST(Obstacles, ABallBouncesOffAWall) {
  BallSpec ball;
  ball.name = "ball";
  ball.restitution = 0.7;
  ball.position_m = {0, 0, 1};
  ball.velocity_m_s = {2, 0, 0};
  Scene scene = fieldWith({obstacleOf("wall", "box", {0.02, 2, 4}, 0, {0.5, 0, 1})});
  scene.gravity_m_s2.setZero();
  scene.balls = {ball};
  World world(scene, 1);
  world.advance(nothing(scene), 0.4);
  EXPECT_NEAR(world.ball(0).velocity_m_s.x(), -1.4, 1e-3);
}

// Momentum is kept where nothing but the two of them is there.
TEST(Obstacles, ABoxThatIsHitTakesOverMomentum) {
  Scene scene = fieldWith({obstacleOf("flying", "box", {0.1, 0.1, 0.1}, 0.2, {-0.5, 0, 1}),
                           obstacleOf("resting", "cylinder", {0, 0, 0.1}, 0.6, {0, 0.01, 1})});
  scene.gravity_m_s2.setZero();
  scene.obstacles[0].velocity_m_s = {1.5, 0, 0};
  World world(scene, 1);
  world.advance(nothing(scene), 1);
  const Vector3d after = 0.2 * world.obstacle(0).velocity_m_s + 0.6 * world.obstacle(1).velocity_m_s;
  EXPECT_LT((after - Vector3d(0.3, 0, 0)).norm(), 1e-6);
  EXPECT_GT(world.obstacle(1).velocity_m_s.x(), 0.05);
}

TEST(Robots, CollideWithEachOtherWhereTheSceneSaysSo) {
  for (const bool collide : {true, false}) {
    Scene scene = withRobot(withRobot(fieldWith({}), 1, {0.2, 0.1, 0.1}, {-0.3, 0, 1}, "a"), 1, {0.2, 0.1, 0.1},
                            {0.3, 0.02, 1}, "b");
    scene.gravity_m_s2.setZero();
    scene.robotsCollide = collide;
    World world(scene, 1);
    world.setRobot(0, scene.robots[0].start, {1, 0, 0}, Vector3d::Zero(), {}, {});
    world.advance(nothing(scene), 1);
    const Vector3d first = world.robot(0).baseVelocity_m_s, second = world.robot(1).baseVelocity_m_s;
    EXPECT_NEAR((first + second).x(), 1, 1e-6);
    if (collide)
      EXPECT_GT(second.x(), 0.3);
    else
      EXPECT_EQ(second.norm(), 0);
  }
}

TEST(Robots, StandOnObstaclesAndAreStoppedByWalls) {
  Scene scene = withRobot(fieldWith({obstacleOf("table", "box", {1, 1, 0.3}, 0, {0, 0, 0.15}),
                                     obstacleOf("wall", "box", {0.1, 1, 0.3}, 0, {0.45, 0, 0.45})}),
                          1.65, {0.2, 0.1, 0.05}, {0, 0, 0.33});
  World world(scene, 1);
  world.advance(nothing(scene), 1);
  EXPECT_NEAR(world.robot(0).base.translation().z(), 0.325 - 1.65 * g / 4 / 2e4, 1e-5);
  EXPECT_TRUE(world.robot(0).contact[0]);
  world.setRobot(0, world.robot(0).base, {3, 0, 0}, Vector3d::Zero(), {}, {});
  world.advance(nothing(scene), 1);
  EXPECT_LT(world.robot(0).base.translation().x(), 0.3 + 1e-3);
  EXPECT_GT(world.robot(0).base.translation().x(), 0.2);
}

TEST(Pulls, HoldAWeightWhereTheSpringSaysAndNeverExceedTheirBound) {
  Scene scene = withRobot(fieldWith({}), 0.5, {0.2, 0.1, 0.05}, {0, 0, 1});
  World world(scene, 1);
  Pull pull;
  pull.what = Pull::What::link;
  pull.target_m = {0, 0, 1};
  pull.stiffness_n_m = 200;
  world.setPulls({pull});
  world.advance(nothing(scene), 3);
  EXPECT_NEAR(world.robot(0).base.translation().z(), 1 - 0.5 * g / 200, 1e-5);
  EXPECT_NEAR(world.pullForce_n(0).z(), 0.5 * g, 1e-4);
  // A bound below the weight lets it fall with the rest.
  pull.most_n = 2;
  world.setPulls({pull});
  world.advance(nothing(scene), 0.25);
  EXPECT_NEAR(world.pullForce_n(0).norm(), 2, 1e-9);
  EXPECT_NEAR(world.robot(0).baseVelocity_m_s.z(), -(g - 4) * 0.25, 0.01);
}

TEST(Pulls, AreStableHoweverStiff) {
  Scene scene = withRobot(fieldWith({}, 0.008), 0.5, {0.2, 0.1, 0.05}, {0, 0, 1});
  World world(scene, 1);
  Pull pull;
  pull.what = Pull::What::link;
  pull.target_m = {0.1, 0, 1};
  pull.stiffness_n_m = 1e5;
  pull.most_n = 1e6;
  world.setPulls({pull});
  world.advance(nothing(scene), 2);
  EXPECT_EQ(world.fault(), "");
  // It sags by m·g/k, k being the stiffest that this step bears.
  EXPECT_NEAR((world.robot(0).base.translation() - pull.target_m).norm(), 4 * g * 0.008 * 0.008, 1e-5);
}

}  // namespace
}  // namespace btr::test
