#pragma once
#include <cmath>

namespace btr {

/// For a root mean square.
struct Squares {
  double sum = 0, count = 0;
  void add(double value) {
    sum += value * value;
    ++count;
  }
  double rms() const { return count > 0 ? std::sqrt(sum / count) : 0; }
};

}  // namespace btr
