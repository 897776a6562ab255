#include "ui/charts/decimate.h"

#include <algorithm>
#include <array>
#include <cmath>

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

  const auto column = [&](const QPointF& point) {
    const double place = (point.x() - from) / (to - from) * columns;
    return static_cast<int>(std::floor(std::clamp(place, -1.0, columns + 1.0)));
  };
  std::vector<QPointF> kept;
  while (first != last) {
    const int here = column(*first);
    const auto end = std::find_if(first, last, [&](const QPointF& point) { return column(point) != here; });
    const auto [low, high] = std::minmax_element(first, end, [](auto& a, auto& b) { return a.y() < b.y(); });
    std::array picks{first, low, high, end - 1};
    std::sort(picks.begin(), picks.end());
    const auto distinct = std::unique(picks.begin(), picks.end());
    for (auto pick = picks.begin(); pick != distinct; ++pick) kept.push_back(**pick);
    first = end;
  }
  return kept;
}

}  // namespace btr::ui
