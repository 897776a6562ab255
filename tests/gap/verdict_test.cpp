// What a verdict says of errors before and after, against its rules: at most a fifth of the excess may stay, and above
// two noise floors at most a twenty-fifth.
#include "core/gap/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace btr {
namespace {

using testing::HasSubstr;
using Verdict = GapReport::Verdict;

/// A channel that moves by 70 noise floors, or stands still.
FitProblem recorded(bool moves = true) {
  FitTrial trial;
  trial.recording.channels = {"time_s", "rig.hinge.position_rad"};
  trial.recording.columns.resize(2);
  for (int row = 0; row < 200; ++row) {
    trial.recording.columns[0].push_back(0.01 * row);
    trial.recording.columns[1].push_back(moves ? std::sin(0.1 * row) : 0);
  }
  trial.binding.measured = {{Binding::Measured::What::position, 0, 0, 1}};
  trial.noiseFloor = {0.01};
  FitProblem problem;
  problem.trials = {trial};
  return problem;
}

Scored meanSquared(double value) {
  Scored scored;
  for (int block = 0; block < 20; ++block) scored.blocks.push_back(value * (block % 2 ? 1.01 : 0.99));
  return scored;
}

/// Judged with mean squared errors in noise floors²; with `named` an effect was accepted.
GapReport judged(double given, double calibrated, double final, bool named, bool curveIsBetter = false,
                 const FitProblem& problem = recorded()) {
  SearchResult found;
  found.given = meanSquared(given);
  found.calibrated = meanSquared(calibrated);
  found.final = meanSquared(final);
  GapReport report;
  if (named) {
    found.effects.resize(1);
    GapReport::Effect effect;
    effect.effect = "coulomb_friction";
    effect.at = "rig.hinge";
    effect.accepted = true;
    report.tried = {effect};
  }
  judge(report, problem, found, curveIsBetter);
  return report;
}

TEST(Verdict, OfErrorsAtTheNoise) {
  EXPECT_EQ(judged(1, 1, 1, false).verdict, Verdict::noMismatch);
  EXPECT_EQ(judged(400, 1, 1, false).verdict, Verdict::parametersSuffice);
  EXPECT_EQ(judged(400, 100, 1, true).verdict, Verdict::missingPhysics);
  EXPECT_EQ(judged(1, 1, 1, false, false, recorded(false)).verdict, Verdict::notExcited);
}

TEST(Verdict, WhatNoEffectTakesUpIsUnexplained) {
  EXPECT_EQ(judged(400, 100, 100, false).verdict, Verdict::unexplained);
  EXPECT_EQ(judged(400, 1.4, 1.4, false).verdict, Verdict::parametersSuffice);
}

TEST(Verdict, AnEffectThatLeavesAFifthOfTheExcessIsNotTheCause) {
  // An excess of 10 over the noise: 1.9 may stay, 2.1 not; and below four noise floors² the smaller share is not asked.
  EXPECT_EQ(judged(11, 11, 2.9, true).verdict, Verdict::missingPhysics);
  EXPECT_EQ(judged(11, 11, 3.1, true).verdict, Verdict::unexplained);
}

TEST(Verdict, AboveTwoNoiseFloorsATwentyFifthOfTheExcessIsTooMuch) {
  // An excess of 500: 5.6 noise floors are 31, of which 30 are above the noise: 6 %. 4 noise floors leave 3 %.
  const GapReport tooMuch = judged(600, 501, 31, true);
  EXPECT_EQ(tooMuch.verdict, Verdict::unexplained);
  EXPECT_THAT(tooMuch.sentence, HasSubstr("94 % of the squared error, is taken up by coulomb friction at rig.hinge"));
  EXPECT_THAT(tooMuch.sentence, HasSubstr("the cause may be another"));
  EXPECT_EQ(judged(600, 501, 16, true).verdict, Verdict::missingPhysics);
}

TEST(Verdict, ACurveThatDoesBetterThanTheEffectsMakesThemDoubtful) {
  EXPECT_EQ(judged(400, 100, 2, true, true).verdict, Verdict::unexplained);
  EXPECT_EQ(judged(400, 100, 1.1, true, true).verdict, Verdict::missingPhysics) << "nothing is left to do better";
}

}  // namespace
}  // namespace btr
