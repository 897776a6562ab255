// Fits in worker processes against the same fits without, and what they tell while they run.
#include "core/gap/fit/fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/analysis.h"
#include "core/spec/error.h"
#include "core/spec/system/cancelled.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

/// With the scene's own step: a replay is long enough for the workers.
FitProblem slowProblem(int jobs) {
  const GapProblem given = recordedFrom({{{"robots.rig.servos.hinge.p", 7}}, {}}, 0.6, 0, library(), 0.0001, 4);
  FitProblem problem = makeFitProblem(given, given.recordings, library());
  problem.jobs = jobs;
  problem.scene.step_s = problem.givenStep_s;
  EXPECT_GT(problem.steps(), 10000);
  return problem;
}

TEST(Fit, InWorkersGivesTheSameBits) {
  const FitProblem alone = slowProblem(1), together = slowProblem(3);
  ASSERT_GT(alone.segments.size(), 3u);
  const Fit one = fitModel(alone, givenModel(alone), {}, {8}),
            three = fitModel(together, givenModel(together), {}, {8});
  EXPECT_EQ(one.cost, three.cost);
  EXPECT_EQ(one.model.values, three.model.values);
  EXPECT_EQ(one.shifts, three.shifts);
  EXPECT_NEAR(one.model.values[0], 7, 0.05);
  const Linearised a = linearise(alone, one), b = linearise(together, three);
  EXPECT_EQ(a.raw, b.raw);
  EXPECT_EQ(a.columns, b.columns);
  // Another model whose first columns are inherited.
  const FitModel with = one.model.with(alone, {"coulomb_friction", "rig.hinge", {{"torque_nm", 0.01}}});
  const Fit inherits = fitModel(alone, with, one.shifts, {8, false, &a}),
            inheritsToo = fitModel(together, with, three.shifts, {8, false, &b});
  EXPECT_EQ(inherits.cost, inheritsToo.cost);
  EXPECT_EQ(inherits.model.values, inheritsToo.model.values);
}

// Whether a candidate that cannot be simulated ends an analysis must not hang on the number of workers.
TEST(Fit, OneThatFailsGivesNothingWithOneWorkerAsWithTwo) {
  const auto job = [](std::size_t i) -> std::vector<double> {
    if (i == 1) throw InputError("a joint limit, 9, allowed: at most 3");
    return {static_cast<double>(i)};
  };
  const auto one = parallel(1, 3, job), two = parallel(2, 3, job);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(one[i].numbers, (i == 1 ? std::vector<double>{} : std::vector<double>{static_cast<double>(i)}));
    EXPECT_EQ(two[i].numbers, one[i].numbers);
    EXPECT_EQ(two[i].refused, one[i].refused);
    EXPECT_EQ(one[i].ok(), i != 1);
  }
}

TEST(Fit, SaysHowFarItIsAndCanBeCancelled) {
  const FitProblem problem = slowProblem(1);
  std::vector<double> shares;
  FitOptions options{8};
  options.goOn = [&](double share) {
    shares.push_back(share);
    return true;
  };
  fitModel(problem, givenModel(problem), {}, options);
  ASSERT_GT(shares.size(), 3u);
  EXPECT_EQ(shares.front(), 0);
  EXPECT_LE(shares.back(), 1);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  int calls = 0;
  options.goOn = [&](double) { return ++calls < 2; };
  EXPECT_THROW(fitModel(problem, givenModel(problem), {}, options), Cancelled);
  EXPECT_EQ(calls, 2);
}

// Gravity leans about the hinge's axis; how far it leans across that is hardly told.
TEST(Fit, ANumberThatTheRecordingsDoNotTellHoldsNoOtherBack) {
  const GapProblem given = recordedFrom({{}, {{"gravity_tilt", "world", {{"about_y_rad", 0.18}}}}});
  const FitProblem problem = makeFitProblem(given, given.recordings, library());
  const auto tilted = [&](double acrossIt, double aboutIt) {
    return givenModel(problem).with(problem,
                                    {"gravity_tilt", "world", {{"about_x_rad", acrossIt}, {"about_y_rad", aboutIt}}});
  };
  const Fit truth = fitModel(problem, tilted(0, 0.18), {}, {30, true});
  for (const double across : {0.0, 0.0025, 0.05, 0.3})
    EXPECT_LT(fitModel(problem, tilted(across, 0.05), {}, {30}).cost, truth.cost) << across;
}

// Begun on this side of a half turn, it ended there: at −3.1416, with seven noise floors left.
TEST(Fit, APhaseGoesRound) {
  const auto ripple = [](double phase_rad) {
    return PlacedEffect{
        "torque_ripple", "rig.hinge", {{"amplitude_nm", 0.05}, {"per_turn", 4}, {"phase_rad", phase_rad}}};
  };
  const GapProblem given = recordedFrom({{}, {ripple(2.8)}});
  const FitProblem problem = makeFitProblem(given, given.recordings, library());
  const Fit fit = fitModel(problem, givenModel(problem).with(problem, ripple(-2.8)), {}, {20});
  const std::vector<FitParameter>& numbers = fit.model.parameters;
  const auto phase = std::ranges::find(numbers, "phase_rad", &FitParameter::name);
  ASSERT_NE(phase, numbers.end());
  EXPECT_TRUE(phase->goesRound);
  EXPECT_NEAR(fit.model.values[static_cast<std::size_t>(phase - numbers.begin())], 2.8, 0.02);
}

TEST(Fit, WhatFailsInAWorkerSaysWhyAsItDoesWithout) {
  for (const int jobs : {1, 3}) {
    const FitProblem problem = slowProblem(jobs);
    FitModel model = givenModel(problem);
    model.parameters[0].name = "robots.rig.servos.no_such_joint.p";
    EXPECT_THROW(fitModel(problem, model, {}, {4}), InputError) << jobs;
  }
}

}  // namespace
}  // namespace btr
