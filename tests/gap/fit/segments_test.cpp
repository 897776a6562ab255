// States within a recording are estimated from the samples around a row, never across a pause.
#include "core/gap/fit/segments.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "tests/gap/pendulum_world.h"

namespace btr {
namespace {

double noExtraTorque(double, double, double) { return 0; }

/// Every n-th row alone has a position.
Recording everyNthRow(Recording recording, std::size_t every) {
  for (std::size_t row = 0; row < recording.rows(); ++row)
    if (row % every != 0) recording.columns[2][row] = NAN;
  return recording;
}

/// Without the positions between two rows, as where a camera lost its marker.
Recording withPause(Recording recording, std::size_t from, std::size_t to) {
  for (std::size_t row = from; row < to; ++row) recording.columns[2][row] = NAN;
  return recording;
}

/// The hinge's position and rate at a row, and what its rate may be off by.
struct EstimatedState {
  double position = 0, rate = 0, rateUnit = 0;
};

EstimatedState estimatedAt(const Recording& recording, std::size_t row) {
  GapProblem problem = test::pendulumProblem(noExtraTorque, 0);
  problem.recordings = {recording};
  const FitProblem fit = makeFitProblem(problem, problem.recordings, library());
  std::vector<Nuisance> nuisances;
  const StartState state = stateAt(fit, 0, row, nuisances);
  EstimatedState found{state.robots[0].positions[0], state.robots[0].rates[0], 0};
  for (const Nuisance& nuisance : nuisances)
    if (nuisance.what == Nuisance::What::jointRate) found.rateUnit = nuisance.unit;
  return found;
}

TEST(Segments, AStateBesideAPauseKnowsNothingFromBeyondIt) {
  constexpr std::size_t every = 5, before = 300, after = 500;
  const Recording whole = everyNthRow(test::recordedPendulum(noExtraTorque, 1), every);
  // Whatever is beyond the pause: the state on this side is the same.
  Recording one = withPause(whole, before + 1, after), other = one;
  for (std::size_t row = after; row < other.rows(); ++row) other.columns[2][row] += 0.3;
  EXPECT_EQ(estimatedAt(one, before).position, estimatedAt(other, before).position);
  EXPECT_EQ(estimatedAt(one, before).rate, estimatedAt(other, before).rate);
}

TEST(Segments, AStateBesideAPauseIsAsGoodAsItsErrorSays) {
  constexpr std::size_t every = 5;
  const Recording fine = test::recordedPendulum(noExtraTorque, 1);
  for (const std::size_t before : {200u, 300u, 400u}) {
    const Recording broken = withPause(everyNthRow(fine, every), before + 1, before + 200);
    const EstimatedState found = estimatedAt(broken, before), truth = estimatedAt(fine, before);
    EXPECT_LT(std::abs(found.rate - truth.rate), 4 * std::hypot(found.rateUnit, truth.rateUnit)) << "row " << before;
  }
}

}  // namespace
}  // namespace btr
