// Trials that disagree with the others are found, named with what they would need, and hide nothing; those that only
// show more of what is missing stay. The pendulum is integrated in the test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/report/report_plain.h"
#include "core/gap/search/trials/disagreement.h"
#include "tests/gap/pendulum_world.h"

namespace btr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

double dryFriction(double, double rate, double) { return -0.08 * std::tanh(rate / 0.005); }

/// 1.8 s each; `odd` makes one of them different.
Recording shortTrial(std::uint64_t number, test::TrialWorld odd = {}, const test::ExtraTorque& extra = dryFriction) {
  odd.length_s = 1.8;
  return test::recordedPendulum(extra, number, odd);
}

GapProblem tenTrials() {
  GapProblem problem = test::pendulumProblem(dryFriction, 0);
  problem.heldOut.clear();
  for (std::uint64_t i = 0; i < 10; ++i) problem.recordings.push_back(shortTrial(i));
  return problem;
}

GapReport analysed(const GapProblem& problem,
                   std::vector<std::string> effects = {"coulomb_friction", "viscous_friction"}) {
  AnalysisOptions options;
  options.effects = std::move(effects);
  options.designNext = false;
  return analyse(problem, library(), options);
}

std::vector<std::string> setAside(const GapReport& report) {
  std::vector<std::string> names;
  for (const GapReport::Disagreement& each : report.disagreements)
    if (each.setAside) names.push_back(each.trial);
  return names;
}

void expectDryFriction(const GapReport& report) {
  std::vector<std::string> names;
  for (const GapReport::Effect& effect : report.tried)
    if (effect.accepted) {
      names.push_back(effect.effect);
      EXPECT_NEAR(effect.parameters[0].value, 0.08, 0.01) << toPlainText(report);
    }
  EXPECT_THAT(names, ElementsAre("coulomb_friction")) << toPlainText(report);
  EXPECT_EQ(report.verdict, GapReport::Verdict::missingPhysics) << report.sentence;
}

TEST(DisagreeingTrials, AreNoneWhereAllAreRight) {
  const GapReport report = analysed(tenTrials());
  expectDryFriction(report);
  EXPECT_THAT(report.disagreements, IsEmpty()) << report.sentence;
}

TEST(DisagreeingTrials, ASlippedMarkerIsFoundAndHidesNothing) {
  GapProblem problem = tenTrials();
  problem.recordings[3] = shortTrial(3, {.offset_rad = 0.2});
  const GapReport report = analysed(problem);
  expectDryFriction(report);
  ASSERT_THAT(setAside(report), ElementsAre("pendulum_3.csv")) << toPlainText(report);
  EXPECT_THAT(report.disagreements[0].what, HasSubstr("rig.hinge.position_rad would have to be 0.2"));
  EXPECT_THAT(report.disagreements[0].what, HasSubstr("less than was recorded"));
  EXPECT_THAT(report.sentence, HasSubstr("1 of 10 trials was set aside"));
  EXPECT_THAT(report.notes, testing::Contains(HasSubstr("pendulum_3.csv")));
  std::size_t marked = 0;
  for (const GapReport::Trial& trial : report.trials)
    if (trial.setAside) {
      ++marked;
      EXPECT_EQ(trial.name, "pendulum_3.csv");
    }
  EXPECT_EQ(marked, 1u);
}

TEST(DisagreeingTrials, AMarkerThatSlipsInTheMiddleIsTold) {
  GapProblem problem = tenTrials();
  Recording& slipped = problem.recordings[3];
  const std::size_t from = slipped.rows() / 3;
  for (std::size_t row = from; row < slipped.rows(); ++row) slipped.columns[2][row] += 0.05;
  Recording& loose = problem.recordings[6];
  const double begins = loose.columns[0][loose.rows() / 2], ends = loose.columns[0].back();
  for (std::size_t row = loose.rows() / 2; row < loose.rows(); ++row)
    loose.columns[2][row] -= 0.08 * (loose.columns[0][row] - begins) / (ends - begins);
  const GapReport report = analysed(problem);
  expectDryFriction(report);
  ASSERT_THAT(setAside(report), ElementsAre("pendulum_3.csv", "pendulum_6.csv")) << toPlainText(report);
  EXPECT_THAT(report.disagreements[0].what, HasSubstr("its rig.hinge.position_rad jumps up by 0.0"));
  EXPECT_THAT(report.disagreements[1].what, HasSubstr("its rig.hinge.position_rad drifts down by 0.0"));
}

TEST(DisagreeingTrials, OneThatWasDrivenByOtherCommandsIsTold) {
  GapProblem problem = tenTrials();
  for (double& command : problem.recordings[5].columns[1]) command *= 1.25;  // the file says more than was sent
  const GapReport report = analysed(problem);
  expectDryFriction(report);
  ASSERT_THAT(setAside(report), ElementsAre("pendulum_5.csv")) << toPlainText(report);
  EXPECT_THAT(report.disagreements[0].what, HasSubstr("its commands would have to be 0."));
}

// It goes farther than all the others, yet shows nothing that they do not.
TEST(DisagreeingTrials, OneThatWasDrivenMuchFartherThanItsFileSaysIsTold) {
  GapProblem problem = tenTrials();
  problem.recordings[5] = shortTrial(5, {.size_rad = 1.3});
  for (double& command : problem.recordings[5].columns[1]) command /= 1.737;
  const GapReport report = analysed(problem);
  expectDryFriction(report);
  ASSERT_THAT(setAside(report), ElementsAre("pendulum_5.csv")) << toPlainText(report);
  EXPECT_THAT(report.disagreements[0].what, HasSubstr("its commands would have to be 1.7"));
}

TEST(DisagreeingTrials, ThreeOfTenAreFound) {
  GapProblem problem = tenTrials();
  problem.recordings[1] = shortTrial(1, {.offset_rad = -0.15});
  problem.recordings[4] = shortTrial(4, {.p = 10});
  // The commands of one trial with the motion of another.
  problem.recordings[8].columns[2] = shortTrial(77).columns[2];
  const GapReport report = analysed(problem);
  expectDryFriction(report);
  EXPECT_THAT(setAside(report), ElementsAre("pendulum_1.csv", "pendulum_4.csv", "pendulum_8.csv"))
      << toPlainText(report);
  for (const GapReport::Disagreement& each : report.disagreements)
    if (each.trial == "pendulum_4.csv") {
      EXPECT_THAT(each.what, HasSubstr("its p would have to be 10")) << each.what;
      EXPECT_THAT(each.what, HasSubstr("robots.rig.servos.hinge.p"));
    }
}

// A motor that is weaker than the scene says shows it in the one trial that asks for much.
TEST(DisagreeingTrials, ATrialThatShowsMoreOfAnEffectStays) {
  GapProblem problem = tenTrials();
  for (std::uint64_t i = 0; i < 10; ++i)
    problem.recordings[i] = shortTrial(i, {.size_rad = i == 6 ? 1.2 : 0.25, .most_nm = 1.1});
  const GapReport report = analysed(problem, {"coulomb_friction", "viscous_friction", "torque_speed_limit"});
  EXPECT_THAT(setAside(report), IsEmpty()) << toPlainText(report);
  std::vector<std::string> names;
  for (const GapReport::Effect& effect : report.tried)
    if (effect.accepted) names.push_back(effect.effect);
  EXPECT_THAT(names, testing::UnorderedElementsAre("coulomb_friction", "torque_speed_limit")) << toPlainText(report);
}

TEST(DisagreeingTrials, ATrialThatShowsMoreOfWhatNobodyKnowsStays) {
  const auto spring = [](double q, double, double) { return -3 * q * q * q; };
  GapProblem problem = tenTrials();
  for (std::uint64_t i = 0; i < 10; ++i)
    problem.recordings[i] = shortTrial(i, {.size_rad = i == 6 ? 1.2 : 0.4}, spring);
  const GapReport report = analysed(problem);
  EXPECT_THAT(setAside(report), IsEmpty()) << toPlainText(report);
}

TEST(OutlyingErrors, StandFarFromTheMedianAndFromTheirScatter) {
  const SearchThresholds::Trials limits;
  EXPECT_THAT(outlying({4, 5, 4.5, 5.5, 4.2, 400}, limits), ElementsAre(5));
  EXPECT_THAT(outlying({1, 1.1, 0.9, 1, 1.05, 3}, limits), IsEmpty()) << "below two noise floors";
  EXPECT_THAT(outlying({4, 16, 64, 256, 1024, 4096}, limits), IsEmpty()) << "all differ";
}

}  // namespace
}  // namespace btr
