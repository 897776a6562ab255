#pragma once
#include <array>

#include "core/camera/camera_spec.h"
#include "core/camera/stages/light.h"

namespace btr {

/// Light of a colour temperature in the three channels, relative to green: Planck's law at 610, 540 and 460 nm.
std::array<double, 3> lightOf(double temperature_k);

/// Colour of the light over that which the white balance takes for white, colour filter (a 3 × 3 matrix), gains, and
/// the cast at the rim (1 + r2·r² + r4·r⁴ for each channel, at least 0).
class ColourFilter {
 public:
  explicit ColourFilter(const CameraSpec& spec);
  void apply(LightPicture& picture) const;

 private:
  std::array<float, 9> matrix_;  // with light, white balance and gains
  std::vector<float> casts_;     // 3 a pixel
};

}  // namespace btr
