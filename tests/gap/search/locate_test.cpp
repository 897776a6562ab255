// Where an error lies is told by the names of what was looked at.
#include "core/gap/search/screening/locate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

TEST(Locate, AServosLoadIsCalledCommandLessPosition) {
  // A weaker servo than the simulator's: its error follows the load, not the command.
  const GapProblem problem = recordedInItsSteps({{{"robots.rig.servos.hinge.p", 4}}, {}});
  const FitProblem fit = makeFitProblem(problem, problem.recordings, library(), 0);
  const auto located = locate(givenModel(fit), fit);
  ASSERT_EQ(located.size(), 1u);
  EXPECT_THAT(located[0].dependsOn, testing::Contains("rig.hinge.command_rad − rig.hinge.position_rad"));
  EXPECT_THAT(located[0].dependsOn, testing::Not(testing::Contains("rig.hinge.command_rad")));
}

}  // namespace
}  // namespace btr
