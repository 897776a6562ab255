#pragma once
#include <cstddef>

#include "core/gap/recordings/recording.h"

namespace btr {

/// Whether a channel's values were taken at their stamps: the slope of their fourth differences over what stamps that
/// are right make of them, speed × the stamps' fourth differences. 1 where they are; 0 where samples are even, row by
/// row, and the stamps jitter. Many samples together tell it where counts hide it in each.
struct StampTruth {
  double slope = 0;
  double weight = 0;  ///< one over the square of its standard error; 0: nothing tells
};
StampTruth stampTruth(const Recording& recording, std::size_t column);

}  // namespace btr
