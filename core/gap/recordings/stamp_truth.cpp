#include "core/gap/recordings/stamp_truth.h"

#include <cmath>
#include <vector>

#include "core/gap/recordings/doctor/even_grid.h"

namespace btr {
namespace {

constexpr std::size_t span = 4;  // steps of a fourth difference

double fourthDifference(const std::vector<double>& values, std::size_t first) {
  return values[first] - 4 * values[first + 1] + 6 * values[first + 2] - 4 * values[first + 3] + values[first + 4];
}

}  // namespace

StampTruth stampTruth(const Recording& recording, std::size_t column) {
  constexpr double lost = 0.5;       // of a step, from which a longer or shorter one is no jitter
  constexpr double overlapping = 2;  // neighbouring differences share samples: their errors are not independent
  constexpr std::size_t enough = 50;
  std::vector<double> time, values, rows, steps;
  for (std::size_t row = 0; row < recording.rows(); ++row) {
    if (!std::isfinite(recording.columns[column][row])) continue;
    if (!time.empty()) steps.push_back(recording.columns[0][row] - time.back());
    time.push_back(recording.columns[0][row]);
    values.push_back(recording.columns[column][row]);
    rows.push_back(static_cast<double>(row));
  }
  if (values.size() < enough) return {};
  const std::vector<double> between = steps;
  const double period_s = median(std::move(steps));
  if (!(period_s > 0)) return {};
  std::vector<double> expected, found;
  for (std::size_t i = 0; i + span < values.size(); ++i) {
    bool isEven = true;
    for (std::size_t k = i; k < i + span; ++k)
      isEven =
          isEven && std::abs(between[k] - period_s) < lost * period_s && rows[k + 1] - rows[k] == rows[1] - rows[0];
    if (!isEven) continue;
    const double speed = (values[i + span] - values[i]) / (span * period_s);
    expected.push_back(speed * fourthDifference(time, i));
    found.push_back(fourthDifference(values, i));
  }
  double joint = 0, spread = 0, error = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    joint += expected[i] * found[i];
    spread += expected[i] * expected[i];
  }
  if (expected.size() < enough || !(spread > 0)) return {};
  StampTruth truth{joint / spread, 0};
  for (std::size_t i = 0; i < expected.size(); ++i)
    error += std::pow(expected[i] * (found[i] - truth.slope * expected[i]), 2);
  if (error > 0) truth.weight = spread * spread / (overlapping * error);
  return truth;
}

}  // namespace btr
