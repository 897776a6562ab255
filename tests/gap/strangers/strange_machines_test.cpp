// Machines of other kinds, integrated here by Runge and Kutta's method, and the loggers that belong to them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "core/gap/report/report_plain.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"
#include "tests/plugin/built_plugins.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace strange_machines {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Position and rate.
using State = std::array<double, 2>;
using Acceleration = std::function<double(double t, const State&)>;

State after(const Acceleration& law, double t, const State& s, double h) {
  const auto slope = [&](double at, const State& x) { return State{x[1], law(at, x)}; };
  const auto moved = [&](const State& k, double by) { return State{s[0] + by * k[0], s[1] + by * k[1]}; };
  const State k1 = slope(t, s), k2 = slope(t + h / 2, moved(k1, h / 2)), k3 = slope(t + h / 2, moved(k2, h / 2)),
              k4 = slope(t + h, moved(k3, h));
  State next = s;
  for (std::size_t i = 0; i < 2; ++i) next[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
  return next;
}

/// One joint between a stand and a link; `limits` as URDF has them.
std::string urdf(const std::string& type, const std::string& axis, const std::string& inertial,
                 const std::string& limits = "") {
  return R"(<robot name="rig"><link name="stand"><inertial><mass value="5"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="j" type=")" +
         type + R"("><parent link="stand"/><child link="part"/><axis xyz=")" + axis + R"("/>)" + limits + R"(</joint>
  <link name="part"><inertial>)" +
         inertial + R"(</inertial></link></robot>)";
}

GapProblem problemOf(const std::string& robot, const std::string& servo, const std::string& calibrate,
                     double controlPeriod_s = 0.001) {
  const TemporaryFolder folder;
  folder.write("rig.urdf", robot);
  GapProblem problem;
  problem.scene = sceneFromJson(R"({"format": "uchilsim-scene-1", "step_s": 0.001, "control_period_s": )" +
                                    std::to_string(controlPeriod_s) + R"(, "robots": [{"name": "rig",
    "model": "rig.urdf", "base": "fixed", "position_m": [0, 0, 1], "collision": "none",
    "servos": {"j": )" + servo + R"(}}], "calibrate": [)" +
                                    calibrate + "]}",
                                "scene", folder.file("."));
  problem.models = loadModels(problem.scene);
  return problem;
}

GapReport reportOn(const GapProblem& problem) {
  return analyse(problem, {test::host().effectFactory(), test::host().effects()}, {});
}

std::vector<std::string> namesOf(const GapReport& report) {
  std::vector<std::string> names;
  for (const GapReport::Effect& each : report.tried)
    if (each.accepted) names.push_back(each.effect);
  return names;
}

double calibrated(const GapReport& report, const std::string& name) {
  for (const GapReport::Number& number : report.calibrated)
    if (number.name.ends_with(name)) return number.value;
  return NAN;
}

/// A carriage on a belt, 2.4 kg, that follows its command (two sines of drawn frequencies) with 1700 N/m and 45 N·s/m.
/// The controller works at `period` (0: without any), the logger writes 200 rows a second, in counts of 0.02 mm.
GapProblem carriage(double period) {
  constexpr double mass = 2.4, p = 1700, d = 45, h = 5e-5, row_s = 0.005;
  GapProblem problem =
      problemOf(urdf("prismatic", "1 0 0",
                     R"(<mass value="2.4"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/>)",
                     R"(<limit lower="-1" upper="1" effort="500" velocity="9"/>)"),
                R"({"p": 2000, "d": 40, "max_force_n": 400})",
                R"({"path": "robots.rig.servos.j.p", "min": 600, "max": 4000},
         {"path": "robots.rig.servos.j.d", "min": 15, "max": 120})");
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 3; ++trial) {
    std::uniform_real_distribution<double> slow(0.3, 0.7), fast(1.0, 2.0);
    const double f1 = slow(random), f2 = fast(random);
    const auto wanted = [&](double t) {
      const double s = std::max(0.0, t - 0.3), fade = std::min(1.0, s / 0.3);
      return fade * (0.1 * std::sin(2 * M_PI * f1 * s) + 0.03 * std::sin(2 * M_PI * f2 * s));
    };
    const auto told = [&](double t) { return wanted(period > 0 ? std::floor(t / period + 1e-9) * period : t); };
    Recording recording;
    recording.source = "trial_" + std::to_string(trial) + ".csv";
    recording.channels = {"time_s", "rig.j.command_m", "rig.j.position_m"};
    recording.columns.resize(3);
    State s{};
    for (long i = 0; i < std::lround(5 / h); ++i) {
      const double t = static_cast<double>(i) * h;
      if (i % std::lround(row_s / h) == 0) {
        recording.columns[0].push_back(t);
        recording.columns[1].push_back(told(t));
        recording.columns[2].push_back(std::round(s[0] / 2e-5) * 2e-5);
      }
      s = after([&](double at, const State& x) { return (p * (told(at) - x[0]) - d * x[1]) / mass; }, t, s, h);
    }
    problem.recordings.push_back(recording);
  }
  return problem;
}

// A command that goes on while the logger waits for its next row is half a row ahead of one that holds: 2.5 ms, which
// were called a rate that is fed forward, and left 15 noise floors.
TEST(StrangeCarriage, WhoseControllerIsFasterThanItsLoggerLacksNothing) {
  const GapReport report = reportOn(carriage(0));
  EXPECT_EQ(report.verdict, GapReport::Verdict::parametersSuffice) << toPlainText(report);
  EXPECT_THAT(namesOf(report), IsEmpty());
  EXPECT_NEAR(calibrated(report, "j.p"), 1700, 17);
  EXPECT_NEAR(calibrated(report, "j.d"), 45, 0.9);
  EXPECT_THAT(report.notes, Contains(HasSubstr("% of the way to the next row")));
}

TEST(StrangeCarriage, WhoseControllerWritesTheRowsHoldsItsCommands) {
  const GapReport report = reportOn(carriage(0.005));
  EXPECT_EQ(report.verdict, GapReport::Verdict::parametersSuffice) << toPlainText(report);
  EXPECT_THAT(namesOf(report), IsEmpty());
  EXPECT_NEAR(calibrated(report, "j.d"), 45, 0.9);
  EXPECT_THAT(report.notes, Each(Not(HasSubstr("to the next row"))));
}

/// A small motor turns a fan: 7.3e-4 kg·m², 0.033 N·m/A, 1.1 Ω, up to 250 rad/s, in air that takes 6.8e-6 N·m·s²/rad².
/// Its voltage changes 50 times a second; whole revolutions a minute are written every 10 ms.
GapProblem fan() {
  constexpr double inertia = 7.3e-4, constant = 0.033, resistance = 1.1, air = 6.8e-6, h = 1e-4;
  GapProblem problem =
      problemOf(urdf("continuous", "0 0 1",
                     R"(<mass value="0.2"/><inertia ixx="7.3e-4" iyy="7.3e-4" izz="7.3e-4" ixy="0" ixz="0" iyz="0"/>)"),
                R"({"drive": "dc_motor", "voltage_v": 12, "torque_constant_nm_per_a": 0.031, "resistance_ohm": 1.1})",
                R"({"path": "robots.rig.servos.j.torque_constant_nm_per_a", "min": 0.01, "max": 0.1})", 0.02);
  std::mt19937_64 random(17);
  for (int trial = 0; trial < 3; ++trial) {
    std::uniform_real_distribution<double> slow(0.2, 0.5), fast(0.8, 1.6);
    const double f1 = slow(random), f2 = fast(random);
    const auto voltage = [&](double t) {
      const double held = std::floor(t / 0.02 + 1e-9) * 0.02;
      return 6 + 3.5 * std::sin(2 * M_PI * f1 * held) + 1.5 * std::sin(2 * M_PI * f2 * held);
    };
    const Acceleration law = [&](double t, const State& x) {
      return (constant * (voltage(t) - constant * x[1]) / resistance - air * x[1] * std::abs(x[1])) / inertia;
    };
    Recording recording;
    recording.source = "trial_" + std::to_string(trial) + ".csv";
    recording.channels = {"time_s", "rig.j.voltage_v", "rig.j.velocity_rad_s"};
    recording.columns.resize(3);
    State s{0, 100};
    for (long i = 0; i < 60000; ++i) s = after([&](double, const State& x) { return law(0, x); }, 0, s, h);
    for (long i = 0; i < std::lround(6 / h); ++i) {
      const double t = static_cast<double>(i) * h;
      if (i % 100 == 0) {
        recording.columns[0].push_back(t);
        recording.columns[1].push_back(voltage(t));
        recording.columns[2].push_back(std::round(s[1] * 30 / M_PI) * M_PI / 30);
      }
      s = after(law, t, s, h);
    }
    problem.recordings.push_back(recording);
  }
  return problem;
}

// Drag was tried in the sizes of arms, which hold such a wheel; what was named in its place differed by direction, in a
// wheel that only turns in one.
TEST(StrangeFan, IsBrakedByAir) {
  const GapReport report = reportOn(fan());
  EXPECT_THAT(namesOf(report), ElementsAre("fluid_drag")) << toPlainText(report);
  for (const GapReport::Effect& each : report.tried) {
    if (!each.accepted) continue;
    EXPECT_NEAR(each.parameters[0].value, 6.8e-6, 0.2e-6);
  }
}

}  // namespace strange_machines
}  // namespace btr
