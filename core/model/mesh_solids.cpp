// Boxes, spheres, cones, cylinders and extrusions as polygons.
#include <cmath>

#include "core/model/mesh.h"

namespace btr::vrml {
namespace {

using Eigen::Vector3f;
constexpr int slices = 24;
constexpr double pi = 3.14159265358979323846;

/// The frame of an extrusion's cross section at a point of the spine: columns x, y (along the spine), z.
using Frames = std::vector<Eigen::Matrix3f>;

Frames spineFrames(const std::vector<Vector3f>& spine) {
  const std::size_t n = spine.size();
  const bool closed = n > 2 && spine.front() == spine.back();
  std::vector<Vector3f> ys(n, Vector3f::Zero()), zs(n, Vector3f::Zero());
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3f& before = i > 0 ? spine[i - 1] : closed ? spine[n - 2] : spine[0];
    const Vector3f& after = i + 1 < n ? spine[i + 1] : closed ? spine[1] : spine[n - 1];
    ys[i] = after - before;
    if (i > 0 || closed)
      if (i + 1 < n || closed) zs[i] = (after - spine[i]).cross(before - spine[i]);
  }

  // Where neighbours coincide or lie in line, the direction of the neighbour before holds, else that of the next one.
  const auto fill = [n](std::vector<Vector3f>& directions) {
    bool any = false;
    for (std::size_t i = 0; i < n; ++i) {
      if (directions[i].norm() > 1e-9f && directions[i].allFinite())
        directions[i].normalize(), any = true;
      else
        directions[i] = i > 0 && any ? directions[i - 1] : Vector3f::Zero();
    }
    for (std::size_t i = n; any && i-- > 0;)
      if (directions[i].isZero()) directions[i] = directions[i + 1];
    return any;
  };
  if (!fill(ys)) ys.assign(n, Vector3f::UnitY());
  if (!fill(zs)) {
    // A straight spine: the shortest rotation from the y axis.
    const Eigen::Quaternionf turn = Eigen::Quaternionf::FromTwoVectors(Vector3f::UnitY(), ys[0]);
    zs.assign(n, turn * Vector3f::UnitZ());
  }

  Frames frames(n);
  for (std::size_t i = 0; i < n; ++i) {
    // The side does not jump over from one point to the next.
    if (i > 0 && zs[i].dot(zs[i - 1]) < 0) zs[i] = -zs[i];
    Vector3f x = ys[i].cross(zs[i]);
    x = x.norm() > 1e-6f ? x.normalized() : ys[i].unitOrthogonal();
    frames[i] << x, ys[i], x.cross(ys[i]);
  }
  return frames;
}

}  // namespace

Polygons boxPolygons(const Eigen::Vector3d& size) {
  Polygons box;
  const Vector3f h = (size / 2).cast<float>();
  for (int i = 0; i < 8; ++i)
    box.points.push_back({i & 1 ? h.x() : -h.x(), i & 2 ? h.y() : -h.y(), i & 4 ? h.z() : -h.z()});
  box.addFace({0, 2, 3, 1});
  box.addFace({4, 5, 7, 6});
  box.addFace({0, 1, 5, 4});
  box.addFace({2, 6, 7, 3});
  box.addFace({0, 4, 6, 2});
  box.addFace({1, 3, 7, 5});
  return box;
}

Polygons spherePolygons(double radius) {
  Polygons sphere;
  sphere.creaseAngle = 4;
  constexpr int rings = slices / 2;
  for (int ring = 0; ring <= rings; ++ring)
    for (int slice = 0; slice < slices; ++slice) {
      const double down = pi * ring / rings, round = 2 * pi * slice / slices;
      sphere.points.push_back(Eigen::Vector3d(radius * std::sin(down) * std::sin(round), radius * std::cos(down),
                                              radius * std::sin(down) * std::cos(round))
                                  .cast<float>());
    }
  for (int ring = 0; ring < rings; ++ring)
    for (int slice = 0; slice < slices; ++slice) {
      const int next = (slice + 1) % slices, upper = ring * slices, lower = upper + slices;
      sphere.addFace({upper + slice, lower + slice, lower + next, upper + next});
    }
  return sphere;
}

Polygons conePolygons(double bottomRadius, double topRadius, double height, bool side, bool bottom, bool top) {
  Polygons cone;
  cone.creaseAngle = 0.6f;
  for (const double y : {-height / 2, height / 2})
    for (int slice = 0; slice < slices; ++slice) {
      const double radius = y < 0 ? bottomRadius : topRadius, round = 2 * pi * slice / slices;
      cone.points.push_back(Eigen::Vector3d(radius * std::sin(round), y, radius * std::cos(round)).cast<float>());
    }
  for (int slice = 0; side && slice < slices; ++slice) {
    const int next = (slice + 1) % slices;
    cone.addFace({slice, next, slices + next, slices + slice});
  }
  for (int slice = slices; bottom && slice-- > 0;) cone.corners.push_back(slice);
  if (bottom) cone.endFace();
  for (int slice = 0; top && slice < slices; ++slice) cone.corners.push_back(slices + slice);
  if (top) cone.endFace();
  return cone;
}

Polygons extrude(const ExtrusionData& data) {
  Polygons result;
  const std::size_t n = data.spine.size(), m = data.crossSection.size();
  if (n < 2 || m < 2) return result;
  const Frames frames = spineFrames(data.spine);
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2f scale = data.scale.empty() ? Eigen::Vector2f(1, 1) : data.scale[i % data.scale.size()];
    const Eigen::Quaternionf turn =
        data.orientation.empty() ? Eigen::Quaternionf::Identity() : data.orientation[i % data.orientation.size()];
    for (const Eigen::Vector2f& point : data.crossSection)
      result.points.push_back(data.spine[i] +
                              frames[i] * (turn * Vector3f(point.x() * scale.x(), 0, point.y() * scale.y())));
  }
  const auto index = [m](std::size_t i, std::size_t j) { return static_cast<std::int32_t>(i * m + j); };
  for (std::size_t i = 0; i + 1 < n; ++i)
    for (std::size_t j = 0; j + 1 < m; ++j)
      result.addFace({index(i, j), index(i, j + 1), index(i + 1, j + 1), index(i + 1, j)});

  // Caps: the first point of a closed cross section is not repeated.
  const std::size_t ring = data.crossSection.front() == data.crossSection.back() ? m - 1 : m;
  if (data.beginCap && ring > 2) {
    for (std::size_t j = ring; j-- > 0;) result.corners.push_back(index(0, j));
    result.endFace();
  }
  if (data.endCap && ring > 2) {
    for (std::size_t j = 0; j < ring; ++j) result.corners.push_back(index(n - 1, j));
    result.endFace();
  }
  return result;
}

}  // namespace btr::vrml
