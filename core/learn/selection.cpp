#include "core/learn/selection.h"

#include <algorithm>
#include <cmath>

#include "core/spec/require.h"

namespace btr {

std::vector<double> finiteFitness(std::span<const double> fitness) {
  double worst = 0;
  bool any = false;
  for (const double value : fitness) {
    if (!std::isfinite(value)) continue;
    worst = any ? std::min(worst, value) : value;
    any = true;
  }
  std::vector<double> finite(fitness.begin(), fitness.end());
  for (double& value : finite)
    if (!std::isfinite(value)) value = worst;
  return finite;
}

std::vector<double> linearScaling(std::span<const double> fitness, double largestCopies) {
  require(largestCopies > 1, "more than one copy of the best");
  std::vector<double> weights = finiteFitness(fitness);
  if (weights.empty()) return weights;

  // In units of the largest magnitude nothing overflows; negative fitness is shifted so that the worst is 0.
  double unit = 0;
  for (const double value : weights) unit = std::max(unit, std::abs(value));
  double worst = unit > 0 ? *std::min_element(weights.begin(), weights.end()) / unit : 0;
  const double shift = std::min(worst, 0.0);
  double best = 0, average = 0;
  for (double& value : weights) {
    value = unit > 0 ? value / unit - shift : 0;
    best = std::max(best, value);
    average += value;
  }
  average /= static_cast<double>(weights.size());
  worst -= shift;

  // A converged population has nothing to prefer.
  if (!(best > average) || !(average > worst)) return std::vector<double>(weights.size(), 1.0);

  const double worstCopies = 1 + (largestCopies - 1) * (worst - average) / (best - average);
  for (double& value : weights)
    value = worstCopies >= 0 ? 1 + (largestCopies - 1) * (value - average) / (best - average)
                             : (value - worst) / (average - worst);
  for (double& value : weights) value = std::max(value, 0.0);
  return weights;
}

Roulette::Roulette(std::span<const double> weights) {
  double sum = 0;
  cumulative_.reserve(weights.size());
  for (const double weight : weights) {
    require(weight >= 0, "weights of 0 or more");
    cumulative_.push_back(sum += weight);
  }
  require(sum > 0, "a weight above 0");
}

std::size_t Roulette::spin(Random& random) const {
  const double total = cumulative_.back();
  const double stop = random.uniform() * total;
  // The first whose share reaches beyond the stop: weight 0 has no share.
  auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), stop);
  if (found == cumulative_.end()) found = std::lower_bound(cumulative_.begin(), cumulative_.end(), total);
  return static_cast<std::size_t>(found - cumulative_.begin());
}

}  // namespace btr
