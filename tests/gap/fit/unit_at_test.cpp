// Units of an effect's numbers: forces and ways on a slide joint, torques and angles on a turning one.
#include "core/gap/fit/unit_at.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/search/laws/learned_force.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<std::string> unitsOf(const FitProblem& problem, const std::string& effect, const std::string& at) {
  std::vector<std::string> units;
  for (const FitParameter& p : FitModel{}.with(problem, {effect, at, {}}).parameters) units.push_back(p.unit);
  return units;
}

FitProblem rig() {
  const GapProblem problem = recordedInItsSteps();
  return makeFitProblem(problem, problem.recordings, library(), 0);
}

TEST(UnitAt, ASlideJointHasForcesAndWays) {
  const FitProblem problem = rig();
  EXPECT_THAT(unitsOf(problem, "coulomb_friction", "rig.hinge"), testing::ElementsAre("N·m"));
  EXPECT_THAT(unitsOf(problem, "coulomb_friction", "rig.rail"), testing::ElementsAre("N"));
  EXPECT_THAT(unitsOf(problem, "joint_spring", "rig.rail"), testing::ElementsAre("N/m", "m"));
  EXPECT_THAT(unitsOf(problem, "backlash", "rig.rail"), testing::ElementsAre("m", "m/(s·N)"));
  EXPECT_THAT(unitsOf(problem, "payload", "rig.cart"), testing::Contains("kg"));
}

TEST(UnitAt, NoEffectOfAJointSpeaksOfTurningOnASlideJoint) {
  const FitProblem problem = rig();
  for (const std::string& name : library().names) {
    if (library().make(name)->place() != Effect::Place::joint) continue;
    for (const Parameter& p : library().make(name)->parameters()) {
      if (p.name == "phase_rad") continue;  // of a ripple: an angle on either joint
      for (const char* turning : {"rad", "N·m", "kg·m²"})
        EXPECT_THAT(unitAt(problem.scene, problem.models, "rig.rail", p), Not(HasSubstr(turning))) << name << p.name;
      EXPECT_EQ(unitAt(problem.scene, problem.models, "rig.hinge", p), p.unit);
    }
  }
}

TEST(UnitAt, ALearnedForceIsAForceOnASlideJoint) {
  FitProblem problem = rig();
  LearnedForce force;
  problem.library = withLearnedForce(problem.library, force);
  EXPECT_THAT(unitsOf(problem, force.name(), "rig.rail"), testing::Each(std::string("N")));
  EXPECT_THAT(unitsOf(problem, force.name(), "rig.hinge"), testing::Each(std::string("N·m")));
}

}  // namespace
}  // namespace btr
