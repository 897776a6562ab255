#include "core/camera/stages/bytes.h"

#include <algorithm>

namespace btr {
namespace {

// BT.601's shares of luma; Cb and Cr are the differences to it, scaled to ±½.
constexpr float lumaRed = 0.299f, lumaGreen = 0.587f, lumaBlue = 0.114f;
constexpr float blueScale = 1.772f, redScale = 1.402f;

float withinUnit(float value) { return std::min(std::max(0.0f, value), 1.0f); }

}  // namespace

std::vector<std::uint8_t> quantised(const LightPicture& picture) {
  std::vector<std::uint8_t> bytes(picture.rgb.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = toByte(255 * picture.rgb[i]);
  return bytes;
}

YcbcrCode::YcbcrCode(bool studio)
    : black_(studio ? 16.0f : 0.0f), lightSpan_(studio ? 219.0f : 255.0f), colourSpan_(studio ? 224.0f : 255.0f) {}

std::array<float, 3> YcbcrCode::coded(float r, float g, float b) const {
  const float luma = lumaRed * r + lumaGreen * g + lumaBlue * b;
  return {black_ + lightSpan_ * luma, 128 + colourSpan_ * (b - luma) / blueScale,
          128 + colourSpan_ * (r - luma) / redScale};
}

std::array<std::uint8_t, 3> YcbcrCode::rgb(float y, float cb, float cr) const {
  const float luma = (y - black_) * (1 / lightSpan_);
  const float r = luma + redScale * (cr - 128) * (1 / colourSpan_),
              b = luma + blueScale * (cb - 128) * (1 / colourSpan_);
  const float g = (luma - lumaRed * r - lumaBlue * b) * (1 / lumaGreen);
  return {toByte(255 * r), toByte(255 * g), toByte(255 * b)};
}

std::vector<std::uint8_t> YcbcrCode::pairs(const LightPicture& picture) const {
  std::vector<std::uint8_t> bytes(picture.rgb.size() / 3 * 2);
  const float* p = picture.rgb.data();
  for (std::size_t i = 0; i + 3 < bytes.size(); i += 4, p += 6) {
    const auto left = coded(withinUnit(p[0]), withinUnit(p[1]), withinUnit(p[2]));
    const auto right = coded(withinUnit(p[3]), withinUnit(p[4]), withinUnit(p[5]));
    bytes[i] = toByte(left[0]);
    bytes[i + 1] = toByte((left[1] + right[1]) / 2);
    bytes[i + 2] = toByte(right[0]);
    bytes[i + 3] = toByte((left[2] + right[2]) / 2);
  }
  return bytes;
}

std::vector<std::uint8_t> YcbcrCode::rgbOfPairs(const std::vector<std::uint8_t>& pairs) const {
  std::vector<std::uint8_t> bytes(pairs.size() / 2 * 3);
  std::uint8_t* to = bytes.data();
  for (std::size_t i = 0; i + 3 < pairs.size(); i += 4)
    for (const std::size_t y : {i, i + 2}) {
      const auto colour = rgb(pairs[y], pairs[i + 1], pairs[i + 3]);
      for (const std::uint8_t byte : colour) *to++ = byte;
    }
  return bytes;
}

}  // namespace btr
