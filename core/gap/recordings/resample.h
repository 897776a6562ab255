#pragma once
#include "core/gap/recordings/recording.h"
#include "core/spec/random.h"

namespace btr {

/// How a recording is thinned out before it is used.
struct Resampling {
  double period_s = 0;    ///< time between samples, 0: the median one of the recording
  double lowpass_hz = 0;  ///< zero-phase Butterworth of fourth order, 0: 0.8 times what the period can carry, where it
                          ///< is longer than the recording's own
};

/// The recording at equal times from its first to its last. Channels are interpolated on a straight line, filtered
/// forward and backward on the recording's own rhythm (no delay) and then taken at the new times; `enabled` and columns
/// that are no channels keep the last value before. An empty cell is passed over. Throws InputError for a filter or
/// period that the recording cannot carry.
Recording resampled(const Recording& recording, const Resampling& how);

/// Noise like the channel's own, drawn anew, one a row [its unit]: white, or what the filter that the recording went
/// through leaves of white noise.
std::vector<double> noiseDrawn(const Recording& recording, std::size_t column, Random& random);

/// The median time between rows, 0 where there are fewer than two. Where rows are of several topics, between those of
/// the channel with the most numbers.
double rhythm(const Recording& recording);
/// Those rows' times: all, or where rows are of several topics those of the channel with the most numbers.
std::vector<double> sampleTimes(const Recording& recording);

}  // namespace btr
