#pragma once
#include <cstddef>
#include <vector>

#include "core/gap/recordings/recording.h"

namespace btr {

/// How fast a channel moves at each of its samples [its unit/s, not negative], NaN where it has none: from the samples
/// on either side, by their numbers and the usual time between them, as stamps may be off. What `noise` [its unit]
/// makes of the difference is taken out.
std::vector<double> sampleSpeeds(const Recording& recording, std::size_t column, double noise);

}  // namespace btr
