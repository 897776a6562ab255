// A tossed body without joints: impacts are where its recording tells least of its state, so windows begin between
// them, and what the floor does is found.
#include <algorithm>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/segments.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"
#include "core/gap/search/gap_report.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

/// Noise: `place_m` of places, `turn` of quaternions.
GapProblem tosses(const SimulatorSpec& truth, int count, double place_m, double turn) {
  GapProblem problem;
  problem.scene = loadScene(SOURCE_DIR "/resources/scenes/contactnets_cube.json");
  problem.models = loadModels(problem.scene);
  // Fine enough for an impact, and the same in both: what a step does to an impact is another matter.
  problem.scene.step_s = 0.00025;
  const Scene scene = makeScene(problem.scene, problem.models, truth, library().make);
  for (int toss = 0; toss < count; ++toss) {
    Random random = Random::forPurpose(17, "toss", static_cast<std::uint64_t>(toss));
    Recording recording;
    recording.source = "toss_" + std::to_string(toss) + ".csv";
    recording.channels = {"time_s",       "cube.base.x_m", "cube.base.y_m", "cube.base.z_m",
                          "cube.base.qw", "cube.base.qx",  "cube.base.qy",  "cube.base.qz"};
    recording.columns.assign(8, {});
    for (int row = 0; row < 80; ++row) {
      recording.columns[0].push_back(row / 150.0);
      for (std::size_t c = 1; c < 8; ++c) recording.columns[c].push_back(c == 4 ? 1 : 0);
    }
    const Binding binding = bind(scene, recording);
    StartState start = startState(scene, recording, binding);
    // One after another: the order of a call's arguments is the compiler's.
    const auto drawn = [&](double largest) {
      Eigen::Vector3d vector;
      for (double& each : vector) each = random.uniform(-largest, largest);
      return vector;
    };
    const Eigen::Vector3d turned = drawn(2);
    start.robots[0].base.linear() = Eigen::AngleAxisd(turned.norm(), turned.normalized()).toRotationMatrix();
    start.robots[0].base.translation() = Eigen::Vector3d(0, 0, random.uniform(0.13, 0.2));
    start.robots[0].velocity_m_s = drawn(1.2);
    start.robots[0].spin_rad_s = drawn(6);
    const auto replayed = replayRecording(scene, recording, binding, start);
    EXPECT_EQ(replayed.fault, "");
    for (std::size_t c = 0; c < binding.measured.size(); ++c)
      for (std::size_t row = 0; row < recording.rows(); ++row)
        recording.columns[binding.measured[c].column][row] =
            replayed.values[c][row] + (c < 3 ? place_m : turn) * random.normal();
    problem.recordings.push_back(recording);
  }
  return problem;
}

SimulatorSpec bouncing(double share) {
  SimulatorSpec truth;
  truth.effects = {{"restitution", "floor", {{"share", share}}}};
  return truth;
}

TEST(TossedBody, WindowsBeginWhereTheRecordingTellsTheState) {
  const SimulatorSpec truth = bouncing(0.4);
  const GapProblem problem = tosses(truth, 24, 2e-4, 1e-3);
  FitProblem cut = makeFitProblem(problem, problem.recordings, library());
  EXPECT_EQ(cut.window_s, 0.1);
  // What the true simulator is off by where nothing is fitted, the estimated states' errors alone: of the windows that
  // begin within a trial, the median.
  const auto error = [&] {
    std::vector<double> errors;
    for (const Segment& segment : cut.segments) {
      if (segment.first == 0) continue;
      const std::vector<double> none(segment.nuisances.size(), 0);
      double sum = 0;
      for (const double r : residualsOf(cut, segment, cut.sceneOf(truth, segment.trial), none)) sum += r * r;
      errors.push_back(std::sqrt(sum / static_cast<double>(segment.row.size())));
    }
    std::ranges::sort(errors);
    return errors[errors.size() / 2];
  };
  const double between = error();
  cut.impacts = false;
  cutSegments(cut, cut.window_s);
  EXPECT_LT(between, error()) << "even windows do as well";
}

TEST(TossedBody, SlowSamplesMakeLongerWindows) {
  GapProblem problem = tosses({}, 1, 2e-4, 1e-3);
  for (std::vector<double>& column : problem.recordings[0].columns) {
    std::vector<double> every;
    for (std::size_t row = 0; row < column.size(); row += 5) every.push_back(column[row]);
    column = every;
  }
  const FitProblem cut = makeFitProblem(problem, problem.recordings, library());
  EXPECT_NEAR(cut.window_s, 12 * 5 / 150.0, 1e-9);
  EXPECT_FALSE(cut.segments.empty());
}

TEST(TossedBody, WhatTheFloorGivesBackIsFound) {
  constexpr double share = 0.6;
  AnalysisOptions options;
  options.effects = {"restitution", "slip"};
  const GapReport report = analyse(tosses(bouncing(share), 2, 5e-4, 2e-3), library(), options);
  EXPECT_EQ(report.verdict, GapReport::Verdict::missingPhysics) << report.sentence;
  // Accepted ones come first.
  ASSERT_FALSE(report.tried.empty());
  for (const GapReport::Effect& effect : report.tried)
    EXPECT_EQ(effect.effect == "restitution", effect.accepted) << effect.effect << ": " << effect.reason;
  const GapReport::Number& found = report.tried[0].parameters.at(0);
  EXPECT_NEAR(found.value, share, 0.1 * share) << found.ci95.low << " to " << found.ci95.high;
  // Half of the excess over the noise at least.
  EXPECT_LT(report.ladder.back().error - 1, 0.5 * (report.ladder.front().error - 1));
}

}  // namespace
}  // namespace btr
