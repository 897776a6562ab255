#include "core/sim/contact/collision.h"

#include <algorithm>
#include <cmath>

namespace btr {
namespace {
using Eigen::Isometry3d;
using Eigen::Vector3d;

// Directions of a sphere that was divided once from an icosahedron: its 12 corners and 30 edge middles.
std::vector<Vector3d> directions() {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vector3d> corners;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-golden, golden}) {
      corners.emplace_back(0, a, b);
      corners.emplace_back(a, b, 0);
      corners.emplace_back(b, 0, a);
    }
  std::vector<Vector3d> result;
  for (const auto& corner : corners) result.push_back(corner.normalized());
  for (std::size_t i = 0; i < corners.size(); ++i)
    for (std::size_t j = i + 1; j < corners.size(); ++j)
      if ((corners[i] - corners[j]).norm() < 2.01) result.push_back((corners[i] + corners[j]).normalized());
  return result;
}

Vector3d closestOnTriangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  // Voronoi regions of the corners, the edges, then the face.
  const Vector3d ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const Vector3d bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const Vector3d cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const double sum = va + vb + vc;
  return a + ab * (vb / sum) + ac * (vc / sum);
}

void add(std::vector<ContactPoint>& contacts, double margin, const Vector3d& point) {
  if (point.z() < margin) contacts.push_back({point, Vector3d::UnitZ(), -point.z()});
}

// On its side a cylinder touches along a line (the lowest point of each rim), upright on four points of its lower rim.
void cylinderOnFloor(const Isometry3d& pose, double radius, double half, double margin,
                     std::vector<ContactPoint>& contacts) {
  const Vector3d axis = pose.linear().col(1);
  Vector3d down = Vector3d(0, 0, -1) + axis.z() * axis;
  const bool upright = down.norm() < 1e-3;
  if (!upright) down *= radius / down.norm();
  if (upright) down = radius * pose.linear().col(0);
  const Vector3d side = axis.cross(down);
  for (const double end : {-half, half}) {
    const Vector3d cap = pose.translation() + end * axis;
    add(contacts, margin, cap + down);
    if (end * axis.z() > 0) continue;
    add(contacts, margin, cap + side);
    add(contacts, margin, cap - side);
    if (upright) add(contacts, margin, cap - down);
  }
}

// Outside: closest point of the body; inside: the way out through the nearest face. All in the shape's own frame.
struct Nearest {
  Vector3d point = Vector3d::Zero(), normal = Vector3d::UnitZ();
  double distance = 0;  // negative inside
};

Nearest nearestOutside(const Vector3d& centre, const Vector3d& point) {
  const double distance = (centre - point).norm();
  return {point, (centre - point) / distance, distance};
}

Nearest nearestOnBox(const Vector3d& half, const Vector3d& c) {
  const Vector3d clamped = c.cwiseMax(-half).cwiseMin(half);
  if ((clamped - c).squaredNorm() > 1e-24) return nearestOutside(c, clamped);
  int face = 0;
  const Vector3d room = half - c.cwiseAbs();
  room.minCoeff(&face);
  Nearest result;
  result.normal = Vector3d::Zero();
  result.normal[face] = c[face] < 0 ? -1 : 1;
  result.distance = -room[face];
  result.point = c + result.normal * room[face];
  return result;
}

Nearest nearestOnCylinder(double radius, double half, const Vector3d& c) {
  const double away = std::hypot(c.x(), c.z());
  const double scale = away > radius ? radius / away : 1;
  const Vector3d clamped(c.x() * scale, std::clamp(c.y(), -half, half), c.z() * scale);
  if ((clamped - c).squaredNorm() > 1e-24) return nearestOutside(c, clamped);
  const double toSide = radius - away, toCap = half - std::abs(c.y());
  Nearest result;
  if (toCap < toSide)
    result.normal = {0, c.y() < 0 ? -1.0 : 1.0, 0};
  else
    result.normal = away > 1e-12 ? Vector3d(c.x() / away, 0, c.z() / away) : Vector3d::UnitX();
  result.distance = -std::min(toSide, toCap);
  result.point = c - result.normal * result.distance;
  return result;
}

Nearest nearestOnHull(const Hull& hull, const Vector3d& c) {
  double deepest = -1e30;
  Nearest result;
  for (const auto& plane : hull.planes) {
    const double distance = plane.head<3>().dot(c) - plane[3];
    if (distance > deepest) {
      deepest = distance;
      result = {c - distance * plane.head<3>(), plane.head<3>(), distance};
    }
  }
  if (deepest <= 1e-9) return result;
  double best = 1e30;
  for (const auto& face : hull.faces) {
    const Vector3d point = closestOnTriangle(c, hull.points[face[0]], hull.points[face[1]], hull.points[face[2]]);
    if (const double distance = (point - c).squaredNorm(); distance < best) {
      best = distance;
      result = nearestOutside(c, point);
    }
  }
  return result;
}

Nearest nearestOnCapsule(double radius, double half, const Vector3d& c) {
  const Vector3d middle(0, std::clamp(c.y(), -half, half), 0);
  const double away = (c - middle).norm();
  Nearest result;
  result.normal = away > 1e-12 ? Vector3d((c - middle) / away) : Vector3d(Vector3d::UnitX());
  result.point = middle + radius * result.normal;
  result.distance = away - radius;
  return result;
}

/// `c` in the collider's frame.
Nearest nearestOn(const Collider& collider, const Vector3d& c) {
  const double half = collider.size_m.y() / 2;
  if (collider.kind == Shape::Kind::box) return nearestOnBox(collider.size_m / 2, c);
  if (collider.kind == Shape::Kind::cylinder) return nearestOnCylinder(collider.size_m.x(), half, c);
  if (collider.kind == Shape::Kind::capsule) return nearestOnCapsule(collider.size_m.x(), half, c);
  return nearestOnHull(*collider.hull, c);
}

}  // namespace

std::shared_ptr<const Hull> convexHull(const std::vector<Eigen::Vector3f>& vertices) {
  auto hull = std::make_shared<Hull>();
  if (vertices.empty()) return hull;
  // The outermost vertex of each direction, each vertex once.
  std::vector<std::size_t> chosen;
  for (const auto& direction : directions()) {
    std::size_t best = 0;
    double furthest = -1e30;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (const double along = vertices[i].cast<double>().dot(direction); along > furthest + 1e-9) {
        furthest = along;
        best = i;
      }
    if (std::find(chosen.begin(), chosen.end(), best) == chosen.end()) chosen.push_back(best);
  }
  for (const auto i : chosen) hull->points.push_back(vertices[i].cast<double>());
  double extent = 0;
  for (const auto& point : hull->points) extent = std::max(extent, (point - hull->points[0]).norm());

  // Few points: every triple whose plane has all points on one side is a face (coplanar faces may overlap, which is
  // harmless).
  const auto& p = hull->points;
  const int count = static_cast<int>(p.size());
  for (int i = 0; i < count; ++i)
    for (int j = i + 1; j < count; ++j)
      for (int k = j + 1; k < count; ++k) {
        Vector3d normal = (p[j] - p[i]).cross(p[k] - p[i]);
        if (normal.norm() < 1e-10 * extent * extent) continue;
        normal.normalize();
        double above = 0, below = 0;
        for (const auto& point : p) {
          const double side = normal.dot(point - p[i]);
          above = std::max(above, side);
          below = std::max(below, -side);
        }
        if (std::min(above, below) > 1e-7 * extent) continue;
        if (above > below) normal = -normal;
        hull->faces.push_back({i, j, k});
        hull->planes.emplace_back(normal.x(), normal.y(), normal.z(), normal.dot(p[i]));
      }
  return hull;
}

bool collidesIn(const RobotModel& model, const Link& link, const Shape& which, const std::string& collision) {
  if (!which.collides || collision == "none") return false;
  if (!model.meshesReplacePrimitives) return true;
  bool hasMesh = false, hasPrimitive = false;
  for (const Shape& shape : link.shapes)
    if (shape.collides) (shape.kind == Shape::Kind::mesh ? hasMesh : hasPrimitive) = true;
  return (which.kind == Shape::Kind::mesh) == (hasMesh && (collision == "mesh" || !hasPrimitive));
}

Collider makeCollider(const Shape& shape, const Isometry3d& linkInBody, int link) {
  Collider collider{shape.kind, linkInBody * shape.pose, shape.size_m, 0, shape.hull, link};
  if (shape.kind == Shape::Kind::mesh && !collider.hull) collider.hull = convexHull(shape.surface->vertices);
  switch (shape.kind) {
    case Shape::Kind::sphere:
      collider.bound_m = shape.size_m.x();
      break;
    case Shape::Kind::box:
      collider.bound_m = shape.size_m.norm() / 2;
      break;
    case Shape::Kind::cylinder:
      collider.bound_m = std::hypot(shape.size_m.x(), shape.size_m.y() / 2);
      break;
    case Shape::Kind::capsule:
      collider.bound_m = shape.size_m.x() + shape.size_m.y() / 2;
      break;
    case Shape::Kind::mesh:
      for (const auto& point : collider.hull->points) collider.bound_m = std::max(collider.bound_m, point.norm());
      break;
  }
  return collider;
}

void floorContacts(const Collider& collider, const Isometry3d& body, double margin,
                   std::vector<ContactPoint>& contacts) {
  contacts.clear();
  const Vector3d centre = body * collider.pose.translation();
  if (centre.z() >= collider.bound_m + margin) return;
  if (collider.kind == Shape::Kind::sphere) return add(contacts, margin, centre - Vector3d(0, 0, collider.size_m.x()));
  const Isometry3d pose = body * collider.pose;
  switch (collider.kind) {
    case Shape::Kind::box: {
      const Vector3d half = collider.size_m / 2;
      for (int corner = 0; corner < 8; ++corner)
        add(contacts, margin,
            pose * Vector3d(corner & 1 ? half.x() : -half.x(), corner & 2 ? half.y() : -half.y(),
                            corner & 4 ? half.z() : -half.z()));
      break;
    }
    case Shape::Kind::cylinder:
      cylinderOnFloor(pose, collider.size_m.x(), collider.size_m.y() / 2, margin, contacts);
      break;
    case Shape::Kind::capsule:
      for (const double end : {-0.5, 0.5})
        add(contacts, margin, pose * Vector3d(0, end * collider.size_m.y(), 0) - Vector3d(0, 0, collider.size_m.x()));
      break;
    default: {
      for (const auto& point : collider.hull->points) add(contacts, margin, pose * point);
      // The deepest few carry the load; more would only make the solver slower.
      constexpr std::size_t most = 6;
      if (contacts.size() > most) {
        std::stable_sort(contacts.begin(), contacts.end(),
                         [](const auto& a, const auto& b) { return a.depth_m > b.depth_m; });
        contacts.resize(most);
      }
    }
  }
}

bool sphereContact(const Collider& collider, const Isometry3d& body, const Vector3d& centre, double radius,
                   double margin, ContactPoint& contact) {
  const Vector3d middle = body * collider.pose.translation();
  const double reach = collider.bound_m + radius;
  if ((centre - middle).squaredNorm() >= (reach + margin) * (reach + margin)) return false;
  if (collider.kind == Shape::Kind::sphere) {
    const double distance = (centre - middle).norm();
    contact.normal = distance > 1e-12 ? Vector3d((centre - middle) / distance) : Vector3d::UnitZ();
    contact.depth_m = reach - distance;
    contact.position_m = centre - contact.normal * radius;
    return true;
  }
  const Isometry3d pose = body * collider.pose;
  const Vector3d local = pose.inverse() * centre;
  const Nearest nearest = nearestOn(collider, local);
  if (nearest.distance >= radius + margin) return false;
  contact.normal = pose.linear() * nearest.normal;
  contact.depth_m = radius - nearest.distance;
  contact.position_m = centre - contact.normal * radius;
  return true;
}

}  // namespace btr
