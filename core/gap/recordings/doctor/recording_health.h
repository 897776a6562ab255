#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/gap/recordings/recording.h"

namespace btr {

/// A pause that is longer than the rhythm around it: samples were dropped, or the recorder waited.
struct Gap {
  std::size_t row = 0;  ///< the first row after it
  double from_s = 0, to_s = 0;
  double missing = 0;  ///< samples that the rhythm would have had in between, at least 1
};

/// What is odd about one channel of a recording.
struct ChannelHealth {
  std::string channel;
  double noiseFloor = 0, quantisation = 0;  ///< see channel_floor.h and noise_floor.h
  std::size_t empty = 0;                    ///< cells without a value
  double longestHold_s = 0;                 ///< longest time without any change, of a channel that does change
};

struct RecordingHealth {
  double period_s = 0;    ///< median time between samples
  double jitter_s = 0;    ///< median deviation from it
  std::vector<Gap> gaps;  ///< steps of more than 1.5 times the rhythm before and after

  std::vector<ChannelHealth> channels;  ///< of the columns whose names the contract knows
  std::vector<std::string> findings;    ///< in words, pauses first; nothing is changed
};

/// Looks at a recording before physics is blamed (gap analysis, step 1). Changes nothing.
RecordingHealth examine(const Recording& recording);

/// n where a column has a number in every n-th row, as that of a slower sensor has; 1 for anything else.
std::size_t everyNthRow(const std::vector<double>& values);

/// By how much `measured` runs behind `command`; negative: ahead, which no servo does.
struct ClockOffset {
  double offset_s = 0;
  double uncertainty_s = 0;  ///< how far the correlation stays within 2 % of its top
  double correlation = 0;    ///< at the top
};
/// From the highest correlation of their changes over 50 ms, for shifts within ±`limit_s`, to a fraction of a sample. A
/// servo's own lag is part of it. Nothing where one of them does not move or the correlation stays below one half.
std::optional<ClockOffset> clockOffset(std::span<const double> time_s, std::span<const double> command,
                                       std::span<const double> measured, double limit_s = 0.5);

}  // namespace btr
