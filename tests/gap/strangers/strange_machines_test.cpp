// Machines of other kinds, integrated here by Runge and Kutta's method, and the loggers that belong to them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
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

/// What the numbers of an accepted effect are; no number where it was not accepted.
double numberOf(const GapReport& report, const std::string& effect, const std::string& name) {
  for (const GapReport::Effect& each : report.tried)
    for (const GapReport::Number& number : each.parameters)
      if (each.accepted && each.effect == effect && number.name == name) return number.value;
  return NAN;
}

/// A reference of three sines that fades in, of drawn frequencies and sizes that add up to 1.
std::function<double(double)> reference(std::mt19937_64& random) {
  std::uniform_real_distribution<double> slow(0.2, 0.5), middle(0.7, 1.2), fast(1.5, 2.4);
  return [f1 = slow(random), f2 = middle(random), f3 = fast(random)](double t) {
    const double s = std::max(0.0, t - 0.5), fade = std::min(1.0, s / 0.3);
    return fade * (0.6 * std::sin(2 * M_PI * f1 * s) + 0.28 * std::sin(2 * M_PI * f2 * s) +
                   0.12 * std::sin(2 * M_PI * f3 * s));
  };
}

/// A cart of 2 kg on a spring of 120 N/m that rests at 0.02 m. Its controller (400 N/m, 35 N·s/m) sets a force every
/// 5 ms, which is written with the place, to 0.02 mm.
GapProblem cartOnASpring() {
  constexpr double h = 1e-4, row_s = 0.005;
  GapProblem problem =
      problemOf(urdf("prismatic", "1 0 0",
                     R"(<mass value="2"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/>)",
                     R"(<limit lower="-2" upper="2" effort="100" velocity="9"/>)"),
                R"({"drive": "force", "max_force_n": 100})",
                R"({"path": "robots.rig.links.part.mass_kg", "min": 1, "max": 4})", row_s);
  std::mt19937_64 random(23);
  std::normal_distribution<double> noise(0, 2e-5);
  for (int trial = 0; trial < 3; ++trial) {
    const auto wanted = reference(random);
    Recording recording;
    recording.source = "trial_" + std::to_string(trial) + ".csv";
    recording.channels = {"time_s", "rig.j.command_n", "rig.j.position_m"};
    recording.columns.resize(3);
    State s{};
    double force = 0;
    for (long i = 0; i < std::lround(5 / h); ++i) {
      const double t = static_cast<double>(i) * h;
      if (i % std::lround(row_s / h) == 0) {
        force = std::round(1000 * (400 * (0.15 * wanted(t) - s[0]) - 35 * s[1])) / 1000;
        recording.columns[0].push_back(t);
        recording.columns[1].push_back(force);
        recording.columns[2].push_back(s[0] + noise(random));
      }
      s = after([&](double, const State& x) { return (force - 120 * (x[0] - 0.02)) / 2; }, t, s, h);
    }
    problem.recordings.push_back(recording);
  }
  return problem;
}

// A usual spring was one of a servo's joint, 0.1 N·m/rad: at a thousand times that nobody looked.
TEST(StrangeCarriage, OnASpringOfAnySizeIsSaidToBe) {
  const GapReport report = reportOn(cartOnASpring());
  EXPECT_THAT(namesOf(report), ElementsAre("joint_spring")) << toPlainText(report);
  EXPECT_NEAR(numberOf(report, "joint_spring", "stiffness_nm_rad"), 120, 1.2);
  EXPECT_NEAR(numberOf(report, "joint_spring", "rest_rad"), 0.02, 0.001);
}

/// A pendulum of 0.8 kg at 0.2 m behind a servo of 6 N·m/rad and 0.2 N·m·s/rad, all as its owner says; oil takes
/// `friction` N·m·s/rad. He trusts neither mass nor gain.
GapProblem pendulumInOil(double friction) {
  constexpr double h = 1e-4, row_s = 0.01, mass = 0.8, arm = 0.2, own = 0.002;
  GapProblem problem = problemOf(urdf("revolute", "0 1 0",
                                      R"(<origin xyz="0 0 -0.2"/><mass value="0.8"/>
              <inertia ixx="0.002" iyy="0.002" izz="0.0005" ixy="0" ixz="0" iyz="0"/>)",
                                      R"(<limit lower="-2.5" upper="2.5" effort="3" velocity="20"/>)"),
                                 R"({"p": 6, "d": 0.2, "max_torque_nm": 3})",
                                 R"({"path": "robots.rig.servos.j.p", "min": 3, "max": 12},
         {"path": "robots.rig.links.part.mass_kg", "min": 0.5, "max": 1.2})",
                                 row_s);
  std::mt19937_64 random(29);
  std::normal_distribution<double> noise(0, 5e-4);
  for (int trial = 0; trial < 2; ++trial) {
    const auto wanted = reference(random);
    Recording recording;
    recording.source = "trial_" + std::to_string(trial) + ".csv";
    recording.channels = {"time_s", "rig.j.command_rad", "rig.j.position_rad"};
    recording.columns.resize(3);
    State s{};
    double command = 0;
    for (long i = 0; i < std::lround(8 / h); ++i) {
      const double t = static_cast<double>(i) * h;
      if (i % std::lround(row_s / h) == 0) {
        command = wanted(t);
        recording.columns[0].push_back(t);
        recording.columns[1].push_back(command);
        recording.columns[2].push_back(s[0] + noise(random));
      }
      s = after(
          [&](double, const State& x) {
            const double torque = std::clamp(6 * (command - x[0]) - 0.2 * x[1], -3.0, 3.0);
            return (torque - mass * 9.81 * arm * std::sin(x[0]) - friction * x[1]) / (own + mass * arm * arm);
          },
          t, s, h);
    }
    problem.recordings.push_back(recording);
  }
  return problem;
}

// Calibration took such friction for a third of the gain and of the mass; beside those numbers it promised nothing, and
// a torque-speed limit beside a gain had its place.
TEST(StrangePendulum, WhoseFrictionLooksLikeAWeakServoIsSaidToHaveIt) {
  const GapReport report = reportOn(pendulumInOil(0.15));
  EXPECT_THAT(namesOf(report), ElementsAre("viscous_friction")) << toPlainText(report);
  EXPECT_NEAR(numberOf(report, "viscous_friction", "coefficient_nm_s_rad"), 0.15, 0.003);
  EXPECT_NEAR(calibrated(report, "j.p"), 6, 0.1);
}

}  // namespace strange_machines
}  // namespace btr
