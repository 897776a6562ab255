#pragma once
#include <span>
#include <vector>

namespace btr {

/// How a measured position follows a command, over the lags that a servo may have.
struct Following {
  double lag_s = 0;        ///< at the strongest correlation, either sign
  double correlation = 0;  ///< there
  double highest = 0;      ///< correlation, over all lags: near −1 only if no lag explains a turned sign
  double ratio = 0;        ///< spread of the measured over that of the command
};

/// `command`, `measured` on an even grid; only points with `used` count (those before them, at a lag, need not).
/// Nothing moves: all 0.
Following follow(std::span<const double> command, std::span<const double> measured, const std::vector<char>& used,
                 double period_s, double longestLag_s = 0.15);

/// Spread (standard deviation) of the used points.
double spread(std::span<const double> values, const std::vector<char>& used);

}  // namespace btr
