#include "ui/scene3d/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace btr::ui {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr int kAround = 40;  ///< segments of a circle
constexpr int kUp = 20;      ///< rings of a sphere

double angle(int step, int steps) { return 2 * std::numbers::pi * step / steps; }

unsigned addVertex(TriangleMesh& mesh, const Isometry3d& pose, const Vector3d& position, const Vector3d& normal,
                   const Colour& colour) {
  mesh.positions.push_back((pose * position).cast<float>());
  mesh.normals.push_back((pose.linear() * normal).cast<float>());
  mesh.colours.push_back(colour);
  return static_cast<unsigned>(mesh.positions.size() - 1);
}

Vector3d onSphere(int ring, int segment) {
  const double latitude = std::numbers::pi * (double(ring) / kUp - 0.5);
  return {std::cos(latitude) * std::cos(angle(segment, kAround)),
          std::cos(latitude) * std::sin(angle(segment, kAround)), std::sin(latitude)};
}

/// For each corner of each triangle the area-weighted mean of the neighbouring faces that bend less than 40°.
void addSmoothed(TriangleMesh& mesh, const Shape& shape, const Isometry3d& pose, const Colour& colour) {
  std::vector<Vector3d> faces;
  std::vector<std::vector<int>> around(shape.surface->vertices.size());
  for (const auto& triangle : shape.surface->triangles) {
    const Vector3d a = shape.surface->vertices[triangle[0]].cast<double>(),
                   b = shape.surface->vertices[triangle[1]].cast<double>(),
                   c = shape.surface->vertices[triangle[2]].cast<double>();
    for (int corner : triangle) around[corner].push_back(static_cast<int>(faces.size()));
    faces.push_back((b - a).cross(c - a));
  }
  const double sharpest = std::cos(40 * std::numbers::pi / 180);
  // Corners of one vertex with one normal are shared: a driver shades each of them once.
  std::vector<std::vector<std::pair<Vector3d, unsigned>>> made(shape.surface->vertices.size());
  for (std::size_t face = 0; face < faces.size(); ++face) {
    const Vector3d own = faces[face].normalized();
    for (int corner : shape.surface->triangles[face]) {
      Vector3d sum = Vector3d::Zero();
      for (int other : around[corner])
        if (own.dot(faces[other].normalized()) > sharpest) sum += faces[other];
      const Vector3d normal = sum.squaredNorm() > 0 ? Vector3d(sum.normalized()) : own;
      constexpr double same = 1e-6;
      auto& there = made[static_cast<std::size_t>(corner)];
      const auto found = std::find_if(there.begin(), there.end(), [&](const auto& vertex) {
        return (vertex.first - normal).squaredNorm() < same * same;
      });
      if (found == there.end()) {
        there.emplace_back(normal,
                           addVertex(mesh, pose, shape.surface->vertices[corner].cast<double>(), normal, colour));
        mesh.indices.push_back(there.back().second);
      } else {
        mesh.indices.push_back(found->second);
      }
    }
  }
}

void addMesh(TriangleMesh& mesh, const Shape& shape, const Isometry3d& pose, const Colour& colour) {
  if (!shape.surface) return;
  if (shape.surface->normals.size() != shape.surface->vertices.size()) return addSmoothed(mesh, shape, pose, colour);
  const auto first = static_cast<unsigned>(mesh.positions.size());
  for (std::size_t i = 0; i < shape.surface->vertices.size(); ++i)
    addVertex(mesh, pose, shape.surface->vertices[i].cast<double>(), shape.surface->normals[i].cast<double>(), colour);
  for (const auto& triangle : shape.surface->triangles)
    for (int corner : triangle) mesh.indices.push_back(first + static_cast<unsigned>(corner));
}

void addBoxOutline(LineSegments& lines, const Isometry3d& pose, const Vector3d& low, const Vector3d& high) {
  const auto corner = [&](int bits) {
    return Vector3f(
        (pose * Vector3d(bits & 1 ? high.x() : low.x(), bits & 2 ? high.y() : low.y(), bits & 4 ? high.z() : low.z()))
            .cast<float>());
  };
  for (int bits = 0; bits < 8; ++bits)
    for (int axis : {1, 2, 4})
      if (!(bits & axis)) lines.insert(lines.end(), {corner(bits), corner(bits | axis)});
}

/// A circle about `axis` (0 x, 1 y, 2 z) of the pose, at `offset` along it.
void addCircle(LineSegments& lines, const Isometry3d& pose, int axis, double radius, double offset) {
  const auto point = [&](int step) {
    Vector3d p = Vector3d::Zero();
    p[axis] = offset;
    p[(axis + 1) % 3] = radius * std::cos(angle(step, kAround));
    p[(axis + 2) % 3] = radius * std::sin(angle(step, kAround));
    return Vector3f((pose * p).cast<float>());
  };
  for (int step = 0; step < kAround; ++step) lines.insert(lines.end(), {point(step), point(step + 1)});
}

}  // namespace

void TriangleMesh::addTriangle(const Vector3f& a, const Vector3f& b, const Vector3f& c, const Colour& colour) {
  const Vector3f normal = (b - a).cross(c - a).normalized();
  for (const auto& corner : {a, b, c}) {
    indices.push_back(static_cast<unsigned>(positions.size()));
    positions.push_back(corner);
    normals.push_back(normal);
    colours.push_back(colour);
  }
}

void TriangleMesh::addQuad(const Vector3f& a, const Vector3f& b, const Vector3f& c, const Vector3f& d,
                           const Colour& colour) {
  addTriangle(a, b, c, colour);
  addTriangle(a, c, d, colour);
}

void TriangleMesh::addBox(const Isometry3d& pose, const Vector3d& size_m, const Colour& colour) {
  const Vector3d half = size_m / 2;
  for (int axis = 0; axis < 3; ++axis)
    for (double side : {-1.0, 1.0}) {
      Vector3d normal = Vector3d::Zero(), u = Vector3d::Zero(), v = Vector3d::Zero();
      normal[axis] = side;
      u[(axis + 1) % 3] = half[(axis + 1) % 3];
      v[(axis + 2) % 3] = side * half[(axis + 2) % 3];
      const Vector3d middle = normal * half[axis];
      const unsigned first = addVertex(*this, pose, middle - u - v, normal, colour);
      addVertex(*this, pose, middle + u - v, normal, colour);
      addVertex(*this, pose, middle + u + v, normal, colour);
      addVertex(*this, pose, middle - u + v, normal, colour);
      for (unsigned corner : {0u, 1u, 2u, 0u, 2u, 3u}) indices.push_back(first + corner);
    }
}

void TriangleMesh::addSphere(const Isometry3d& pose, double radius_m, const Colour& colour) {
  const auto first = static_cast<unsigned>(positions.size());
  for (int ring = 0; ring <= kUp; ++ring)
    for (int segment = 0; segment <= kAround; ++segment) {
      const Vector3d normal = onSphere(ring, segment);
      addVertex(*this, pose, radius_m * normal, normal, colour);
    }
  const unsigned row = kAround + 1;
  for (unsigned ring = 0; ring < kUp; ++ring)
    for (unsigned segment = 0; segment < kAround; ++segment) {
      const unsigned a = first + ring * row + segment;
      for (unsigned corner : {a, a + 1, a + row + 1, a, a + row + 1, a + row}) indices.push_back(corner);
    }
}

void TriangleMesh::addCylinder(const Isometry3d& pose, double radius_m, double height_m, const Colour& colour) {
  const Vector3d top(0, height_m / 2, 0);
  for (int step = 0; step < kAround; ++step) {
    const Vector3d n0(std::sin(angle(step, kAround)), 0, std::cos(angle(step, kAround)));
    const Vector3d n1(std::sin(angle(step + 1, kAround)), 0, std::cos(angle(step + 1, kAround)));
    const unsigned first = addVertex(*this, pose, radius_m * n0 - top, n0, colour);
    addVertex(*this, pose, radius_m * n1 - top, n1, colour);
    addVertex(*this, pose, radius_m * n1 + top, n1, colour);
    addVertex(*this, pose, radius_m * n0 + top, n0, colour);
    for (double side : {1.0, -1.0}) {
      const Vector3d up(0, side, 0);
      addVertex(*this, pose, side * top, up, colour);
      addVertex(*this, pose, side * top + radius_m * (side > 0 ? n0 : n1), up, colour);
      addVertex(*this, pose, side * top + radius_m * (side > 0 ? n1 : n0), up, colour);
    }
    for (unsigned corner : {0u, 1u, 2u, 0u, 2u, 3u, 4u, 5u, 6u, 7u, 8u, 9u}) indices.push_back(first + corner);
  }
}

// A sphere whose halves stand apart: one more ring of faces joins them.
void TriangleMesh::addCapsule(const Isometry3d& pose, double radius_m, double length_m, const Colour& colour) {
  const Isometry3d upright = pose * Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3d::UnitX());  // z along its y axis
  const auto first = static_cast<unsigned>(positions.size());
  const unsigned row = kAround + 1, rings = kUp + 1;
  for (unsigned ring = 0; ring <= rings; ++ring) {
    const bool upper = ring > kUp / 2;
    for (int segment = 0; segment <= kAround; ++segment) {
      const Vector3d normal = onSphere(static_cast<int>(upper ? ring - 1 : ring), segment);
      const Vector3d middle(0, 0, (upper ? 0.5 : -0.5) * length_m);
      addVertex(*this, upright, middle + radius_m * normal, normal, colour);
    }
  }
  for (unsigned ring = 0; ring < rings; ++ring)
    for (unsigned segment = 0; segment < kAround; ++segment) {
      const unsigned a = first + ring * row + segment;
      for (unsigned corner : {a, a + 1, a + row + 1, a, a + row + 1, a + row}) indices.push_back(corner);
    }
}

void TriangleMesh::addRing(double inner_m, double outer_m, double z_m, const Colour& colour,
                           const Eigen::Vector2d& centre_m) {
  constexpr int steps = 96;
  const auto point = [&](double radius, int step) {
    return Vector3d(centre_m.x() + radius * std::cos(angle(step, steps)),
                    centre_m.y() + radius * std::sin(angle(step, steps)), z_m)
        .cast<float>()
        .eval();
  };
  for (int step = 0; step < steps; ++step)
    addQuad(point(inner_m, step), point(outer_m, step), point(outer_m, step + 1), point(inner_m, step + 1), colour);
}

void TriangleMesh::addShape(const Shape& shape, const Isometry3d& pose, const Colour& colour) {
  switch (shape.kind) {
    case Shape::Kind::box:
      return addBox(pose, shape.size_m, colour);
    case Shape::Kind::sphere:
      return addSphere(pose, shape.size_m.x(), colour);
    case Shape::Kind::cylinder:
      return addCylinder(pose, shape.size_m.x(), shape.size_m.y(), colour);
    case Shape::Kind::capsule:
      return addCapsule(pose, shape.size_m.x(), shape.size_m.y(), colour);
    case Shape::Kind::mesh:
      return addMesh(*this, shape, pose, colour);
  }
}

TriangleMesh ballMesh(double radius_m) {
  constexpr Colour orange{0.98f, 0.46f, 0.05f, 1.f}, dark{0.80f, 0.27f, 0.02f, 1.f};
  TriangleMesh mesh;
  for (int ring = 0; ring < kUp; ++ring)
    for (int segment = 0; segment < kAround; ++segment) {
      const bool odd = (segment / (kAround / 4) + ring / (kUp / 2)) % 2 == 1;
      const auto first = static_cast<unsigned>(mesh.positions.size());
      for (const auto& normal : {onSphere(ring, segment), onSphere(ring, segment + 1), onSphere(ring + 1, segment + 1),
                                 onSphere(ring + 1, segment)})
        addVertex(mesh, Isometry3d::Identity(), radius_m * normal, normal, odd ? dark : orange);
      for (unsigned corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
    }
  return mesh;
}

void addOutline(LineSegments& lines, const Shape& shape, const Isometry3d& pose) {
  const Vector3d half = shape.size_m / 2;
  switch (shape.kind) {
    case Shape::Kind::box:
      return addBoxOutline(lines, pose, -half, half);
    case Shape::Kind::sphere:
      for (int axis = 0; axis < 3; ++axis) addCircle(lines, pose, axis, shape.size_m.x(), 0);
      return;
    case Shape::Kind::cylinder:
      for (double side : {-1.0, 1.0}) {
        addCircle(lines, pose, 1, shape.size_m.x(), side * half.y());
        for (int axis : {0, 2}) {
          Vector3d rim = Vector3d::Zero();
          rim[axis] = side * shape.size_m.x();
          for (double end : {-half.y(), half.y()}) lines.push_back((pose * (rim + Vector3d(0, end, 0))).cast<float>());
        }
      }
      return;
    case Shape::Kind::capsule:
      for (double side : {-1.0, 1.0}) {
        const Isometry3d end = pose * Eigen::Translation3d(0, side * half.y(), 0);
        for (int axis = 0; axis < 3; ++axis) addCircle(lines, end, axis, shape.size_m.x(), 0);
        for (int axis : {0, 2}) {
          Vector3d rim = Vector3d::Zero();
          rim[axis] = side * shape.size_m.x();
          for (double other : {-half.y(), half.y()})
            lines.push_back((pose * (rim + Vector3d(0, other, 0))).cast<float>());
        }
      }
      return;
    case Shape::Kind::mesh:
      if (!shape.surface || shape.surface->vertices.empty()) return;
      Vector3f low = shape.surface->vertices.front(), high = low;
      for (const auto& vertex : shape.surface->vertices) {
        low = low.cwiseMin(vertex);
        high = high.cwiseMax(vertex);
      }
      return addBoxOutline(lines, pose, low.cast<double>(), high.cast<double>());
  }
}

}  // namespace btr::ui
