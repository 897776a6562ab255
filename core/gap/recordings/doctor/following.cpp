#include "core/gap/recordings/doctor/following.h"

#include <algorithm>
#include <cmath>

namespace btr {
namespace {

struct Moments {
  double count = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  void add(double x, double y) {
    ++count;
    a += x;
    b += y;
    aa += x * x;
    bb += y * y;
    ab += x * y;
  }
  double spreadA() const { return std::sqrt(std::max(0.0, aa / count - a / count * (a / count))); }
  double spreadB() const { return std::sqrt(std::max(0.0, bb / count - b / count * (b / count))); }
  double correlation() const {
    const double both = spreadA() * spreadB();
    return both > 0 ? (ab / count - a / count * (b / count)) / both : 0;
  }
};

}  // namespace

double spread(std::span<const double> values, const std::vector<char>& used) {
  Moments moments;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (used[i]) moments.add(values[i], 0);
  return moments.count > 0 ? moments.spreadA() : 0;
}

Following follow(std::span<const double> command, std::span<const double> measured, const std::vector<char>& used,
                 double period_s, double longestLag_s) {
  Following best;
  best.highest = -1;
  const auto most = static_cast<std::size_t>(longestLag_s / period_s);
  for (std::size_t lag = 0; lag <= most; lag += std::max<std::size_t>(1, most / 30)) {
    Moments moments;
    for (std::size_t i = lag; i < command.size(); ++i)
      if (used[i]) moments.add(command[i - lag], measured[i]);
    if (moments.count < 20) break;
    const double correlation = moments.correlation();
    best.highest = std::max(best.highest, correlation);
    if (std::abs(correlation) <= std::abs(best.correlation)) continue;
    best.correlation = correlation;
    best.lag_s = static_cast<double>(lag) * period_s;
    best.ratio = moments.spreadB() / moments.spreadA();
  }
  if (best.correlation == 0) best.highest = 0;
  return best;
}

}  // namespace btr
