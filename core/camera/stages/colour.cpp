#include "core/camera/stages/colour.h"

#include <cmath>
#include <string>

#include "core/camera/stages/rim.h"

namespace btr {
namespace {

constexpr std::array<const char*, 3> channelNames{"red", "green", "blue"};

double planck(double wavelength_m, double temperature_k) {
  constexpr double secondRadiation_m_k = 0.014387769;  // CODATA 2018
  return std::pow(wavelength_m, -5) / std::expm1(secondRadiation_m_k / (wavelength_m * temperature_k));
}

}  // namespace

std::array<double, 3> lightOf(double temperature_k) {
  const double green = planck(540e-9, temperature_k);
  return {planck(610e-9, temperature_k) / green, 1, planck(460e-9, temperature_k) / green};
}

ColourFilter::ColourFilter(const CameraSpec& spec) {
  const auto number = [&](const std::string& name) { return spec.number(CameraStage::colour, name); };
  const auto light = lightOf(number("light_k")), white = lightOf(number("balance_k"));
  for (std::size_t row = 0; row < 3; ++row) {
    const std::string to = channelNames[row];
    for (std::size_t column = 0; column < 3; ++column)
      matrix_[3 * row + column] = static_cast<float>(
          number(to + "_gain") * number(to + "_from_" + channelNames[column]) * light[column] / white[column]);
  }
  const std::vector<float> squares = squaredRadii(spec);
  casts_.resize(3 * squares.size());
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string channel = channelNames[c];
    const auto a = static_cast<float>(number(channel + "_r2")), b = static_cast<float>(number(channel + "_r4"));
    for (std::size_t i = 0; i < squares.size(); ++i)
      casts_[3 * i + c] = std::max(0.0f, 1 + squares[i] * (a + squares[i] * b));
  }
}

void ColourFilter::apply(LightPicture& picture) const {
  for (std::size_t i = 0; i < casts_.size(); i += 3) {
    float* p = picture.rgb.data() + i;
    const float r = p[0], g = p[1], b = p[2];
    for (std::size_t c = 0; c < 3; ++c)
      p[c] = casts_[i + c] * (matrix_[3 * c] * r + matrix_[3 * c + 1] * g + matrix_[3 * c + 2] * b);
  }
}

}  // namespace btr
