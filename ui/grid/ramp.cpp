#include "ui/grid/ramp.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace btr::ui {

QColor rampColour(double share) {
  static constexpr std::array stops{0x2d3a70, 0x2f6f8f, 0x35a080, 0x8cc653, 0xf5e04b};
  const double place = std::clamp(std::isfinite(share) ? share : 0.0, 0.0, 1.0) * (stops.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const QColor a(static_cast<QRgb>(stops[lower])), b(static_cast<QRgb>(stops[lower + 1]));
  const double t = place - static_cast<double>(lower);
  const auto mix = [&](int from, int to) { return static_cast<int>(std::lround(from + (to - from) * t)); };
  return {mix(a.red(), b.red()), mix(a.green(), b.green()), mix(a.blue(), b.blue())};
}

QColor textOn(const QColor& colour) {
  return 0.299 * colour.red() + 0.587 * colour.green() + 0.114 * colour.blue() > 140 ? Qt::black : Qt::white;
}

}  // namespace btr::ui
