#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/camera/stages/light.h"

namespace btr {

/// The nearest whole number from 0 to 255; what is no number is 0.
inline std::uint8_t toByte(float value) {
  const float within = value > 0 ? (value < 255 ? value : 255.0f) : 0.0f;
  return static_cast<std::uint8_t>(static_cast<int>(within + 0.5f));
}

/// 0 to 1 as 0 to 255.
std::vector<std::uint8_t> quantised(const LightPicture& picture);

/// Y′CbCr of R′G′B′ by ITU-R BT.601. Full range: all three are 0 to 255, Cb and Cr around 128 (JFIF); studio range: Y′
/// 16 to 235, Cb and Cr 16 to 240.
class YcbcrCode {
 public:
  explicit YcbcrCode(bool studio);
  /// From R′G′B′ between 0 and 1; not rounded.
  std::array<float, 3> coded(float r, float g, float b) const;
  /// Back to 0 to 255.
  std::array<std::uint8_t, 3> rgb(float y, float cb, float cr) const;
  /// Y Cb Y Cr for each two neighbours, which share the colour of their mean.
  std::vector<std::uint8_t> pairs(const LightPicture& picture) const;
  std::vector<std::uint8_t> rgbOfPairs(const std::vector<std::uint8_t>& pairs) const;

 private:
  float black_, lightSpan_, colourSpan_;
};

}  // namespace btr
