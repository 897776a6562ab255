#include "core/camera/stages/truth.h"

#include <cmath>
#include <limits>

namespace btr {
namespace {

void addSeenPixel(SeenObject& seen, int x, int y, float distance_m) {
  if (seen.pixels == 0) {
    seen.left = seen.right = x;
    seen.top = y;
  }
  ++seen.pixels;
  seen.left = std::min(seen.left, x);
  seen.right = std::max(seen.right, x);
  seen.bottom = y;  // rows come in order
  seen.centreX_px += x;
  seen.centreY_px += y;
  seen.distance_m += distance_m;
}

}  // namespace

PictureTruth truthOf(const PinholePicture& picture, const LensMap& lens, int width, int height) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  PictureTruth truth;
  truth.depth_m.assign(pixels, std::numeric_limits<float>::infinity());
  truth.object.assign(pixels, 0);
  std::vector<SeenObject> all;
  std::size_t i = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x, ++i) {
      const std::size_t from = lens.nearest(i);
      if (!picture.depth_m.empty()) truth.depth_m[i] = picture.depth_m[from];
      if (picture.object.empty() || picture.object[from] == 0) continue;
      const std::uint16_t object = truth.object[i] = picture.object[from];
      if (object >= all.size()) all.resize(object + 1u);
      addSeenPixel(all[object], x, y, truth.depth_m[i] * lens.rayLength(i));
    }
  for (std::size_t number = 1; number < all.size(); ++number) {
    SeenObject& seen = all[number];
    if (seen.pixels == 0) continue;
    seen.object = static_cast<std::uint16_t>(number);
    seen.centreX_px /= seen.pixels;
    seen.centreY_px /= seen.pixels;
    seen.distance_m /= seen.pixels;
    truth.seen.push_back(seen);
  }
  return truth;
}

}  // namespace btr
