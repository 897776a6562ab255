#include "core/sim/contact/ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace btr {
namespace {
using Eigen::Vector3d;

/// The part of a ray p + t·d that lies in a convex solid, as far as it is known.
struct RaySpan {
  double from = 0, to = std::numeric_limits<double>::infinity();

  bool isEmpty() const { return from > to; }
  void clear() { from = 1, to = 0; }
  /// Only where n·x ≤ offset.
  void cut(double along, double outside) {
    if (along == 0) {
      if (outside > 0) clear();
    } else if (along > 0) {
      to = std::min(to, -outside / along);
    } else {
      from = std::max(from, -outside / along);
    }
  }
  /// Only where a·t² + 2·b·t + c ≤ 0, a ≥ 0.
  void cutRound(double a, double b, double c) {
    const double root = b * b - a * c;
    if (a < 1e-24) {
      if (c > 0) clear();
    } else if (root < 0) {
      clear();
    } else {
      from = std::max(from, (-b - std::sqrt(root)) / a);
      to = std::min(to, (-b + std::sqrt(root)) / a);
    }
  }
  std::optional<double> begin() const { return isEmpty() ? std::nullopt : std::optional(from); }
};

void cutAcross(RaySpan& span, double origin, double direction, double half) {
  span.cut(direction, origin - half);
  span.cut(-direction, -origin - half);
}

std::optional<double> raySphere(const Vector3d& p, const Vector3d& d, double radius) {
  RaySpan span;
  span.cutRound(1, p.dot(d), p.squaredNorm() - radius * radius);
  return span.begin();
}

/// Along y, without its caps where it is a capsule.
std::optional<double> rayTube(const Vector3d& p, const Vector3d& d, double radius, double half) {
  RaySpan span;
  span.cutRound(d.x() * d.x() + d.z() * d.z(), p.x() * d.x() + p.z() * d.z(),
                p.x() * p.x() + p.z() * p.z() - radius * radius);
  cutAcross(span, p.y(), d.y(), half);
  return span.begin();
}

std::optional<double> leastOf(std::initializer_list<std::optional<double>> all) {
  std::optional<double> least;
  for (const auto& each : all)
    if (each && (!least || *each < *least)) least = each;
  return least;
}

}  // namespace

std::optional<double> rayDistance(const Collider& collider, const Eigen::Isometry3d& solid, const Vector3d& origin,
                                  const Vector3d& direction) {
  const Vector3d p = solid.linear().transpose() * (origin - solid.translation());
  const Vector3d d = solid.linear().transpose() * direction;
  const Vector3d& size = collider.size_m;
  switch (collider.kind) {
    case Shape::Kind::sphere:
      return raySphere(p, d, size.x());
    case Shape::Kind::box: {
      RaySpan span;
      for (int axis = 0; axis < 3; ++axis) cutAcross(span, p[axis], d[axis], size[axis] / 2);
      return span.begin();
    }
    case Shape::Kind::cylinder:
      return rayTube(p, d, size.x(), size.y() / 2);
    case Shape::Kind::capsule: {
      const Vector3d end(0, size.y() / 2, 0);
      return leastOf(
          {rayTube(p, d, size.x(), end.y()), raySphere(p - end, d, size.x()), raySphere(p + end, d, size.x())});
    }
    case Shape::Kind::mesh:
      break;
  }
  if (!collider.hull) return std::nullopt;
  RaySpan span;
  for (const Eigen::Vector4d& plane : collider.hull->planes)
    span.cut(plane.head<3>().dot(d), plane.head<3>().dot(p) - plane.w());
  return span.begin();
}

}  // namespace btr
