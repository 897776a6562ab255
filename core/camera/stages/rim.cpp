#include "core/camera/stages/rim.h"

#include <cmath>

namespace btr {

std::vector<float> squaredRadii(const CameraSpec& spec) {
  const double corner = std::hypot((spec.width - 1) / 2.0, (spec.height - 1) / 2.0);
  std::vector<float> squares;
  squares.reserve(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height));
  for (int y = 0; y < spec.height; ++y)
    for (int x = 0; x < spec.width; ++x) {
      const double dx = (x - spec.centreX_px) / corner, dy = (y - spec.centreY_px) / corner;
      squares.push_back(static_cast<float>(dx * dx + dy * dy));
    }
  return squares;
}

Vignetting::Vignetting(const CameraSpec& spec) {
  const auto term = [&](const char* name) { return static_cast<float>(spec.number(CameraStage::vignetting, name)); };
  const float a = term("r2"), b = term("r4"), c = term("r6");
  gains_ = squaredRadii(spec);
  for (float& q : gains_) q = std::max(0.0f, 1 + q * (a + q * (b + q * c)));
}

void Vignetting::apply(LightPicture& picture) const {
  for (std::size_t i = 0; i < gains_.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) picture.rgb[3 * i + c] *= gains_[i];
}

}  // namespace btr
