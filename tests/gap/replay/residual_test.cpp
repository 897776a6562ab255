#include "core/gap/replay/residual.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"
#include "core/sim/world.h"
#include "tests/gap/scene_of.h"
#include "tests/refusal.h"

namespace btr {
namespace {

using testing::HasSubstr;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// 190 Hz with a regular wobble and one long pause, as a serial bus gives.
std::vector<double> unevenTimes(std::size_t count) {
  std::vector<double> times;
  double t = 0.00357;
  for (std::size_t i = 0; i < count; ++i) {
    times.push_back(t);
    t += 0.0053 + 0.0009 * std::sin(1.7 * static_cast<double>(i)) + (i == count / 2 ? 0.03 : 0);
  }
  return times;
}

Recording recordingAt(std::vector<double> times) {
  Recording recording;
  recording.source = "trial.csv";
  recording.channels = {"time_s"};
  recording.columns = {std::move(times)};
  return recording;
}

std::vector<double>& addColumn(Recording& recording, const std::string& channel,
                               const std::function<double(double)>& value) {
  recording.channels.push_back(channel);
  recording.columns.emplace_back();
  for (const double t : recording.columns[0]) recording.columns.back().push_back(value(t));
  return recording.columns.back();
}

/// What our own world measures at the recorded times when it is driven by hand: robot 0, joint `joint`.
struct Driven {
  std::vector<double> positions, rates;
};
Driven drive(const Scene& scene, const std::vector<double>& times, std::size_t joint, double start,
             const std::function<JointInput(std::size_t)>& input) {
  World world(scene, 1);
  const std::size_t joints = scene.robots[0].model.joints.size();
  std::vector<double> positions(joints, 0), rates(joints, 0);
  positions[joint] = start;
  world.setRobot(0, scene.robots[0].start, {0, 0, 0}, {0, 0, 0}, positions, rates);
  std::vector<std::vector<JointInput>> inputs(1, std::vector<JointInput>(joints));
  Driven driven;
  for (std::size_t row = 0; row < times.size(); ++row) {
    driven.positions.push_back(world.robot(0).position[joint]);
    driven.rates.push_back(world.robot(0).rate[joint]);
    if (row + 1 == times.size()) break;
    inputs[0][joint] = input(row);
    world.advance(inputs, times[row + 1] - times[row]);
  }
  return driven;
}

std::string refusalOf(const Scene& scene, const Recording& recording) {
  return test::refusal([&] { residual(scene, {recording}); });
}

const std::string servo = R"("hinge": {"p": 6, "d": 0.05, "max_torque_nm": 1.5}, "rail": {"drive": "none"})";

TEST(Residual, IsZeroForARecordingThatTheSameWorldMade) {
  const Scene scene = rigScene(servo);
  Recording recording = recordingAt(unevenTimes(400));
  const auto command = addColumn(recording, "rig.hinge.command_rad", [](double t) { return 0.6 * std::sin(7 * t); });
  const Driven driven =
      drive(scene, recording.columns[0], 0, 0, [&](std::size_t row) { return JointInput{.command = command[row]}; });
  // At rest while the first samples are read.
  addColumn(recording, "rig.hinge.position_rad", [](double) { return 0; }) = driven.positions;
  addColumn(recording, "rig.hinge.velocity_rad_s", [](double) { return 0; }) = driven.rates;
  const Binding binding = bind(scene, recording);
  StartState start = startState(scene, recording, binding);
  start.robots[0].positions[0] = start.robots[0].rates[0] = 0;
  const ReplayedRecording replayed = replayRecording(scene, recording, binding, start);
  EXPECT_EQ(replayed.values[0], driven.positions);
  EXPECT_EQ(replayed.values[1], driven.rates);
  EXPECT_EQ(replayed.fault, "");
}

TEST(Residual, OfAShiftedSensorIsTheShift) {
  // The joint rests at its command; the sensor says 0.02 rad more after the start.
  const Scene scene = rigScene(servo);
  Recording recording = recordingAt(unevenTimes(300));
  addColumn(recording, "rig.hinge.command_rad", [](double) { return 0; });
  auto& position = addColumn(recording, "rig.hinge.position_rad", [](double t) { return t > 0.5 ? 0.02 : 0; });
  const auto shifted = static_cast<double>(std::count(position.begin(), position.end(), 0.02));
  const ChannelError error = residual(scene, {recording}).channels.at(0);
  EXPECT_EQ(error.samples, 300u);
  EXPECT_NEAR(error.maximum, 0.02, 1e-9);
  EXPECT_NEAR(error.bias, -0.02 * shifted / 300, 1e-9);
  EXPECT_NEAR(error.meanAbsolute, 0.02 * shifted / 300, 1e-9);
  EXPECT_NEAR(error.rootMeanSquare, 0.02 * std::sqrt(shifted / 300), 1e-9);
}

TEST(Residual, OfAConstantForceIsTheParabolaOfTheWrongMass) {
  // Truth: 2.5 kg; the scene says 2 kg. x = F t²/(2m), force held from the first row.
  const Scene scene = rigScene(R"("hinge": {"drive": "none"}, "rail": {"drive": "force"})");
  Recording recording = recordingAt(unevenTimes(200));
  const double t0 = recording.columns[0][0];
  addColumn(recording, "rig.rail.force_n", [](double) { return 3; });
  addColumn(recording, "rig.rail.position_m", [&](double t) { return 3 * (t - t0) * (t - t0) / (2 * 2.5); });
  const ChannelError error = residual(scene, {recording}).channels.at(0);
  const double duration = recording.columns[0].back() - t0;
  const double expected = 3 * duration * duration / 2 * (1 / 2.0 - 1 / 2.5);
  // The step's own error is at most h/2 · v.
  EXPECT_NEAR(error.maximum, expected, 0.0005 * 1.5 * duration + 1e-6);
  EXPECT_GT(error.bias, 0);
}

TEST(Residual, TakesTheCommandAtItsTimeHoweverUnevenTheTimes) {
  // A force from 0.5 s to 0.5 s + one long pause: momentum is force × the pause, not force × a nominal period.
  const Scene scene = rigScene(R"("hinge": {"drive": "none"}, "rail": {"drive": "force"})");
  Recording recording = recordingAt(unevenTimes(200));
  const std::vector<double> times = recording.columns[0];
  auto& force = addColumn(recording, "rig.rail.force_n", [](double) { return 0; });
  force[100] = 10;
  addColumn(recording, "rig.rail.velocity_m_s", [](double) { return 0; });
  addColumn(recording, "rig.rail.position_m", [](double) { return 0; });
  const ChannelError error = residual(scene, {recording}).channels.at(0);
  ASSERT_EQ(error.channel, "rig.rail.velocity_m_s");
  const double momentum = 10 * (times[101] - times[100]);
  const double ofAStep = 10 * 0.0005;  // an integrator may share a kick with the step before or after
  EXPECT_EQ(error.simulated[100], 0);
  EXPECT_NEAR(2 * error.simulated[101], momentum, ofAStep);
  EXPECT_NEAR(2 * error.simulated[199], momentum, ofAStep);
}

TEST(Residual, HoldsTheLastInputOverEmptyCells) {
  const Scene scene = rigScene(R"("hinge": {"drive": "none"}, "rail": {"drive": "force"})");
  Recording recording = recordingAt({0, 0.1, 0.2, 0.3});
  auto& force = addColumn(recording, "rig.rail.force_n", [](double) { return 4; });
  force[1] = force[2] = nothing;
  addColumn(recording, "rig.rail.velocity_m_s", [](double) { return 0; });
  EXPECT_NEAR(residual(scene, {recording}).channels[0].simulated[3], 4 * 0.3 / 2, 4 * 0.0005 / 2);
  recording.columns[1][0] = nothing;
  EXPECT_THAT(refusalOf(scene, recording), HasSubstr("(rig.rail.force_n): an empty cell"));
}

TEST(Residual, SwingsFreelyWhileTheServoIsSwitchedOff) {
  // Held at 0.4 rad, switched off at the first row: a pendulum whose energy m g r (1 − cos q) + J w²/2 stays.
  const Scene scene = rigScene(servo);
  std::vector<double> times;
  for (int i = 0; i < 400; ++i) times.push_back(0.005 * i);
  Recording recording = recordingAt(times);
  addColumn(recording, "rig.hinge.command_rad", [](double) { return 0.4; });
  addColumn(recording, "rig.hinge.enabled", [](double) { return 0; });
  addColumn(recording, "rig.hinge.position_rad", [](double) { return 0.4; });
  addColumn(recording, "rig.hinge.velocity_rad_s", [](double) { return 0; });
  const auto channels = residual(scene, {recording}).channels;
  const double inertia = 0.5 * 0.2 * 0.2 + 1e-4, weight = 0.5 * 9.81 * 0.2;
  const double before = weight * (1 - std::cos(0.4));
  double lowest = 1;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double q = channels[0].simulated[i], w = channels[1].simulated[i];
    EXPECT_NEAR(weight * (1 - std::cos(q)) + inertia * w * w / 2, before, 0.01 * before);
    lowest = std::min(lowest, q);
  }
  EXPECT_NEAR(lowest, -0.4, 0.004);
}

TEST(Residual, DrivesAMotorByItsMeasuredVoltageDutyOrFirmware) {
  // No load: the motor turns at u/kt when it has settled. A cart with kt = 2 N/A, R = 1 Ω settles in m R/kt² = 0.5 s.
  const std::string rail = R"("hinge": {"drive": "none"}, "rail": {"drive": "dc_motor", "voltage_v": 8,
    "force_constant_n_per_a": 2, "resistance_ohm": 1, "firmware_gain_v_per_m": )";
  const auto finalSpeed = [&](const std::string& gain, const std::vector<std::pair<std::string, double>>& columns) {
    std::vector<double> times;
    for (int i = 0; i < 1000; ++i) times.push_back(0.01 * i);
    Recording recording = recordingAt(times);
    for (const auto& [channel, value] : columns) addColumn(recording, channel, [v = value](double) { return v; });
    addColumn(recording, "rig.rail.velocity_m_s", [](double) { return 0; });
    const auto report = residual(rigScene(rail + gain + "}"), {recording});
    return report.channels.at(0).simulated.back();
  };
  EXPECT_NEAR(finalSpeed("0", {{"rig.rail.voltage_v", 3}}), 1.5, 1e-6);
  EXPECT_NEAR(finalSpeed("0", {{"rig.rail.voltage_v", -3}}), -1.5, 1e-6);
  EXPECT_NEAR(finalSpeed("0", {{"rig.rail.duty", 0.25}}), 0.25 * 8 / 2, 1e-6);
  EXPECT_NEAR(finalSpeed("0", {{"rig.rail.duty", -0.25}, {"rig.rail.voltage_v", 6}}), -0.25 * 6 / 2, 1e-6);
  // Far from its goal the firmware gives full duty of the supply of the moment.
  EXPECT_NEAR(finalSpeed("1000", {{"rig.rail.command_m", 40}, {"rig.rail.voltage_v", 6}}), 3, 1e-6);
  EXPECT_NEAR(finalSpeed("1000", {{"rig.rail.command_m", 40}}), 4, 1e-6);
  EXPECT_EQ(finalSpeed("0", {}), 0);
}

TEST(Residual, ScalesTheFirmwaresDutyByTheSupplyOfTheMoment) {
  // Stalled by a spring-like balance: duty = gain·(goal − q)/8 V; torque = kt·duty·supply/R balances gravity m g r sin
  // q.
  const auto rest = [](double supply) {
    const Scene scene = rigScene(R"("rail": {"drive": "none"}, "hinge": {"drive": "dc_motor", "voltage_v": 8,
      "torque_constant_nm_per_a": 0.4, "resistance_ohm": 2, "firmware_gain_v_per_rad": 10})");
    std::vector<double> times;
    for (int i = 0; i < 2000; ++i) times.push_back(0.005 * i);
    Recording recording = recordingAt(times);
    addColumn(recording, "rig.hinge.command_rad", [](double) { return 0.5; });
    addColumn(recording, "rig.hinge.voltage_v", [&](double) { return supply; });
    addColumn(recording, "rig.hinge.position_rad", [](double) { return 0; });
    return residual(scene, {recording}).channels.at(0).simulated.back();
  };
  for (const double supply : {8.0, 5.0}) {
    const double q = rest(supply);
    EXPECT_NEAR(0.4 / 2 * 10 * (0.5 - q) / 8 * supply, 0.5 * 9.81 * 0.2 * std::sin(q), 1e-6) << supply;
  }
}

TEST(Residual, StartsMovingWhereTheRecordingMoves) {
  const Scene scene = rigScene(R"("hinge": {"drive": "none"}, "rail": {"drive": "none"})");
  Recording recording = recordingAt(unevenTimes(200));
  addColumn(recording, "rig.rail.position_m", [](double t) { return 0.3 + 1.5 * t; });
  const ChannelError error = residual(scene, {recording}).channels.at(0);
  EXPECT_LT(error.maximum, 1e-9);
}

TEST(Residual, FollowsAThrownBall) {
  const Scene scene = rigScene(R"("hinge": {"drive": "none"}, "rail": {"drive": "none"})",
                               R"("balls": [{"name": "ball", "position_m": [5, 5, 5]}])");
  std::vector<double> times;
  for (int i = 0; i < 100; ++i) times.push_back(0.01 * i);
  Recording recording = recordingAt(times);
  addColumn(recording, "ball.x_m", [](double t) { return 1 + 2 * t; });
  addColumn(recording, "ball.y_m", [](double) { return 3; });
  addColumn(recording, "ball.z_m", [](double t) { return 2 + 3 * t - 9.81 * t * t / 2; });
  for (const ChannelError& error : residual(scene, {recording}).channels)
    EXPECT_LT(error.maximum, 9.81 * 0.0005 / 2 * 1 + 1e-6) << error.channel;
}

TEST(Residual, RefusesChannelsThatTheSceneDoesNotHave) {
  const Scene scene = rigScene(servo);
  const auto refusal = [&](const std::string& channel) {
    Recording recording = recordingAt({0, 1});
    addColumn(recording, channel, [](double) { return 0; });
    return refusalOf(scene, recording);
  };
  EXPECT_THAT(refusal("dog.hinge.position_rad"), HasSubstr("the scene's robots are: rig"));
  EXPECT_THAT(refusal("rig.knee.position_rad"), HasSubstr("the joints of rig are: hinge, rail"));
  EXPECT_THAT(refusal("ball.x_m"), HasSubstr("the scene's balls are: none"));
  EXPECT_THAT(refusal("rig.rail.position_rad"), HasSubstr("the joint slides: position_m"));
  EXPECT_THAT(refusal("rig.hinge.force_n"), HasSubstr("the joint turns: torque_nm"));
  EXPECT_THAT(refusal("rig.hinge.command_rad"), HasSubstr("no column can be compared"));
}

TEST(Residual, SaysWhatItCouldNotUse) {
  Recording recording = recordingAt({0, 0.1, 0.2});
  recording.notes = {"column \"x\" is not mapped to a channel; kept, not used"};
  addColumn(recording, "rig.hinge.current_a", [](double) { return 0; });
  addColumn(recording, "rig.hinge.position_rad", [](double) { return 0; });
  EXPECT_THAT(
      residual(rigScene(servo), {recording}).notes,
      testing::ElementsAre("trial.csv: column \"x\" is not mapped to a channel; kept, not used",
                           "trial.csv: rig.hinge: no command column; its servo holds the starting position",
                           "trial.csv: rig.hinge.current_a: the simulator has no such quantity here; not compared"));
}

TEST(Residual, TellsMillisecondsBeforeItReplaysThem) {
  std::vector<double> times;
  for (int i = 0; i < 60; ++i) times.push_back(10 * i);
  Recording recording = recordingAt(times);
  addColumn(recording, "rig.hinge.position_rad", [](double) { return 0; });
  EXPECT_THAT(refusalOf(rigScene(servo), recording), HasSubstr("milliseconds, it seems"));
}

TEST(Residual, SaysWhenTheStepIsTooCoarse) {
  Scene scene = rigScene(R"("hinge": {"drive": "none"}, "rail": {"drive": "none"})");
  std::vector<double> times;
  for (int i = 0; i < 600; ++i) times.push_back(0.005 * i);
  Recording recording = recordingAt(times);
  // A fine sensor at rest far from balance: it falls fast.
  addColumn(recording, "rig.hinge.position_rad", [](double t) { return 2 + 1e-7 * std::sin(40 * t); });
  scene.step_s = 0.005;
  const ResidualReport coarse = residual(scene, {recording});
  EXPECT_GT(coarse.channels[0].stepError, coarse.channels[0].resolution);
  EXPECT_THAT(coarse.notes, testing::Contains(HasSubstr("the integration's own error")));
  scene.step_s = 0.0005;
  EXPECT_LT(residual(scene, {recording}).channels[0].stepError, 0.25 * coarse.channels[0].stepError);
}

TEST(ResidualRun, ReadsSceneMappingSettingsAndWritesItsFiles) {
  const TemporaryFolder folder;
  folder.write("rig.urdf", rigUrdf);
  const std::string scene = folder.write("scene.json", R"({"format": "uchilsim-scene-1", "step_s": 0.0005,
    "control_period_s": 0.005, "robots": [{"name": "rig", "model": "rig.urdf", "base": "fixed", "collision": "none",
    "servos": {"hinge": {"drive": "none"}, "rail": {"drive": "dc_motor", "voltage_v": 8, "force_constant_n_per_a": 2}}}]})");
  // Degrees become radians, feet become metres; the trial's own voltage stands in its name.
  folder.write("scene.mapping.json", R"({"time_s": {"column": "ms", "scale": 0.001},
    "rig.rail.position_m": {"column": "feet", "scale": -0.3048}, "rig.rail.duty": {"column": "duty"},
    "settings": [{"file_contains": "volts4", "values": {"robots.rig.servos.rail.voltage_v": 4}}]})");
  std::string rows = "ms,feet,duty\n";
  for (int i = 0; i < 1000; ++i) rows += std::to_string(10 * i) + ",0,0.5\n";
  const std::string first = folder.write("volts4.csv", rows), second = folder.write("volts8.csv", rows);
  std::vector<std::size_t> counted;
  const ResidualReport report = runResidual(
      {.scene = scene, .recordings = {first, second}, .mapping = "", .simulator = "", .out = folder.file("out")}, {},
      [&](std::size_t done, std::size_t) {
        counted.push_back(done);
        return true;
      });
  ASSERT_EQ(report.channels.size(), 2u);
  // Settled at u/kt: 1 and 2 m/s for 9.99 s, less the settling time m R/kt² = 0.5 s.
  EXPECT_NEAR(report.channels[0].maximum, 1 * (9.99 - 0.5), 0.01);
  EXPECT_NEAR(report.channels[1].maximum, 2 * (9.99 - 0.5), 0.02);
  // Asked in the middle of each recording, too.
  EXPECT_GE(std::ranges::count(counted, 0u), 3);
  counted.erase(std::unique(counted.begin(), counted.end()), counted.end());
  EXPECT_EQ(counted, (std::vector<std::size_t>{0, 1, 2}));
  for (const std::string name : {"out/volts4.rig.rail.position_m.svg", "out/volts8.rig.rail.position_m.svg",
                                 "out/residual.json", "out/residual.txt"})
    EXPECT_TRUE(std::filesystem::is_regular_file(folder.file(name))) << name;

  // Stopped in the middle of the only recording: nothing of it is there.
  int asked = 0;
  const ResidualReport none =
      runResidual({.scene = scene, .recordings = {first}, .mapping = "", .simulator = "", .out = folder.file("none")},
                  {}, [&](std::size_t, std::size_t) { return ++asked < 3; });
  EXPECT_EQ(3, asked);
  EXPECT_TRUE(none.channels.empty());
  EXPECT_FALSE(std::filesystem::exists(folder.file("none")));
}

}  // namespace
}  // namespace btr
