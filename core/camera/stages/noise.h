#pragma once
#include <cstdint>

#include "core/camera/camera_spec.h"
#include "core/camera/stages/light.h"

namespace btr {

/// Amplified signal with noise: G·(s·(1 + pattern gain) + pattern offset + σ·n), σ = √(read² + shot·s), n standard
/// normal, G = 10^(dB/20). The pattern belongs to the seed, n to seed and number of the frame.
class SensorNoise {
 public:
  explicit SensorNoise(const CameraSpec& spec);
  void apply(LightPicture& picture, std::uint64_t frameNumber) const;

 private:
  std::uint64_t seed_;
  float amplifier_, readVariance_, shot_;
  std::vector<float> gains_, offsets_;  // 3 a pixel
};

}  // namespace btr
