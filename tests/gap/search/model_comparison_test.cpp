// Which of two models predicts better, where a shift in time of less than half a step may stand for what one has.
#include "core/gap/search/model_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/gap/report/report_plain.h"
#include "tests/gap/pendulum_world.h"

namespace btr {
namespace {

Scored left(const std::vector<double>& blocks, const std::vector<double>& unshifted, double shiftOfMost) {
  Scored scored;
  scored.blocks = blocks;
  scored.unshifted = unshifted;
  scored.aligned.ofMost = shiftOfMost;
  return scored;
}

// A delay of two steps on counts of 4 mrad: half a step is taken for a shift, and what is left lies in two blocks.
// Among 37 effects chance did as well, though the delay explains all of it without any shift.
TEST(ModelComparison, WhatAShiftThatIsAsFarAsItMayBeHidesIsPartOfTheEffect) {
  const SearchThresholds::Shift limits;
  const std::vector<double> shifted{1.1, 1.0, 2.5, 1.2, 4.0, 1.0, 1.1, 0.9},
      whole{2.1, 1.9, 5.1, 2.3, 9.0, 1.8, 2.2, 1.7}, noise{1.0, 1.0, 1.1, 0.9, 1.2, 1.0, 1.0, 0.9};
  const Scored without = left(shifted, whole, 1);
  const PairedTest comparison = compare(shifted, noise);
  const PairedTest farthest = besideAFarthestShift(comparison, without, left(noise, noise, 0.2), limits);
  EXPECT_EQ(farthest.pValue, compare(whole, noise).pValue);
  EXPECT_LT(farthest.pValue, comparison.pValue);
  EXPECT_EQ(farthest.gain, comparison.gain);
  EXPECT_EQ(farthest.t, comparison.t);
}

// Another engine's integration is off by half a step as well: what needs the shift still, or a shift that is shorter
// than that, stands for nothing else.
TEST(ModelComparison, AShiftThatBothHaveOrThatIsShorterStandsForNothingElse) {
  const SearchThresholds::Shift limits;
  const std::vector<double> shifted{1.1, 1.0, 1.5, 1.2, 1.3, 1.0}, whole{9, 9, 9, 9, 9, 8},
      less{1.0, 1.0, 1.2, 1.1, 1.1, 0.9};
  const PairedTest comparison = compare(shifted, less);
  EXPECT_EQ(besideAFarthestShift(comparison, left(shifted, whole, 1), left(less, whole, 1), limits).pValue,
            comparison.pValue);
  EXPECT_EQ(besideAFarthestShift(comparison, left(shifted, whole, 0.9), left(less, less, 0), limits).pValue,
            comparison.pValue);
}

// A thousandth of what names take is theirs, and never more than is seen of a motion.
TEST(ModelComparison, WhatANamedLawMayLeaveIsInProportionToWhatItTakes) {
  const SearchThresholds::Screening limits;
  const auto leaving = [](double error) { return left({error, error}, {}, 0); };
  EXPECT_DOUBLE_EQ(imperfectionOf(leaving(101), leaving(1), limits), 0.1);
  EXPECT_DOUBLE_EQ(imperfectionOf(leaving(1e6), leaving(1), limits), limits.imperfectMost);
  EXPECT_EQ(imperfectionOf(leaving(1), leaving(1.5), limits), 0);
  EXPECT_EQ(imperfectionOf(leaving(std::numeric_limits<double>::quiet_NaN()), leaving(1), limits), 0);
}

// Other simulators smooth dry friction where it would hold: that is the same friction, and no second one beside it.
TEST(ModelComparison, DryFrictionThatSmoothlyChangesItsSignIsDryFrictionAlone) {
  const auto smooth = [](double, double rate, double) { return -0.2 * std::tanh(rate / 0.01); };
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "viscous_friction", "bristle_friction", "asymmetric_friction"};
  options.designNext = false;
  GapProblem problem = test::pendulumProblem(smooth);
  problem.scene.calibrate.clear();
  const GapReport report = analyse(std::move(problem), library(), options);
  std::vector<std::string> named;
  for (const GapReport::Effect& each : report.tried)
    if (each.accepted) named.push_back(each.effect);
  EXPECT_THAT(named, testing::ElementsAre("coulomb_friction")) << toPlainText(report);
  EXPECT_FALSE(report.law.known()) << report.law.sentence;
}

// Over a wide range of speeds it is not that, nor bristles or viscous friction beside it: a detail of the law, which is
// fitted once friction has been found.
TEST(ModelComparison, WhereDryFrictionFadesSlowlyItsTransitionIsFitted) {
  const auto smooth = [](double, double rate, double) { return -0.2 * std::tanh(rate / 0.1); };
  AnalysisOptions options;
  options.effects = {"coulomb_friction", "viscous_friction", "bristle_friction", "asymmetric_friction",
                     "stribeck_friction"};
  options.designNext = false;
  GapProblem problem = test::pendulumProblem(smooth);
  problem.scene.calibrate.clear();
  const GapReport report = analyse(std::move(problem), library(), options);
  std::vector<std::string> named;
  for (const GapReport::Effect& each : report.tried) {
    if (!each.accepted) continue;
    named.push_back(each.effect);
    ASSERT_EQ(each.parameters.size(), 2U);
    EXPECT_NEAR(each.parameters[0].value, 0.2, 0.01);
    // The line that rises like tanh at its middle is at 1 at 1.0 of its scale; one that comes near it everywhere later.
    EXPECT_EQ(each.parameters[1].name, "transition_rad_s");
    EXPECT_GT(each.parameters[1].value, 0.1);
    EXPECT_LT(each.parameters[1].value, 0.2);
  }
  EXPECT_THAT(named, testing::ElementsAre("coulomb_friction")) << toPlainText(report);
  EXPECT_FALSE(report.law.known()) << report.law.sentence;
}

}  // namespace
}  // namespace btr
