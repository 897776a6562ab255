// A window that begins in the middle of a recording: what an effect remembers there no sensor says.
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"
#include "tests/gap/recorded_hinge.h"

namespace btr {
namespace {

enum class Rate { ofTheJoint, ofWhatItsSensorSays };

/// The largest difference of a window from 0.55 s (the hinge moves since 0.3 s) to 1.05 s, begun with what the joint's
/// sensor says and with a rate, which the recording has or which is the slope of the positions that it has, from the
/// same rows of a replay from the beginning.
double strayOfWindow(const PlacedEffect& effect, Rate rate = Rate::ofTheJoint) {
  GapProblem problem = recordedInItsSteps({{}, {effect}});
  const Scene scene = makeScene(problem.scene, problem.models, {{}, {effect}}, library().make);
  Recording& recording = problem.recordings[0];
  recording.channels.push_back("rig.hinge.velocity_rad_s");
  recording.columns.emplace_back(recording.rows(), 0.0);
  const Binding binding = bind(scene, recording);
  const ReplayedRecording replayed = replayRecording(scene, recording, binding, startState(scene, recording, binding));
  const std::vector<double>&whole = replayed.values[0], &rates = replayed.values[1];
  recording.columns[2] = whole;  // without noise
  recording.columns[3] = rates;
  Binding known = binding;
  if (rate == Rate::ofWhatItsSensorSays) known.measured.pop_back();

  const auto rowAt = [&](double time_s) {
    const auto& time = recording.columns[0];
    return static_cast<std::size_t>(std::ranges::lower_bound(time, time_s) - time.begin());
  };
  const std::size_t first = rowAt(0.55), last = rowAt(1.05);
  StartState start = startState(scene, recording, binding, first);
  const std::size_t hinge = binding.measured[0].part;
  start.robots[0].positions[hinge] = whole[first];
  start.robots[0].rates[hinge] =
      rate == Rate::ofTheJoint
          ? rates[first]
          : (whole[first + 1] - whole[first - 1]) / (recording.columns[0][first + 1] - recording.columns[0][first - 1]);
  const std::vector<double> window = replayRecording(scene, recording, known, start, first, last).values[0];
  double most = 0;
  for (std::size_t row = first; row < last; ++row) most = std::max(most, std::abs(window[row] - whole[row]));
  return most;
}

TEST(Window, KnowsTheCommandsThatADelayStillHolds) {
  EXPECT_LT(strayOfWindow({"command_delay", "rig.hinge", {{"delay_s", 0.08}}}), 3 * noise_rad);
}

TEST(Window, KnowsOnWhichFlankTheToothLies) {
  EXPECT_LT(strayOfWindow({"backlash", "rig.hinge", {{"width_rad", 0.05}, {"free_speed_rad_s_nm", 2}}}), 3 * noise_rad);
}

TEST(Window, KnowsWhatALaggingSensorSaid) {
  EXPECT_LT(strayOfWindow({"sensor_lag", "rig.hinge", {{"time_constant_s", 0.03}}}), 3 * noise_rad);
}

// Behind a sensor that lags or whose scale is wrong, a joint is not as fast as its positions say.
TEST(Window, BeginsAsFastAsTheJointMovesWhereItsPositionsAloneAreKnown) {
  EXPECT_LT(strayOfWindow({"sensor_lag", "rig.hinge", {{"time_constant_s", 0.1}, {"closes_loop", 0}}},
                          Rate::ofWhatItsSensorSays),
            3 * noise_rad);
  EXPECT_LT(
      strayOfWindow({"sensor_scale", "rig.hinge", {{"excess", 0.3}, {"closes_loop", 0}}}, Rate::ofWhatItsSensorSays),
      3 * noise_rad);
}

}  // namespace
}  // namespace btr
