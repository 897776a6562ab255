#include "core/sim/contact/solid_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace btr {
namespace {
using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double flat = 0.17;  ///< sine of the tilt below which a face or an edge lies against the other solid

/// Axes across the normal, in which faces are clipped.
struct Plane {
  Vector3d normal, x, y;
  explicit Plane(const Vector3d& n) : normal(n) {
    x = std::abs(n.x()) < 0.6 ? Vector3d::UnitX() : Vector3d::UnitY();
    x = (x - n * n.dot(x)).normalized();
    y = n.cross(x);
  }
  Vector2d across(const Vector3d& p) const { return {x.dot(p), y.dot(p)}; }
  Vector3d at(const Vector2d& p, double height) const { return p.x() * x + p.y() * y + height * normal; }
};

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The part of a solid that faces the other one: a corner, an edge or a face, counter-clockwise; each with its height
/// along the normal.
struct Feature {
  std::vector<Vector2d> points;
  std::vector<double> heights;

  double height(const Vector2d& p) const {
    if (points.size() == 1) return heights[0];
    const Vector2d edge = points[1] - points[0];
    if (points.size() == 2) {
      const double share = std::clamp(edge.dot(p - points[0]) / edge.squaredNorm(), 0.0, 1.0);
      return heights[0] + share * (heights[1] - heights[0]);
    }
    // The plane through the first corner and the two that span most with it.
    std::size_t k = 2;
    double area = 0;
    for (std::size_t i = 2; i < points.size(); ++i)
      if (const double a = std::abs(cross(edge, points[i] - points[0])); a > area) {
        area = a;
        k = i;
      }
    const Vector2d other = points[k] - points[0], d = p - points[0];
    const double along = cross(d, other) / cross(edge, other), aside = cross(edge, d) / cross(edge, other);
    return heights[0] + along * (heights[1] - heights[0]) + aside * (heights[k] - heights[0]);
  }
};

/// The solid's outermost points towards `towards`, in its own frame.
std::vector<Vector3d> outermost(const Collider& solid, const Vector3d& towards) {
  const double radius = solid.size_m.x(), half = solid.size_m.y() / 2;
  switch (solid.kind) {
    case Shape::Kind::sphere:
      return {radius * towards};
    case Shape::Kind::capsule: {
      std::vector<Vector3d> ends;
      for (const double end : {-1.0, 1.0})
        if (end * towards.y() > -flat) ends.emplace_back(Vector3d(0, end * half, 0) + radius * towards);
      return ends;
    }
    case Shape::Kind::cylinder: {
      const double aside = std::hypot(towards.x(), towards.z());
      std::vector<Vector3d> points;
      if (aside < flat) {
        constexpr int corners = 8;
        for (int i = 0; i < corners; ++i) {
          const double angle = 2 * M_PI * i / corners;
          points.emplace_back(radius * std::cos(angle), std::copysign(half, towards.y()), radius * std::sin(angle));
        }
        return points;
      }
      const Vector3d rim(radius * towards.x() / aside, 0, radius * towards.z() / aside);
      for (const double end : {-1.0, 1.0})
        if (end * towards.y() > -flat) points.emplace_back(rim + Vector3d(0, end * half, 0));
      return points;
    }
    case Shape::Kind::box: {
      std::vector<Vector3d> corners;
      for (int corner = 0; corner < 8; ++corner) {
        const Vector3d sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        if ((sign.cwiseProduct(towards).array() > -flat).all()) corners.push_back(sign.cwiseProduct(solid.size_m) / 2);
      }
      return corners;
    }
    case Shape::Kind::mesh:
      break;
  }
  const auto& all = solid.hull->points;
  double highest = -1e30;
  Vector3d top = Vector3d::Zero();
  for (const Vector3d& p : all)
    if (p.dot(towards) > highest) {
      highest = p.dot(towards);
      top = p;
    }
  std::vector<Vector3d> points;
  for (const Vector3d& p : all)
    if (highest - p.dot(towards) <= flat * (p - top).norm()) points.push_back(p);
  return points;
}

/// The convex outline of the points (Andrew's monotone chain), those that lie in it left out.
Feature outline(const Plane& plane, const std::vector<Vector3d>& points) {
  struct Point {
    Vector2d at;
    double height;
  };
  std::vector<Point> sorted;
  for (const Vector3d& p : points) sorted.push_back({plane.across(p), plane.normal.dot(p)});
  std::sort(sorted.begin(), sorted.end(), [](const Point& a, const Point& b) {
    return a.at.x() != b.at.x() ? a.at.x() < b.at.x() : a.at.y() < b.at.y();
  });
  constexpr double same_m = 1e-9;
  std::vector<Point> chain;
  const auto extend = [&](const Point& p, std::size_t kept) {
    while (chain.size() >= kept + 2 &&
           cross(chain.back().at - chain[chain.size() - 2].at, p.at - chain.back().at) <= same_m * same_m)
      chain.pop_back();
    chain.push_back(p);
  };
  for (const Point& p : sorted) extend(p, 0);
  const std::size_t lower = chain.size() - 1;
  for (std::size_t i = sorted.size() - 1; i-- > 0;) extend(sorted[i], lower);
  if (chain.size() > 1) chain.pop_back();
  Feature feature;
  for (const Point& p : chain) {
    if (!feature.points.empty() && (feature.points.back() - p.at).norm() < same_m) continue;
    feature.points.push_back(p.at);
    feature.heights.push_back(p.height);
  }
  return feature;
}

/// Sutherland–Hodgman: what of `subject` (a segment or a polygon) lies within the polygon.
std::vector<Vector2d> clipped(std::vector<Vector2d> subject, const std::vector<Vector2d>& polygon) {
  for (std::size_t i = 0; i < polygon.size() && !subject.empty(); ++i) {
    const Vector2d& from = polygon[i];
    const Vector2d edge = polygon[(i + 1) % polygon.size()] - from;
    std::vector<Vector2d> kept;
    const std::size_t count = subject.size();
    for (std::size_t k = 0; k < count; ++k) {
      const Vector2d &a = subject[k], &b = subject[(k + 1) % count];
      const double sideA = cross(edge, a - from), sideB = cross(edge, b - from);
      if (sideA >= 0) kept.push_back(a);
      const bool closes = count == 2 && k == 1;  // a segment has one side
      if (!closes && (sideA >= 0) != (sideB >= 0)) kept.push_back(a + (b - a) * sideA / (sideA - sideB));
    }
    subject = std::move(kept);
  }
  return subject;
}

/// Where two segments lie side by side: the ends of their common part; nothing where they cross.
std::vector<Vector2d> sideBySide(const Feature& first, const Feature& second) {
  const Vector2d along = (first.points[1] - first.points[0]).normalized();
  if (std::abs(cross(along, (second.points[1] - second.points[0]).normalized())) > flat) return {};
  std::array<double, 2> a{along.dot(first.points[0]), along.dot(first.points[1])},
      b{along.dot(second.points[0]), along.dot(second.points[1])};
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  const double from = std::max(a[0], b[0]), to = std::min(a[1], b[1]);
  if (from >= to) return {};
  const Vector2d start = first.points[0] - along * along.dot(first.points[0]);
  return {start + from * along, start + to * along};
}

std::vector<Vector2d> common(const Feature& first, const Feature& second) {
  if (first.points.size() == 1 || second.points.size() == 1) return {};
  if (first.points.size() == 2 && second.points.size() == 2) return sideBySide(first, second);
  if (second.points.size() == 2) return clipped(second.points, first.points);
  return clipped(first.points, second.points);
}

/// The deepest, and those that are furthest from the ones that are kept already.
void keepFour(std::vector<ContactPoint>& contacts) {
  constexpr std::size_t most = 4;
  if (contacts.size() <= most) return;
  const auto deepest = std::max_element(contacts.begin(), contacts.end(),
                                        [](const auto& a, const auto& b) { return a.depth_m < b.depth_m; });
  std::vector<ContactPoint> kept{*deepest};
  while (kept.size() < most) {
    const ContactPoint* next = nullptr;
    double furthest = -1;
    for (const ContactPoint& contact : contacts) {
      double nearest = 1e30;
      for (const ContactPoint& k : kept) nearest = std::min(nearest, (k.position_m - contact.position_m).norm());
      if (nearest > furthest) {
        furthest = nearest;
        next = &contact;
      }
    }
    kept.push_back(*next);
  }
  contacts = std::move(kept);
}

}  // namespace

struct SolidGeom::Convex {
  std::vector<dReal> points, planes;
  std::vector<unsigned int> polygons;
};

SolidGeom::SolidGeom(const Collider& collider) : collider_(collider) {
  const Vector3d& size = collider.size_m;
  switch (collider.kind) {
    case Shape::Kind::sphere:
      id_ = dCreateSphere(nullptr, size.x());
      break;
    case Shape::Kind::box:
      id_ = dCreateBox(nullptr, size.x(), size.y(), size.z());
      break;
    case Shape::Kind::cylinder:
      id_ = dCreateCylinder(nullptr, size.x(), size.y());
      turn_.rotate(Eigen::AngleAxisd(-M_PI / 2, Vector3d::UnitX()));
      break;
    case Shape::Kind::capsule:
      id_ = dCreateCapsule(nullptr, size.x(), size.y());
      turn_.rotate(Eigen::AngleAxisd(-M_PI / 2, Vector3d::UnitX()));
      break;
    case Shape::Kind::mesh: {
      convex_ = std::make_unique<Convex>();
      Vector3d centre = Vector3d::Zero();
      for (const Vector3d& p : collider.hull->points) centre += p / static_cast<double>(collider.hull->points.size());
      turn_.translation() = centre;
      for (const Vector3d& point : collider.hull->points) {
        const Vector3d p = point - centre;
        convex_->points.insert(convex_->points.end(), {p.x(), p.y(), p.z()});
      }
      for (const Eigen::Vector4d& p : collider.hull->planes)
        convex_->planes.insert(convex_->planes.end(), {p[0], p[1], p[2], p[3] - p.head<3>().dot(centre)});
      for (const auto& face : collider.hull->faces) {
        // Counter-clockwise seen from outside.
        const auto& points = collider.hull->points;
        const auto [a, b, c] = face;
        const Vector3d turn = (points[b] - points[a]).cross(points[c] - points[a]);
        const auto& plane = collider.hull->planes[convex_->polygons.size() / 4];
        const bool outward = turn.dot(plane.head<3>()) > 0;
        for (const int index : {3, a, outward ? b : c, outward ? c : b})
          convex_->polygons.push_back(static_cast<unsigned int>(index));
      }
      id_ = dCreateConvex(nullptr, convex_->planes.data(), static_cast<unsigned int>(convex_->planes.size() / 4),
                          convex_->points.data(), static_cast<unsigned int>(convex_->points.size() / 3),
                          convex_->polygons.data());
      break;
    }
  }
}

SolidGeom::SolidGeom(SolidGeom&& other) noexcept
    : collider_(std::move(other.collider_)),
      pose_(other.pose_),
      turn_(other.turn_),
      convex_(std::move(other.convex_)),
      id_(std::exchange(other.id_, nullptr)) {}

SolidGeom::~SolidGeom() {
  if (id_) dGeomDestroy(id_);
}

void SolidGeom::place(const Isometry3d& body) {
  pose_ = body * collider_.pose;
  const Isometry3d theirs = pose_ * turn_;
  const Eigen::Matrix3d& r = theirs.linear();
  const Vector3d& p = theirs.translation();
  dGeomSetPosition(id_, p.x(), p.y(), p.z());
  const dMatrix3 rotation = {r(0, 0), r(0, 1), r(0, 2), 0, r(1, 0), r(1, 1), r(1, 2), 0, r(2, 0), r(2, 1), r(2, 2), 0};
  dGeomSetRotation(id_, rotation);
}

bool solidContacts(const SolidGeom& first, const SolidGeom& second, std::vector<ContactPoint>& contacts) {
  contacts.clear();
  const double reach = first.collider().bound_m + second.collider().bound_m;
  if ((first.pose().translation() - second.pose().translation()).squaredNorm() > reach * reach) return false;
  constexpr int most = 8;
  std::array<dContactGeom, most> found;
  const int count = dCollide(first.id(), second.id(), most, found.data(), sizeof(dContactGeom));
  if (count <= 0) return false;
  const dContactGeom* deepest = &found[0];
  for (int i = 1; i < count; ++i)
    if (found[static_cast<std::size_t>(i)].depth > deepest->depth) deepest = &found[static_cast<std::size_t>(i)];
  const Vector3d normal(deepest->normal[0], deepest->normal[1], deepest->normal[2]);
  if (!normal.allFinite() || std::abs(normal.norm() - 1) > 1e-3) return false;

  // The lower side of the first against the upper side of the second.
  const Plane plane(normal);
  const auto featureOf = [&](const SolidGeom& solid, const Vector3d& towards) {
    std::vector<Vector3d> points = outermost(solid.collider(), solid.pose().linear().transpose() * towards);
    for (Vector3d& p : points) p = solid.pose() * p;
    return outline(plane, points);
  };
  const Feature lower = featureOf(first, -normal), upper = featureOf(second, normal);
  for (const Vector2d& p : common(lower, upper)) {
    const double top = upper.height(p), depth = top - lower.height(p);
    if (depth > 0) contacts.push_back({plane.at(p, top), normal, depth});
  }
  if (contacts.empty())
    contacts.push_back({{deepest->pos[0], deepest->pos[1], deepest->pos[2]}, normal, deepest->depth});
  keepFour(contacts);
  return true;
}

}  // namespace btr
