// What is fitted at some settings of a servo is asked whether it holds at others.
#include "core/gap/search/laws/other_settings.h"

#include <gtest/gtest.h>

#include "core/gap/fit/fit_model.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace other_settings {

constexpr int iterations = 10;

/// A torque beside the servo's at two settings, which differ by name alone: the numbers are the scene's.
FitProblem recordedUnder(double first_nm, double second_nm) {
  GapProblem problem = hingeProblem();
  problem.scene.calibrate.clear();
  const auto record = [&](double torque_nm, const Values& settings) {
    for (Recording& recording :
         recordedInItsSteps({{}, {{"force_offset", "rig.hinge", {{"torque_nm", torque_nm}}}}}).recordings) {
      recording.settings = settings;
      problem.recordings.push_back(std::move(recording));
    }
  };
  record(first_nm, {{"robots.rig.servos.hinge.p", 6}});
  record(second_nm, {{"robots.rig.servos.hinge.d", 0.3}});
  return makeFitProblem(problem, problem.recordings, library());
}

bool aTorqueHolds(double first_nm, double second_nm) {
  const FitProblem problem = recordedUnder(first_nm, second_nm);
  const FitModel plain = givenModel(problem);
  const FitModel pushed = plain.with(problem, {"force_offset", "rig.hinge", {{"torque_nm", 0.05}}});
  return holdsAtOtherSettings(problem, fitModel(problem, plain, {}, {iterations}),
                              fitModel(problem, pushed, {}, {iterations}), iterations);
}

TEST(OtherSettings, WhatIsThereAtAllOfThemHolds) { EXPECT_TRUE(aTorqueHolds(0.2, 0.2)); }

TEST(OtherSettings, WhatIsThereAtOneOfThemIsNoLawOfAll) { EXPECT_FALSE(aTorqueHolds(0.2, -0.1)); }

TEST(OtherSettings, ThatNobodyNamesAskForNothing) {
  FitProblem problem = recordedUnder(0.2, -0.1);
  for (FitTrial& trial : problem.trials) trial.recording.settings.clear();
  const Fit fit = fitModel(problem, givenModel(problem), {}, {iterations});
  EXPECT_TRUE(holdsAtOtherSettings(problem, fit, fit, iterations));
}

}  // namespace other_settings
}  // namespace btr
