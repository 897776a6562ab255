// Joints that follow another one through a gear: one unknown for both, exact beside ODE, and close to that within ODE.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/sim/engine/joint_space.h"
#include "core/sim/world/scene_build.h"
#include "core/spec/random.h"
#include "tests/refusal.h"
#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

using Eigen::Vector3d;

/// Two arms that hang from one stand, at the joints "leader" and "follower" about y. In ODE: with shapes that have
/// nothing to touch.
RobotModel twoArms(double multiplier, double offset, bool inOde) {
  RobotModel model;
  model.name = "gear";
  const std::vector<Shape> shapes = inOde ? std::vector<Shape>{sphere(0.005)} : std::vector<Shape>{};
  model.links = {link("stand", 1, {0, 0, 0}, {1, 1, 1}), link("light", 0.2, {0, 0, -0.1}, {1e-3, 1e-3, 1e-3}, shapes),
                 link("heavy", 0.5, {0, 0, -0.15}, {2e-3, 2e-3, 2e-3}, shapes)};
  model.joints = {joint("leader", 0, {0, 1, 0}), joint("follower", 0, {0, 1, 0}, {0, 0.2, 0})};
  model.joints[1].mimic = Mimic{0, multiplier, offset};
  return model;
}

double inertiaOf(const Link& arm) {
  return arm.inertial.inertia_kg_m2(1, 1) + arm.inertial.mass_kg * arm.inertial.centreOfMass_m.squaredNorm();
}
double weightOf(const Link& arm) { return arm.inertial.mass_kg * g * -arm.inertial.centreOfMass_m.z(); }

Scene fixedScene(RobotModel model, double step, const Drive& drive = {.kind = Drive::Kind::none}) {
  SceneRobot rig = robot(std::move(model), false);
  rig.drives[0] = drive;
  return sceneOf(std::move(rig), step);
}

TEST(Mimic, TwoGearedPendulumsSwingAsOne) {
  // Lagrange: (I + m²·J)·q" = −(w + m²·v)·q for small swings, whatever the sign of the multiplier.
  const double m = -0.5;
  const RobotModel model = twoArms(m, 0, false);
  const double inertia = inertiaOf(model.links[1]) + m * m * inertiaOf(model.links[2]);
  const double stiffness = weightOf(model.links[1]) + m * m * weightOf(model.links[2]);
  const double quarter = M_PI / 2 / std::sqrt(stiffness / inertia);
  for (const bool inOde : {false, true}) {
    Scene scene = fixedScene(twoArms(m, 0, inOde), 1e-4);
    ASSERT_EQ(!inOde, JointSpace::suits(scene.robots[0]));
    scene.robots[0].jointStart = {0.01, 0.7};  // where the follower is told to be does not count
    World world(scene, 1);
    EXPECT_DOUBLE_EQ(m * 0.01, world.robot(0).position[1]);
    world.advance(commands(scene, 0), quarter);
    EXPECT_NEAR(0, world.robot(0).position[0], 2e-5) << inOde;
    EXPECT_NEAR(0, world.robot(0).position[1], 2e-5) << inOde;
    world.advance(commands(scene, 0), quarter);
    EXPECT_NEAR(-0.01, world.robot(0).position[0], 2e-5) << inOde;
  }
}

TEST(Mimic, KeepsEnergyAndTheRatio) {
  Scene scene = fixedScene(twoArms(2.5, -0.3, false), 2e-4);
  scene.robots[0].jointStart[0] = 1.2;
  World world(scene, 1);
  const double energy = world.energy();
  for (int i = 0; i < 50; ++i) {
    world.advance(commands(scene, 0), 0.02);
    const RobotReadings now = world.robot(0);
    EXPECT_NEAR(2.5 * now.position[0] - 0.3, now.position[1], 1e-9);
    EXPECT_NEAR(energy, world.energy(), 2e-3 * std::abs(energy));
  }
}

TEST(Mimic, ARackIsPushedByItsPinion) {
  // torque = (I + r²·M)·q" where the follower slides.
  const double r = 0.03, torque = 0.02;
  for (const bool inOde : {false, true}) {
    RobotModel model = twoArms(r, 0, inOde);
    model.joints[1].type = Joint::Type::slide;
    model.joints[1].axis = Vector3d::UnitX();
    Scene scene = weightless(fixedScene(model, 2e-4, {.kind = Drive::Kind::torque}));
    World world(scene, 1);
    world.advance(commands(scene, torque), 0.4);
    const double inertia = inertiaOf(model.links[1]) + r * r * model.links[2].inertial.mass_kg;
    const double way = torque / inertia * 0.4 * 0.4 / 2;
    EXPECT_NEAR(way, world.robot(0).position[0], 2e-3 * way) << inOde;
    EXPECT_NEAR(r * way, world.robot(0).position[1], 2e-3 * r * way) << inOde;
  }
}

TEST(Mimic, TheLeaderFeelsTheFollowersDryFriction) {
  // It holds both until the torque exceeds multiplier·friction.
  const double m = 2, friction = 0.05;
  for (const bool inOde : {false, true})
    for (const double share : {0.9, 1.1}) {
      Scene scene = weightless(fixedScene(twoArms(m, 0, inOde), 1e-3, {.kind = Drive::Kind::torque}));
      scene.robots[0].drives[1].coulombFriction = friction;
      World world(scene, 1);
      world.advance(commands(scene, share * m * friction), 0.5);
      // In ODE the leader feels a step later what holds the follower, and creeps.
      const double inertia =
          inertiaOf(scene.robots[0].model.links[1]) + m * m * inertiaOf(scene.robots[0].model.links[2]);
      const double way = std::max(0.0, share - 1) * m * friction / inertia * 0.5 * 0.5 / 2;
      EXPECT_NEAR(way, world.robot(0).position[0], inOde ? 3e-3 : 1e-4) << inOde << share;
    }
}

TEST(Mimic, AServoThatIsTooWeakForBothStaysAtItsLimit) {
  // The torque that holds the follower horizontally is more than the leader's servo has.
  const double m = 1;
  const RobotModel arms = twoArms(m, 0, false);
  const double needed = weightOf(arms.links[1]) + weightOf(arms.links[2]);
  for (const double share : {0.8, 1.2}) {
    Scene scene = fixedScene(arms, 1e-3, {.p = 200, .d = 2, .maxTorque = share * needed});
    scene.robots[0].jointStart[0] = M_PI / 2;
    World world(scene, 1);
    world.advance(commands(scene, M_PI / 2), 0.3);
    if (share < 1)
      EXPECT_LT(world.robot(0).position[0], M_PI / 2 - 0.1);
    else
      EXPECT_NEAR(M_PI / 2, world.robot(0).position[0], 0.02);
  }
}

TEST(Mimic, InOdeItMovesAsBesideIt) {
  // Driven by a servo along a path: the difference is of the size of a step, and shrinks with it.
  const auto after = [](bool inOde, double step) {
    Scene scene = fixedScene(twoArms(-1.5, 0.1, inOde), step, {.p = 8, .d = 0.1, .maxTorque = 1.5});
    World world(scene, 1);
    double most = 0;
    for (int i = 0; i < 40; ++i) world.advance(commands(scene, 0.5 * std::sin(0.3 * i)), 0.02);
    const RobotReadings now = world.robot(0);
    most = std::abs(now.position[1] - (-1.5 * now.position[0] + 0.1));
    EXPECT_LT(most, 3e-3);
    return now.position[0];
  };
  const double exact = after(false, 1e-4);
  EXPECT_NEAR(exact, after(false, 1e-3), 5e-3);
  EXPECT_NEAR(exact, after(true, 1e-3), 2e-2);
  EXPECT_NEAR(exact, after(true, 2e-4), 5e-3);
}

/// A finger: three phalanges one behind the other; the second and third follow the first.
Scene finger(double multiplier, double tipMass, bool inOde, double step) {
  const std::vector<Shape> shapes = inOde ? std::vector<Shape>{sphere(0.005)} : std::vector<Shape>{};
  RobotModel model;
  model.name = "finger";
  model.links = {link("palm", 1, {0, 0, 0}, {1, 1, 1}), link("first", 0.05, {0, 0, 0.02}, {1e-5, 1e-5, 1e-5}, shapes),
                 link("second", 0.03, {0, 0, 0.015}, {5e-6, 5e-6, 5e-6}, shapes),
                 link("tip", tipMass, {0, 0, 0.01}, {2e-6, 2e-6, 2e-6}, shapes)};
  model.joints = {joint("leader", 0, {0, 1, 0}), joint("middle", 1, {0, 1, 0}, {0, 0, 0.04}),
                  joint("end", 2, {0, 1, 0}, {0, 0, 0.03})};
  model.joints[1].mimic = Mimic{0, multiplier, 0};
  model.joints[2].mimic = Mimic{0, multiplier, 0.1};
  SceneRobot rig = robot(std::move(model), false);
  rig.drives[0] = {.p = 1, .d = 0.02, .maxTorque = 1};
  Scene scene = sceneOf(std::move(rig), step);
  scene.robots[0].jointStart[0] = 0.5;
  return scene;
}

TEST(Mimic, AFingersPhalangesMoveInOdeAsBesideIt) {
  // Each follower is carried by its leader: what couples them in the mass matrix counts, whatever the step.
  for (const double multiplier : {1.0, 1.5, -0.5})
    for (const double tipMass : {0.02, 0.2}) {
      const auto path = [&](bool inOde, double step) {
        const Scene scene = finger(multiplier, tipMass, inOde, step);
        EXPECT_EQ(!inOde, JointSpace::suits(scene.robots[0]));
        World world(scene, 1);
        std::vector<double> positions;
        for (int i = 0; i < 40; ++i) {
          world.advance(commands(scene, 0.5 + 0.4 * std::sin(0.3 * i)), 0.02);
          const RobotReadings now = world.robot(0);
          positions.push_back(now.position[0]);
          EXPECT_NEAR(multiplier * now.position[0] + 0.1, now.position[2], 3e-3);
        }
        EXPECT_EQ("", world.fault());
        return positions;
      };
      const std::vector<double> exact = path(false, 1e-4);
      const auto farthest = [&](const std::vector<double>& positions) {
        double most = 0;
        for (std::size_t i = 0; i < exact.size(); ++i) most = std::max(most, std::abs(positions[i] - exact[i]));
        return most;
      };
      const double coarse = farthest(path(true, 1e-3)), fine = farthest(path(true, 2.5e-4));
      EXPECT_LT(coarse, 0.03) << multiplier << " " << tipMass;
      EXPECT_LT(farthest(path(true, 5e-4)), 0.015) << multiplier << " " << tipMass;
      EXPECT_LT(fine, std::max(1e-3, coarse / 2)) << multiplier << " " << tipMass;
    }
}

TEST(Mimic, AHeavyFollowerOfALightLeaderIsHeld) {
  // The leader feels late what holds the follower, which is fifty times as heavy.
  for (const double step : {1e-3, 2.5e-4}) {
    RobotModel arms = twoArms(1, 0, true);
    arms.links[1] = link("light", 0.01, {0, 0, -0.1}, {1e-5, 1e-5, 1e-5}, {sphere(0.005)});
    Scene scene = fixedScene(arms, step, {.p = 8, .d = 0.1, .maxTorque = 5});
    scene.robots[0].jointStart[0] = 0.5;
    World world(scene, 1);
    world.advance(commands(scene, 0.5), 2);
    EXPECT_EQ("", world.fault());
    EXPECT_NEAR(0, world.robot(0).rate[0], 1e-3) << step;
    EXPECT_NEAR(world.robot(0).position[0], world.robot(0).position[1], 1e-4) << step;
  }
}

TEST(Mimic, AParallelGripperHoldsABoxStill) {
  // What the box does to the follower the leader feels a step later: in long steps it hammers.
  for (const double step : {2.5e-4, 1e-4}) {
    RobotModel model;
    model.name = "gripper";
    const Shape finger = box({0.01, 0.02, 0.06}, {0, 0, -0.03});
    model.links = {link("hand", 0.5, {0, 0, 0}, {1e-3, 1e-3, 1e-3}),
                   link("left", 0.05, {0, 0, -0.03}, {1e-5, 1e-5, 1e-5}, {finger}),
                   link("right", 0.05, {0, 0, -0.03}, {1e-5, 1e-5, 1e-5}, {finger})};
    model.joints = {joint("leader", 0, {1, 0, 0}, {0, 0, 0}, Joint::Type::slide),
                    joint("follower", 0, {-1, 0, 0}, {0, 0, 0}, Joint::Type::slide)};
    model.joints[1].mimic = Mimic{0, 1, 0};
    SceneRobot gripper = robot(model, false);
    gripper.drives[0] = {.p = 2000, .d = 20, .maxTorque = 10};
    gripper.jointStart = {0.04, 0.04};
    gripper.start.translation().z() = 0.07;
    Scene scene = sceneOf(gripper, step);
    scene.floor = FloorSpec{};
    ObstacleSpec cube;
    cube.name = "cube";
    cube.size_m = {0.04, 0.04, 0.04};
    cube.position_m = {0, 0, 0.02};
    cube.mass_kg = 0.05;
    scene.obstacles = {cube};
    World world(scene, 1);
    world.advance(commands(scene, 0.01), 1.0);
    EXPECT_EQ("", world.fault());
    const double held = world.robot(0).position[0];
    EXPECT_NEAR(0.025, held, 2e-3) << step;
    double farthest = 0;
    for (int i = 0; i < 100; ++i) {
      world.advance(commands(scene, 0.01), 0.008);
      farthest = std::max(farthest, std::abs(world.robot(0).position[0] - held));
    }
    EXPECT_LT(farthest, 1e-4) << step;
    EXPECT_NEAR(0.02, world.obstacle(0).pose.translation().z(), 2e-3) << step;
  }
}

TEST(Mimic, AGripperThatStandsOnTheFloorStaysThere) {
  // A free body whose legs are geared: the floor pushes the follower, which pushes the leader.
  RobotModel model;
  model.name = "stool";
  model.links = {link("seat", 1, {0, 0, 0}, {5e-3, 5e-3, 5e-3}),
                 link("left", 0.1, {0, 0, -0.05}, {1e-4, 1e-4, 1e-4},
                      {sphere(0.01, {0, 0.05, -0.1}), sphere(0.01, {0, -0.05, -0.1})}),
                 link("right", 0.1, {0, 0, -0.05}, {1e-4, 1e-4, 1e-4},
                      {sphere(0.01, {0, 0.05, -0.1}), sphere(0.01, {0, -0.05, -0.1})})};
  model.joints = {joint("leader", 0, {0, 1, 0}, {0.1, 0, 0}), joint("follower", 0, {0, 1, 0}, {-0.1, 0, 0})};
  model.joints[1].mimic = Mimic{0, -1, 0};
  SceneRobot stool = robot(model, true);
  stool.drives[0] = {.p = 20, .d = 0.3, .maxTorque = 3};
  stool.jointStart = {-0.3, 0.3};
  stool.start.translation().z() = 0.1 * std::cos(0.3) + 0.011;
  Scene scene = sceneOf(stool, 1e-3);
  scene.floor = FloorSpec{};
  World world(scene, 1);
  world.advance(commands(scene, -0.3), 1.0);
  EXPECT_EQ("", world.fault());
  const RobotReadings now = world.robot(0);
  EXPECT_NEAR(-now.position[0], now.position[1], 1e-3);
  EXPECT_NEAR(0.1 * std::cos(now.position[0]) + 0.01, now.base.translation().z(), 3e-3);
  EXPECT_LT(now.baseVelocity_m_s.norm(), 0.02);
}

}  // namespace
}  // namespace btr::test
