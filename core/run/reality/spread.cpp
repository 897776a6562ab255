#include "core/run/reality/spread.h"

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

namespace btr {

Spread spreadOf(std::span<const double> values) {
  Spread spread;
  spread.count = static_cast<int>(values.size());
  if (values.empty()) return spread;
  const double n = static_cast<double>(values.size());
  spread.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() < 2) return spread;

  // Two passes: the deviations are small beside the mean.
  double squares = 0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  spread.deviation = std::sqrt(squares / (n - 1));
  spread.standardError = spread.deviation / std::sqrt(n);
  const boost::math::students_t student(n - 1);
  spread.halfWidth95 = spread.standardError * boost::math::quantile(student, 0.975);
  return spread;
}

}  // namespace btr
