#include "core/gap/noise_floor.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/gap/even_grid.h"

namespace btr {

double noiseFloor(std::span<const double> values) {
  constexpr std::size_t block = 50;
  const double gain = std::sqrt(70.0);  // 1² + 4² + 6² + 4² + 1²
  std::vector<double> levels;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 4; i < values.size(); ++i) {
    const double difference = values[i] - 4 * values[i - 1] + 6 * values[i - 2] - 4 * values[i - 3] + values[i - 4];
    if (std::isfinite(difference)) {
      sum += difference * difference;
      ++count;
    }
    // A block is full; a last, shorter one counts only when it stands alone.
    if (count == block || (i + 1 == values.size() && levels.empty() && count > 0)) {
      levels.push_back(std::sqrt(sum / static_cast<double>(count)) / gain);
      sum = 0;
      count = 0;
    }
  }
  return median(std::move(levels));
}

double quantisationStep(std::span<const double> values) {
  std::vector<double> steps;
  double scale = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double step = std::abs(values[i] - values[i - 1]);
    if (!std::isfinite(step)) continue;
    scale = std::max({scale, std::abs(values[i]), std::abs(values[i - 1])});
    if (step > 0) steps.push_back(step);
  }
  // Few different steps prove nothing.
  if (steps.size() < 10) return 0;
  const double smallest = *std::min_element(steps.begin(), steps.end());
  if (smallest < 1e-9 * scale) return 0;  // rounding of the arithmetic itself
  // The smallest difference carries the rounding of the file's digits; the mean over all of them does not.
  double counts = 0, travel = 0;
  for (const double step : steps) {
    if (step > 50 * smallest) continue;
    counts += std::round(step / smallest);
    travel += step;
  }
  const double quantum = travel / counts;
  std::size_t whole = 0, multiples = 0;
  for (const double step : steps) {
    const double ratio = step / quantum;
    if (ratio > 10) continue;
    ++multiples;
    if (std::abs(ratio - std::round(ratio)) < 0.02 * std::max(1.0, ratio)) ++whole;
  }
  return multiples >= 10 && static_cast<double>(whole) >= 0.98 * static_cast<double>(multiples) ? quantum : 0;
}

double resolution(std::span<const double> values) {
  return std::max(noiseFloor(values), quantisationStep(values) / std::sqrt(12.0));
}

}  // namespace btr
