#include "ui/charts/decimate.h"

#include <algorithm>
#include <cmath>

#include "core/spec/thinning.h"

namespace btr::ui {

std::vector<QPointF> decimate(const std::vector<QPointF>& points, double from, double to, int columns) {
  if (columns < 1 || !(to > from)) return points;
  const auto xLess = [](const QPointF& point, double x) { return point.x() < x; };
  const auto lessX = [](double x, const QPointF& point) { return x < point.x(); };
  auto first = std::lower_bound(points.begin(), points.end(), from, xLess);
  auto last = std::upper_bound(first, points.end(), to, lessX);

  // The neighbours outside keep the line running through the border.
  if (first != points.begin()) --first;
  if (last != points.end()) ++last;
  if (last - first <= 2 * columns) return {first, last};

  const auto at = [&](std::size_t i) { return *(first + static_cast<std::ptrdiff_t>(i)); };
  const auto column = [&](std::size_t i) {
    const double place = (at(i).x() - from) / (to - from) * columns;
    return static_cast<int>(std::floor(std::clamp(place, -1.0, columns + 1.0)));
  };
  std::vector<QPointF> kept;
  thin(
      0, static_cast<std::size_t>(last - first), column, [&](std::size_t i) { return at(i).y(); },
      [&](std::size_t i) { kept.push_back(at(i)); });
  return kept;
}

}  // namespace btr::ui
