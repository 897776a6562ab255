#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/spec/random.h"

namespace btr::prove {

/// A recording on its way from the sensors to the file.
struct LoggedTrial {
  std::vector<std::string> columns;                      ///< time_s first
  std::vector<std::vector<std::optional<double>>> rows;  ///< nothing: the cell is empty
  std::size_t firstMeasured = 1;                         ///< columns before it are time and inputs
};

/// What loggers do to recordings. Drawn for a case, from a stream of its own, and the same in all of its trials.
struct Dirt {
  double jitter = 0;          ///< standard deviation of a stamp's error, as a share of the sample period
  std::vector<int> staleFor;  ///< by measured column: a new value every n-th row, repeated until then; 1: always new
  std::vector<int> everyNth;  ///< by measured column: a value in every n-th row only; 1: in all
  double lost = 0;            ///< share of the rows whose measured values never arrived
  bool losesRows = false;     ///< of which nothing arrived at all (where there are no inputs)
};

/// "quiet", "jitter", "stale", "multirate", "dropped", or "mixed" of them.
const std::vector<std::string>& dirtKinds();

/// `groups`: measured columns that come from one sensor and share its rate, as numbers of their groups.
Dirt drawDirt(const std::string& kind, const std::vector<int>& groups, bool hasInputs, Random random);

/// Of one trial; `sample_s` is its period.
void soil(LoggedTrial& trial, const Dirt& dirt, double sample_s, Random random);

/// Somebody touched the marker, or pushed what was measured: from a drawn row on one measured column is off by
/// `size`, drawn as 15 to 60 times its noise, or goes on with another slope.
void spoil(LoggedTrial& trial, const std::vector<double>& noises, Random random);

/// As a logger writes it: times in whole microseconds.
std::string csvOf(const LoggedTrial& trial);

}  // namespace btr::prove
