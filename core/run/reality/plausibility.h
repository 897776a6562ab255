#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/store/records.h"

namespace btr {

// Whether a measured value can be what was measured, asked before it counts: a slipped decimal point or another unit
// would pull the simulator along.

/// What is known of a run's values before new ones are entered.
struct KnownFitness {
  std::vector<MeasurementTask> tasks;           ///< with what the simulator expects of each
  std::vector<MeasurementRecord> measurements;  ///< everything stored, void ones too
  std::string unit;
  bool canBeNegative = true;  ///< Fitness::canBeNegative
};

/// Why a value needs a second look.
struct Doubt {
  std::size_t index = 0;      ///< of the value among those that are entered
  std::string sentence;       ///< "41 m is about 100 times the usual 0.4 m of this run; …"
  bool isImpossible = false;  ///< never counts, whoever confirms it
};

/// The doubtful ones among `entered`, in their order; void values are not judged. A value is doubtful if it
///   - is negative where the fitness cannot be: impossible;
///   - is at least `largeFactor` times larger than the largest simulated fitness of the run and than the median of what
///     was measured, or at least `smallFactor` times smaller than the smallest and the median;
///   - lies further than `farSpreads` robust standard deviations (1.4826·MAD) from the median of at least `fewest`
///     other values, stored and entered; a spread below `leastSpread` of that median, or below a quarter of the
///     simulated values' range, counts as that.
/// The sentences name measured values only: the simulated ones stay blind.
std::vector<Doubt> doubts(const KnownFitness& known, const std::vector<MeasurementRecord>& entered);

/// Why values with these doubts are not taken: one clause for each, where a doubtful value was confirmed only for the
/// impossible ones; "" where all are taken. `places`, unless empty, says for each value where it came from;
/// `otherwise`, how a doubtful value counts all the same, ends the sentence unless one is impossible.
std::string whyRefused(const std::vector<Doubt>& doubts, bool isConfirmed, const std::string& otherwise,
                       const std::vector<std::string>& places = {});

/// The thresholds. A slip is a factor of 10 or more, kicks of one run differ by less. Downwards a real kick may fail
/// where the simulated one went well, so that only another unit (a factor of 100) is asked about.
struct DoubtLimits {
  static constexpr double largeFactor = 5, smallFactor = 50, farSpreads = 8, leastSpread = 0.2;
  static constexpr std::size_t fewest = 4;
};

}  // namespace btr
