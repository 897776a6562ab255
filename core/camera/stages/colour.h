#pragma once
#include <array>

#include "core/camera/camera_spec.h"
#include "core/camera/stages/light.h"

namespace btr {

/// Light of a colour temperature in the three channels, relative to green: Planck's law at 610, 540 and 460 nm.
std::array<double, 3> lightOf(double temperature_k);

/// Colour of the light, colour filter (a 3 × 3 matrix), cast at the rim (1 + r2·r² + r4·r⁴ for each channel, at least
/// 0), and the gains of the white balance.
class ColourFilter {
 public:
  explicit ColourFilter(const CameraSpec& spec);
  void apply(LightPicture& picture) const;

 private:
  std::array<float, 9> matrix_;  // with the light's colour and the gains
  std::vector<float> casts_;     // 3 a pixel
};

}  // namespace btr
