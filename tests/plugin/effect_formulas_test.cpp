// Each effect against its own equation.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "core/sim/tracked_frame.h"
#include "core/spec/error.h"
#include "tests/plugin/built_plugins.h"

namespace btr {
namespace {

using Numbers = std::vector<double>;

using test::effect;

TEST(CoulombFriction, LimitsByItsTorqueAtAnySpeed) {
  EXPECT_EQ(0.07, effect("coulomb_friction")->frictionLimit({.rate = -3}, Numbers{0.07}));
  EXPECT_EQ(0.07, effect("coulomb_friction")->frictionLimit({}, Numbers{0.07}));
}

TEST(ViscousFriction, IsItsCoefficient) {
  EXPECT_EQ(0.02, effect("viscous_friction")->damping({.rate = 4}, Numbers{0.02}));
}

TEST(JointStop, PushesBackBeyondItsEndsAndNeverHolds) {
  const Numbers values{40, -0.3, 0.5, 0.05};
  const auto torque = [&](double position, double rate) {
    return effect("joint_stop")->torque({.position = position, .rate = rate}, values);
  };
  EXPECT_EQ(0, torque(0.5, 3));
  EXPECT_EQ(0, torque(-0.3, -3));
  EXPECT_DOUBLE_EQ(-40 * 0.1 - 2 * 3, torque(0.6, 3));
  EXPECT_DOUBLE_EQ(40 * 0.1 + 2 * 3, torque(-0.4, -3));
  EXPECT_EQ(0, torque(0.6, -3)) << "what leaves it is not held back";
  EXPECT_EQ(0, torque(-0.4, 3));
  EXPECT_EQ(0, effect("joint_stop")->torque({.position = 0.6, .rate = 3}, Numbers{0, -0.3, 0.5, 2}));
  // Ends that cross meet in their middle.
  EXPECT_DOUBLE_EQ(-40 * (0.6 - 0.1), effect("joint_stop")->torque({.position = 0.6}, Numbers{40, 0.5, -0.3, 0}));
}

TEST(JointSpring, PullsToItsRestInProportion) {
  EXPECT_DOUBLE_EQ(-0.5 * (0.7 - 0.2), effect("joint_spring")->torque({.position = 0.7}, Numbers{0.5, 0.2}));
  EXPECT_DOUBLE_EQ(0, effect("joint_spring")->torque({.position = 0.2}, Numbers{0.5, 0.2}));
}

TEST(ForceOffset, IsConstant) {
  EXPECT_EQ(-0.3, effect("force_offset")->torque({.position = 9, .rate = 9}, Numbers{-0.3}));
}

TEST(PositionOffset, IsMeasuredAndSettlesTheJointBelowItsCommand) {
  const auto offset = effect("position_offset");
  EXPECT_EQ(1.25, offset->measured(1, {}, Numbers{0.25, 1}, {}, 0.008));
  const CommandAround followed = offset->command({1, 3}, {}, Numbers{0.25, 1}, {}, 0.001);
  EXPECT_EQ(0.75, followed.before);
  EXPECT_EQ(2.75, followed.after);
}

TEST(PositionOffset, OfTheRecordersOwnSensorIsMeasuredOnly) {
  const auto offset = effect("position_offset");
  EXPECT_EQ(1.25, offset->measured(1, {}, Numbers{0.25, 0}, {}, 0.008));
  EXPECT_EQ(2, offset->command({1, 3}, {}, Numbers{0.25, 0}, {}, 0.001).mean());
}

TEST(PositionOffset, LeavesATorqueCommandAlone) {
  EXPECT_EQ(1,
            effect("position_offset")->command({1, 1}, {.followsPosition = false}, Numbers{0.25, 1}, {}, 0.001).mean());
}

/// What a delay makes of a ramp that rises by 1 every 8 ms from t = 0, on both sides of each step's instant.
std::vector<CommandAround> delayedStairs(double delay_s, double step_s, int steps) {
  const auto delay = effect("command_delay");
  Numbers state(static_cast<std::size_t>(delay->stateSize()));
  std::vector<CommandAround> result;
  double before = 0;
  for (int i = 0; i < steps; ++i) {
    const double time = i * step_s;
    const double command = std::floor(time / 0.008 + 1e-9);
    result.push_back(
        delay->command({before, command}, {.time = time, .command = command}, Numbers{delay_s}, state, step_s));
    before = command;
  }
  return result;
}

TEST(CommandDelay, OfWholeStepsShiftsTheCommandsByThem) {
  for (const int late : {1, 8, 24, 80}) {
    const auto commands = delayedStairs(late * 1e-3, 1e-3, 400);
    for (int i = 0; i < 400; ++i) {
      const CommandAround& followed = commands[static_cast<std::size_t>(i)];
      EXPECT_NEAR(std::floor(std::max(0, i - late) / 8.0), followed.after, 1e-9) << late << " " << i;
      EXPECT_NEAR(std::floor(std::max(0, i - late - 1) / 8.0), followed.before, 1e-9) << late << " " << i;
    }
  }
}

TEST(CommandDelay, BetweenHalfStepsInterpolatesLinearly) {
  const auto at = [](double delay) { return delayedStairs(delay, 1e-3, 200); };
  const auto shorter = at(0.012), longer = at(0.0125), between = at(0.0123);
  for (std::size_t i = 0; i < between.size(); ++i) {
    EXPECT_NEAR(0.4 * shorter[i].before + 0.6 * longer[i].before, between[i].before, 1e-9);
    EXPECT_NEAR(0.4 * shorter[i].after + 0.6 * longer[i].after, between[i].after, 1e-9);
  }
}

TEST(CommandDelay, DoesNotDependOnTheStep) {
  // The mean over half a coarse step is the mean over the halves of fine steps in it.
  const auto coarse = delayedStairs(0.0217, 4e-3, 60), fine = delayedStairs(0.0217, 0.5e-3, 481);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    double mean = 0;
    for (std::size_t k = 0; k < 4; ++k) mean += (fine[8 * i + k].after + fine[8 * i + k + 1].before) / 8;
    EXPECT_NEAR(coarse[i].after, mean, 1e-9);
  }
}

TEST(CommandDelay, KeepsACommandThatChangesAtEveryStepOfATenthOfAMillisecond) {
  const auto delay = effect("command_delay");
  Numbers state(static_cast<std::size_t>(delay->stateSize()));
  const double late = 0.08, step = 1e-4;
  for (int i = 0; i < 4000; ++i) {
    const double time = i * step, command = std::sin(5 * time);
    const double followed = delay->command({command, command}, {.time = time}, Numbers{late}, state, step).mean();
    // Merged changes may be early by a 256th of the largest delay, at a slope of 5 per second.
    if (time > late) {
      EXPECT_NEAR(std::sin(5 * (time - late)), followed, 5 * (0.08 / 256 + 2 * step));
    }
  }
}

TEST(Backlash, PassesTheTorqueOnceTheGapIsCrossed) {
  // Width 20 mrad, from its middle: 10 mrad at 6 rad/(s·N·m) · 0.5 N·m = 3 rad/s are crossed after 10/3 ms.
  const auto backlash = effect("backlash");
  Numbers state{0};
  const Numbers values{0.02, 6, 0};
  const Numbers expected{0, 0, 0, 0.5 * (1 - 1.0 / 3), 0.5, 0.5};
  for (const double torque : expected) EXPECT_NEAR(torque, backlash->driveTorque(0.5, {}, values, state, 1e-3), 1e-12);
}

TEST(Backlash, AReversalRunsThroughTheWholeGap) {
  const auto backlash = effect("backlash");
  Numbers state{0.01};
  const Numbers values{0.02, 6, 0};
  int idle = 0;
  while (backlash->driveTorque(-0.5, {}, values, state, 1e-4) == 0 && idle < 1000) ++idle;
  EXPECT_NEAR(0.02 / 3, idle * 1e-4, 1e-4);
  EXPECT_EQ(-0.01, state[0]);
}

TEST(Backlash, AJointThatComesTowardsTheMotorClosesTheGapSoonerOneThatRunsAheadIsCaughtAllTheSame) {
  const auto backlash = effect("backlash");
  const std::map<double, double> speeds{{-5, 3 + 5}, {0, 3}, {5, 3}};
  for (const auto& [rate, closing] : speeds) {
    Numbers state{-0.01};
    EXPECT_EQ(0, backlash->driveTorque(0.5, {.rate = rate}, Numbers{0.02, 6, 0}, state, 1e-3));
    EXPECT_NEAR(-0.01 + closing * 1e-3, state[0], 1e-15);
  }
}

TEST(Backlash, OfVanishingWidthIsNone) {
  // Impulse lost at a reversal: the torque for the time that the gap takes.
  const auto backlash = effect("backlash");
  for (const double rate : {-9.0, 0.0, 9.0})
    for (const double width : {1e-3, 1e-5, 1e-7}) {
      Numbers state{-width / 2};
      double impulse = 0;
      for (int i = 0; i < 1000; ++i)
        impulse += 1e-3 * backlash->driveTorque(0.5, {.rate = rate}, Numbers{width, 6, 0}, state, 1e-3);
      EXPECT_NEAR(0.5 - 0.5 * width / (3 - std::min(rate, 0.0)), impulse, 1e-12);
    }
}

TEST(Backlash, NeverTurnsOrRaisesTheTorque) {
  const auto backlash = effect("backlash");
  Random random(1);
  Numbers state{0};
  for (int i = 0; i < 10000; ++i) {
    const double torque = random.uniform(-1, 1);
    const double passed = backlash->driveTorque(torque, {.rate = random.normal()}, Numbers{0.05, 6, 0}, state, 1e-3);
    EXPECT_GE(passed * torque, 0);
    EXPECT_LE(std::abs(passed), std::abs(torque));
    EXPECT_LE(std::abs(state[0]), 0.025);
  }
}

Scene sceneWithLink() {
  Scene scene;
  scene.floor = FloorSpec{};
  SceneRobot robot;
  robot.name = "leg";
  Link link;
  link.name = "lower";
  link.inertial = {0.3, {0.1, 0, 0}, Eigen::Vector3d(1e-3, 2e-3, 2e-3).asDiagonal()};
  robot.model.links.push_back(link);
  scene.robots.push_back(robot);
  return scene;
}

TEST(Payload, MovesTheCentreOfMassAndAddsInertiaAsTwoBodiesDo) {
  Scene scene = sceneWithLink();
  effect("payload")->changeScene(scene, "leg.lower", Numbers{0.1, 0, 0, 0.2});
  const Inertial& body = scene.robots[0].model.links[0].inertial;
  EXPECT_DOUBLE_EQ(0.4, body.mass_kg);
  // 0.1 of 0.4 kg at 0.2 m: the centre moves by 0.05 m; the reduced mass 0.3·0.1/0.4 turns with 0.2 m.
  EXPECT_NEAR(0.05, body.centreOfMass_m.z(), 1e-15);
  EXPECT_NEAR(0.1, body.centreOfMass_m.x(), 1e-15);
  const double added = 0.3 * 0.1 / 0.4 * 0.2 * 0.2;
  EXPECT_NEAR(1e-3 + added, body.inertia_kg_m2(0, 0), 1e-15);
  EXPECT_NEAR(2e-3 + added, body.inertia_kg_m2(1, 1), 1e-15);
  EXPECT_NEAR(2e-3, body.inertia_kg_m2(2, 2), 1e-15);
}

TEST(Payload, RefusesALinkThatIsNotThere) {
  Scene scene = sceneWithLink();
  EXPECT_THROW(effect("payload")->changeScene(scene, "leg.upper", Numbers{0.1, 0, 0, 0}), InputError);
}

TEST(GroundSlope, LetsGravityLeanDownTheSlope) {
  Scene scene = sceneWithLink();
  effect("ground_slope")->changeScene(scene, "floor", Numbers{0, 0.1});  // about +y: falls towards +x
  EXPECT_NEAR(9.81 * std::sin(0.1), scene.gravity_m_s2.x(), 1e-12);
  EXPECT_NEAR(-9.81 * std::cos(0.1), scene.gravity_m_s2.z(), 1e-12);
  scene = sceneWithLink();
  effect("ground_slope")->changeScene(scene, "floor", Numbers{0.1, 0});  // about +x: rises towards +y
  EXPECT_NEAR(-9.81 * std::sin(0.1), scene.gravity_m_s2.y(), 1e-12);
}

TEST(FloorPlace, KeepsDownDownInTheFrameOfWhatTracksTheBalls) {
  Scene scene = sceneWithLink();
  const Eigen::Vector3d down = scene.gravity_m_s2;
  const auto made = effect("floor_place");
  scene.effects.push_back({made, "floor_place", "ball", {0.02, 0.1, -0.05}});
  made->changeScene(scene, "ball", scene.effects.back().values);
  const Eigen::Isometry3d frame = trackedFrame(scene);
  EXPECT_NEAR(0, (frame.linear() * scene.gravity_m_s2 - down).norm(), 1e-12);
  EXPECT_NEAR(0.02, (frame * Eigen::Vector3d::Zero()).z(), 1e-15);
  // About +x: what lies at +y is higher; about +y: what lies at +x is lower.
  EXPECT_NEAR(0.02 + std::sin(0.1) * std::cos(0.05), (frame * Eigen::Vector3d(0, 1, 0)).z(), 1e-12);
  EXPECT_NEAR(0.02 + std::sin(0.05), (frame * Eigen::Vector3d(1, 0, 0)).z(), 1e-12);
}

TEST(GravityTilt, TurnsGravityByTheRightHandRule) {
  Scene scene = sceneWithLink();
  effect("gravity_tilt")->changeScene(scene, "world", Numbers{0, 0.1});  // about +y: −z turns towards −x
  EXPECT_NEAR(-9.81 * std::sin(0.1), scene.gravity_m_s2.x(), 1e-12);
  EXPECT_NEAR(9.81, scene.gravity_m_s2.norm(), 1e-12);
  scene = sceneWithLink();
  effect("gravity_tilt")->changeScene(scene, "world", Numbers{0.1, 0});  // about +x: −z turns towards +y
  EXPECT_NEAR(9.81 * std::sin(0.1), scene.gravity_m_s2.y(), 1e-12);
}

TEST(RollingResistance, AddsToTheBallsDeceleration) {
  Scene scene;
  scene.balls.push_back({.name = "a", .rollingDeceleration_m_s2 = 0.2});
  scene.balls.push_back({.name = "b"});
  effect("rolling_resistance")->changeScene(scene, "a", Numbers{0.5});
  EXPECT_DOUBLE_EQ(0.7, scene.balls[0].rollingDeceleration_m_s2);
  EXPECT_EQ(0, scene.balls[1].rollingDeceleration_m_s2);
  EXPECT_THROW(effect("rolling_resistance")->changeScene(scene, "c", Numbers{0.5}), InputError);
}

}  // namespace
}  // namespace btr
