// Inverse scoring: the torque that a recorded motion takes.
#include "core/gap/replay/inverse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/inverse_text.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"
#include "core/gap/report/report_json.h"
#include "core/sim/world.h"
#include "core/spec/error.h"
#include "tests/gap/scene_of.h"

namespace btr {
namespace {

Scene doublePendulum(const Values& values = {}) {
  const SceneSpec spec = loadScene(SOURCE_DIR "/resources/scenes/dfki.json");
  return makeScene(spec, loadModels(spec), {values, {}}, {});
}

/// Drives the double pendulum with smooth torques, all but continuous, and writes down what a recorder would.
Recording swing(const Scene& scene, double period, double seconds) {
  constexpr int finer = 10;
  Recording recording;
  recording.source = "made";
  recording.channels = {"time_s", "dp.shoulder.position_rad", "dp.shoulder.torque_nm", "dp.elbow.position_rad",
                        "dp.elbow.torque_nm"};
  recording.columns.resize(recording.channels.size());
  World world(scene, 1);
  std::vector<std::vector<JointInput>> inputs(1, std::vector<JointInput>(2));
  const auto torques = [&](double time) {
    inputs[0][0].command = 0.8 * std::sin(2 * M_PI * 0.9 * time);
    inputs[0][1].command = 0.5 * std::sin(2 * M_PI * 1.3 * time);
  };
  const auto rows = static_cast<int>(seconds / period);
  for (int row = 0; row < rows; ++row) {
    const double time = row * period;
    torques(time);
    const RobotReadings now = world.robot(0);
    const double values[]{time, now.position[0], inputs[0][0].command, now.position[1], inputs[0][1].command};
    for (std::size_t i = 0; i < 5; ++i) recording.columns[i].push_back(values[i]);
    for (int part = 0; part < finer; ++part) {
      torques(time + (part + 0.5) * period / finer);
      world.advance(inputs, period / finer);
    }
  }
  return recording;
}

const Values frictionAndRotors{{"robots.dp.joints.shoulder.coulomb_friction_nm", 0.16},
                               {"robots.dp.joints.elbow.coulomb_friction_nm", 0.12},
                               {"robots.dp.joints.shoulder.viscous_friction_nm_s_rad", 0.02},
                               {"robots.dp.servos.shoulder.rotor_inertia_kg_m2", 0.00226},
                               {"robots.dp.servos.elbow.rotor_inertia_kg_m2", 0.00226}};

TEST(Inverse, FindsTheTorqueThatMadeAMotionToSecondOrderOfTheSamplingTime) {
  const Scene scene = doublePendulum();
  const InverseReport coarse = inverse(scene, {swing(scene, 0.002, 4)}, {100, 5});
  const InverseReport fine = inverse(scene, {swing(scene, 0.001, 4)}, {100, 10});
  ASSERT_EQ(fine.joints.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_LT(fine.joints[i].relative, 0.2) << fine.joints[i].error.channel;
    EXPECT_LT(fine.joints[i].relative, 0.4 * coarse.joints[i].relative) << fine.joints[i].error.channel;
  }
}

TEST(Inverse, FindsTheTorqueOfAMotionWithDryFrictionAndRotors) {
  const Scene scene = doublePendulum(frictionAndRotors);
  const Recording recording = swing(scene, 0.002, 5);
  // Where a joint rests, friction may take any share of the torque that holds it: what is told apart is the moving
  // rest.
  for (const InverseError& joint : inverse(scene, {recording}, {100, 10}).joints)
    EXPECT_LT(joint.relative, 5) << joint.error.channel;
  // Without friction and rotors the same motion takes clearly other torques.
  for (const InverseError& joint : inverse(doublePendulum(), {recording}, {100, 10}).joints)
    EXPECT_GT(joint.relative, 15) << joint.error.channel;
}

/// x = ½·a·t² of the 2 kg carriage of the rig, and a force column that is wrong by a tenth.
Recording accelerated(double acceleration, int rows) {
  Recording recording;
  recording.source = "made";
  recording.channels = {"time_s", "rig.rail.position_m", "rig.rail.force_n"};
  recording.columns.resize(3);
  for (int i = 0; i < rows; ++i) {
    const double time = 0.001 * i;
    recording.columns[0].push_back(time);
    recording.columns[1].push_back(acceleration * time * time / 2);
    recording.columns[2].push_back(2 * acceleration * 1.1);
  }
  return recording;
}

TEST(Inverse, ForceIsMassTimesAccelerationInEveryRow) {
  const Scene scene = rigScene(R"("rail": {"drive": "motion"}, "hinge": {"drive": "none"})");
  const Recording recording = accelerated(3, 200);
  const Binding binding = bind(scene, recording);
  ASSERT_EQ(binding.measured.size(), 1u);
  const ReplayedRecording replayed = replayRecording(scene, recording, binding, startState(scene, recording, binding));
  for (std::size_t row = 0; row < 200; ++row) EXPECT_NEAR(replayed.values[0][row], 6, 1e-4) << row;
}

TEST(Inverse, ARotorFollowsThePrescribedJointEvenBehindAnElasticGear) {
  Scene scene = rigScene(R"("rail": {"drive": "motion"}, "hinge": {"drive": "none"})");
  Drive& drive = scene.robots[0].drives[1];
  drive.rotorInertia_kg_m2 = 1;
  drive.gearCompliance = 1e-3;
  const Recording recording = accelerated(3, 200);
  const Binding binding = bind(scene, recording);
  const ReplayedRecording replayed = replayRecording(scene, recording, binding, startState(scene, recording, binding));
  for (std::size_t row = 0; row < 200; ++row) EXPECT_NEAR(replayed.values[0][row], (2 + 1) * 3, 1e-4) << row;
}

TEST(Inverse, AWindowThatBeginsInTheMiddleHasTheSameForces) {
  const Scene scene = rigScene(R"("rail": {"drive": "motion"}, "hinge": {"drive": "none"})");
  const Recording recording = accelerated(3, 200);
  const Binding binding = bind(scene, recording);
  const StartState start = startState(scene, recording, binding, 100);
  const ReplayedRecording replayed = replayRecording(scene, recording, binding, start, 100, 120);
  for (std::size_t row = 100; row < 120; ++row) EXPECT_NEAR(replayed.values[0][row], 6, 1e-4) << row;
  EXPECT_TRUE(std::isnan(replayed.values[0][99]));
}

/// The hinge leaning by half a radian, where its weight has 0.47 N·m, with what a sensor adds, in one swing of
/// `beyond_rad` around it.
Recording leaning(double noise_rad, double beyond_rad) {
  Recording recording;
  recording.source = "made";
  recording.channels = {"time_s", "rig.hinge.position_rad", "rig.hinge.torque_nm"};
  recording.columns.resize(3);
  for (int i = 0; i < 400; ++i) {
    const double time = 0.005 * i;
    recording.columns[0].push_back(time);
    recording.columns[1].push_back(0.5 + noise_rad * std::sin(2 * M_PI * 5 * time) +
                                   beyond_rad * std::sin(2 * M_PI * 0.5 * time));
    recording.columns[2].push_back(0);
  }
  return recording;
}

std::vector<double> torqueOf(const Recording& recording, double dryFriction) {
  Scene scene = rigScene(R"("hinge": {"drive": "motion"}, "rail": {"drive": "none"})");
  scene.robots[0].drives[0].coulombFriction = dryFriction;
  const Binding binding = bind(scene, recording);
  return replayRecording(scene, recording, binding, startState(scene, recording, binding)).values[0];
}

TEST(Inverse, WhereAJointRestsItsFrictionCarriesWhatItCan) {
  const Recording rests = leaning(1e-4, 0);
  const double weight = 0.5 * 9.81 * 0.2 * std::sin(0.5);
  const auto held = torqueOf(rests, 0.6), partly = torqueOf(rests, 0.3), none = torqueOf(rests, 0);
  for (std::size_t row = 1; row < 400; ++row) {
    EXPECT_NEAR(held[row], 0, 0.01) << row;
    EXPECT_NEAR(partly[row], weight - 0.3, 0.01) << row;
    EXPECT_NEAR(none[row], weight, 0.01) << row;
  }
  // A joint that moves has friction against its motion, also where it turns round.
  const Recording moves = leaning(0, 0.4);
  const auto with = torqueOf(moves, 0.3), without = torqueOf(moves, 0);
  for (std::size_t row = 10; row < 390; ++row) {
    const double rate = std::cos(2 * M_PI * 0.5 * moves.columns[0][row]);
    if (std::abs(rate) < 0.1) continue;
    EXPECT_NEAR(with[row] - without[row], std::copysign(0.3, rate), 1e-3) << row;
  }
}

TEST(Inverse, RelativeErrorIsThatOfTheNorms) {
  const Scene scene = rigScene(R"("rail": {"drive": "force"}, "hinge": {"drive": "none"})");
  const InverseReport report = inverse(scene, {accelerated(3, 2000)}, {100, 10});
  ASSERT_EQ(report.joints.size(), 1u);
  EXPECT_NEAR(report.joints[0].relative, 100 * 0.1 / 1.1, 0.01);
  EXPECT_NEAR(report.joints[0].rootMeanSquare_recorded, 6.6, 1e-3);
  const auto json = nlohmann::json::parse(toJsonText(report));
  EXPECT_EQ(json["format"], "uchilsim-inverse-1");
  EXPECT_NEAR(json["joints"][0]["relative_error_percent"].get<double>(), 100 * 0.1 / 1.1, 0.01);
  EXPECT_NE(inverseTable(report).find("9.09"), std::string::npos);
}

TEST(Inverse, RefusesARecordingWithoutTorqueAndFiltersThatItCannotCarry) {
  const Scene scene = rigScene(R"("rail": {"drive": "force"}, "hinge": {"drive": "none"})");
  Recording silent = accelerated(3, 2000);
  silent.channels.pop_back();
  silent.columns.pop_back();
  EXPECT_THROW(inverse(scene, {silent}, {100, 10}), InputError);
  EXPECT_THROW(inverse(scene, {accelerated(3, 2000)}, {500, 10}), InputError);
  EXPECT_THROW(inverse(scene, {accelerated(3, 2000)}, {100, 200}), InputError);
}

}  // namespace
}  // namespace btr
