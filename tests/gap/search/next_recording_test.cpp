// What to record next so that rivals part, for a joint that follows positions and for one that is pushed.
#include "core/gap/search/rivals/next_recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/extent.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"
#include "core/gap/search/gap_report.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Two laws of friction that the recordings of `problem` do not tell from each other.
SearchResult rivals(const FitProblem& problem, const std::string& at, double coulomb, double viscous) {
  SearchResult found;
  const FitModel given = givenModel(problem);
  found.final.fit.model = given.with(problem, {"coulomb_friction", at, {{"torque_nm", coulomb}}});
  Found effect;
  effect.effect = {"coulomb_friction", at, {}};
  effect.rivals.push_back({"viscous_friction", at});
  effect.rivalFits.push_back(
      {given.with(problem, {"viscous_friction", at, {{"coefficient_nm_s_rad", viscous}}}), {}, 0});
  found.effects.push_back(effect);
  return found;
}

/// The cart on its rail, pushed to and fro by 2 N: a few decimetres.
GapProblem pushedCart() {
  GapProblem problem;
  const TemporaryFolder folder;
  folder.write("rig.urdf", rigUrdf);
  problem.scene = sceneFromJson(R"({"format": "uchilsim-scene-1", "step_s": 0.001, "control_period_s": 0.01,
    "robots": [{"name": "rig", "model": "rig.urdf", "base": "fixed", "position_m": [0, 0, 1], "collision": "none",
                "servos": {"hinge": {"drive": "none"}, "rail": {"drive": "force"}}}]})",
                                "scene", folder.file("."));
  problem.models = loadModels(problem.scene);
  const Scene scene = makeScene(problem.scene, problem.models, {}, library().make);
  Recording recording;
  recording.source = "pushed.csv";
  recording.channels = {"time_s", "rig.rail.force_n", "rig.rail.position_m"};
  recording.columns.resize(3);
  Random random = Random::forPurpose(3, "cart");
  for (double t = 0; t < 6; t += 0.01) {
    recording.columns[0].push_back(t);
    recording.columns[1].push_back(2 * std::cos(2 * M_PI * t));
    recording.columns[2].push_back(0);
  }
  const Binding binding = bind(scene, recording);
  const auto replayed = replayRecording(scene, recording, binding, startState(scene, recording, binding));
  for (std::size_t row = 0; row < recording.rows(); ++row)
    recording.columns[2][row] = replayed.values[0][row] + 1e-4 * random.normal();
  problem.recordings.push_back(recording);
  return problem;
}

TEST(NextRecording, MovesAJointThatFollowsPositionsWithinThoseThatWereCommanded) {
  const GapProblem given = recordedInItsSteps();
  const FitProblem problem = makeFitProblem(given, given.recordings, library());
  const GapReport::NextRecording next = designNext(problem, rivals(problem, "rig.hinge", 0.03, 0.03), 1);
  ASSERT_THAT(next.channels, ElementsAre("time_s", "rig.hinge.command_rad"));
  EXPECT_GT(next.separation, 1);
  Extent recorded, designed;
  for (const Recording& recording : given.recordings) recorded.add(recording.columns[1]);
  designed.add(next.columns[1]);
  EXPECT_GE(designed.low, recorded.low);
  EXPECT_LE(designed.high, recorded.high);
}

TEST(NextRecording, PushesAJointThatGoesWhereItWillNoFartherThanItWasSeen) {
  const GapProblem given = pushedCart();
  const FitProblem problem = makeFitProblem(given, given.recordings, library());
  const SearchResult found = rivals(problem, "rig.rail", 0.5, 2);
  const GapReport::NextRecording next = designNext(problem, found, 1);
  ASSERT_THAT(next.channels, ElementsAre("time_s", "rig.rail.force_n"));
  EXPECT_GT(next.separation, 1);
  EXPECT_THAT(next.why, HasSubstr("separates coulomb friction at rig.rail from viscous friction at rig.rail"));

  // Both simulators stay where the cart was seen, a tenth more at most.
  Extent seen, force, pushed;
  seen.add(given.recordings[0].columns[2]);
  force.add(given.recordings[0].columns[1]);
  pushed.add(next.columns[1]);
  EXPECT_GE(pushed.low, force.low);
  EXPECT_LE(pushed.high, force.high);
  Recording recording;
  recording.channels = {"time_s", "rig.rail.force_n", "rig.rail.position_m"};
  recording.columns = {next.columns[0], next.columns[1], std::vector<double>(next.columns[0].size(), NAN)};
  double square = 0, count = 0;
  std::vector<std::vector<double>> paths;
  for (const FitModel& model : {found.final.fit.model, found.effects[0].rivalFits[0].model}) {
    const Scene scene = problem.sceneOf(model.simulator(problem), 0);
    const Binding binding = bind(scene, recording);
    paths.push_back(replayRecording(scene, recording, binding, startState(scene, recording, binding)).values[0]);
    Extent path;
    path.add(paths.back());
    const double slack = 0.1 * (seen.high - seen.low);
    EXPECT_GE(path.low, seen.low - slack);
    EXPECT_LE(path.high, seen.high + slack);
  }
  for (std::size_t row = 0; row < paths[0].size(); ++row, ++count) square += std::pow(paths[0][row] - paths[1][row], 2);
  EXPECT_NEAR(std::sqrt(square / count) / problem.trials[0].noiseFloor[0], next.separation, 0.01 * next.separation);
}

// The same law twice, but for a billionth: a user who recorded that would have wasted a day.
TEST(NextRecording, SaysWhereNoneWouldTellRivalsApart) {
  const GapProblem given = pushedCart();
  const FitProblem problem = makeFitProblem(given, given.recordings, library());
  SearchResult found = rivals(problem, "rig.rail", 0.5, 0);
  found.effects[0].rivalFits[0].model =
      givenModel(problem).with(problem, {"coulomb_friction", "rig.rail", {{"torque_nm", 0.5 * (1 + 1e-9)}}});
  const GapReport::NextRecording next = designNext(problem, found, 1);
  ASSERT_GT(next.separation, 0);
  ASSERT_LT(next.separation, SearchThresholds::NextRecording{}.leastSeparation);
  EXPECT_THAT(next.why, HasSubstr("would hardly tell coulomb friction at rig.rail from viscous friction at rig.rail"));
}

// Beside a law that was measured, the simulators of rivals are thrown away: nothing can be designed.
TEST(NextRecording, DesignsNothingForRivalsWithoutSimulators) {
  const GapProblem given = pushedCart();
  const FitProblem problem = makeFitProblem(given, given.recordings, library());
  SearchResult found = rivals(problem, "rig.rail", 0.5, 2);
  found.effects[0].rivalFits.clear();
  EXPECT_THAT(designNext(problem, found, 1).channels, testing::IsEmpty());
}

// Nobody knows where it would go.
TEST(NextRecording, PushesNothingWhosePlaceWasNotRecorded) {
  GapProblem given = pushedCart();
  const FitProblem seen = makeFitProblem(given, given.recordings, library());
  FitProblem problem = seen;
  for (double& place : problem.trials[0].recording.columns[2]) place = 0.3;
  EXPECT_THAT(designNext(problem, rivals(problem, "rig.rail", 0.5, 2), 1).channels, testing::IsEmpty());
}

}  // namespace
}  // namespace btr
