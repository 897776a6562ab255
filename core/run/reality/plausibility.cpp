#include "core/run/reality/plausibility.h"

#include <algorithm>
#include <cmath>

#include "core/gap/report/report_figures.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/// 1.4826·MAD: the standard deviation where values are normal, whatever a few of them are. 0 below two values.
double robustSpread(const std::vector<double>& values) {
  if (values.size() < 2) return 0;
  const double centre = medianOf(values);
  std::vector<double> away;
  for (const double value : values) away.push_back(std::abs(value - centre));
  return 1.4826 * medianOf(std::move(away));
}

/// A quarter of the range: what a handful of values scatter by, skewed ones too.
double quarterRange(const std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return (*high - *low) / 4;
}

std::vector<double> sizesOf(const std::vector<double>& values) {
  std::vector<double> sizes;
  for (const double value : values)
    if (value != 0) sizes.push_back(std::abs(value));
  return sizes;
}

/// Says numbers with their unit.
class Sentences {
 public:
  explicit Sentences(std::string unit) : unit_(std::move(unit)) {}
  std::string value(double v) const { return brief(v) + (unit_.empty() ? "" : " " + unit_); }

  std::string negative(double v) const { return value(v) + " is not possible: this fitness is never negative"; }
  std::string wrongScale(double v, double ratio, const std::vector<double>& stored) const {
    const double tens = std::max(1.0, std::round(std::abs(std::log10(ratio))));
    const std::string often = brief(std::pow(10, tens)) + " times " + (ratio > 1 ? "larger" : "smaller");
    const std::string than =
        stored.empty() ? "than is expected here" : "than usual in this run (" + value(medianOf(stored)) + ")";
    return value(v) + " is about " + often + " " + than + ": is the decimal point right, and the unit?";
  }
  std::string far(double v, const std::vector<double>& others) const {
    const auto [low, high] = std::minmax_element(others.begin(), others.end());
    return value(v) + " is far from the other measured values (" + brief(*low) + " to " + value(*high) + ")";
  }

 private:
  std::string unit_;
};

/// How many times larger than the largest, or smaller than the smallest (below 1); 1 within them.
std::optional<double> scaleBeside(double value, const std::vector<double>& simulated,
                                  const std::vector<double>& stored) {
  const double size = std::abs(value);
  if (size == 0 || (simulated.empty() && stored.empty())) return std::nullopt;
  double large = 0, small = INFINITY;
  if (!simulated.empty()) {
    const auto [low, high] = std::minmax_element(simulated.begin(), simulated.end());
    small = *low;
    large = *high;
  }
  if (!stored.empty()) {
    large = std::max(large, medianOf(stored));
    small = std::min(small, medianOf(stored));
  }
  if (size >= DoubtLimits::largeFactor * large) return size / (stored.empty() ? large : medianOf(stored));
  if (size * DoubtLimits::smallFactor <= small) return size / (stored.empty() ? small : medianOf(stored));
  return std::nullopt;
}

}  // namespace

std::vector<Doubt> doubts(const KnownFitness& known, const std::vector<MeasurementRecord>& entered) {
  std::vector<double> simulated, stored;
  for (const MeasurementTask& task : known.tasks)
    if (std::isfinite(task.simulatedFitness)) simulated.push_back(task.simulatedFitness);
  for (const MeasurementRecord& m : known.measurements)
    if (!m.isVoid) stored.push_back(m.value);
  const Sentences say(known.unit);

  std::vector<Doubt> all;
  for (std::size_t i = 0; i < entered.size(); ++i) {
    const double value = entered[i].value;
    // What is beyond any fitness is refused when it is stored.
    if (entered[i].isVoid || !(std::abs(value) <= largestFitness)) continue;
    if (value < 0 && !known.canBeNegative) {
      all.push_back({i, say.negative(value), true});
      continue;
    }
    if (const auto ratio = scaleBeside(value, sizesOf(simulated), sizesOf(stored))) {
      all.push_back({i, say.wrongScale(value, *ratio, stored)});
      continue;
    }
    std::vector<double> others = stored;
    for (std::size_t k = 0; k < entered.size(); ++k)
      if (k != i && !entered[k].isVoid) others.push_back(entered[k].value);
    if (others.size() < DoubtLimits::fewest) continue;
    const double centre = medianOf(others);
    const double spread =
        std::max({robustSpread(others), quarterRange(simulated), DoubtLimits::leastSpread * std::abs(centre)});
    if (std::abs(value - centre) > DoubtLimits::farSpreads * spread && spread > 0)
      all.push_back({i, say.far(value, others)});
  }
  return all;
}

std::string whyRefused(const std::vector<Doubt>& doubts, bool isConfirmed, const std::string& otherwise,
                       const std::vector<std::string>& places) {
  std::string said;
  bool isImpossible = false;
  for (const Doubt& doubt : doubts) {
    if (isConfirmed && !doubt.isImpossible) continue;
    said += (said.empty() ? "" : "; ") + (places.empty() ? "" : places[doubt.index] + ": ") + doubt.sentence;
    isImpossible = isImpossible || doubt.isImpossible;
  }
  return said.empty() || isImpossible ? said : said + "; nothing was stored; " + otherwise;
}

}  // namespace btr
