// Which of an effect's numbers a fit may change.
#include "core/gap/fit/fit_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/gap/fit/fit_problem.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

std::vector<std::string> namesOf(const FitModel& model) {
  std::vector<std::string> names;
  for (const FitParameter& p : model.parameters) names.push_back(std::to_string(p.effect) + " " + p.name);
  return names;
}

// A detail keeps what was given until the effect has been found; then it stands with the effect's other numbers.
TEST(FitModel, DetailsAreFittedOnceAnEffectIsRefined) {
  const GapProblem given = recordedFrom({});
  const FitProblem problem = makeFitProblem(given, given.recordings, library());
  FitModel plain;
  plain = plain.with(problem, {"coulomb_friction", "rig.hinge", {{"torque_nm", 0.02}, {"transition_rad_s", 0.05}}})
              .with(problem, {"viscous_friction", "rig.hinge", {{"coefficient_nm_s_rad", 0.01}}});
  EXPECT_THAT(namesOf(plain), testing::ElementsAre("0 torque_nm", "1 coefficient_nm_s_rad"));
  EXPECT_EQ(plain.simulator(problem).effects[0].parameters.at("transition_rad_s"), 0.05);

  const FitModel refined = plain.refined(problem, 0);
  EXPECT_THAT(namesOf(refined), testing::ElementsAre("0 torque_nm", "0 transition_rad_s", "1 coefficient_nm_s_rad"));
  EXPECT_THAT(refined.values, testing::ElementsAre(0.02, 0.05, 0.01));
  EXPECT_EQ(namesOf(refined.refined(problem, 0)), namesOf(refined));
  EXPECT_EQ(namesOf(plain.refined(problem, 1)), namesOf(plain)) << "viscous friction has no details";
  EXPECT_THAT(namesOf(refined.without(0)), testing::ElementsAre("0 coefficient_nm_s_rad"));
}

}  // namespace
}  // namespace btr
