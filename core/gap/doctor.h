#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/gap/recording.h"
#include "core/gap/replay.h"

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
  double noiseFloor = 0, quantisation = 0;  ///< see noise_floor.h
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

/// Something that the columns say of how they are read.
struct Finding {
  std::string channel;   ///< that it is about
  std::string text;      ///< in words, with its evidence and with what to change in the mapping
  bool certain = false;  ///< no physics does that: whatever is compared with this channel would mean nothing
  /// What is certain is not where the channel follows in another recording that was read in the same way: beyond its
  /// resonance a joint moves against its command, too.
  bool refutable = false;
};

/// What one recording's columns say.
struct Diagnosis {
  std::vector<Finding> findings;
  std::vector<std::string> following;  ///< position channels that move with their command
};

/// Whether the columns can be what their names say, by comparing what was commanded with what was measured at each
/// joint that follows positions: wrong units (degrees, millimetres, milliseconds), turned signs, joints mixed up, a
/// constant offset of the encoder that no load explains, a clock that is ahead, a position that never changes. Nothing
/// is changed. A joint whose command hardly moves, or where the evidence is ambiguous (the joints move alike, one fast
/// sine), gives none.
Diagnosis doctor(const Scene& scene, const Recording& recording, const Binding& binding);

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
