#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "core/camera/camera_spec.h"

namespace btr {

/// The class of a colour: for each value of each channel the boxes that it lies in, as bits; a colour lies in the boxes
/// that all three have (the threshold test of Bruce, Balch and Veloso 2000). Exact for all 2^24 colours.
class ColourTable {
 public:
  explicit ColourTable(const CameraSpec& spec);
  /// 0 none, else 1 + index of the class.
  std::uint8_t classOf(std::uint8_t y, std::uint8_t cb, std::uint8_t cr) const;
  /// Of pairs Y Cb Y Cr.
  std::vector<std::uint8_t> ofPairs(const std::vector<std::uint8_t>& pairs) const;
  /// Of R′G′B′ bytes, in full range.
  std::vector<std::uint8_t> ofRgb(const std::vector<std::uint8_t>& rgb) const;

 private:
  std::array<std::array<std::uint32_t, 256>, 3> boxes_{};
  std::array<std::uint8_t, mostColourBoxes> classOfBox_{};
};

}  // namespace btr
