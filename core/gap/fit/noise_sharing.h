#pragma once
#include <string>
#include <vector>

#include "core/gap/fit/fit_problem.h"

namespace btr {

/// Fills the noise floors of all compared channels: the median over the trials of what each shows (channel_floor.h), as
/// the same channel has the same noise in all of them; where fast motion is part of some, the median of the others. A
/// channel that stands still everywhere, or nearly so, shows none: it takes that of the other channels of its kind
/// (another joint's position), else what the last decimal of its file is worth, and `notes` says so. Where stamps
/// jitter each sample has its own, √(sensor² + (speed·jitter)²), and the channel's is the root mean square of all of
/// them.
void shareNoiseFloors(std::vector<FitTrial>& trials, std::vector<std::string>& notes);

}  // namespace btr
