#pragma once
#include "core/gap/recordings/recording.h"

namespace btr {

/// Stamps that jitter replaced by those of even samples, as the mapping's "retime" agrees to: a straight line through
/// the recorded ones, a period apart (`period_s`, 0: the line's own), samples that were dropped left out. Throws
/// InputError where rows are no even samples: another period than the stamps have on the average, or stamps that stray
/// from any even clock by more than `mostPeriods` of them. A note tells by how much stamps were moved.
void retime(Recording& trial, double period_s);

/// How the stamps of a recording stray from an even clock.
struct StampJitter {
  double period_s = 0;  ///< median
  double size_s = 0;    ///< standard deviation from row to row of what is no drift (noise_floor.h, of the stamps)
};
StampJitter stampJitter(const Recording& trial);

}  // namespace btr
