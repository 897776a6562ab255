#include "core/camera/stages/lens.h"

#include <algorithm>
#include <cmath>

#include "core/camera/stages/brown.h"
#include "core/spec/error.h"

namespace btr {

LensMap::LensMap(const CameraSpec& spec)
    : width_(spec.width),
      height_(spec.height),
      identity_(!spec[CameraStage::lens].on),
      pinhole_{spec.width, spec.height, spec.focal_px, spec.centreX_px, spec.centreY_px} {
  if (identity_) return;
  solve(spec);
  enclose(spec);
}

// From the optical axis outwards, each pixel from its neighbour: Newton's method stays on the branch that is seen.
void LensMap::solve(const CameraSpec& spec) {
  const BrownTerms terms = brownTerms(spec);
  x_px_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  y_px_.resize(x_px_.size());
  const auto clampedTo = [](double value, int size) {
    return static_cast<int>(std::lround(std::min(std::max(value, 0.0), size - 1.0)));
  };
  const int middleX = clampedTo(spec.centreX_px, width_), middleY = clampedTo(spec.centreY_px, height_);
  using Point = std::array<double, 2>;
  const auto at = [&](int x, int y, const Point& guess) {
    const Point seen{(x - spec.centreX_px) / spec.focal_px, (y - spec.centreY_px) / spec.focal_px};
    const auto ideal = undistorted(terms, seen, guess);
    if (!ideal)
      throw InputError(spec.name + " /stages/lens",
                       "a picture that folds over at pixel " + std::to_string(x) + ", " + std::to_string(y),
                       "terms with which the radius grows all over the sensor");
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    x_px_[pixel] = static_cast<float>(spec.focal_px * (*ideal)[0] + spec.centreX_px);
    y_px_[pixel] = static_cast<float>(spec.focal_px * (*ideal)[1] + spec.centreY_px);
    return *ideal;
  };
  const auto row = [&](int y, const Point& guess) {
    const Point middle = at(middleX, y, guess);
    Point last = middle;
    for (int x = middleX - 1; x >= 0; --x) last = at(x, y, last);
    last = middle;
    for (int x = middleX + 1; x < width_; ++x) last = at(x, y, last);
    return middle;
  };
  const Point first =
      row(middleY, {(middleX - spec.centreX_px) / spec.focal_px, (middleY - spec.centreY_px) / spec.focal_px});
  Point last = first;
  for (int y = middleY - 1; y >= 0; --y) last = row(y, last);
  last = first;
  for (int y = middleY + 1; y < height_; ++y) last = row(y, last);
}

// The picture to render: as wide as the lens looks, and one pixel more for what lies between pixels.
void LensMap::enclose(const CameraSpec& spec) {
  const auto [left, right] = std::minmax_element(x_px_.begin(), x_px_.end());
  const auto [top, bottom] = std::minmax_element(y_px_.begin(), y_px_.end());
  const double fromX = std::floor(*left) - 1, fromY = std::floor(*top) - 1;
  const double width = std::ceil(*right) + 2 - fromX, height = std::ceil(*bottom) + 2 - fromY;
  if (width > 4.0 * width_ || height > 4.0 * height_)
    throw InputError(spec.name + " /stages/lens", "a view more than four times as wide as the sensor",
                     "terms that are smaller");
  pinhole_.width = static_cast<int>(width);
  pinhole_.height = static_cast<int>(height);
  pinhole_.centreX_px -= fromX;
  pinhole_.centreY_px -= fromY;
  for (float& x : x_px_) x -= static_cast<float>(fromX);
  for (float& y : y_px_) y -= static_cast<float>(fromY);
}

void LensMap::addRow(const std::vector<float>& rgb, int y, float weight, float* row) const {
  const std::size_t first = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
  const std::size_t count = static_cast<std::size_t>(width_);
  if (identity_) {
    const float* from = rgb.data() + 3 * first;
    for (std::size_t i = 0; i < 3 * count; ++i) row[i] += weight * from[i];
    return;
  }
  const std::size_t stride = 3 * static_cast<std::size_t>(pinhole_.width);
  for (std::size_t i = 0; i < count; ++i) {
    const float px = x_px_[first + i], py = y_px_[first + i];
    const int ix = static_cast<int>(px), iy = static_cast<int>(py);  // both are at least 1
    const float u = px - static_cast<float>(ix), v = py - static_cast<float>(iy);
    const float* upper = rgb.data() + static_cast<std::size_t>(iy) * stride + 3 * static_cast<std::size_t>(ix);
    const float* lower = upper + stride;
    for (std::size_t c = 0; c < 3; ++c) {
      const float above = upper[c] + u * (upper[c + 3] - upper[c]);
      const float below = lower[c] + u * (lower[c + 3] - lower[c]);
      row[3 * i + c] += weight * (above + v * (below - above));
    }
  }
}

PictureRows LensMap::rowsFor(int y) const {
  if (identity_) return {y, y};
  const auto row = y_px_.begin() + static_cast<std::ptrdiff_t>(y) * width_;
  const auto [top, bottom] = std::minmax_element(row, row + width_);
  return {static_cast<int>(*top), static_cast<int>(*bottom) + 1};
}

std::size_t LensMap::nearest(std::size_t pixel) const {
  if (identity_) return pixel;
  const auto x = static_cast<std::size_t>(x_px_[pixel] + 0.5f), y = static_cast<std::size_t>(y_px_[pixel] + 0.5f);
  return y * static_cast<std::size_t>(pinhole_.width) + x;
}

float LensMap::rayLength(std::size_t pixel) const {
  const std::size_t width = static_cast<std::size_t>(width_);
  const double x = identity_ ? static_cast<double>(pixel % width) : x_px_[pixel];
  const double y = identity_ ? static_cast<double>(pixel / width) : y_px_[pixel];
  const double right = (x - pinhole_.centreX_px) / pinhole_.focal_px;
  const double down = (y - pinhole_.centreY_px) / pinhole_.focal_px;
  return static_cast<float>(std::sqrt(1 + right * right + down * down));
}

}  // namespace btr
