// The parts of a search, each by itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/search/calibrator.h"
#include "core/gap/search/confirmer.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/rivals/rival_finder.h"
#include "core/gap/search/screening/candidate_search.h"
#include "core/gap/search/screening/screener.h"
#include "core/gap/search/selection.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

using testing::HasSubstr;

SearchOptions considering(std::vector<std::string> names) {
  SearchOptions options;
  options.names = std::move(names);
  return options;
}

FitProblem problemOf(const GapProblem& recorded) { return makeFitProblem(recorded, recorded.recordings, library()); }

/// All parts up to the rounds of candidates, over a hinge that is `truth`.
struct Parts {
  Parts(const GapProblem& recorded, SearchOptions given)
      : options(std::move(given)), service(problemOf(recorded), options) {}
  Parts(const SimulatorSpec& truth, SearchOptions given) : Parts(recordedInItsSteps(truth), std::move(given)) {}

  Round firstRound() {
    return candidates.search({.without = calibration.base,
                              .models = {calibration.base.fit},
                              .known = nullptr,
                              .toFit = options.thresholds.screening.fitted});
  }

  SearchOptions options;
  FitService service;
  Calibration calibration = Calibrator(service).calibrate();
  Confirmer confirmer{service, calibration.held};
  CandidateSearch candidates{service, confirmer};
};

const SimulatorSpec dryFriction{{}, {{"coulomb_friction", "rig.hinge", {{"torque_nm", 0.05}}}}};

/// Twenty blocks, each of about this error; the last effect that many standard errors large.
Scored scoredAt(double error, double spread = 0, double size = 100) {
  Scored scored;
  for (int i = 0; i < 20; ++i) scored.blocks.push_back(error + spread * (i % 2 ? 1 : -1) * (1 + 0.1 * (i % 5)));
  scored.sizes = {size};
  return scored;
}

TEST(Calibrator, FitsTheNumbersAndHoldsThoseToWhichNothingIsSensitive) {
  GapProblem recorded = recordedInItsSteps({{{"robots.rig.servos.hinge.p", 7}}, {}});
  recorded.scene.calibrate.push_back({"robots.rig.servos.hinge.max_torque_nm", 2.9, 9});  // it never saturates
  const SearchOptions options;
  FitService service(problemOf(recorded), options);
  const Calibration calibration = Calibrator(service).calibrate();
  EXPECT_FALSE(calibration.unstable);
  EXPECT_NEAR(calibration.calibrated.fit.model.values[0], 7, 0.05);
  EXPECT_GT(calibration.given.mean(), 2);
  EXPECT_LT(calibration.calibrated.mean(), 1.1);
  ASSERT_EQ(calibration.held.size(), 1u);
  EXPECT_EQ(calibration.held[0].name, "robots.rig.servos.hinge.max_torque_nm");
  EXPECT_EQ(calibration.calibrated.fit.model.parameters.size(), 3u);
  EXPECT_EQ(calibration.base.fit.model.parameters.size(), 2u);
  EXPECT_EQ(calibration.linear.columns.cols(), 2);
}

TEST(Screener, PromisesMostOfWhatIsMissing) {
  Parts parts(dryFriction, considering({"command_delay", "coulomb_friction", "joint_spring"}));
  const Screening screening =
      Screener(parts.service)
          .screenBeside({parts.calibration.base.fit}, {}, nullptr, parts.service.thresholds().screening, "", 0, 1);
  ASSERT_FALSE(screening.tried.empty());
  EXPECT_EQ(screening.tried[0].attempt.candidate.text(), "coulomb_friction at rig.hinge");
  EXPECT_EQ(screening.tried[0].attempt.rank, 1);
  EXPECT_GT(screening.tried[0].attempt.share, 0.5);
  EXPECT_FALSE(screening.tried[0].attempt.fitted) << "screening fits nothing";
}

TEST(Screener, ForAnEffectsPlaceScreensFewInFullAndWhatIsMissingIsAmongThoseToFit) {
  Parts parts(dryFriction, {});
  const SearchThresholds& limits = parts.service.thresholds();
  const Screening screening =
      Screener(parts.service)
          .screenBeside({parts.calibration.base.fit}, {}, nullptr, limits.rivals.of(limits.screening), "", 0, 1);
  ASSERT_GT(screening.tried.size(), 2 * limits.rivals.screened) << "all effects were looked at";
  // Friction by direction, which contains it, may promise a little more.
  const auto missing = std::ranges::find(screening.tried, std::string("coulomb_friction at rig.hinge"),
                                         [](const TriedCandidate& each) { return each.attempt.candidate.text(); });
  ASSERT_NE(missing, screening.tried.end());
  EXPECT_LE(static_cast<std::size_t>(missing->attempt.rank), limits.screening.fittedAsRivals);
  const auto wasScreened = [&](const TriedCandidate& each) { return !screening.promiseOf(each).starts.empty(); };
  EXPECT_LE(static_cast<std::size_t>(std::ranges::count_if(screening.tried, wasScreened)), limits.rivals.screened);
}

TEST(CrossValidation, IsTheSameWhereTheSensitivitiesAreKnown) {
  const Parts parts(dryFriction, considering({"coulomb_friction"}));
  const FitProblem& problem = parts.service.problem();
  const Fit& fit = parts.calibration.calibrated.fit;
  const Scored alone = crossValidate(problem, fit), known = crossValidate(problem, fit, linearise(problem, fit));
  EXPECT_EQ(alone.blocks, known.blocks);
  EXPECT_EQ(alone.heldOut, known.heldOut);
}

TEST(Confirmer, RejectsWhatDoesNotLowerTheHeldOutErrorClearly) {
  const SearchOptions options;
  FitService service(problemOf(recordedInItsSteps()), options);
  const std::vector<FitParameter> held;
  const Confirmer confirmer(service, held);
  const Acceptance acceptance = confirmer.judge(scoredAt(3), scoredAt(2.9, 1), 0);
  EXPECT_FALSE(acceptance.passes);
  EXPECT_LT(acceptance.comparison.t, options.thresholds.confirmation.leastT);
  EXPECT_THAT(acceptance.reason, HasSubstr("not better on blocks that it was not fitted to"));
}

TEST(Confirmer, RejectsAClearGainThatIsTooSmallForTheExcess) {
  const SearchOptions options;
  FitService service(problemOf(recordedInItsSteps()), options);
  const std::vector<FitParameter> held;
  const Acceptance acceptance = Confirmer(service, held).judge(scoredAt(3, 0.5), scoredAt(2.9, 0.5), 0);
  EXPECT_FALSE(acceptance.passes);
  EXPECT_GT(acceptance.comparison.t, options.thresholds.confirmation.leastT);
  EXPECT_EQ(acceptance.reason, "takes only 5.0 % of the excess error");
}

// The same scores by other thresholds: nobody's constants decide behind the options.
TEST(Confirmer, AsksTheThresholdsOfTheOptions) {
  SearchOptions options;
  options.thresholds.confirmation.leastGain = 0.5;
  FitService service(problemOf(recordedInItsSteps()), options);
  const std::vector<FitParameter> held;
  EXPECT_THAT(Confirmer(service, held).judge(scoredAt(3, 0.5), scoredAt(2, 0.5), 0).reason,
              HasSubstr("of the cross-validated squared error"));
}

TEST(Confirmer, AcceptsWhatIsMissingAndTheRoundPutsItFirst) {
  Parts parts(dryFriction, considering({"command_delay", "coulomb_friction"}));
  const Round round = parts.firstRound();
  ASSERT_FALSE(round.tried.empty());
  EXPECT_TRUE(round.tried[0].passes) << round.tried[0].attempt.reason;
  EXPECT_EQ(round.tried[0].attempt.candidate.text(), "coulomb_friction at rig.hinge");
  EXPECT_NEAR(round.tried[0].attempt.values.at("torque_nm"), 0.05, 0.005);
  EXPECT_EQ(round.without.step_s, parts.service.step_s()) << "compared with one step";
  EXPECT_EQ(round.tried[0].scored.step_s, parts.service.step_s());
}

TEST(Confirmer, AcceptsNothingOfAHealthyRobotAndLeavesTheStepAsItWas) {
  Parts parts(SimulatorSpec{}, considering({"command_delay", "coulomb_friction"}));
  const double step_s = parts.service.step_s();
  const Round round = parts.firstRound();
  for (const TriedCandidate& each : round.tried) EXPECT_FALSE(each.passes) << each.attempt.candidate.text();
  EXPECT_EQ(parts.service.step_s(), step_s);
  EXPECT_EQ(round.without.blocks, parts.calibration.base.blocks);
}

TEST(FalseDiscoveries, WhatPassesOnlyByItselfDoesNotAmongMany) {
  std::vector<TriedCandidate> tried(20);
  tried[0].passes = tried[0].attempt.scored = true;
  tried[0].attempt.comparison.pValue = 0.01;  // adjusted among twenty: 0.2
  controlFalseDiscoveries(tried, 0.05);
  EXPECT_FALSE(tried[0].passes);
  EXPECT_DOUBLE_EQ(tried[0].attempt.qValue, 0.2);
  EXPECT_THAT(tried[0].attempt.reason, HasSubstr("among 20 effects and places"));
}

// About the axis of an only joint a gravity that leans and a sensor that is off are the same law.
TEST(RivalFinder, ListsTheEffectThatTheRecordingsCannotTellFromTheOneThatWasFound) {
  Parts parts({{}, {{"gravity_tilt", "world", {{"about_y_rad", 0.18}}}}},
              considering({"gravity_tilt", "position_offset"}));
  const Round round = parts.firstRound();
  ASSERT_FALSE(round.tried.empty());
  ASSERT_TRUE(round.tried[0].passes) << round.tried[0].attempt.reason;
  Selection selection;
  selection.final = parts.calibration.base;
  selection.take(round.tried[0].scored, "+ it");
  for (const TriedCandidate& each : round.tried) selection.remember(each.attempt);
  const RivalSearch found =
      RivalFinder(parts.service, parts.confirmer, parts.candidates, parts.calibration.calibrated, round.tried)
          .find(selection);
  ASSERT_EQ(found.effects.size(), 1u);
  std::vector<std::string> readings{found.effects[0].effect.effect};
  for (const GapReport::Rival& rival : found.effects[0].rivals) readings.push_back(rival.effect);
  EXPECT_THAT(readings, testing::IsSupersetOf({"gravity_tilt", "position_offset"}));
  EXPECT_EQ(found.effects[0].rivalFits.size(), found.effects[0].rivals.size());
  EXPECT_EQ(found.selection.final.fit.model.effects.size(), 1u);
}

TEST(Selection, KeepsOfEachCandidateTheAttemptThatCameFurthestFirst) {
  Selection selection;
  Attempt screened;
  screened.candidate = {"backlash", "rig.hinge", {}, {}};
  screened.rank = 3;
  screened.reason = "screened";
  selection.remember(screened);
  Attempt fitted = screened;
  fitted.fitted = true;
  fitted.rank = 1;
  fitted.reason = "fitted";
  selection.remember(fitted);
  screened.reason = "screened again";
  selection.remember(screened);
  ASSERT_EQ(selection.attempts.size(), 1u);
  EXPECT_EQ(selection.attempts[0].reason, "fitted");
  EXPECT_EQ(selection.attempts[0].rank, 3) << "the first screening's";
}

TEST(SearchThresholds, AreThePublishedOnesUnlessOthersAreGiven) {
  const SearchThresholds thresholds = SearchOptions{}.thresholds;
  EXPECT_EQ(thresholds.confirmation.leastT, 2.5);
  EXPECT_EQ(thresholds.confirmation.leastGain, 0.01);
  EXPECT_EQ(thresholds.confirmation.leastShareOfExcess, 0.08);
  EXPECT_EQ(thresholds.confirmation.leastErrors, 6);
  EXPECT_EQ(thresholds.confirmation.mostFalse, 0.05);
  EXPECT_EQ(thresholds.verdict.unexplainedShare, 0.2);
}

}  // namespace
}  // namespace btr
