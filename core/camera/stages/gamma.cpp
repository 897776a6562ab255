#include "core/camera/stages/gamma.h"

#include <algorithm>
#include <cmath>

namespace btr {
namespace {
constexpr std::size_t gammaSteps = 1u << 16;
}

GammaCurve::GammaCurve(const CameraSpec& spec) : table_(gammaSteps + 2) {
  const double power = 1 / spec.number(CameraStage::gamma, "gamma");
  for (std::size_t i = 0; i < table_.size(); ++i)
    table_[i] = static_cast<float>(std::pow(std::min(1.0, static_cast<double>(i) / gammaSteps), power));
}

void GammaCurve::apply(LightPicture& picture) const {
  for (float& value : picture.rgb) {
    const float place = std::min(std::max(0.0f, value), 1.0f) * gammaSteps;
    const auto index = static_cast<std::size_t>(place);
    value = table_[index] + (place - static_cast<float>(index)) * (table_[index + 1] - table_[index]);
  }
}

}  // namespace btr
