// A richer law has to show what makes it richer.
#include "core/gap/search/rivals/shown_sizes.h"

#include <gtest/gtest.h>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

const PlacedEffect byLoad{"load_dependent_friction", "rig.hinge", {{"torque_nm", 0.05}, {"per_motor_torque", 0.05}}};

/// Fitted to what was recorded with `hidden` friction.
std::pair<FitProblem, Fit> fittedByLoad(const PlacedEffect& hidden) {
  const GapProblem given = recordedInItsSteps({{}, {hidden}});
  FitProblem problem = makeFitProblem(given, given.recordings, library());
  problem.scene.step_s = problem.givenStep_s;
  Fit fit = fitModel(problem, givenModel(problem).with(problem, byLoad), {}, {30});
  return {std::move(problem), std::move(fit)};
}

TEST(ShownSizes, FrictionByLoadOfWhichOnlyTheDryPartShowsIsNoMoreThanDryFriction) {
  const auto [problem, fit] = fittedByLoad({"coulomb_friction", "rig.hinge", {{"torque_nm", 0.1}}});
  EXPECT_EQ(sizesOf(fit.model, 0), 3u);
  EXPECT_EQ(shownSizes(problem, fit, 0), 1u);
  EXPECT_TRUE(showsNoMoreThan(1, problem, fit, 0));
}

TEST(ShownSizes, FrictionThatGrowsWithLoadShowsIt) {
  const auto [problem, fit] =
      fittedByLoad({"load_dependent_friction", "rig.hinge", {{"torque_nm", 0.05}, {"per_motor_torque", 0.15}}});
  EXPECT_GE(shownSizes(problem, fit, 0), 2u);
  EXPECT_FALSE(showsNoMoreThan(1, problem, fit, 0));
}

// Friction that fades with speed has one size, as viscous friction has: its other numbers tell it.
TEST(ShownSizes, OneThatShowsIsEnoughWhereTheSimplerHasOneToo) {
  const PlacedEffect thinning{"thinning_friction", "rig.hinge", {{"coefficient_nm_s_rad", 0.3}, {"fading_rad_s", 1.5}}};
  const GapProblem given = recordedInItsSteps({{}, {thinning}});
  FitProblem problem = makeFitProblem(given, given.recordings, library());
  problem.scene.step_s = problem.givenStep_s;
  const Fit fit = fitModel(problem, givenModel(problem).with(problem, thinning), {}, {30});
  EXPECT_EQ(sizesOf(fit.model, 0), 1u);
  EXPECT_FALSE(showsNoMoreThan(1, problem, fit, 0));
}

}  // namespace
}  // namespace btr
