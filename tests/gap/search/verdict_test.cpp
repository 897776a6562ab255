// What a verdict says of errors before and after, against its rules: at most a fifth of the excess may stay, above two
// noise floors at most a twenty-fifth, and never five noise floors; else names explain a part, if they take half of it.
#include "core/gap/search/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/proof/proof_marks.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"
#include "core/spec/random.h"

namespace btr {
namespace {

using testing::HasSubstr;
using testing::Not;
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
                 const FitProblem& problem = recorded(), SearchResult found = {}, GapReport report = {}) {
  found.given = meanSquared(given);
  found.calibrated = meanSquared(calibrated);
  const Eigen::VectorXd rest = found.final.heldOut;
  found.final = meanSquared(final);
  found.final.heldOut = rest;
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

TEST(Verdict, AnEffectThatLeavesAFifthOfTheExcessIsNotTheWholeCause) {
  // An excess of 10 over the noise: 1.9 may stay, 2.1 not; and below four noise floors² the smaller share is not asked.
  EXPECT_EQ(judged(11, 11, 2.9, true).verdict, Verdict::missingPhysics);
  EXPECT_EQ(judged(11, 11, 3.1, true).verdict, Verdict::partlyExplained);
  EXPECT_EQ(judged(11, 11, 5.9, true).verdict, Verdict::partlyExplained);
  EXPECT_EQ(judged(11, 11, 6.1, true).verdict, Verdict::unexplained) << "it leaves more than half";
}

TEST(Verdict, AboveTwoNoiseFloorsATwentyFifthOfTheExcessIsTooMuch) {
  // An excess of 500: 5.6 noise floors are 31, of which 30 are above the noise: 6 %. 4 noise floors leave 3 %.
  const GapReport tooMuch = judged(600, 501, 31, true);
  EXPECT_EQ(tooMuch.verdict, Verdict::partlyExplained);
  // 31 of 600 are left.
  EXPECT_NEAR(tooMuch.explainedShare, 1 - 31.0 / 600, 1e-3);
  EXPECT_EQ(tooMuch.sentence.find("What was left out explains 95 % of the squared error of the simulator as given: "
                                  "coulomb friction at rig.hinge. Beside it 5.57 noise floors are left that have no "
                                  "name here. "),
            0u)
      << tooMuch.sentence;
  EXPECT_EQ(judged(600, 501, 16, true).verdict, Verdict::missingPhysics);
}

// A payload and an offset of the sensor that explain alike ask for other gains of the servo.
TEST(Verdict, SaysWhichNumbersTheChoiceAmongRivalsDecides) {
  GapReport report;
  report.calibrated = {{"servo.p", "", 5, 7, {6.9, 7.1}, false, true, {6.9, 9.2}},
                       {"servo.d", "", 5, 7, {6, 8}, false, true, {5.5, 8}}};
  const auto said = [&] { return judged(400, 100, 1, true, false, recorded(), {}, report).sentence; };
  EXPECT_THAT(said(), HasSubstr("decides of other numbers, too; over all of them: servo.p [6.9, 9.2] instead of "
                                "[6.9, 7.1]. "));
  report.calibrated[0].ci95 = {6.9012, 6.9034};
  EXPECT_THAT(said(), HasSubstr("[6.9, 9.2] instead of [6.901, 6.903]. "));
  report.calibrated[0].amongRivals = report.calibrated[0].ci95;
  EXPECT_THAT(said(), Not(HasSubstr("instead of")));
}

/// Held-out recordings left by so many noise floors.
GapReport unseen(double given, double calibrated, double withEffects) {
  GapReport report;
  GapReport::Channel channel;
  channel.noiseFloor = 0.01;
  channel.heldoutAsGiven = 0.01 * given;
  channel.heldoutCalibrated = 0.01 * calibrated;
  channel.heldoutWithEffects = 0.01 * withEffects;
  report.channels = {channel};
  return report;
}

TEST(Verdict, SaysWhatRecordingsThatNoFitSawAreLeftBy) {
  const GapReport better = judged(400, 100, 1, true, false, recorded(), {}, unseen(18, 9, 1.5));
  EXPECT_THAT(better.sentence,
              HasSubstr("Recordings that no fit saw are left by 18 noise floors as given, 9 calibrated, "
                        "1.5 with what was found. "));
  EXPECT_THAT(better.sentence, Not(HasSubstr("worse")));
  const GapReport faulted = judged(400, 100, 1, true, false, recorded(), {}, unseen(18, 9, NAN));
  EXPECT_THAT(
      faulted.sentence,
      HasSubstr("left by 18 noise floors as given, 9 calibrated, a fault with what was found. There it does worse"));
  EXPECT_EQ(unseenWarning(faulted), "a fault ends the simulation of the recordings that were held out");
  const GapReport mended = judged(400, 100, 1, true, false, recorded(), {}, unseen(NAN, 9, 1.5));
  EXPECT_THAT(mended.sentence, HasSubstr("left by a fault of the simulation as given, 9 calibrated, 1.5 with"));
  EXPECT_EQ(unseenWarning(mended), "");
  const GapReport worse = judged(400, 100, 1, true, false, recorded(), {}, unseen(18, 9, 14));
  EXPECT_THAT(worse.sentence, HasSubstr("There it does worse than calibration alone"));
  const GapReport misled = judged(400, 1, 1, false, false, recorded(), {}, unseen(2, 9, 9));
  EXPECT_EQ(misled.verdict, Verdict::parametersSuffice);
  EXPECT_THAT(misled.sentence, HasSubstr("There the numbers as given do better"));
  EXPECT_THAT(judged(400, 100, 1, true).sentence, Not(HasSubstr("no fit saw")));
}

TEST(Verdict, OfOneRecordingSaysThatAnotherMotionIsNotKnown) {
  const char* once = "learned from one recording and checked on other parts of the same motion";
  EXPECT_THAT(judged(400, 100, 1, true).sentence, HasSubstr(once));
  FitProblem two = recorded();
  two.trials.push_back(two.trials[0]);
  EXPECT_THAT(judged(400, 100, 1, true, false, two).sentence, Not(HasSubstr(once)));
  EXPECT_THAT(judged(400, 100, 1, true, false, recorded(), {}, unseen(18, 9, 1.5)).sentence, Not(HasSubstr(once)))
      << "another one was held out";
  EXPECT_THAT(judged(1, 1, 1, false).sentence, Not(HasSubstr(once))) << "there is nothing to adopt";
}

/// All samples of the channel compared, in one segment.
FitProblem compared() {
  FitProblem problem = recorded();
  Segment segment;
  for (std::size_t row = 0; row < 200; ++row) {
    segment.row.push_back(row);
    segment.channel.push_back(0);
  }
  problem.segments = {segment};
  return problem;
}

/// Left by the final simulator: each sample follows the one before it by `alike`.
SearchResult leaving(double alike) {
  Random random(7);
  SearchResult found;
  found.final.heldOut.resize(200);
  double last = 0;
  for (double& value : found.final.heldOut) value = last = alike * last + random.normal();
  return found;
}

TEST(Verdict, WithoutAnythingThatHelpsParametersDoNotSuffice) {
  // 1.16 noise floors, calibrated or not. White: the floor was estimated too low. Coloured: something is left.
  const GapReport white = judged(1.35, 1.35, 1.35, false, false, compared(), leaving(0));
  EXPECT_EQ(white.verdict, Verdict::noMismatch) << white.sentence;
  EXPECT_THAT(white.sentence, HasSubstr("within 1.16 noise floors"));
  EXPECT_THAT(white.sentence, HasSubstr("the floor may be larger"));
  const GapReport coloured = judged(1.35, 1.35, 1.35, false, false, compared(), leaving(0.8));
  EXPECT_EQ(coloured.verdict, Verdict::unexplained) << coloured.sentence;
  EXPECT_THAT(coloured.sentence, HasSubstr("not noise alone: successive samples of it correlate by 0.8"));
}

TEST(Verdict, ACalibrationThatLeavesColourSaysSo) {
  const GapReport report = judged(400, 1.4, 1.4, false, false, compared(), leaving(0.8));
  EXPECT_EQ(report.verdict, Verdict::parametersSuffice);
  EXPECT_THAT(report.sentence, HasSubstr("Something small may be missing"));
  EXPECT_THAT(judged(400, 1.4, 1.4, false, false, compared(), leaving(0)).sentence, Not(HasSubstr("small")));
}

TEST(Verdict, WhatTheIntegrationHidesIsNotSaidToSuffice) {
  SearchResult found;
  found.stepChange = Eigen::VectorXd::Constant(200, 2.0);
  const double step = stepErrorOf(found.stepChange);
  const GapReport report = judged(400, 1.2 + step, 1.2 + step, false, false, recorded(), found);
  EXPECT_EQ(report.verdict, Verdict::unexplained);
  EXPECT_THAT(report.sentence, HasSubstr("a smaller step_s would tell"));
}

TEST(Verdict, TwoBlocksAreTooFewToSayThatCalibrationHelps) {
  SearchResult found;
  found.given.blocks = {400, 400};
  found.calibrated.blocks = found.final.blocks = {1, 1};
  GapReport report;
  judge(report, recorded(), found, false);
  EXPECT_EQ(report.verdict, Verdict::notExcited);
  EXPECT_THAT(report.sentence, HasSubstr("not certain over 2 blocks"));
}

TEST(Verdict, ANumberThatIsToldOrACalibrationThatHelpsIsExcitedThoughLittleMoves) {
  GapReport told;
  told.calibrated = {{"balls.ball.rolling_deceleration_m_s2", "", 0.456, 0.458, {0.44, 0.476}, false, true}};
  const GapReport helped = judged(11, 1.03, 1.03, false, false, recorded(false), {}, told);
  EXPECT_EQ(helped.verdict, Verdict::parametersSuffice) << helped.sentence;
  EXPECT_THAT(helped.sentence, HasSubstr("they can show little"));
  const GapReport agrees = judged(1, 1, 1, false, false, recorded(false), {}, told);
  EXPECT_EQ(agrees.verdict, Verdict::noMismatch) << agrees.sentence;
  told.calibrated[0].excited = false;
  EXPECT_EQ(judged(1, 1, 1, false, false, recorded(false), {}, told).verdict, Verdict::notExcited);
}

TEST(Verdict, WhatMovesButFeelsNoNumberAndNoEffectTellsNothing) {
  SearchResult found;
  found.attempts.resize(3);
  for (Attempt& attempt : found.attempts) attempt.excited = false;
  const GapReport report = judged(1.1, 1.1, 1.1, false, false, recorded(), found);
  EXPECT_EQ(report.verdict, Verdict::notExcited);
  EXPECT_THAT(report.sentence, HasSubstr("no effect of a typical size"));
  found.attempts[1].excited = true;
  EXPECT_EQ(judged(1.1, 1.1, 1.1, false, false, recorded(), found).verdict, Verdict::noMismatch);
}

// What calibration took is not said to be explained by the effect alone.
TEST(Verdict, SaysThatOtherNumbersTookTheirPart) {
  GapReport calibrated;
  calibrated.calibrated.resize(1);
  EXPECT_THAT(judged(15000, 1900, 1, true, false, recorded(), {}, calibrated).sentence,
              HasSubstr("What was left out and other numbers explain more than 99 % of the squared error"));
  EXPECT_THAT(judged(15000, 1900, 1, true).sentence, HasSubstr("What was left out explains more than 99 %"));
}

TEST(Verdict, FiveNoiseFloorsAreTooMuchWhateverTheirShare) {
  // 99.97 % of 1e12 are explained, 17 000 noise floors are left.
  const GapReport huge = judged(1e12, 1e12, 3e8, true);
  EXPECT_EQ(huge.verdict, Verdict::partlyExplained);
  EXPECT_THAT(huge.sentence, HasSubstr("explains more than 99 % of the squared error of the simulator as given"));
  EXPECT_THAT(huge.sentence, HasSubstr("17300 noise floors are left that have no name here"));
  EXPECT_EQ(judged(1e4, 1e4, 25.1, true).verdict, Verdict::partlyExplained);
  EXPECT_EQ(judged(1e4, 1e4, 24.9, true).verdict, Verdict::missingPhysics);
}

TEST(Verdict, ALargeRestIsSaidRightAfterTheName) {
  EXPECT_THAT(judged(600, 501, 16, true).sentence,
              HasSubstr("coulomb friction at rig.hinge. The named effects explain 97 % of the squared error beyond the "
                        "noise, yet 4 noise floors are left: the name may be a stand-in for something else."));
  EXPECT_THAT(judged(400, 100, 1.1, true).sentence, Not(HasSubstr("stand-in")));
}

TEST(Verdict, ACurveThatDoesBetterThanTheEffectsMakesThemDoubtful) {
  EXPECT_EQ(judged(400, 100, 2, true, true).verdict, Verdict::unexplained);
  EXPECT_EQ(judged(400, 100, 1.1, true, true).verdict, Verdict::missingPhysics) << "nothing is left to do better";
}

TEST(Verdict, WhatHasAShapeIsNotExplainedByTheNamesThatLeaveIt) {
  const auto left = [](double final, double share) {
    GapReport report;
    report.remainder.at = "rig.hinge";
    report.remainder.on = "position";
    report.remainder.shareOfRest = share;
    return judged(400, 100, final, true, false, recorded(), {}, report);
  };
  const GapReport much = left(2, 0.6);
  EXPECT_EQ(much.verdict, Verdict::unexplained);
  EXPECT_THAT(much.sentence, HasSubstr("the cause may be another"));
  EXPECT_THAT(much.sentence, HasSubstr("would take 60 % of the rest"));
  EXPECT_EQ(left(2, 0.2).verdict, Verdict::missingPhysics) << "a small part of it";
  EXPECT_EQ(left(1.1, 0.6).verdict, Verdict::missingPhysics) << "of noise";
}

TEST(Verdict, NamesThatStayBesideALawExplainPartly) {
  GapReport report;
  report.law = {"rig.hinge", "detent", "a torque at rig.hinge that depends on position alone", {}, 0.9, 0.98, 1e-6,
                1.1,         2.1};
  report.law.curves.resize(1);
  // Beside 11 the name leaves 60 %: by itself too much, but it was tested with the law in the model.
  const GapReport partly = judged(11, 11, 7, true, false, recorded(), {}, report);
  EXPECT_EQ(partly.verdict, Verdict::partlyExplained) << partly.sentence;
  EXPECT_THAT(partly.sentence,
              HasSubstr("Its shape was measured: a torque at rig.hinge that depends on position alone. "
                        "With it 1.1 noise floors are left; it takes 90 % of the squared error"));
  const GapReport none = judged(11, 11, 7, false, false, recorded(), {}, report);
  EXPECT_EQ(none.verdict, Verdict::unexplained);
  EXPECT_THAT(none.sentence, HasSubstr(report.law.sentence));
}

TEST(Verdict, AServoThatHuntsIsSaidBesideWhatIsUnexplained) {
  // Four seconds; the last of them swings at 9.75 Hz, though nothing asks for it, in thirds that tell it to 0.75 Hz.
  FitProblem problem = recorded();
  FitTrial& trial = problem.trials[0];
  trial.recording.channels.push_back("rig.hinge.command_rad");
  trial.recording.columns = {{}, {}, {}};
  trial.binding.inputs = {{Binding::Input::What::command, 0, 0, 2}};
  GapReport report;
  report.trials.resize(1);
  report.trials[0].name = "swing.csv";
  GapReport::Series series;
  series.channel = "rig.hinge.position_rad";
  series.noiseFloor = trial.noiseFloor[0];
  for (int row = 0; row <= 400; ++row) {
    const double t = 0.01 * row;
    const double swing = t > 3 ? 0.5 * std::sin(2 * M_PI * 9.75 * t) : 0;
    trial.recording.columns[0].push_back(t);
    trial.recording.columns[1].push_back(std::sin(t) + swing);
    trial.recording.columns[2].push_back(std::sin(t));
    series.withEffects.push_back(std::sin(t));
  }
  series.recorded = trial.recording.columns[1];
  report.trials[0].series = {series};
  EXPECT_THAT(judged(400, 100, 100, false, false, problem, {}, report).sentence,
              HasSubstr("In swing.csv, from 2.7 to 4 s, rig.hinge.position_rad swings at 9.8 Hz by ±"));
  EXPECT_THAT(judged(400, 100, 1.1, true, false, problem, {}, report).sentence, Not(HasSubstr("swings")));
}

}  // namespace
}  // namespace btr
