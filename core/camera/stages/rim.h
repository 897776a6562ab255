#pragma once
#include "core/camera/camera_spec.h"
#include "core/camera/stages/light.h"

namespace btr {

/// Square of the distance of each pixel from the optical axis, 1 at half the diagonal of the sensor.
std::vector<float> squaredRadii(const CameraSpec& spec);

/// Gain of a pixel by its radius: 1 + r2·r² + r4·r⁴ + r6·r⁶, at least 0. A picture's rim gets darker.
class Vignetting {
 public:
  explicit Vignetting(const CameraSpec& spec);
  void apply(LightPicture& picture) const;

 private:
  std::vector<float> gains_;
};

}  // namespace btr
