// Where and by how much one trial's measuring slipped. The pendulum is integrated in the test.
#include "core/gap/search/trials/slip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/fit/fit_problem.h"
#include "tests/gap/pendulum_world.h"

namespace btr {
namespace {

const test::ExtraTorque nothing = [](double, double, double) { return 0.0; };

/// What findSlip makes of a recording that the simulator as given fits.
std::optional<Slip> slipOf(const Recording& recording) {
  const GapProblem world = test::pendulumProblem(nothing, 0);
  const auto ready = [&](const std::vector<Recording>& recordings) {
    return makeFitProblem(world, recordings, library());
  };
  return findSlip(recording, givenModel(ready({recording})), 6, ready);
}

TEST(Slip, OfAJumpIsItsSizeAndItsMoment) {
  for (const double by : {0.05, -0.02}) {
    Recording recording = test::recordedPendulum(nothing, 3, {.length_s = 2.5});
    const std::size_t from = recording.rows() / 3;
    for (std::size_t row = from; row < recording.rows(); ++row) recording.columns[2][row] += by;
    const auto slip = slipOf(recording);
    ASSERT_TRUE(slip.has_value());
    EXPECT_EQ(slip->channel, "rig.hinge.position_rad");
    EXPECT_FALSE(slip->drifts);
    EXPECT_NEAR(slip->by, by, 0.02 * std::abs(by));
    EXPECT_NEAR(slip->from_s, recording.columns[0][from], 0.02);
    EXPECT_LT(slip->error, 1.5);
  }
}

TEST(Slip, OfADriftIsItsSizeAtTheEnd) {
  Recording recording = test::recordedPendulum(nothing, 3, {.length_s = 2.5});
  const std::vector<double>& time = recording.columns[0];
  const double begins = time[recording.rows() / 2];
  for (std::size_t row = recording.rows() / 2; row < recording.rows(); ++row)
    recording.columns[2][row] += 0.06 * (time[row] - begins) / (time.back() - begins);
  const auto slip = slipOf(recording);
  ASSERT_TRUE(slip.has_value());
  EXPECT_TRUE(slip->drifts);
  EXPECT_NEAR(slip->by, 0.06, 0.003);
  EXPECT_NEAR(slip->from_s, begins, 0.1);
}

TEST(Slip, IsSaidInWords) {
  EXPECT_EQ(inWords(Slip{"ball.z_m", false, 0.35, 0.021, 1}),
            "its ball.z_m jumps up by 0.021 m at 0.35 s, as a marker that slips does");
  EXPECT_EQ(inWords(Slip{"ball.x_m", true, 0.5, -0.03, 1}),
            "its ball.x_m drifts down by 0.03 m from 0.5 s on, as a marker that comes loose does");
}

}  // namespace
}  // namespace btr
