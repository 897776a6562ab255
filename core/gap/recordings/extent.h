#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace btr {

/// The lowest and the highest of finite values; others are passed over.
struct Extent {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void add(std::span<const double> values) {
    for (const double value : values) add(value);
  }
  bool empty() const { return !(high >= low); }
  bool some() const { return high > low; }  ///< more than one value
};

}  // namespace btr
