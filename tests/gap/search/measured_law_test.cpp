// Forces that no effect of the library is, in a pendulum that is integrated in the test: what they depend on is said,
// recordings that no fit saw are predicted, and nothing is made up where nothing is missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/gap/fit/fit.h"
#include "core/gap/report/report_plain.h"
#include "core/gap/search/laws/law_screen.h"
#include "core/gap/search/laws/law_shape.h"
#include "core/gap/search/laws/law_terms.h"
#include "tests/gap/pendulum_world.h"

namespace btr {
namespace {

using testing::HasSubstr;
using Verdict = GapReport::Verdict;

double detent(double q) {
  const double u = (q - 0.2) / 0.06;
  return -0.3 * u * std::exp(0.5 - u * u / 2);
}

/// So many of them at a time; each more is fitted beside every other, and takes as long again.
AnalysisOptions usualEffects(int most = 1) {
  AnalysisOptions options;
  options.maximumEffects = most;
  options.effects = {"coulomb_friction", "viscous_friction", "joint_spring",
                     "force_offset",     "torque_ripple",    "backlash"};
  options.designNext = false;
  return options;
}

void expectLaw(const GapReport& report, const std::string& on, const std::string& family) {
  ASSERT_TRUE(report.law.known()) << toPlainText(report);
  EXPECT_EQ(report.law.curves[0].on, on) << report.law.sentence;
  EXPECT_EQ(report.law.family, family) << report.law.sentence;
  EXPECT_THAT(report.law.sentence, HasSubstr("at rig.hinge that depends on " + on)) << report.law.sentence;
  EXPECT_THAT(report.sentence, HasSubstr(report.law.sentence));
  const GapReport::Channel& channel = report.channels[0];
  EXPECT_LT(channel.heldoutWithEffects, 0.4 * channel.heldoutCalibrated) << toPlainText(report);
  const auto& effects = report.after.effects;
  EXPECT_TRUE(std::ranges::any_of(effects, [](const PlacedEffect& e) { return e.effect == measuredLaw; }));
}

TEST(MeasuredLaw, OfADetent) {
  const GapReport report =
      analyse(test::pendulumProblem([](double q, double, double) { return detent(q); }), library(), usualEffects(2));
  expectLaw(report, "position", "detent");
  EXPECT_EQ(report.verdict, Verdict::unexplained) << report.sentence;
  const GapReport::LawCurve& curve = report.law.curves[0];
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (std::abs(curve.x[i] - 0.1) < 0.4) {
      EXPECT_NEAR(curve.y[i], detent(curve.x[i]), 0.06) << curve.x[i];
    }
}

/// The torque that a drawn path of rigUrdf's hinge takes beside a detent, by the equation of motion; white noise of 1 %
/// of the detent's.
Recording recordedAlongAPath(std::uint64_t number) {
  constexpr double inertia = 0.5 * 0.2 * 0.2 + 1e-4, weight = 0.5 * 9.81 * 0.2;
  Random random = Random::forPurpose(9, "path", number);
  struct Sine {
    double size_rad, rate_rad_s, phase;
  };
  std::array<Sine, 3> sines{};
  for (Sine& sine : sines) sine = {random.uniform(0.2, 0.4), random.uniform(1, 6), random.uniform(0, 2 * M_PI)};
  Recording recording;
  recording.source = "path_" + std::to_string(number) + ".csv";
  recording.sha256 = "of path " + std::to_string(number);
  recording.channels = {"time_s", "rig.hinge.command_nm", "rig.hinge.position_rad"};
  recording.columns.resize(3);
  for (int i = 0; i < 800; ++i) {
    const double t = 0.005 * i;
    double q = 0, acceleration = 0;
    for (const Sine& sine : sines) {
      const double now = sine.size_rad * std::sin(sine.rate_rad_s * t + sine.phase);
      q += now;
      acceleration -= sine.rate_rad_s * sine.rate_rad_s * now;
    }
    const double torque = inertia * acceleration + weight * std::sin(q) - detent(q) + 0.003 * random.normal();
    for (std::size_t c = 0; const double value : {t, torque, q}) recording.columns[c++].push_back(value);
  }
  return recording;
}

// Where a motion is prescribed, its torque is what is compared: a curve over the position shows there, too.
TEST(MeasuredLaw, OfADetentOnAJointWhoseTorqueWasRecordedAlongItsPath) {
  GapProblem problem = hingeProblem();
  problem.scene.robots[0].servos["hinge"] = {};
  problem.scene.robots[0].servos["hinge"].drive = "motion";
  problem.scene.calibrate.clear();
  for (std::uint64_t i = 0; i < 5; ++i) (i < 3 ? problem.recordings : problem.heldOut).push_back(recordedAlongAPath(i));
  AnalysisOptions options = usualEffects();
  options.effects = {"coulomb_friction", "viscous_friction"};
  const GapReport report = analyse(std::move(problem), library(), options);
  expectLaw(report, "position", "detent");
  const GapReport::LawCurve& curve = report.law.curves[0];
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (std::abs(curve.x[i] - 0.1) < 0.4) {
      EXPECT_NEAR(curve.y[i], detent(curve.x[i]), 0.06) << curve.x[i];
    }
}

TEST(MeasuredLaw, OfACam) {
  const auto cam = [](double q, double, double) { return 0.25 * std::sin(2 * M_PI * (q - 0.1) / 0.9); };
  expectLaw(analyse(test::pendulumProblem(cam), library(), usualEffects()), "position", "cam");
}

TEST(MeasuredLaw, OfASpringThatHardens) {
  const auto spring = [](double q, double, double) { return -4 * q * q * q; };
  expectLaw(analyse(test::pendulumProblem(spring), library(), usualEffects()), "position", "hardening spring");
}

// What swings freely passes the ends of its curve for a moment, and is soon far from where a wrong torque has it: the
// curve was cut off before its ends, and kept few knots.
TEST(MeasuredLaw, OfASpringThatHardensOnAPendulumThatSwingsFreely) {
  GapProblem problem = hingeProblem();
  problem.scene.robots[0].servos["hinge"] = {};
  problem.scene.robots[0].servos["hinge"].drive = "none";
  problem.scene.calibrate.clear();
  const auto spring = [](double q, double rate, double) { return -q * q * q - 0.02 * rate; };
  for (std::uint64_t i = 0; i < 5; ++i) {
    const test::TrialWorld world{
        .p = 0, .d = 0, .letGo_rad = (i % 2 == 0 ? 1 : -1) * (1.6 - 0.15 * static_cast<double>(i))};
    Recording recording = test::recordedPendulum(spring, 300 + i, world);
    recording.channels.erase(recording.channels.begin() + 1);
    recording.columns.erase(recording.columns.begin() + 1);
    (i < 3 ? problem.recordings : problem.heldOut).push_back(recording);
  }
  AnalysisOptions options = usualEffects();
  options.effects = {"coulomb_friction", "viscous_friction"};
  const GapReport report = analyse(problem, library(), options);
  expectLaw(report, "position", "hardening spring");
  EXPECT_LT(report.ladder.back().error, 0.01 * report.ladder.front().error) << toPlainText(report);
  const GapReport::LawCurve& curve = report.law.curves[0];
  EXPECT_LT(curve.x.front(), -1.3);
  EXPECT_GT(curve.x.back(), 1.3);
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    if (std::abs(curve.x[i]) < 1.1) {
      EXPECT_NEAR(curve.y[i], -std::pow(curve.x[i], 3), 0.15) << curve.x[i];
    }
}

TEST(MeasuredLaw, OfADriftWithTime) {
  const auto drift = [](double, double, double t) { return -0.4 * (1 - std::exp(-t / 1.5)); };
  expectLaw(analyse(test::pendulumProblem(drift), library(), usualEffects()), "time", "drift");
}

TEST(MeasuredLaw, IsNoneWhereNothingIsMissing) {
  const GapReport report =
      analyse(test::pendulumProblem([](double, double, double) { return 0.0; }), library(), usualEffects());
  EXPECT_EQ(report.verdict, Verdict::noMismatch) << report.sentence;
  EXPECT_FALSE(report.law.known());
}

TEST(MeasuredLaw, LeavesFrictionItsNameBesideADetent) {
  const auto both = [](double q, double rate, double) { return detent(q) - 0.08 * std::tanh(rate / 0.005); };
  AnalysisOptions options = usualEffects(3);
  options.effects = {"coulomb_friction", "viscous_friction"};
  const GapReport report = analyse(test::pendulumProblem(both, 3), library(), options);
  expectLaw(report, "position", "detent");
  EXPECT_EQ(report.verdict, Verdict::partlyExplained) << toPlainText(report);
  std::vector<std::string> names;
  for (const GapReport::Effect& effect : report.tried)
    if (effect.accepted) {
      names.push_back(effect.effect);
      EXPECT_NEAR(effect.parameters[0].value, 0.08, 0.02) << toPlainText(report);
    }
  EXPECT_THAT(names, testing::ElementsAre("coulomb_friction"));
}

TEST(MeasuredLaw, EndsWhereTheRecordingsDo) {
  const GapProblem recorded = test::pendulumProblem([](double q, double, double) { return -4 * q * q * q; });
  const FitProblem problem = makeFitProblem(recorded, recorded.recordings, library());
  const Fit fit = fitModel(problem, givenModel(problem), {}, {0});
  SearchThresholds::Law limits;
  limits.leastPromise = -INFINITY;  // all curves are looked at
  const std::vector<LawOption> options = screenLaws(problem, fit.model, fit, linearise(problem, fit), {}, 1, limits);
  const auto curveOver = [&](LawTerm::On on) {
    const auto option = std::ranges::find_if(options, [&](const LawOption& o) {
      return o.law.terms[0].on == on && o.law.terms[0].kind == LawTerm::Kind::force;
    });
    EXPECT_NE(option, options.end());
    return option->law;
  };
  // The motor has 3 N·m; holding and moving the weight never takes half of that.
  const Law load = curveOver(LawTerm::On::load), position = curveOver(LawTerm::On::position);
  EXPECT_LT(load.terms[0].high, 2.5);
  EXPECT_GT(load.terms[0].low, -2.5);
  EXPECT_GE(load.terms[0].knots, 3);
  EXPECT_EQ(load.values[0].size(), static_cast<std::size_t>(load.terms[0].knots));
  EXPECT_EQ(position.terms[0].knots, limits.firstKnots) << "all of it was passed";
}

/// The effect as the host has it.
double torqueAt(const Law& law, const JointState& joint) {
  const auto effect = host().effectFactory()(measuredLaw);
  const std::vector<Parameter> declared = effect->parameters();
  return effect->torque(joint, resolve(declared, law.placed().parameters, "law"));
}

TEST(MeasuredLaw, IsTheSumOfItsCurvesInTheSimulator) {
  Law law{"rig.hinge", 1, {}, {}};
  law.terms = {{LawTerm::On::position, LawTerm::Kind::force, -1, 1, 3},
               {LawTerm::On::time, LawTerm::Kind::force, 0, 10, 2}};
  law.values = {{0, 2, 4}, {0, 1}};
  JointState joint;
  joint.position = 0.5;
  joint.time = 5;
  EXPECT_DOUBLE_EQ(torqueAt(law, joint), 3 + 0.5);
  joint.position = 7;
  joint.time = -1;
  EXPECT_DOUBLE_EQ(torqueAt(law, joint), 4) << "the ends' values hold outside";
  law.terms[0].on = LawTerm::On::angle;
  law.terms[0].low = 0;
  law.terms[0].high = 2 * M_PI;
  joint.position = 5 * M_PI / 2;
  EXPECT_NEAR(torqueAt(law, joint), 1, 1e-12) << "a quarter of a turn after one turn";
  for (double x = -2; x < 9; x += 0.1) {
    joint.position = x;
    EXPECT_NEAR(torqueAt(law, joint), lawValue(law.terms[0], law.values[0], x), 1e-9);
  }
}

TEST(LawShape, IsNamedOnlyWhereItsFormulaFits) {
  const LawTerm term{LawTerm::On::position, LawTerm::Kind::force, -1, 1, 25};
  const std::vector<double> error(25, 0.01);
  const auto of = [&](const std::function<double(double)>& f) {
    std::vector<double> values;
    for (int i = 0; i < 25; ++i) values.push_back(f(term.knot(i)));
    return shapeOf(term, values, error);
  };
  const LawShape pulls =
      of([](double x) { return -(x - 0.3) / 0.1 * std::exp(0.5 - std::pow((x - 0.3) / 0.1, 2) / 2); });
  EXPECT_EQ(pulls.family, "detent");
  EXPECT_NEAR(pulls.middle, 0.3, 0.03);
  EXPECT_NEAR(pulls.size, 1, 0.1);
  const LawShape wave = of([](double x) { return 0.4 * std::sin(5 * x); });
  EXPECT_EQ(wave.family, "cam");
  EXPECT_NEAR(wave.reach, 2 * M_PI / 5, 0.05);
  EXPECT_NEAR(wave.size, 0.4, 0.02);
  EXPECT_EQ(of([](double x) { return -3 * x * x * x; }).family, "hardening spring");
  const LawShape slack = of([](double x) { return x > 0.4 ? -2 * (x - 0.4) : x < -0.2 ? -2 * (x + 0.2) : 0; });
  EXPECT_EQ(slack.family, "dead zone");
  EXPECT_NEAR(slack.middle, 0.1, 0.05);
  EXPECT_NEAR(slack.size, 2, 0.2);
  EXPECT_EQ(of([](double x) { return std::cos(17 * x * x) + (x > 0.2 ? 1 : 0); }).family, "");
}

}  // namespace
}  // namespace btr
