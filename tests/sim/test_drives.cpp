// Servos, motors and joint friction against stepped formulas.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/sim/drive_law.h"
#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

constexpr double inertia = 0.0015;  // kg·m², about that of a leg

// Position of the same wheel under the contract's law, stepped in 2 µs: the truth.
struct Truth {
  double q = 0, rate = 0, integral = 0, torque = 0;
  double dt = 2e-6;  ///< [s]
  void run(const std::function<double(double)>& command, double duration, const Drive& d, double& time) {
    for (long i = 0; i < std::lround(duration / dt); ++i) {
      const double error = command(time) - q;
      integral += error * dt;
      torque = std::clamp(d.p * error + d.i * integral - d.d * rate, -d.maxTorque, d.maxTorque);
      rate += torque / inertia * dt;
      q += rate * dt;
      time += dt;
    }
  }
};

// Largest difference between World and truth over a step of the command, and of the final torque.
double servoError(const Drive& drive, double step, double command) {
  Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, drive), step));
  World world(scene, 1);
  Truth truth;
  double time = 0, worst = 0;
  for (int i = 0; i < 60; ++i) {
    world.advance(commands(scene, command), 0.008);
    truth.run([&](double) { return command; }, 0.008, drive, time);
    worst = std::max(worst, std::abs(world.robot(0).position[0] - truth.q));
  }
  return worst;
}

TEST(Servo, FollowsThePidLawSteppedByHand) {
  const Drive small{.p = 7.5, .d = 0.05, .maxTorque = 1e9};
  EXPECT_LT(servoError(small, 0.00025, 0.1), 0.1 * 0.01);
  const Drive withIntegral{.p = 5, .i = 8, .d = 0.08, .maxTorque = 0.85};
  EXPECT_LT(servoError(withIntegral, 0.00025, 0.1), 0.1 * 0.01);
  const Drive saturated{.p = 7.5, .d = 0.05, .maxTorque = 0.3};
  EXPECT_LT(servoError(saturated, 0.00025, 0.6), 0.6 * 0.01);
}

TEST(Servo, ItsErrorVanishesWithTheStep) {
  const Drive drive{.p = 7.5, .i = 3, .d = 0.05, .maxTorque = 0.4};
  const double coarse = servoError(drive, 0.001, 0.3), fine = servoError(drive, 0.000125, 0.3);
  EXPECT_LT(fine, coarse / 5);
}

TEST(Servo, IsOfSecondOrderInTheStepThoughCommandsThrowItInAndOutOfItsLimit) {
  const Drive drive{.p = 2.2, .d = 0.1, .maxTorque = 0.3};
  // Every 8 ms another command: most differences are beyond the limit, on either side, some are not.
  const auto commandOf = [](int frame) { return 0.5 * std::sin(0.9 * frame) * (frame % 3); };
  const auto errorOf = [&](double step) {
    Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, drive), step));
    World world(scene, 1);
    world.setRobot(0, scene.robots[0].start, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), std::vector{0.0},
                   std::vector{0.0});
    Truth truth;
    truth.dt = 1e-7;
    double time = 0, worst = 0;
    for (int frame = 0; frame < 60; ++frame) {
      world.advance(commands(scene, commandOf(frame)), 0.008);
      truth.run([&](double) { return commandOf(frame); }, 0.008, drive, time);
      worst = std::max(worst, std::abs(world.robot(0).position[0] - truth.q));
    }
    return worst;
  };
  const double coarse = errorOf(0.001), half = errorOf(0.0005), quarter = errorOf(0.00025);
  EXPECT_LT(half, coarse / 3);
  EXPECT_LT(quarter, half / 3);
}

TEST(Servo, SwitchedOffAndOnActsForExactlyItsTime) {
  // A constant torque for 0.1 s, nothing for 0.2 s, again for 0.1 s; no other force. By arithmetic:
  constexpr double torque = 0.03, a = torque / inertia;
  const double expected = a * 0.1 * 0.1 / 2 + a * 0.1 * 0.2 + (a * 0.1 * 0.1 + a * 0.1 * 0.1 / 2);
  Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, {.kind = Drive::Kind::torque}), 0.01));
  World world(scene, 1);
  auto inputs = commands(scene, torque);
  world.setRobot(0, scene.robots[0].start, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), std::vector{0.0},
                 std::vector{0.0});
  world.advance(inputs, 0.1);
  inputs[0][0].enabled = false;
  world.advance(inputs, 0.2);
  inputs[0][0].enabled = true;
  world.advance(inputs, 0.1);
  EXPECT_NEAR(expected, world.robot(0).position[0], 1e-9 * expected);
}

TEST(Servo, IsStableAndNearlyRightAtEightMilliseconds) {
  const Drive drive{.p = 7.5, .d = 0.05, .maxTorque = 0.85};
  EXPECT_LT(servoError(drive, 0.008, 0.5), 0.5 * 0.16);
  // A gain at which an explicit law would explode: h²·p/I = 17.
  const Drive stiff{.p = 400, .d = 0.05, .maxTorque = 1e9};
  Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, stiff), 0.008));
  World world(scene, 1);
  world.advance(commands(scene, 0.3), 2);
  EXPECT_LT(std::abs(world.robot(0).position[0] - 0.3), 0.35);
  EXPECT_EQ("", world.fault());
}

TEST(Servo, ReportsTheTorqueThatHoldsAWeight) {
  const Drive drive{.p = 20, .d = 0.2, .maxTorque = 2};
  Scene scene = sceneOf(robot(pendulumModel(0.5, 0.2, 0.001), false, drive), 0.002);
  World world(scene, 1);
  world.advance(commands(scene, 0.6), 4);
  // At rest the torque balances gravity: m·g·l·sin(q), and the servo gives p·(command − q).
  const auto readings = world.robot(0);
  EXPECT_NEAR(0.5 * g * 0.2 * std::sin(readings.position[0]), readings.torque[0], 1e-6);
  EXPECT_NEAR(20 * (0.6 - readings.position[0]), readings.torque[0], 1e-6);
}

TEST(Servo, NeverGivesMoreThanItsLargestTorque) {
  const Drive drive{.p = 50, .d = 0.01, .maxTorque = 0.3};
  for (const double step : {0.0005, 0.008}) {
    Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, drive), step));
    World world(scene, 1);
    for (int i = 0; i < 100; ++i) {
      world.advance(commands(scene, i < 40 ? 1.5 : -1), 0.008);
      EXPECT_LE(std::abs(world.robot(0).torque[0]), 0.3 + 1e-12);
    }
  }
}

TEST(Servo, SwitchedOffLetsTheJointSwing) {
  const Drive drive{.p = 20, .d = 0.2, .maxTorque = 2};
  double ends[2];
  for (const bool servo : {false, true}) {
    Scene scene =
        sceneOf(robot(pendulumModel(0.5, 0.2, 0.001), false, servo ? drive : Drive{.kind = Drive::Kind::none}), 0.001);
    scene.robots[0].jointStart = {1};
    World world(scene, 1);
    auto inputs = commands(scene, 0);
    inputs[0][0].enabled = false;
    world.advance(inputs, 0.6);
    ends[servo] = world.robot(0).position[0];
    EXPECT_EQ(0, world.robot(0).torque[0]);
  }
  EXPECT_EQ(ends[0], ends[1]);
}

TEST(NoLoadSpeed, IsReachedAndNeverExceededByTheServosOwnDrive) {
  // From a step that resolves the speeding up to one that is three times as long as it takes.
  for (const double step : {0.00025, 0.002, 0.008}) {
    const Drive drive{.p = 50, .d = 0.02, .maxTorque = 0.85, .noLoadSpeed_rad_s = 5.3};
    Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, drive), step));
    World world(scene, 1);
    for (int i = 0; i < 60; ++i) {
      world.advance(commands(scene, 1000), 0.008);
      EXPECT_LE(world.robot(0).rate[0], 5.3 * (1 + 1e-9)) << step;
      EXPECT_LE(std::abs(world.robot(0).torque[0]), 0.85 * (1 + 1e-12));
    }
    EXPECT_NEAR(5.3, world.robot(0).rate[0], 1e-6);
    EXPECT_NEAR(0, world.robot(0).torque[0], 1e-6);
  }
}

TEST(NoLoadSpeed, SpeedsUpExponentially) {
  const Drive drive{.p = 500, .maxTorque = 0.85, .noLoadSpeed_rad_s = 5.3};
  Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, drive), 0.00005));
  World world(scene, 1);
  const double tau = inertia * 5.3 / 0.85;  // of ω0·(1 − exp(−t/τ))
  world.advance(commands(scene, 1000), 0.008);
  EXPECT_NEAR(5.3 * (1 - std::exp(-0.008 / tau)), world.robot(0).rate[0], 0.01 * 5.3);
}

TEST(NoLoadSpeed, LeavesTheLargestTorqueToAHeldShaft) {
  const Drive drive{.p = 500, .maxTorque = 0.85, .noLoadSpeed_rad_s = 5.3, .coulombFriction = 100};
  Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, drive), 0.002));
  World world(scene, 1);
  world.advance(commands(scene, 1000), 0.1);
  EXPECT_NEAR(0.85, world.robot(0).torque[0], 1e-9);
}

TEST(NoLoadSpeed, LeavesASlowServoAndItsHoldingTorqueAsTheyAre) {
  // A weight that takes most of the torque is held to the same place with and without the line.
  const Drive plain{.p = 20, .d = 0.2, .maxTorque = 1};
  Drive line = plain;
  line.noLoadSpeed_rad_s = 5;
  double positions[2], torques[2];
  for (const bool withLine : {false, true}) {
    Scene scene = sceneOf(robot(pendulumModel(0.5, 0.2, 0.001), false, withLine ? line : plain), 0.008);
    scene.robots[0].jointStart = {0.9};
    World world(scene, 1);
    world.advance(commands(scene, 0.94), 4);
    positions[withLine] = world.robot(0).position[0];
    torques[withLine] = world.robot(0).torque[0];
  }
  EXPECT_NEAR(positions[0], positions[1], 1e-9);
  EXPECT_NEAR(torques[0], torques[1], 1e-9);
}

TEST(NoLoadSpeed, FollowsTheLawSteppedByHand) {
  // A swing through most of the speed range and back: the line drives, the full torque brakes.
  const Drive drive{.p = 7.5, .d = 0.05, .maxTorque = 0.4, .noLoadSpeed_rad_s = 5};
  Scene scene = weightless(sceneOf(robot(wheelModel(0.004), false, drive), 0.00025));
  World world(scene, 1);
  double q = 0, rate = 0, fastest = 0;
  for (int i = 0; i < 60; ++i) {
    world.advance(commands(scene, 1), 0.008);
    for (int k = 0; k < 4000; ++k) {
      const double law = 7.5 * (1 - q) - 0.05 * rate;
      const double up = std::min(0.4 * (1 - rate / 5), 0.4), down = std::max(-0.4 * (1 + rate / 5), -0.4);
      rate += std::clamp(law, down, up) / 0.004 * 2e-6;
      q += rate * 2e-6;
    }
    fastest = std::max(fastest, rate);
    EXPECT_NEAR(q, world.robot(0).position[0], 0.01);
  }
  EXPECT_GT(fastest, 4);
}

TEST(NoLoadSpeed, BrakesWhatIsDrivenBeyondIt) {
  const Drive drive{.p = 50, .maxTorque = 0.85, .noLoadSpeed_rad_s = 5};
  EXPECT_DOUBLE_EQ(0.85, largestTorque(drive, -3));
  EXPECT_DOUBLE_EQ(0.85, largestTorque(drive, 0));
  EXPECT_NEAR(0.85 * 0.4, largestTorque(drive, 3), 1e-15);
  EXPECT_DOUBLE_EQ(0, largestTorque(drive, 5));
  EXPECT_NEAR(-0.85 * 0.2, largestTorque(drive, 6), 1e-15);
  EXPECT_DOUBLE_EQ(-0.85, largestTorque(drive, 100));
  EXPECT_DOUBLE_EQ(0.85, largestTorque(Drive{.maxTorque = 0.85}, 100));

  Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, drive), 0.001));
  scene.robots[0].jointStartRate = {9};
  World world(scene, 1);
  world.advance(commands(scene, 1000), 0.004);
  EXPECT_LT(world.robot(0).torque[0], 0);
  world.advance(commands(scene, 1000), 0.2);
  EXPECT_NEAR(5, world.robot(0).rate[0], 1e-6);
}

const Drive motor{.kind = Drive::Kind::dcMotor,
                  .firmwareGain_v_rad = 40,
                  .supply_v = 7.4,
                  .torqueConstant_nm_a = 0.8,
                  .resistance_ohm = 4};

TEST(DcMotor, RunsAtItsNoLoadSpeed) {
  Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, motor), 0.002));
  World world(scene, 1);
  world.advance(commands(scene, 1000), 2);
  EXPECT_NEAR(7.4 / 0.8, world.robot(0).rate[0], 1e-6);  // ω0 = V/kt
  EXPECT_NEAR(0, world.robot(0).torque[0], 1e-6);
}

TEST(DcMotor, GivesItsStallTorqueAndHalfOfItAtHalfTheDuty) {
  Drive limited = motor;
  limited.maxDuty = 0.5;
  limited.coulombFriction = 100;  // holds the shaft
  Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, limited), 0.001));
  World world(scene, 1);
  world.advance(commands(scene, 1000), 0.1);
  EXPECT_NEAR(0.5 * 0.8 * 7.4 / 4, world.robot(0).torque[0], 1e-9);  // kt·V·duty/R
  auto inputs = commands(scene, 1000);
  inputs[0][0].supply_v = 6;
  world.advance(inputs, 0.1);
  EXPECT_NEAR(0.5 * 0.8 * 6 / 4, world.robot(0).torque[0], 1e-9);
}

TEST(DcMotor, SpeedsUpExponentiallyWithItsRotor) {
  Drive heavy = motor;
  heavy.rotorInertia_kg_m2 = 0.004;
  Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, heavy), 0.00025));
  World world(scene, 1);
  world.advance(commands(scene, 1000), 0.024);
  const double tau = (inertia + 0.004) * 4 / (0.8 * 0.8);  // J·R/kt²
  EXPECT_NEAR(7.4 / 0.8 * (1 - std::exp(-0.024 / tau)), world.robot(0).rate[0], 0.01 * 7.4 / 0.8);
}

// A step's kick lies half before the instant at which a recorded voltage jumps: it was all given the new one. A wheel
// of hundreds of radians was off by 18 mrad at a step of 1 ms.
TEST(DcMotor, IsOfSecondOrderInTheStepThoughItsRecordedVoltageJumps) {
  const double tau = inertia * motor.resistance_ohm / (motor.torqueConstant_nm_a * motor.torqueConstant_nm_a);
  const double frame_s = 0.008;
  const auto dutyOf = [](int frame) { return std::sin(0.9 * frame) * (frame % 3 == 0 ? 0.2 : 0.9); };
  const auto errorOf = [&](double step) {
    Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, motor), step));
    World world(scene, 1);
    world.setRobot(0, scene.robots[0].start, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), std::vector{0.0},
                   std::vector{0.0});
    double q = 0, rate = 0, worst = 0;
    for (int frame = 0; frame < 60; ++frame) {
      auto inputs = commands(scene, 0);
      inputs[0][0].duty = dutyOf(frame);
      world.advance(inputs, frame_s);
      // Under a constant voltage the rate comes near V/kt as exp(−t/τ).
      const double noLoad = motor.supply_v * dutyOf(frame) / motor.torqueConstant_nm_a, off = rate - noLoad;
      q += noLoad * frame_s + off * tau * (1 - std::exp(-frame_s / tau));
      rate = noLoad + off * std::exp(-frame_s / tau);
      worst = std::max(worst, std::abs(world.robot(0).position[0] - q));
    }
    return worst;
  };
  const double coarse = errorOf(0.004), middle = errorOf(0.002), fine = errorOf(0.001);
  EXPECT_LT(middle, coarse / 3.5);
  EXPECT_LT(fine, middle / 3.5);
}

TEST(DcMotor, SwitchedOffDoesNotBrake) {
  Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, motor), 0.001));
  scene.robots[0].jointStartRate = {6};
  World world(scene, 1);
  auto inputs = commands(scene, 0);
  inputs[0][0].enabled = false;
  world.advance(inputs, 0.4);
  EXPECT_NEAR(6, world.robot(0).rate[0], 1e-9);
}

TEST(RotorInertia, SlowsAJointOnAFreeBaseByItsOwnInertia) {
  // Two wheels against each other, no outer torque: reduced inertia J1·J2/(J1+J2) plus the rotor's.
  RobotModel model;
  model.name = "pair";
  model.links = {link("one", 1, {0, 0, 0}, {0.003, 0.003, 0.003}), link("two", 1, {0, 0, 0}, {0.001, 0.001, 0.001})};
  model.joints = {joint("axle", 0, {0, 1, 0})};
  Drive drive{.kind = Drive::Kind::torque, .rotorInertia_kg_m2 = 0.002};
  Scene scene = weightless(sceneOf(robot(model, true, drive), 0.001));
  World world(scene, 1);
  world.advance(commands(scene, 0.01), 0.4);
  const double reduced = 0.003 * 0.001 / 0.004 + 0.002;
  EXPECT_NEAR(0.01 / reduced * 0.4, world.robot(0).rate[0], 1e-6);
}

TEST(TorqueDrive, AcceleratesByTorqueOverInertiaUpToItsLimit) {
  for (const double command : {0.01, 5.0}) {
    Scene scene =
        weightless(sceneOf(robot(wheelModel(inertia), false, {.kind = Drive::Kind::torque, .maxTorque = 0.02}), 0.001));
    World world(scene, 1);
    world.advance(commands(scene, command), 0.4);
    EXPECT_NEAR(std::min(command, 0.02) / inertia * 0.4, world.robot(0).rate[0], 1e-9);
    EXPECT_NEAR(std::min(command, 0.02) / inertia * 0.4 * 0.4 / 2, world.robot(0).position[0], 1e-9);
  }
}

TEST(ForceDrive, MovesACarriageAndAServoPlacesIt) {
  Scene scene = weightless(sceneOf(robot(carriageModel(95), false, {.kind = Drive::Kind::torque}), 0.001));
  World world(scene, 1);
  world.advance(commands(scene, 20), 0.8);
  EXPECT_NEAR(20.0 / 95 * 0.8, world.robot(0).rate[0], 1e-9);
  EXPECT_NEAR(20.0 / 95 * 0.8 * 0.8 / 2, world.robot(0).position[0], 2e-4);
}

TEST(SlideServo, SettlesAtItsCommand) {
  Scene scene = weightless(sceneOf(robot(carriageModel(2), false, {.p = 800, .d = 80}), 0.001));
  World world(scene, 1);
  world.advance(commands(scene, 0.05), 2);
  EXPECT_NEAR(0.05, world.robot(0).position[0], 1e-6);
}

TEST(ViscousFriction, LetsTheRateDecayExponentially) {
  Scene scene = weightless(
      sceneOf(robot(wheelModel(inertia), false, {.kind = Drive::Kind::none, .viscousFriction = 0.01}), 0.00025));
  scene.robots[0].jointStartRate = {10};
  World world(scene, 1);
  world.advance(commands(scene, 0), 0.2);
  EXPECT_NEAR(10 * std::exp(-0.01 * 0.2 / inertia), world.robot(0).rate[0], 0.01);
}

TEST(CoulombFriction, StopsAWheelAfterItsStoppingAngleAndThenHoldsIt) {
  for (const double step : {0.00025, 0.004}) {
    const double friction = 0.02, rate = 8;
    Scene scene = weightless(
        sceneOf(robot(wheelModel(inertia), false, {.kind = Drive::Kind::none, .coulombFriction = friction}), step));
    scene.robots[0].jointStartRate = {rate};
    World world(scene, 1);
    world.advance(commands(scene, 0), 1.6);
    // I·rate²/(2·friction); one step's way is the integrator's error.
    EXPECT_NEAR(inertia * rate * rate / (2 * friction), world.robot(0).position[0], rate * step);
    const double stopped = world.robot(0).position[0];
    EXPECT_NEAR(0, world.robot(0).rate[0], 1e-9);
    world.advance(commands(scene, 0), 4);
    EXPECT_NEAR(stopped, world.robot(0).position[0], 1e-9);
  }
}

TEST(CoulombFriction, HoldsAPendulumUpToItsLimitAndNotBeyond) {
  const double mass = 0.5, length = 0.2;
  const double needed = mass * g * length * std::sin(0.5);
  for (const double share : {1.02, 0.98}) {
    Scene scene = sceneOf(robot(pendulumModel(mass, length, 0.001), false,
                                {.kind = Drive::Kind::none, .coulombFriction = share * needed}),
                          0.002);
    scene.robots[0].jointStart = {0.5};
    World world(scene, 1);
    world.advance(commands(scene, 0), 4);
    if (share > 1)
      EXPECT_NEAR(0.5, world.robot(0).position[0], 1e-6);
    else
      EXPECT_LT(world.robot(0).position[0], 0.49);
  }
}

TEST(CoulombFriction, StopsASlidingCarriageAfterItsWay) {
  Scene scene =
      weightless(sceneOf(robot(carriageModel(95), false, {.kind = Drive::Kind::none, .coulombFriction = 20}), 0.001));
  scene.robots[0].jointStartRate = {0.3};
  World world(scene, 1);
  world.advance(commands(scene, 0), 4);
  EXPECT_NEAR(95 * 0.3 * 0.3 / (2 * 20), world.robot(0).position[0], 0.3 * 0.001);
  EXPECT_NEAR(0, world.robot(0).rate[0], 1e-9);
}

TEST(CoulombFriction, HoldsBesideASaturatedServoWithViscousFriction) {
  const Drive drive{.p = 50, .d = 0.02, .maxTorque = 0.1, .coulombFriction = 0.12, .viscousFriction = 0.01};
  Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false, drive), 0.002));
  World world(scene, 1);
  world.advance(commands(scene, 1), 2);
  EXPECT_NEAR(0, world.robot(0).position[0], 1e-6) << "0.1 N·m cannot overcome 0.12 N·m";
}

TEST(PassiveTerms, NeverAddEnergy) {
  for (const double step : {0.0005, 0.004, 0.008}) {
    RobotModel model = pendulumModel(0.3, 0.2, 0.001);
    model.links.push_back(link("second", 0.2, {0, 0, -0.1}, {5e-4, 5e-4, 5e-4}));
    model.joints.push_back(joint("elbow", 1, {0, 1, 0}, {0, 0, -0.3}));
    Scene scene = weightless(sceneOf(
        robot(model, false, {.kind = Drive::Kind::none, .coulombFriction = 0.05, .viscousFriction = 0.02}), step));
    scene.robots[0].jointStartRate = {6, -9};
    World world(scene, 1);
    double energy = world.energy();
    for (int i = 0; i < 1000; ++i) {
      world.advance(commands(scene, 0), 0.008);
      EXPECT_LE(world.energy(), energy * 1.002 + 1e-12);
      energy = world.energy();
    }
    EXPECT_LT(energy, 1e-9);
  }
}

}  // namespace
}  // namespace btr::test
