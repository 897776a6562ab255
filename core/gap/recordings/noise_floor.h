#pragma once
#include <span>

namespace btr {

/// Standard deviation of the noise of evenly sampled values: the fourth difference is free of slow motion and
/// multiplies white noise by √70; its root mean square in blocks of 50 samples, and the median of the blocks, so that a
/// few fast moments do not count. Differencing overestimates where the motion itself is fast within five samples.
/// Values that are not finite are passed over, as if the sensor measured more slowly, in blocks of as many rows. 0 for
/// fewer than five values; a channel that rests within one quantisation step also gives 0.
/// Of what bounces, some differences span an impact. Where they are so many that no block is without, the level is that
/// of the others: from the 40 % quantile on, those within three standard deviations.
enum class Impacts { none, some };
double noiseFloor(std::span<const double> values, Impacts impacts = Impacts::none);

/// True where fast motion is part of that `level`: differences of a higher order, which make as much of white noise and
/// less of motion, say clearly less. Noise of other colours does not: it would have to end far below the rate at which
/// it is sampled.
bool motionPasses(std::span<const double> values, double level);

/// The same for samples at their own times, which increase: the fourth divided difference, scaled to what it makes of
/// white noise. Free of slow motion however uneven the times are, so that stamps that jitter count where values follow
/// another clock. Not across pauses.
double noiseFloor(std::span<const double> time_s, std::span<const double> values, Impacts impacts = Impacts::none);

/// The smallest step between different neighbouring values that all steps are whole multiples of (within 2 %), else the
/// same of the steps' changes, 0 if there is none: what the sensor's counts are worth. Values that are not finite are
/// passed over.
double quantisationStep(std::span<const double> values);

/// What a channel cannot be known better than: the larger of its noise floor and of its rounding error, step/√12.
double resolution(std::span<const double> values, Impacts impacts = Impacts::none);

}  // namespace btr
