// A world that remembers goes on with the same bits.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

using Eigen::Vector3d;

/// A body with a driven leg, a rig beside it, a ball and a box: all that a memory holds.
Scene fullScene() {
  RobotModel legged = bodyModel(1.2, {0.004, 0.004, 0.006}, {box({0.2, 0.1, 0.05})});
  legged.links.push_back(link("leg", 0.2, {0, 0, -0.05}, {1e-4, 1e-4, 1e-4}, {sphere(0.015, {0, 0, -0.1})}));
  legged.joints.push_back(joint("hip", 0, {0, 1, 0}, {0.05, 0.02, 0}));
  Scene scene = sceneOf(robot(legged, true, {.kind = Drive::Kind::servo, .p = 5, .i = 2, .d = 0.05}), 0.001);
  scene.robots[0].start.translation().z() = 0.14;
  SceneRobot rig = robot(pendulumModel(0.3, 0.2, 0.02), false, {.kind = Drive::Kind::servo, .p = 2, .d = 0.02});
  rig.name = "rig";
  rig.collision = "none";
  scene.robots.push_back(rig);
  scene.floor = FloorSpec{};
  BallSpec ball;
  ball.name = "ball";
  ball.position_m = {0.3, 0.05, 0.1};
  ball.velocity_m_s = {-0.5, 0, 0};
  ball.spin_rad_s = {1, 2, 3};
  scene.balls = {ball};
  ObstacleSpec crate;
  crate.name = "crate";
  crate.mass_kg = 0.3;
  crate.position_m = {-0.2, 0, 0.2};
  scene.obstacles = {crate};
  scene.robotsCollide = true;
  return scene;
}

std::vector<double> rowsOf(World& world, const Scene& scene, int periods, double phase) {
  std::vector<double> rows;
  for (int i = 0; i < periods; ++i) {
    auto inputs = commands(scene, 0);
    for (auto& robot : inputs)
      for (JointInput& input : robot) input.command = 0.4 * std::sin(0.2 * (phase + i));
    world.advance(inputs, scene.controlPeriod_s);
    world.sample(rows);
  }
  return rows;
}

TEST(Memory, ANewWorldThatGetsItGoesOnAsAnyOther) {
  const Scene scene = fullScene();
  WorldMemory memory;
  {
    World world(scene, 7);
    rowsOf(world, scene, 60, 0);
    memory = world.memory();
  }
  std::vector<double> first, second;
  {
    World world(scene, 1);
    world.remember(memory);
    first = rowsOf(world, scene, 100, 60);
  }
  {
    World world(scene, 99);
    world.remember(memory);
    EXPECT_EQ(world.memory().steps, memory.steps);
    second = rowsOf(world, scene, 100, 60);
  }
  EXPECT_EQ(first, second);
}

TEST(Memory, ChangesNothingThatMatters) {
  const Scene scene = fullScene();
  WorldMemory memory;
  std::vector<double> onwards;
  {
    World running(scene, 7);
    rowsOf(running, scene, 60, 0);
    memory = running.memory();
    onwards = rowsOf(running, scene, 20, 60);
  }
  World world(scene, 7);
  world.remember(memory);
  const std::vector<double> again = rowsOf(world, scene, 20, 60);
  ASSERT_EQ(onwards.size(), again.size());
  for (std::size_t i = 0; i < onwards.size(); ++i) EXPECT_NEAR(onwards[i], again[i], 1e-6 * (1 + std::abs(onwards[i])));
}

TEST(Memory, OfOtherObjectsIsLeftAlone) {
  Scene scene = fullScene();
  WorldMemory memory;
  {
    World world(scene, 7);
    rowsOf(world, scene, 60, 0);
    memory = world.memory();
  }
  scene.balls.push_back(scene.balls[0]);
  scene.balls[1].name = "other";
  scene.balls[1].position_m = {1, 1, 1};
  World world(scene, 7);
  world.remember(memory);
  EXPECT_LT((world.ball(0).position_m - memory.balls[0].body.position_m).norm(), 1e-12);
  EXPECT_LT((world.ball(1).position_m - Vector3d(1, 1, 1)).norm(), 1e-12);
}

}  // namespace
}  // namespace btr::test
