#include "core/camera/stages/brown.h"

#include <cmath>

namespace btr {

BrownTerms brownTerms(const CameraSpec& spec) {
  if (!spec[CameraStage::lens].on) return {};
  const auto term = [&](const char* name) { return spec.number(CameraStage::lens, name); };
  return {term("k1"), term("k2"), term("k3"), term("p1"), term("p2")};
}

std::array<double, 2> distorted(const BrownTerms& t, double x, double y) {
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (t.k1 + r2 * (t.k2 + r2 * t.k3));
  return {x * radial + 2 * t.p1 * x * y + t.p2 * (r2 + 2 * x * x),
          y * radial + t.p1 * (r2 + 2 * y * y) + 2 * t.p2 * x * y};
}

std::optional<std::array<double, 2>> undistorted(const BrownTerms& t, std::array<double, 2> seen,
                                                 std::array<double, 2> guess) {
  constexpr int mostSteps = 20;
  constexpr double near = 1e-10;  // focal lengths
  double x = guess[0], y = guess[1];
  for (int step = 0; step < mostSteps; ++step) {
    const auto there = distorted(t, x, y);
    const double ex = seen[0] - there[0], ey = seen[1] - there[1];
    const double r2 = x * x + y * y;
    const double radial = 1 + r2 * (t.k1 + r2 * (t.k2 + r2 * t.k3));
    const double slope = t.k1 + r2 * (2 * t.k2 + r2 * 3 * t.k3);  // of `radial` along r2
    const double xx = radial + 2 * x * x * slope + 2 * t.p1 * y + 6 * t.p2 * x;
    const double yy = radial + 2 * y * y * slope + 6 * t.p1 * y + 2 * t.p2 * x;
    const double xy = 2 * x * y * slope + 2 * t.p1 * x + 2 * t.p2 * y;
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > 0) || !(xx > 0)) return {};
    if (std::abs(ex) < near && std::abs(ey) < near) return std::array<double, 2>{x, y};
    x += (yy * ex - xy * ey) / determinant;
    y += (xx * ey - xy * ex) / determinant;
  }
  return {};
}

}  // namespace btr
