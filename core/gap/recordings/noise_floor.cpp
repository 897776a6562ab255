#include "core/gap/recordings/noise_floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "core/gap/recordings/doctor/even_grid.h"

namespace btr {
namespace {

/// The values that are there.
std::vector<double> finite(std::span<const double> values) {
  std::vector<double> there;
  there.reserve(values.size());
  for (const double value : values)
    if (std::isfinite(value)) there.push_back(value);
  return there;
}

std::vector<double> differencesOf(std::span<const double> values) {
  std::vector<double> differences;
  for (std::size_t i = 1; i < values.size(); ++i) differences.push_back(values[i] - values[i - 1]);
  return differences;
}

constexpr std::size_t fullBlock = 50;

/// So many differences of a sensor that is slower than the table make a block that they take as long as 50 rows.
std::size_t blockOf(std::size_t numbers, std::size_t rows) {
  return std::clamp<std::size_t>(fullBlock * numbers / std::max<std::size_t>(rows, 1), 10, fullBlock);
}

/// By how much the median of a block's mean square falls behind the mean: a χ² of as many degrees as a block's fourth
/// differences have, overlapping as they do (their correlations −0.8, 0.4, −0.11, 0.01), after Wilson and Hilferty.
double medianOfSquare(std::size_t block) {
  constexpr double sharedBy = 2.626;  // 1 + 2·Σρ²
  return std::pow(1 - 2 / (9 * static_cast<double>(block) / sharedBy), 3);
}

/// The median over blocks of the root mean square, of numbers that white noise of standard deviation 1 makes as large;
/// of short blocks as that of long ones would be. A last, shorter block counts only when it stands alone.
double medianOfBlocks(const std::vector<double>& noise, std::size_t block) {
  std::vector<double> levels;
  for (std::size_t first = 0; first < noise.size(); first += block) {
    const std::size_t last = std::min(noise.size(), first + block);
    if (last - first < block && !levels.empty()) break;
    double sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += noise[i] * noise[i];
    levels.push_back(std::sqrt(sum / static_cast<double>(last - first)));
  }
  return median(std::move(levels)) * std::sqrt(medianOfSquare(fullBlock) / medianOfSquare(block));
}

/// Standard deviation of those numbers that are normal, of the smaller ones among others that are much larger.
double levelOfTheMany(std::vector<double> noise) {
  constexpr double quantile = 0.4, ofNormal = 0.5244, within = 3, ofCut = 0.98658;  // √ of the variance within 3 σ
  constexpr int turns = 20;
  for (double& value : noise) value = std::abs(value);
  std::ranges::sort(noise);
  double level = noise[static_cast<std::size_t>(quantile * static_cast<double>(noise.size()))] / ofNormal;
  for (int turn = 0; turn < turns; ++turn) {
    double sum = 0, count = 0;
    for (const double value : noise)
      if (value <= within * level) sum += value * value, ++count;
    if (count == 0) break;
    level = std::sqrt(sum / count) / ofCut;
  }
  return level;
}

double levelOf(const std::vector<double>& noise, std::size_t block, Impacts impacts) {
  constexpr std::size_t enough = 12;
  constexpr double torn = 2;
  const double level = medianOfBlocks(noise, block);
  if (impacts == Impacts::none || noise.size() < enough) return level;
  const double ofTheMany = levelOfTheMany(noise);
  return ofTheMany > 0 && level > torn * ofTheMany ? ofTheMany : level;
}

double rootMeanSquare(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

/// What these differences are whole multiples of, the smallest of them; 0 for nothing. Up to `negligible` they are
/// zero; where the smallest of the others is below `rounding` nothing is told.
double commonMeasure(const std::vector<double>& differences, double negligible, double rounding) {
  std::vector<double> steps;
  for (const double difference : differences)
    if (std::abs(difference) > negligible) steps.push_back(std::abs(difference));
  // Few different steps prove nothing.
  if (steps.size() < 10) return 0;
  const double smallest = *std::min_element(steps.begin(), steps.end());
  if (smallest < rounding) return 0;
  // The smallest difference carries the rounding of the file's digits; the mean over all of them does not.
  double counts = 0, travel = 0;
  for (const double step : steps) {
    if (step > 50 * smallest) continue;
    counts += std::round(step / smallest);
    travel += step;
  }
  const double quantum = travel / counts;
  std::size_t whole = 0, multiples = 0, ones = 0;
  for (const double step : steps) {
    const double ratio = step / quantum;
    if (ratio > 10) continue;
    ++multiples;
    if (std::abs(ratio - std::round(ratio)) < 0.02 * std::max(1.0, ratio)) ++whole;
    if (std::round(ratio) == 1) ++ones;
  }
  // An even motion without any noise has one difference, and no count.
  const bool areCounts = ones < differences.size();
  return areCounts && multiples >= 10 && static_cast<double>(whole) >= 0.98 * static_cast<double>(multiples) ? quantum
                                                                                                             : 0;
}

}  // namespace

double noiseFloor(std::span<const double> all, Impacts impacts) {
  const double gain = std::sqrt(70.0);  // 1² + 4² + 6² + 4² + 1²
  const std::vector<double> values = finite(all);
  std::vector<double> noise;
  for (std::size_t i = 4; i < values.size(); ++i)
    noise.push_back((values[i] - 4 * values[i - 1] + 6 * values[i - 2] - 4 * values[i - 3] + values[i - 4]) / gain);
  return levelOf(noise, blockOf(values.size(), all.size()), impacts);
}

bool motionPasses(std::span<const double> all, double level) {
  constexpr double clearly = 0.75;
  constexpr std::array sixth{1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0};
  const double gain = std::sqrt(924.0);  // the sum of their squares
  const std::vector<double> values = finite(all);
  std::vector<double> noise;
  for (std::size_t i = sixth.size(); i <= values.size(); ++i)
    noise.push_back(std::inner_product(sixth.begin(), sixth.end(),
                                       values.begin() + static_cast<std::ptrdiff_t>(i - sixth.size()), 0.0) /
                    gain);
  const std::size_t block = blockOf(values.size(), all.size());
  return noise.size() >= block && medianOfBlocks(noise, block) < clearly * level;
}

double noiseFloor(std::span<const double> allTimes, std::span<const double> allValues, Impacts impacts) {
  constexpr std::size_t points = 5;
  constexpr double longestSpan = 1.6;  // of the usual one: no pause in it
  std::vector<double> time, value, spans;
  for (std::size_t i = 0; i < allValues.size(); ++i)
    if (std::isfinite(allValues[i])) {
      time.push_back(allTimes[i]);
      value.push_back(allValues[i]);
    }
  for (std::size_t i = points; i <= time.size(); ++i) spans.push_back(time[i - 1] - time[i - points]);
  const double usual = median(spans);
  if (!(usual > 0)) return noiseFloor(value, impacts);
  std::vector<double> noise;
  for (std::size_t first = 0; first < spans.size(); ++first) {
    if (spans[first] > longestSpan * usual) continue;
    // The weights of a divided difference, 1/Π(tᵢ − tⱼ): nothing of a cubic passes.
    double sum = 0, gain = 0;
    for (std::size_t i = first; i < first + points; ++i) {
      double product = 1;
      for (std::size_t j = first; j < first + points; ++j)
        if (j != i) product *= (time[i] - time[j]) / usual;
      sum += (value[i] - value[first]) / product;
      gain += 1 / (product * product);
    }
    noise.push_back(sum / std::sqrt(gain));
  }
  return levelOf(noise, blockOf(value.size(), allValues.size()), impacts);
}

double quantisationStep(std::span<const double> all) {
  const std::vector<double> values = finite(all);
  double scale = 0;
  for (const double value : values) scale = std::max(scale, std::abs(value));
  const double rounding = 1e-9 * scale;  // of the arithmetic itself
  const std::vector<double> first = differencesOf(values);
  if (const double quantum = commonMeasure(first, 0, rounding); quantum > 0) return quantum;
  // A motion that passes five or six counts from sample to sample shows one count in how that changes.
  // Rounding goes up and down; what falls without noise changes by one difference to one side.
  const std::vector<double> second = differencesOf(first);
  const double negligible = std::max(rounding, 0.01 * rootMeanSquare(second));
  const auto up = std::ranges::count_if(second, [&](double change) { return change > negligible; });
  const auto down = std::ranges::count_if(second, [&](double change) { return change < -negligible; });
  return 2 * std::min(up, down) > std::max(up, down) ? commonMeasure(second, negligible, rounding) : 0;
}

double resolution(std::span<const double> values, Impacts impacts) {
  return std::max(noiseFloor(values, impacts), quantisationStep(values) / std::sqrt(12.0));
}

}  // namespace btr
