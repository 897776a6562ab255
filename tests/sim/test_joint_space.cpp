// A fixed robot that touches nothing, moved in joint coordinates: against ODE, which moves bodies and holds them
// together, and against what mechanics keeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/sim/engine/joint_space.h"
#include "core/spec/random.h"
#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

/// A random tree of hinges and slides. With shapes that collide (there is nothing to touch) it moves in ODE.
SceneRobot randomRig(std::uint64_t seed, bool inOde, bool driven) {
  Random random(seed);
  const auto small = [&](double size) {
    return Eigen::Vector3d(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
  };
  RobotModel model;
  model.name = "tree";
  std::vector<Drive> drives;
  const int count = 2 + static_cast<int>(random.below(5));
  for (int i = 0; i < count; ++i) {
    std::vector<Shape> shapes;
    if (inOde) shapes.push_back(sphere(0.01));
    model.links.push_back(
        link("link" + std::to_string(i), random.uniform(0.1, 0.5), small(0.05), {2e-3, 3e-3, 4e-3}, shapes));
    if (i == 0) continue;
    const auto type = random.chance(0.2) ? Joint::Type::slide : Joint::Type::rotate;
    Joint made = joint("joint" + std::to_string(i), static_cast<int>(random.below(static_cast<std::uint64_t>(i))),
                       (small(1) + Eigen::Vector3d(0, 0, 1e-3)).normalized(), small(0.15), type);
    made.origin.rotate(Eigen::AngleAxisd(random.uniform(-2, 2), small(1).normalized()));
    made.lower = -100;
    made.upper = 100;
    model.joints.push_back(made);
    Drive drive{.kind = Drive::Kind::none};
    if (driven) {
      drive = {.p = random.uniform(1, 10), .d = random.uniform(0.02, 0.1), .maxTorque = random.uniform(0.1, 1)};
      if (random.chance(0.4)) drive.coulombFriction = 0.05;
      if (random.chance(0.4)) drive.viscousFriction = 0.02;
      if (random.chance(0.4)) drive.rotorInertia_kg_m2 = 0.002;
    }
    // What slides without a drive falls out of the world.
    if (type == Joint::Type::slide) drive = {.p = 100, .d = 1};
    drives.push_back(drive);
  }
  SceneRobot rig = robot(std::move(model), false);
  rig.drives = drives;
  for (std::size_t j = 0; j < drives.size(); ++j) {
    rig.jointStart[j] = random.uniform(-0.05, 0.05);
    rig.jointStartRate[j] = random.uniform(-2, 2);
  }
  return rig;
}

std::vector<double> positionsAfter(std::uint64_t seed, bool inOde, double step) {
  Scene scene = sceneOf(randomRig(seed, inOde, true), step);
  World world(scene, seed);
  Random random(seed + 1000);
  for (int period = 0; period < 20; ++period) {
    auto inputs = commands(scene, 0);
    for (auto& input : inputs[0]) input.command = random.uniform(-0.4, 0.4);
    world.advance(inputs, 0.02);
  }
  EXPECT_EQ("", world.fault()) << seed;
  return world.robot(0).position;
}

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

TEST(JointSpace, IsChosenWhereNothingCanBeTouched) {
  EXPECT_TRUE(JointSpace::suits(randomRig(1, false, true)));
  EXPECT_FALSE(JointSpace::suits(randomRig(1, true, true)));
  SceneRobot untouched = randomRig(1, true, true);
  untouched.collision = "none";
  EXPECT_TRUE(JointSpace::suits(untouched));
  untouched.freeBase = true;
  EXPECT_FALSE(JointSpace::suits(untouched));
}

TEST(JointSpace, DrivenTreesEndWhereOdeTakesThem) {
  // Servos at their limits, dry friction, rotors, slides. Both engines approach one motion as the step shrinks.
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    const auto ours = positionsAfter(seed, false, 2e-5);
    const auto coarse = positionsAfter(seed, true, 4e-5), fine = positionsAfter(seed, true, 2e-5);
    // ODE's error is proportional to the step: halving it shows what is left.
    EXPECT_LT(apart(ours, fine), 1.5 * apart(coarse, fine) + 2e-5) << seed;
  }
}

TEST(JointSpace, TheStepsErrorFallsWithItsSquare) {
  // Without friction and limits, whose switching is not smooth.
  int checked = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const auto after = [&](double step) {
      Scene scene = sceneOf(randomRig(seed, false, false), step);
      World world(scene, 1);
      world.advance(commands(scene, 0), 0.4);
      return world.robot(0).position;
    };
    const auto exact = after(2.5e-5);
    const double coarse = apart(after(8e-4), exact), fine = apart(after(2e-4), exact);
    if (coarse < 1e-8) continue;
    ++checked;
    EXPECT_LT(fine, coarse / 10) << seed << ' ' << coarse;
  }
  EXPECT_GT(checked, 20);
}

TEST(JointSpace, ASwingingTreeKeepsItsEnergy) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SceneRobot rig = randomRig(seed, false, false);
    // Hinges alone: a slide's servo takes energy.
    for (auto& joint : rig.model.joints) joint.type = Joint::Type::rotate;
    for (auto& drive : rig.drives) drive = {.kind = Drive::Kind::none};
    Scene scene = sceneOf(std::move(rig), 5e-5, 0.001);
    World world(scene, 1);
    const double begin = world.energy();
    double most = 0;
    for (int i = 0; i < 500; ++i) {
      world.advance(commands(scene, 0), 0.001);
      most = std::max(most, std::abs(world.energy() - begin));
    }
    // Energy is read with the rates of a step's middle, so it trembles with the step.
    EXPECT_LT(most, 2e-3) << seed << ' ' << begin;
  }
}

TEST(JointSpace, BodiesStandWhereTheChainOfTheModelPutsThem) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Scene scene = sceneOf(randomRig(seed, false, true), 0.001);
    World world(scene, 1);
    world.advance(commands(scene, 0.3), 0.1);
    const auto poses = world.linkPoses(0);
    const auto readings = world.robot(0);
    const RobotModel& model = scene.robots[0].model;
    std::vector<Eigen::Isometry3d> chain{Eigen::Isometry3d::Identity()};
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      const Joint& joint = model.joints[j];
      Eigen::Isometry3d pose = chain[static_cast<std::size_t>(joint.parentLink)] * joint.origin;
      if (joint.type == Joint::Type::rotate) pose.rotate(Eigen::AngleAxisd(readings.position[j], joint.axis));
      if (joint.type == Joint::Type::slide) pose.translate(readings.position[j] * joint.axis);
      chain.push_back(pose);
      EXPECT_TRUE(poses[j + 1].isApprox(pose, 1e-9)) << seed << ' ' << j;
    }
  }
}

TEST(JointSpace, ATorqueThatIsNotANumberIsAFaultThatSaysSo) {
  Scene scene = sceneOf(robot(pendulumModel(0.5, 0.3, 0.004), false, {.kind = Drive::Kind::torque}), 0.001);
  World world(scene, 1);
  world.advance(commands(scene, NAN), 0.01);
  EXPECT_NE(std::string::npos, world.fault().find("not finite")) << world.fault();
}

}  // namespace
}  // namespace btr::test
