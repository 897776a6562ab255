// A motor that is driven by a voltage turns a beam that swings: what is recorded is the motor.
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/recordings/recording.h"
#include "core/gap/report/report_plain.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

constexpr double rotor_kg_m2 = 0.010, beam_kg_m2 = 0.018, stiffness_nm_rad = 4.6;  // the beam alone: 16 rad/s
constexpr double torquePerVolt = 0.6, braking_nm_s_rad = 0.36;

/// The beam is rigid in the scene; motor constants are to be calibrated. Its axis is vertical.
SceneSpec beamScene(const TemporaryFolder& folder) {
  folder.write("beam.urdf", R"(<robot name="rig">
    <link name="stand"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
    <joint name="base" type="continuous"><parent link="stand"/><child link="beam"/><axis xyz="0 0 1"/></joint>
    <link name="beam"><inertial><origin xyz="0.15 0 0"/><mass value="0.6"/>
      <inertia ixx="1e-4" iyy="4.5e-3" izz="4.5e-3" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)");
  return sceneFromJson(R"({"format": "uchilsim-scene-1", "step_s": 0.001, "control_period_s": 0.004, "robots": [
    {"name": "rig", "model": "beam.urdf", "base": "fixed", "position_m": [0, 0, 1], "collision": "none", "servos": {
      "base": {"drive": "dc_motor", "voltage_v": 12, "max_duty": 1, "torque_constant_nm_per_a": 1,
               "resistance_ohm": 2, "rotor_inertia_kg_m2": 0.01}}}],
    "calibrate": [{"path": "robots.rig.servos.base.torque_constant_nm_per_a", "min": 0.1, "max": 5},
                  {"path": "robots.rig.servos.base.resistance_ohm", "min": 0.2, "max": 10}]})",
                       "scene", folder.file("."));
}

/// The motor under a loop that follows a sine which grows faster, for 3 s at 4 ms, in counts of 3 mrad; integrated in
/// steps of 0.05 ms.
Recording swept(double fastest_hz, std::uint64_t number) {
  constexpr double step_s = 5e-5, count_rad = 0.003, loop_v_rad = 8, length_s = 3;
  Random random = Random::forPurpose(5, "beam", number);
  Recording recording;
  recording.source = "swept_" + std::to_string(number) + ".csv";
  recording.sha256 = recording.source;
  recording.channels = {"time_s", "rig.base.voltage_v", "rig.base.position_rad"};
  recording.columns.resize(3);
  double motor = 0, motorRate = 0, beam = 0, beamRate = 0, volts = 0, counted = 0;
  for (int i = 0; i < std::lround(length_s / step_s); ++i) {
    const double t = i * step_s;
    if (i % 80 == 0) {
      counted = std::round((motor + 0.001 * random.normal()) / count_rad) * count_rad;
      volts = loop_v_rad * (0.3 * std::sin(M_PI * fastest_hz * t * t / length_s) - counted);
      recording.columns[0].push_back(t);
      recording.columns[1].push_back(volts);
      recording.columns[2].push_back(counted);
    }
    const double spring = stiffness_nm_rad * (motor - beam) + 0.005 * (motorRate - beamRate);
    motorRate += step_s * (torquePerVolt * volts - braking_nm_s_rad * motorRate - spring) / rotor_kg_m2;
    beamRate += step_s * spring / beam_kg_m2;
    motor += step_s * motorRate;
    beam += step_s * beamRate;
  }
  return recording;
}

// As a function of time any single motion can be explained: that would be no law.
TEST(SwingingBeam, IsFoundBehindAMotorInOneRecording) {
  const TemporaryFolder folder;
  GapProblem problem;
  problem.scene = beamScene(folder);
  problem.models = loadModels(problem.scene);
  problem.recordings = {swept(5, 0)};
  problem.heldOut = {swept(8, 1)};
  AnalysisOptions options;
  options.effects = {"gear_elasticity", "coulomb_friction", "viscous_friction", "rotor_inertia",
                     "sensor_lag",      "drive_lag",        "backlash"};
  const GapReport report = analyse(problem, library(), options);
  const auto found =
      std::ranges::find_if(report.tried, [](const GapReport::Effect& effect) { return effect.accepted; });
  ASSERT_NE(found, report.tried.end()) << toPlainText(report);
  EXPECT_EQ(found->effect, "gear_elasticity");
  const auto compliance = std::ranges::find(found->parameters, "compliance_rad_nm", &GapReport::Number::name);
  ASSERT_NE(compliance, found->parameters.end());
  EXPECT_NEAR(compliance->value, 1 / stiffness_nm_rad, 0.1 / stiffness_nm_rad);
  EXPECT_EQ(std::ranges::count_if(report.tried, &GapReport::Effect::accepted), 1) << toPlainText(report);
  EXPECT_TRUE(report.law.curves.empty()) << toPlainText(report);
}

}  // namespace
}  // namespace btr
