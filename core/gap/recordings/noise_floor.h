#pragma once
#include <span>

namespace btr {

/// Standard deviation of the noise of evenly sampled values: the fourth difference is free of slow motion and
/// multiplies white noise by √70; its root mean square in blocks of 50 samples, and the median of the blocks, so that a
/// few fast moments do not count. Differencing overestimates where the motion itself is fast within five samples.
/// Values that are not finite are passed over, as if the sensor measured more slowly, in blocks of as many rows. 0 for
/// fewer than five values; a channel that rests within one quantisation step also gives 0.
double noiseFloor(std::span<const double> values);

/// The same for samples at their own times, which increase: the fourth divided difference, scaled to what it makes of
/// white noise. Free of slow motion however uneven the times are, so that stamps that jitter count where values follow
/// another clock. Not across pauses.
double noiseFloor(std::span<const double> time_s, std::span<const double> values);

/// The smallest step between different neighbouring values that all steps are whole multiples of (within 2 %), else the
/// same of the steps' changes, 0 if there is none: what the sensor's counts are worth. Values that are not finite are
/// passed over.
double quantisationStep(std::span<const double> values);

/// What a channel cannot be known better than: the larger of its noise floor and of its rounding error, step/√12.
double resolution(std::span<const double> values);

}  // namespace btr
