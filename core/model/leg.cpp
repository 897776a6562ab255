#include "core/model/leg.h"

#include <algorithm>
#include <cmath>

namespace btr {
namespace {
using Eigen::Vector3d;

Vector3d turnY(double angle, const Vector3d& v) {
  return {v.x() * std::cos(angle) + v.z() * std::sin(angle), v.y(), v.z() * std::cos(angle) - v.x() * std::sin(angle)};
}

Vector3d turnX(double angle, const Vector3d& v) {
  return {v.x(), v.y() * std::cos(angle) - v.z() * std::sin(angle), v.y() * std::sin(angle) + v.z() * std::cos(angle)};
}

/// The angle that differs from `angle` by whole turns and breaks its limits least; of several the one nearest to
/// `last`.
double turnedNear(double angle, double last, double lower, double upper) {
  const double nearest = last + std::remainder(angle - last, 2 * M_PI);
  double best = nearest;
  const auto excess = [&](double a) { return std::max({lower - a, a - upper, 0.0}); };
  for (const double other : {nearest - 2 * M_PI, nearest + 2 * M_PI})
    if (excess(other) < excess(best)) best = other;
  return best;
}

/// Both roots of a·sin t + b·cos t = c for joint j.
std::array<double, 2> roots(double a, double b, double c, std::size_t j, const LegAngles& last, const LegLimits& limits,
                            bool& reached) {
  const double most = std::hypot(a, b);
  if (std::abs(c) > most) reached = false;
  const double middle = std::atan2(a, b), away = most > 0 ? std::acos(std::clamp(c / most, -1.0, 1.0)) : 0;
  return {turnedNear(middle + away, last[j], limits.lower[j], limits.upper[j]),
          turnedNear(middle - away, last[j], limits.lower[j], limits.upper[j])};
}

double squared(double x) { return x * x; }

/// How far angles lie outside the limits, squared.
double excess(const LegAngles& angles, const LegLimits& limits) {
  double sum = 0;
  for (std::size_t j = 0; j < 3; ++j)
    sum += squared(std::max({limits.lower[j] - angles[j], angles[j] - limits.upper[j], 0.0}));
  return sum;
}

double distance(const LegAngles& a, const LegAngles& b) {
  return squared(a[0] - b[0]) + squared(a[1] - b[1]) + squared(a[2] - b[2]);
}

}  // namespace

bool LegLimits::allow(const LegAngles& angles) const { return excess(angles, *this) == 0; }

Vector3d LegGeometry::foot(const LegAngles& a) const {
  return turnY(-side * a[0], turnX(a[1], knee + turnY(-side * a[2], shank)));
}

LegSolution LegGeometry::solve(const Vector3d& p, const LegAngles& last, const LegLimits& limits) const {
  // The distance from hip to foot gives the knee, the distance from the plane of J1 gives J2, what is left J1.
  const double k = (p.squaredNorm() - knee.squaredNorm() - shank.squaredNorm()) / 2 - knee.y() * shank.y();
  const double a = -side * (knee.x() * shank.z() - knee.z() * shank.x());
  const double b = knee.x() * shank.x() + knee.z() * shank.z();
  LegSolution best;
  double leastExcess = 0, leastDistance = 0;
  bool none = true;
  bool kneeReached = true;
  for (const double t3 : roots(a, b, k, 2, last, limits, kneeReached)) {
    const Vector3d q = knee + turnY(-side * t3, shank);
    bool reached = kneeReached;
    for (const double t2 : roots(-q.z(), q.y(), p.y(), 1, last, limits, reached)) {
      const Vector3d w = turnX(t2, q);
      const double t1 = turnedNear(side * (std::atan2(p.x(), -p.z()) - std::atan2(w.x(), -w.z())), last[0],
                                   limits.lower[0], limits.upper[0]);
      const LegAngles angles{t1, t2, t3};
      const double e = excess(angles, limits), d = distance(angles, last);
      // First those within reach, then those that break the limits least, then the nearest.
      const bool better = reached != best.reached ? reached : e != leastExcess ? e < leastExcess : d < leastDistance;
      if (!none && !better) continue;
      none = false;
      best = {angles, reached, e == 0};
      leastExcess = e;
      leastDistance = d;
    }
  }
  for (std::size_t j = 0; j < 3; ++j) best.angles[j] = std::clamp(best.angles[j], limits.lower[j], limits.upper[j]);
  return best;
}

}  // namespace btr
