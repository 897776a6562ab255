#pragma once
#include <cstddef>

#include "core/gap/recordings/recording.h"

namespace btr {

/// What one recording says of how well one of its channels is known.
struct ChannelFloor {
  double level = 0;     ///< [the channel's unit]; 0 only for a column without a number
  bool shown = false;   ///< by the numbers themselves; else `level` is the rounding of the digits written, or a guess
  bool few = false;     ///< not shown, as it has too few numbers, not as it stands still
  bool moves = false;   ///< fast motion is part of `level`
  double byRows = 0;    ///< noise over the rows, as if they were even samples
  double byStamps = 0;  ///< noise over the time stamps
  double ofTime = 0;    ///< part of `level`: what the motion makes of stamps that jitter, speed × jitter
  double ofSensor = 0;  ///< the other part, where ofTime > 0
  double jitter_s = 0;  ///< of the stamps, where ofTime > 0
};
/// When samples were taken: at their time stamps unless the values show otherwise, or, as other recordings of the same
/// logger show, evenly, row by row, while the stamps jitter.
enum class Stamps { asShown, off };

/// The largest of the noise over the channel's own samples at their times, of the rounding of its counts and of the
/// digits written, of what a filter left of the noise (neighbours are then alike, and differences hide it), and, where
/// stamps jitter and values do not, of the usual speed times the jitter.
ChannelFloor channelFloor(const Recording& recording, std::size_t column, Stamps stamps = Stamps::asShown);

/// What one step of a column's numbers is: of its counts, or of the last digit that was written, if that is coarser; 0
/// where neither shows.
double stepOfNumbers(const Recording& recording, std::size_t column);

/// Values are smoother over rows than over stamps: these were not given when the samples were taken.
bool followsRowsNotStamps(const ChannelFloor& floor);

}  // namespace btr
