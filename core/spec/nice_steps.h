#pragma once
#include <algorithm>
#include <cmath>

namespace btr {

// Steps between the numbers of an axis, for every chart: of the window, where a tick more would not fit, and of a
// report, where about so many look best.

/// The smallest of 1, 2, 2.5, 5 · 10ⁿ that divides `range` into at most `most` steps; 2.5 is left out and nothing below
/// 1 comes if `whole`.
inline double niceStep(double range, int most, bool whole = false) {
  if (!(range > 0) || !std::isfinite(range) || most < 1) return 1;
  const double atLeast = range / most;
  const double power = std::pow(10.0, std::floor(std::log10(atLeast)));
  double step = 10 * power;
  for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
    if (whole && factor == 2.5) continue;
    if (factor * power >= atLeast * (1 - 1e-9)) {
      step = factor * power;
      break;
    }
  }
  return whole ? std::max(1.0, step) : step;
}

/// The one of 1, 2, 5 · 10ⁿ that divides `range` into about `wanted` steps.
inline double nearestNiceStep(double range, double wanted) {
  const double raw = range / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double rest = raw / power;
  return power * (rest < 1.5 ? 1 : rest < 3.5 ? 2 : rest < 7.5 ? 5 : 10);
}

/// Multiples of `step` from `from` to `to`.
inline int ticksWithin(double from, double to, double step) {
  return static_cast<int>(std::floor(to / step + 1e-9) - std::ceil(from / step - 1e-9)) + 1;
}

}  // namespace btr
