#include "core/camera/stages/noise.h"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

#include "core/spec/random.h"

namespace btr {
namespace {

constexpr unsigned quantileBits = 14;
constexpr std::size_t quantileCount = std::size_t{1} << quantileBits;

/// Equally likely values of a standard normal: the middle quantiles of 2^14 parts, scaled to a variance of exactly 1.
/// One draw of 64 bits gives four; a logarithm and a cosine each would take longer than all other stages together.
const std::vector<float>& normalQuantiles() {
  static const std::vector<float> quantiles = [] {
    std::vector<double> exact(quantileCount);
    double square = 0;
    for (std::size_t i = 0; i < quantileCount; ++i) {
      const double p = (static_cast<double>(i) + 0.5) / static_cast<double>(quantileCount);
      exact[i] = std::numbers::sqrt2 * boost::math::erf_inv(2 * p - 1);
      square += exact[i] * exact[i];
    }
    const double scale = 1 / std::sqrt(square / static_cast<double>(quantileCount));
    std::vector<float> scaled;
    for (const double value : exact) scaled.push_back(static_cast<float>(scale * value));
    return scaled;
  }();
  return quantiles;
}

}  // namespace

SensorNoise::SensorNoise(const CameraSpec& spec) : seed_(spec.seed) {
  const auto number = [&](const char* name) { return spec.number(CameraStage::noise, name); };
  amplifier_ = static_cast<float>(std::pow(10, number("gain_db") / 20));
  readVariance_ = static_cast<float>(number("read") * number("read"));
  shot_ = static_cast<float>(number("shot"));
  const std::size_t values = 3 * static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  Random random = Random::forPurpose(seed_, "camera pattern");
  gains_.resize(values);
  offsets_.resize(values);
  for (float& gain : gains_) gain = static_cast<float>(1 + number("pattern_gain") * random.normal());
  for (float& offset : offsets_) offset = static_cast<float>(number("pattern_offset") * random.normal());
}

void SensorNoise::apply(LightPicture& picture, std::uint64_t frameNumber) const {
  const float* quantiles = normalQuantiles().data();
  Random random = Random::forPurpose(seed_, "camera noise", frameNumber);
  const std::size_t values = picture.rgb.size();
  for (std::size_t i = 0; i < values; i += 4) {
    std::uint64_t bits = random.next();
    for (std::size_t k = i; k < std::min(i + 4, values); ++k, bits >>= quantileBits) {
      const float signal = picture.rgb[k];
      const float deviation = std::sqrt(readVariance_ + shot_ * std::max(0.0f, signal));
      picture.rgb[k] =
          amplifier_ * (signal * gains_[k] + offsets_[k] + deviation * quantiles[bits & (quantileCount - 1)]);
    }
  }
}

}  // namespace btr
