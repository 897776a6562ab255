#pragma once
#include <array>
#include <cmath>
#include <vector>

#include "core/camera/twin.h"

namespace btr {

/// The numbers of the colour stages in this order.
enum ColourNumber {
  redGain,
  greenGain,
  blueGain,
  rim2,
  rim4,
  rim6,
  redCast2,
  redCast4,
  blueCast2,
  blueCast4,
  gammaPower
};
inline constexpr std::size_t colourNumberCount = 11;
using ColourNumbers = std::array<double, colourNumberCount>;

/// One channel of one pixel: what falls on it, and what the photograph has.
struct ColourSample {
  double light;          ///< after lens, exposure, light and filter; gains, rim and gamma are still to come
  double squaredRadius;  ///< 1 at the corner
  int channel;           ///< 0 red, 1 green, 2 blue
  double code;           ///< 0 to 1
};

/// The pixels of a photograph that tell something: away from edges of the scene. Three samples each, one a channel.
std::vector<ColourSample> colourSamples(const CameraSpec& spec, const ColourView& view);

/// The signal before gamma.
template <class T>
T signalOf(const ColourSample& sample, const T* n) {
  const double q = sample.squaredRadius;
  const T rim = 1.0 + q * (n[rim2] + q * (n[rim4] + q * n[rim6]));
  const T red = 1.0 + q * (n[redCast2] + q * n[redCast4]), blue = 1.0 + q * (n[blueCast2] + q * n[blueCast4]);
  const T cast = sample.channel == 0 ? red : sample.channel == 2 ? blue : T(1.0);
  return sample.light * n[redGain + sample.channel] * rim * cast;
}

/// What the photograph should have, from 0 to 1.
template <class T>
T codeOf(const ColourSample& sample, const T* n) {
  using std::pow;
  const T signal = signalOf(sample, n);
  if (!(signal > 0.0)) return T(0.0);
  if (!(signal < 1.0)) return T(1.0);
  return pow(signal, 1.0 / n[gammaPower]);
}

ColourNumbers colourNumbersOf(const CameraSpec& spec);
CameraSpec withColourNumbers(CameraSpec spec, const ColourNumbers& numbers);

/// Variance of the signal before gamma: `read²` and `shot` times the signal.
struct NoiseFit {
  double read = 0, shot = 0, readDeviation = 0, shotDeviation = 0;
};

/// From the scatter of luma, which 4:2:2 leaves as it is. Samples come in threes.
NoiseFit fitNoise(const std::vector<ColourSample>& samples, const ColourNumbers& numbers);

/// Root mean square of what noise and rounding leave in a channel, in 255ths.
double noiseLevel(const std::vector<ColourSample>& samples, const ColourNumbers& numbers, const NoiseFit& noise);

}  // namespace btr
