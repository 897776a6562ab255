// What servos hold beforehand, what they do by direction, and what sensors say wrongly, each against its own equation.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/plugin/effect_worlds.h"

namespace btr {
namespace servos_and_sensors {

using Numbers = std::vector<double>;

using test::effect;

TEST(GravityCompensation, HoldsItsShareOfTheWeightWithinWhatTheDriveGives) {
  const auto holds = effect("gravity_compensation");
  EXPECT_DOUBLE_EQ(0.1 + 0.6 * 0.5, holds->driveTorque(0.1, {.limit = 0.9, .load = -0.5}, Numbers{0.6}, {}, 1e-3));
  EXPECT_DOUBLE_EQ(0.9, holds->driveTorque(0.8, {.limit = 0.9, .load = -0.5}, Numbers{0.6}, {}, 1e-3));
  // The law asks for 1.5 N·m of 0.9: what the weight takes off that is not felt.
  EXPECT_DOUBLE_EQ(0.9, holds->driveTorque(0.9, {.limit = 0.9, .load = 0.5, .beyond = 0.6}, Numbers{0.6}, {}, 1e-3));
  EXPECT_EQ(0.1,
            holds->driveTorque(0.1, {.followsPosition = false, .limit = 0.9, .load = -0.5}, Numbers{0.6}, {}, 1e-3));
}

TEST(GravityCompensation, OfTheWholeWeightLetsAServoWithoutErrorRest) {
  test::Trial trial{test::armScene(), 1};
  Scene scene = trial.scene;
  for (const char* at : {"rig.hinge", "rig.wrist"})
    scene = test::withEffect(scene, effect("gravity_compensation"), "gravity_compensation", {1}, at);
  World world(scene, 1);
  for (int i = 0; i < 300; ++i) world.advance(test::commands(scene, 0.5), 0.01);
  for (const double position : world.jointPositions(0)) EXPECT_NEAR(0.5, position, 1e-4);
}

TEST(DirectionGain, IsStrongerForOneSignOfTheErrorOrOfTheTorque) {
  const auto gain = effect("direction_gain");
  const auto seen = [&](double command, double kind) {
    return gain->command({command, command}, {.position = 0.2}, Numbers{0.25, kind}, {}, 1e-3).mean() - 0.2;
  };
  EXPECT_DOUBLE_EQ(1.25 * 0.4, seen(0.6, 0));
  EXPECT_DOUBLE_EQ(-0.75 * 0.4, seen(-0.2, 0));
  EXPECT_DOUBLE_EQ(0.4, seen(0.6, 1));
  EXPECT_EQ(0.7, gain->driveTorque(0.7, {}, Numbers{0.25, 0}, {}, 1e-3));
  EXPECT_DOUBLE_EQ(1.25 * 0.7, gain->driveTorque(0.7, {}, Numbers{0.25, 1}, {}, 1e-3));
  EXPECT_DOUBLE_EQ(-0.75 * 0.7, gain->driveTorque(-0.7, {}, Numbers{0.25, 1}, {}, 1e-3));
}

TEST(DriveGain, IsOfTheErrorOrOfTheTorque) {
  const auto gain = effect("drive_gain");
  const JointState joint{.position = 0.2};
  EXPECT_DOUBLE_EQ(0.2 + 1.25 * 0.4, gain->command({0.6, 0.6}, joint, Numbers{0.25, 0}, {}, 1e-3).mean());
  EXPECT_DOUBLE_EQ(0.2 - 0.75 * 0.4, gain->command({-0.2, -0.2}, joint, Numbers{-0.25, 0}, {}, 1e-3).mean());
  EXPECT_EQ(0.6, gain->command({0.6, 0.6}, joint, Numbers{0.25, 1}, {}, 1e-3).mean());
  EXPECT_EQ(0.7, gain->driveTorque(0.7, {}, Numbers{0.25, 0}, {}, 1e-3));
  EXPECT_DOUBLE_EQ(-0.75 * 0.7, gain->driveTorque(-0.7, {}, Numbers{-0.25, 1}, {}, 1e-3));
}

TEST(RateFilter, DampsWhatTheRateWas) {
  const auto filter = effect("rate_filter");
  const JointState joint{.rate = 2, .limit = 9, .damping = 0.3};
  Numbers state{1, 0};
  double torque = 0;
  for (int i = 0; i < 20; ++i) torque = filter->driveTorque(-0.6, joint, Numbers{0.02}, state, 1e-3);
  EXPECT_NEAR(2 * (1 - std::exp(-1.0)), state[1], 1e-12);
  EXPECT_NEAR(-0.3 * 2 * (1 - std::exp(-0.0195 / 0.02)), torque, 1e-4);
  state = {0, 0};
  EXPECT_NEAR(-0.6, filter->driveTorque(-0.6, joint, Numbers{0.02}, state, 1e-3), 1e-15) << "it turned as fast before";
  EXPECT_EQ(-0.6, filter->driveTorque(-0.6, joint, Numbers{0}, state, 1e-3));
}

TEST(DriveLag, FollowsExponentiallyAndNoFasterThanItMay) {
  const auto lag = effect("drive_lag");
  Numbers state{1, 0};
  double mean = 0;
  for (int i = 0; i < 20; ++i) mean = lag->driveTorque(0.5, {}, Numbers{0.02, 0}, state, 1e-3);
  EXPECT_NEAR(0.5 * (1 - std::exp(-1.0)), state[1], 1e-12);
  EXPECT_NEAR(0.5 * (1 - std::exp(-0.0195 / 0.02)), mean, 1e-4);
  state = {1, 0};
  for (int i = 0; i < 20; ++i) lag->driveTorque(0.5, {}, Numbers{0, 0.1}, state, 1e-3);
  EXPECT_NEAR(0.2, state[1], 1e-12);
  state = {0, 0};
  EXPECT_EQ(0.5, lag->driveTorque(0.5, {}, Numbers{0.02, 0.1}, state, 1e-3)) << "it gave that before";
}

/// What a sensor says, and what the servo sees in place of its command.
struct Says {
  double recorded = 0, followed = 0;
};
Says saysAt(const char* name, const JointState& joint, const Numbers& values) {
  const auto sensor = effect(name);
  return {sensor->measured(joint.position, joint, values, {}, 1e-3),
          sensor->command({1, 1}, joint, values, {}, 1e-3).mean()};
}

TEST(Sensors, WhoseZeroCreepsSayMoreWithTime) {
  const Says own = saysAt("sensor_drift", {.time = 3, .position = 0.5}, {0.02, 0});
  EXPECT_DOUBLE_EQ(0.56, own.recorded);
  EXPECT_EQ(1, own.followed);
  EXPECT_DOUBLE_EQ(0.94, saysAt("sensor_drift", {.time = 3, .position = 0.5}, {0.02, 1}).followed);
}

TEST(Sensors, WhoseGainIsWrongSayAShareTooMuch) {
  const Says own = saysAt("sensor_scale", {.position = 0.5}, {0.04, 0});
  EXPECT_DOUBLE_EQ(0.52, own.recorded);
  EXPECT_EQ(1, own.followed);
  EXPECT_DOUBLE_EQ(0.98, saysAt("sensor_scale", {.position = 0.5}, {0.04, 1}).followed);
}

TEST(Sensors, OffTheirAxisSayTheSameAfterATurn) {
  const Numbers values{0.01, 0.02, 0};
  EXPECT_DOUBLE_EQ(0.01, saysAt("sensor_eccentricity", {.position = 0}, values).recorded);
  EXPECT_NEAR(M_PI / 2 + 0.02, saysAt("sensor_eccentricity", {.position = M_PI / 2}, values).recorded, 1e-14);
  EXPECT_NEAR(2 * M_PI + 0.01, saysAt("sensor_eccentricity", {.position = 2 * M_PI}, values).recorded, 1e-14);
  EXPECT_NEAR(1 - 0.02, saysAt("sensor_eccentricity", {.position = M_PI / 2}, {0.01, 0.02, 1}).followed, 1e-15);
}

TEST(BristleFriction, BuildsUpOverTheWayAfterAReversal) {
  const auto friction = effect("bristle_friction");
  Numbers state{0};
  const Numbers values{0.2, 0.05};
  double torque = 0;
  const auto travel = [&](double rate, double way) {
    constexpr double dt = 1e-4;
    for (int i = 0; i < std::lround(way / std::abs(rate) / dt); ++i)
      torque = friction->driveTorque(0, {.rate = rate}, values, state, dt);
  };
  travel(0.5, 1);
  EXPECT_NEAR(-0.2, torque, 1e-6);
  // ż = ω − |ω|·z/s from z = s: z = −s + 2·s·e^(−way/s).
  travel(-0.5, 0.05);
  EXPECT_NEAR(0.2 * (1 - 2 * std::exp(-1.0)), torque, 1e-3);
  travel(-2, 1);
  EXPECT_NEAR(0.2, torque, 1e-6);
}

}  // namespace servos_and_sensors
}  // namespace btr
