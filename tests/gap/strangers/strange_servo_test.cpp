// What an analysis makes of a servo that was integrated elsewhere (strange_servo.h): real machines differ from the laws
// of the library in structure, above all in where their sensors sit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/gap/report/report_plain.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"
#include "tests/gap/strangers/strange_servo.h"
#include "tests/plugin/built_plugins.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

constexpr const char* strangeUrdf = R"(<robot name="rig">
  <link name="wall"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hinge" type="continuous"><parent link="wall"/><child link="bob"/><axis xyz="0 1 0"/></joint>
  <link name="bob"><inertial><origin xyz="0 0 -0.2"/><mass value="0.5"/>
    <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)";

/// What its owner believes of the servo; the gains are not trusted, `limit` says whether its torque is.
struct Believed {
  double p = 6, d = 0.3, maxTorque = 3;
  bool limit = true;
};

constexpr double length_s = 3;  ///< of a trial; of an analysis three, one of each excitation

/// The rig as its owner describes it: a link, a rotor, a servo.
GapProblem strangeProblem(const strange::Plant& plant, std::uint64_t seed, int trials, const Believed& believed = {}) {
  const TemporaryFolder folder;
  folder.write("rig.urdf", strangeUrdf);
  GapProblem problem;
  problem.scene = sceneFromJson(R"({"format": "uchilsim-scene-1", "step_s": 0.001, "control_period_s": 0.01, "robots": [
    {"name": "rig", "model": "rig.urdf", "base": "fixed", "position_m": [0, 0, 1], "collision": "none", "servos": {
      "hinge": {"p": 6, "d": 0.3, "max_torque_nm": 3, "rotor_inertia_kg_m2": 0.002}}}],
    "calibrate": [{"path": "robots.rig.servos.hinge.p", "min": 3, "max": 12},
                  {"path": "robots.rig.servos.hinge.d", "min": 0.1, "max": 0.9}]})",
                                "scene", folder.file("."));
  Values& servo = problem.scene.robots[0].servos.at("hinge").numbers;
  servo["p"] = believed.p;
  servo["d"] = believed.d;
  servo["max_torque_nm"] = believed.maxTorque;
  if (!believed.limit) problem.scene.calibrate.push_back({"robots.rig.servos.hinge.max_torque_nm", 0.5, 4});
  problem.models = loadModels(problem.scene);
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < trials; ++trial) {
    const auto around = strange::excitation(trial, random);
    const auto command = [&](double time) { return plant.bias + around(time); };
    const strange::Trial made = strange::Servo(plant).run(command, length_s, 0.005, 5e-4, random);
    Recording recording;
    recording.source = "trial_" + std::to_string(trial) + ".csv";
    recording.channels = {"time_s", "rig.hinge.command_rad", "rig.hinge.position_rad"};
    recording.columns = {made.time, made.command, made.position};
    problem.recordings.push_back(recording);
  }
  return problem;
}

GapReport reportOn(const strange::Plant& plant, std::uint64_t seed, const std::vector<std::string>& among = {},
                   const Believed& believed = {}) {
  AnalysisOptions options;
  options.effects = among;
  return analyse(strangeProblem(plant, seed, 3, believed), {test::host().effectFactory(), test::host().effects()},
                 options);
}

/// What is named, first its rivals are asked for that it cannot be told from.
bool names(const GapReport& report, const std::string& effect) {
  for (const GapReport::Effect& each : report.tried) {
    if (!each.accepted) continue;
    if (each.effect == effect && each.at == "rig.hinge") return true;
    if (each.rivals.size() > 2) continue;
    for (const GapReport::Rival& rival : each.rivals)
      if (rival.effect == effect && rival.at == "rig.hinge") return true;
  }
  return false;
}

TEST(StrangeServo, ThatLacksNothingIsMerelyCalibrated) {
  strange::Plant plant;
  plant.p = 5.6;
  plant.d = 0.33;
  const GapReport report = reportOn(plant, 1);
  EXPECT_EQ(report.verdict, GapReport::Verdict::parametersSuffice) << toPlainText(report);
}

/// Play that is named wherever its sensors sit, among what it is most like.
class StrangePlay : public testing::TestWithParam<int> {};

TEST_P(StrangePlay, IsNamed) {
  strange::Plant plant;
  plant.play = 0.04;
  plant.loopAtMotor = (GetParam() & 1) != 0;
  plant.recordedAtMotor = (GetParam() & 2) != 0;
  const GapReport report = reportOn(plant, 2, {"backlash", "coulomb_friction", "command_delay", "gear_elasticity"});
  EXPECT_TRUE(names(report, "backlash")) << toPlainText(report);
}
INSTANTIATE_TEST_SUITE_P(WithItsLoopAtTheMotor, StrangePlay, testing::Values(1, 3));

class StrangeSpring : public testing::TestWithParam<int> {};

TEST_P(StrangeSpring, InTheGearIsNamed) {
  strange::Plant plant;
  plant.stiffness = 25;
  plant.damping = 0.1;
  plant.loopAtMotor = (GetParam() & 1) != 0;
  plant.recordedAtMotor = (GetParam() & 2) != 0;
  const GapReport report = reportOn(plant, 3, {"backlash", "coulomb_friction", "gear_elasticity", "joint_spring"});
  EXPECT_TRUE(names(report, "gear_elasticity")) << toPlainText(report);
}
INSTANTIATE_TEST_SUITE_P(WithItsLoopAtTheMotor, StrangeSpring, testing::Values(1, 3));

TEST(StrangeServo, ThatGrowsWeakerWithTimeIsSaidTo) {
  strange::Plant plant;
  plant.lossPerSecond = 0.04;
  const GapReport report = reportOn(plant, 4, {"strength_decline", "voltage_sag", "torque_speed_limit", "payload"});
  EXPECT_TRUE(names(report, "strength_decline")) << toPlainText(report);
}

TEST(StrangeServo, WithAnIntegralTermIsSaidToHaveIt) {
  strange::Plant plant;
  plant.integral = 6;
  plant.integralClamp = 0.4;
  const GapReport report = reportOn(plant, 5, {"integral_action", "joint_spring", "coulomb_friction", "force_offset"});
  EXPECT_TRUE(names(report, "integral_action")) << toPlainText(report);
}

/// The accepted effect's numbers.
Values sizesOf(const GapReport& report, const std::string& effect) {
  Values sizes;
  for (const GapReport::Effect& each : report.tried)
    if (each.accepted && each.effect == effect)
      for (const GapReport::Number& number : each.parameters) sizes[number.name] = number.value;
  return sizes;
}

// Servos are on for long before somebody records them.
TEST(StrangeServo, WhoseIntegralHasSettledBeforeIsSaidToHaveIt) {
  strange::Plant plant;
  plant.integral = 9;
  plant.integralClamp = 0.5;
  plant.bias = 0.4;
  plant.before = 4;
  const GapReport report = reportOn(plant, 6, {"integral_action", "gear_elasticity", "command_filter", "joint_spring"});
  const Values found = sizesOf(report, "integral_action");
  ASSERT_TRUE(found.contains("gain_nm_rad_s")) << toPlainText(report);
  EXPECT_NEAR(found.at("gain_nm_rad_s"), 9, 0.9);
  EXPECT_EQ(found.at("settled"), 1);
}

// Not wound up: while the torque is at its limit nothing is added up. A limited sum alone left 24 noise floors, under
// three wrong names.
TEST(StrangeServo, WhoseIntegralWaitsAtTheLimitIsSaidTo) {
  strange::Plant plant;
  plant.maxTorque = 1.6;
  plant.integral = 14;
  plant.integralClamp = 1e3;
  plant.integralWaits = true;
  const GapReport report = reportOn(
      plant, 31, {"integral_action", "gravity_compensation", "sensor_scale", "voltage_sag"}, {.maxTorque = 1.6});
  const Values found = sizesOf(report, "integral_action");
  ASSERT_TRUE(found.contains("gain_nm_rad_s")) << toPlainText(report);
  EXPECT_NEAR(found.at("gain_nm_rad_s"), plant.integral, 0.03 * plant.integral);
  EXPECT_EQ(found.at("waits"), 1);
}

// Limits above what the owner believes change nothing, and a fit that came there stayed: a payload was named.
TEST(StrangeServo, WhoseLimitIsLowerThanItsOwnerBelievesIsSaidTo) {
  strange::Plant plant;
  plant.maxTorque = 1.4;
  const GapReport report =
      reportOn(plant, 32, {"torque_speed_limit", "voltage_sag", "asymmetric_friction"}, {.maxTorque = 2});
  const Values found = sizesOf(report, "torque_speed_limit");
  ASSERT_TRUE(found.contains("inverse_stall_torque_1_nm")) << toPlainText(report);
  EXPECT_NEAR(1 / found.at("inverse_stall_torque_1_nm"), plant.maxTorque, 0.02 * plant.maxTorque);
}

TEST(StrangeServo, WhoseSupplyFallsKeepsItsDamping) {
  strange::Plant plant;
  plant.p = 8;
  plant.lossPerSecond = 0.1;
  plant.lossTime = 4;
  plant.lossOfSupply = true;
  const GapReport report = reportOn(plant, 7, {"strength_decline", "voltage_sag", "torque_speed_limit", "payload"});
  const Values found = sizesOf(report, "strength_decline");
  ASSERT_TRUE(found.contains("damping_stays")) << toPlainText(report);
  EXPECT_EQ(found.at("damping_stays"), 1);
  EXPECT_NEAR(found.at("loss_1_s"), 0.1, 0.02);
}

TEST(StrangeServo, WhoseFirmwareLeadsItAlongATrapezoidIsSaidTo) {
  strange::Plant plant;
  plant.profileSpeed = 2.5;
  plant.profileAcceleration = 30;
  const GapReport report =
      reportOn(plant, 8, {"command_profile", "command_filter", "torque_speed_limit", "viscous_friction"});
  const Values found = sizesOf(report, "command_profile");
  ASSERT_TRUE(found.contains("inverse_speed_s_rad")) << toPlainText(report);
  EXPECT_NEAR(1 / found.at("inverse_speed_s_rad"), 2.5, 0.1);
  EXPECT_NEAR(1 / found.at("inverse_acceleration_s2_rad"), 30, 5);
}

TEST(StrangeServo, ThatDampsTheRateOfItsErrorIsSaidTo) {
  strange::Plant plant;
  plant.errorRate = plant.d;
  const GapReport report = reportOn(plant, 10, {"rate_feedforward", "load_dependent_friction"});
  const Values found = sizesOf(report, "rate_feedforward");
  ASSERT_TRUE(found.contains("gain_nm_s_rad")) << toPlainText(report);
  EXPECT_NEAR(found.at("gain_nm_s_rad"), plant.d, 0.1 * plant.d);
}

TEST(StrangeServo, ThatHoldsItsTorqueBetweenTwoLooksIsSaidTo) {
  strange::Plant plant;
  plant.loopPeriod = 0.01;
  const GapReport report =
      reportOn(plant, 12, {"sampled_loop", "joint_spring", "position_offset", "command_filter", "rotor_inertia"});
  const Values found = sizesOf(report, "sampled_loop");
  ASSERT_TRUE(found.contains("period_ms")) << toPlainText(report);
  EXPECT_EQ(found.at("period_ms"), 1e3 * plant.loopPeriod);
  EXPECT_NEAR(found.at("share"), 1, 0.05);
}

// Half the period beside less damping is nearly the same, and calibration has taken the damping away.
TEST(StrangeServo, ThatHoldsItsTorqueAndIsOftenAtItsLimitIsSaidToForTheWholePeriod) {
  strange::Plant plant;
  plant.p = 6.5;
  plant.d = 0.2;
  plant.maxTorque = 1.5;
  plant.loopPeriod = 0.01;
  const GapReport report = reportOn(plant, 14, {"sampled_loop"}, {6.1, 0.177, 1.39, false});
  const Values found = sizesOf(report, "sampled_loop");
  ASSERT_TRUE(found.contains("period_ms")) << toPlainText(report);
  EXPECT_EQ(found.at("period_ms"), 1e3 * plant.loopPeriod);
  EXPECT_NEAR(found.at("share"), 1, 0.05);
}

TEST(StrangeServo, ThatLetsSmallErrorsBeIsSaidTo) {
  for (const bool whole : {false, true}) {
    strange::Plant plant;
    plant.errorBand = 0.03;
    plant.wholeBeyond = whole;
    const GapReport report = reportOn(plant, 13, {"error_dead_band", "drive_dead_band", "backlash", "integral_action"});
    const Values found = sizesOf(report, "error_dead_band");
    ASSERT_TRUE(found.contains("half_width_rad")) << toPlainText(report);
    EXPECT_NEAR(found.at("half_width_rad"), plant.errorBand, 0.05 * plant.errorBand);
    EXPECT_EQ(found.at("kind"), whole ? 0 : 1);
  }
}

TEST(StrangeServo, WithASoftGearBehindItsLoopIsSaidToHaveIt) {
  strange::Plant plant;
  plant.stiffness = 9;
  plant.damping = 0.01;
  plant.loopAtMotor = true;
  const GapReport report = reportOn(plant, 9, {"gear_elasticity", "command_filter", "gravity_tilt", "payload"});
  EXPECT_TRUE(names(report, "gear_elasticity")) << toPlainText(report);
}

// It was called an elastic gear beside a rate feedforward.
TEST(StrangeServo, ThatHoldsAShareOfTheWeightBeforehandIsSaidTo) {
  strange::Plant plant;
  plant.maxTorque = 1.3;
  plant.weightHeld = 0.6;
  const GapReport report = reportOn(
      plant, 18, {"gravity_compensation", "gear_elasticity", "rotor_inertia", "integral_action"}, {6, 0.3, 1.4, false});
  const Values found = sizesOf(report, "gravity_compensation");
  ASSERT_TRUE(found.contains("share")) << toPlainText(report);
  EXPECT_NEAR(found.at("share"), plant.weightHeld, 0.02);
}

TEST(StrangeServo, ThatIsStrongerUpwardsIsSaidTo) {
  strange::Plant plant;
  plant.strongerUp = 0.2;
  const GapReport report = reportOn(plant, 19, {"direction_gain", "asymmetric_friction", "position_offset"});
  const Values found = sizesOf(report, "direction_gain");
  ASSERT_TRUE(found.contains("difference")) << toPlainText(report);
  EXPECT_NEAR(found.at("difference"), plant.strongerUp, 0.01);
  EXPECT_EQ(found.at("kind"), 0);
}

TEST(StrangeServo, WhoseRecordersZeroCreepsIsSaidToHaveThatSensor) {
  strange::Plant plant;
  plant.drift = 0.004;
  const GapReport report = reportOn(plant, 20, {"sensor_drift", "force_offset", "direction_gain", "sensor_scale"});
  const Values found = sizesOf(report, "sensor_drift");
  ASSERT_TRUE(found.contains("rate_rad_s")) << toPlainText(report);
  EXPECT_NEAR(found.at("rate_rad_s"), plant.drift, 1e-4);
  EXPECT_EQ(found.at("closes_loop"), 0);
}

// Screening is linear, and a lag as long as this is not: others promise more and are fitted first.
TEST(StrangeServo, WhoseSensorLagsIsSaidToThoughOthersPromiseMore) {
  strange::Plant plant;
  plant.d = 0.4;
  plant.sensorLag = 0.09;
  AnalysisOptions options;
  options.effects = {"sensor_lag",           "gear_elasticity", "gravity_tilt",
                     "gravity_compensation", "sensor_scale",    "rotor_inertia"};
  options.thresholds.screening.fitted = 4;
  options.maximumEffects = 1;
  const GapProblem problem = strangeProblem(plant, 2, 3);
  const GapReport report = analyse(problem, {test::host().effectFactory(), test::host().effects()}, options);
  const Values found = sizesOf(report, "sensor_lag");
  ASSERT_TRUE(found.contains("time_constant_s")) << toPlainText(report);
  EXPECT_NEAR(found.at("time_constant_s"), plant.sensorLag, 0.03 * plant.sensorLag);
}

// Held weight does much the same, and was named.
TEST(StrangeServo, WhoseRecordersGainIsWrongIsSaidToHaveThatSensor) {
  strange::Plant plant;
  plant.sensorScale = 0.04;
  const GapReport report = reportOn(plant, 21, {"sensor_scale", "gravity_compensation", "joint_spring"});
  const Values found = sizesOf(report, "sensor_scale");
  ASSERT_TRUE(found.contains("excess")) << toPlainText(report);
  EXPECT_NEAR(found.at("excess"), plant.sensorScale, 1e-3);
  EXPECT_TRUE(sizesOf(report, "gravity_compensation").empty()) << toPlainText(report);
}

// A camera whose zero is not the joint's; the servo has a sensor of its own.
TEST(StrangeServo, WhoseRecordersZeroIsOffIsSaidToHaveThatSensor) {
  strange::Plant plant;
  plant.recorderOffset = 0.04;
  const GapReport report =
      reportOn(plant, 33, {"position_offset", "sensor_eccentricity", "gravity_tilt", "force_offset", "joint_spring"});
  const Values found = sizesOf(report, "position_offset");
  ASSERT_TRUE(found.contains("offset_rad")) << toPlainText(report);
  EXPECT_NEAR(found.at("offset_rad"), plant.recorderOffset, 5e-4);
  EXPECT_EQ(found.at("closes_loop"), 0);
}

// A log that was filtered: a delay with a rotor and play was named.
TEST(StrangeServo, WhoseLogIsFilteredIsSaidToHaveThatSensor) {
  strange::Plant plant;
  plant.recorderLag = 0.016;
  const GapReport report = reportOn(plant, 34, {"sensor_lag", "command_delay", "rotor_inertia", "gear_elasticity"});
  const Values found = sizesOf(report, "sensor_lag");
  ASSERT_TRUE(found.contains("time_constant_s")) << toPlainText(report);
  EXPECT_NEAR(found.at("time_constant_s"), plant.recorderLag, 5e-4);
  EXPECT_EQ(found.at("closes_loop"), 0);
}

TEST(StrangeServo, WhoseFrictionBuildsUpOverAWayIsSaidToHaveThatOne) {
  strange::Plant plant;
  plant.bristle = 0.15;
  plant.bristleWay = 0.06;
  const GapReport report =
      reportOn(plant, 22, {"bristle_friction", "coulomb_friction", "load_dependent_friction", "joint_spring"});
  const Values found = sizesOf(report, "bristle_friction");
  ASSERT_TRUE(found.contains("give_rad")) << toPlainText(report);
  EXPECT_NEAR(found.at("torque_nm"), plant.bristle, 0.005);
  EXPECT_NEAR(found.at("give_rad"), plant.bristleWay, 0.003);
}

// What it adds up to is only known to be more than it was.
TEST(StrangeServo, WhoseIntegralIsNeverFullIsNotSaidToBe) {
  strange::Plant plant;
  plant.integral = 6;
  plant.integralClamp = 50;
  const GapReport report = reportOn(plant, 23, {"integral_action"});
  const Values found = sizesOf(report, "integral_action");
  ASSERT_TRUE(found.contains("clamp_nm")) << toPlainText(report);
  EXPECT_GT(found.at("clamp_nm"), 10);
  EXPECT_NEAR(found.at("gain_nm_rad_s"), plant.integral, 0.3);
}

// It winds up until it swings over the top: no free run ends where it did, whatever the numbers, and nothing was found.
TEST(StrangeServo, WhoseWholeTrialsAreLostIsLookedAtInWindows) {
  strange::Plant plant;
  plant.maxTorque = 1.05;
  plant.integral = 40;
  plant.integralClamp = 50;
  AnalysisOptions options;
  options.effects = {"integral_action"};
  options.designNext = false;
  const GapReport report = analyse(strangeProblem(plant, 24, 3, {7, 0.28, 1.4, false}),
                                   {test::host().effectFactory(), test::host().effects()}, options);
  EXPECT_EQ(report.window_s, 1) << toPlainText(report);
  const Values found = sizesOf(report, "integral_action");
  ASSERT_TRUE(found.contains("gain_nm_rad_s")) << toPlainText(report);
  EXPECT_NEAR(found.at("gain_nm_rad_s"), plant.integral, 0.2 * plant.integral);
}

TEST(StrangeServo, WithAHardStopOnEitherSideIsSaidToHaveThem) {
  strange::Plant plant;
  plant.spring = 400;
  plant.springFrom = 0.5;
  const GapReport report =
      reportOn(plant, 18, {"joint_stop", "joint_spring", "torque_ripple", "coulomb_friction", "backlash"});
  EXPECT_EQ(report.verdict, GapReport::Verdict::missingPhysics) << toPlainText(report);
  const Values found = sizesOf(report, "joint_stop");
  ASSERT_TRUE(found.contains("stiffness_nm_rad")) << toPlainText(report);
  EXPECT_NEAR(found.at("stiffness_nm_rad"), plant.spring, 0.05 * plant.spring);
  EXPECT_NEAR(found.at("lower_rad"), -plant.springFrom, 0.002);
  EXPECT_NEAR(found.at("upper_rad"), plant.springFrom, 0.002);
}

// Where stops themselves are not looked for, a straight spring takes most of the error, and a curve beside it the rest,
// which is a wrong name and a wrong curve: the curve alone is what it is.
TEST(StrangeServo, WithSoftStopsOnEitherSideHasASpringWithADeadZoneAndNoOtherName) {
  strange::Plant plant;
  plant.spring = 2;
  plant.springFrom = 0.3;
  const GapReport report = reportOn(plant, 17, {"joint_spring", "torque_ripple"});
  EXPECT_TRUE(sizesOf(report, "joint_spring").empty()) << toPlainText(report);
  EXPECT_TRUE(sizesOf(report, "torque_ripple").empty()) << toPlainText(report);
  ASSERT_TRUE(report.law.known()) << toPlainText(report);
  EXPECT_EQ(report.law.family, "dead zone") << toPlainText(report);
  EXPECT_LT(report.law.error, 1.5) << toPlainText(report);
}

// Its stamps are off by up to 1.2 ms, so that fast samples lie a few times the sensor's noise off. The recordings that
// no fit sees move twice as fast.
TEST(StrangeServo, WhoseStampsJitterLacksNothingHoweverFastItMoves) {
  strange::Plant plant;
  plant.p = 5.6;
  plant.d = 0.33;
  GapProblem problem = strangeProblem(plant, 15, 3);
  std::mt19937_64 random(16);
  std::uniform_real_distribution<double> off(-0.0012, 0.0012);
  for (Recording& recording : problem.recordings)
    for (std::size_t row = 1; row < recording.rows(); ++row) recording.columns[0][row] += off(random);
  Recording fast = problem.recordings[0];
  const auto command = [](double t) { return t < 0.3 ? 0.0 : 1.5 * std::sin(12 * (t - 0.3)); };
  const strange::Trial made = strange::Servo(plant).run(command, length_s, 0.005, 5e-4, random);
  fast.source = "fast.csv";
  fast.columns = {made.time, made.command, made.position};
  for (std::size_t row = 1; row < fast.rows(); ++row) fast.columns[0][row] += off(random);
  problem.heldOut = {fast};
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "command_delay", "torque_speed_limit"};
  const GapReport report = analyse(problem, {test::host().effectFactory(), test::host().effects()}, options);
  EXPECT_EQ(report.verdict, GapReport::Verdict::parametersSuffice) << toPlainText(report);
  ASSERT_EQ(report.channels.size(), 1u);
  EXPECT_GT(report.channels[0].heldoutFloor(), 1.2 * report.channels[0].noiseFloor);
  EXPECT_LT(report.channels[0].heldoutWithEffects, 1.5 * report.channels[0].heldoutFloor()) << toPlainText(report);
}

}  // namespace
}  // namespace btr
