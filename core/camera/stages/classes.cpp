#include "core/camera/stages/classes.h"

#include <bit>

#include "core/camera/stages/bytes.h"

namespace btr {

ColourTable::ColourTable(const CameraSpec& spec) {
  unsigned box = 0;
  for (std::size_t colour = 0; colour < spec.classes.size(); ++colour)
    for (const ColourBox& bounds : spec.classes[colour].boxes) {
      classOfBox_[box] = static_cast<std::uint8_t>(colour + 1);
      for (std::size_t c = 0; c < 3; ++c)
        for (int value = bounds.least[c]; value <= bounds.most[c]; ++value)
          boxes_[c][static_cast<std::size_t>(value)] |= std::uint32_t{1} << box;
      ++box;
    }
}

std::uint8_t ColourTable::classOf(std::uint8_t y, std::uint8_t cb, std::uint8_t cr) const {
  const std::uint32_t all = boxes_[0][y] & boxes_[1][cb] & boxes_[2][cr];
  return all == 0 ? std::uint8_t{0} : classOfBox_[static_cast<std::size_t>(std::countr_zero(all))];
}

std::vector<std::uint8_t> ColourTable::ofPairs(const std::vector<std::uint8_t>& pairs) const {
  std::vector<std::uint8_t> classes(pairs.size() / 2);
  for (std::size_t i = 0; i + 3 < pairs.size(); i += 4)
    for (const std::size_t y : {i, i + 2}) classes[y / 2] = classOf(pairs[y], pairs[i + 1], pairs[i + 3]);
  return classes;
}

std::vector<std::uint8_t> ColourTable::ofRgb(const std::vector<std::uint8_t>& rgb) const {
  const YcbcrCode code(false);
  std::vector<std::uint8_t> classes(rgb.size() / 3);
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
    const auto colour = code.coded(rgb[i] / 255.0f, rgb[i + 1] / 255.0f, rgb[i + 2] / 255.0f);
    classes[i / 3] = classOf(toByte(colour[0]), toByte(colour[1]), toByte(colour[2]));
  }
  return classes;
}

}  // namespace btr
