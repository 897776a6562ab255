#include "core/model/mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>

namespace btr::vrml {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector3f;

/// A triangle by positions in Polygons::corners.
using Cut = std::array<std::size_t, 3>;

/// Newell's normal of a polygon: its length is twice the area.
Vector3d newell(const std::vector<Vector3d>& ring) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < ring.size(); ++i) sum += ring[i].cross(ring[(i + 1) % ring.size()]);
  return sum;
}

double cross(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Cuts a plane polygon (counter-clockwise) by clipping ears. Gives positions within the polygon; false if the effort
/// is used up or no ear is left, as in polygons that cross themselves.
bool clipEars(const std::vector<Vector2d>& ring, MeshEffort& effort, std::vector<Cut>& cuts) {
  std::vector<std::size_t> left(ring.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  while (left.size() > 3) {
    bool found = false;
    for (std::size_t i = 0; i < left.size() && !found; ++i) {
      if (effort.left < left.size()) return effort.wasShort = true, false;
      effort.left -= left.size();
      const std::size_t n = left.size();
      const std::size_t a = left[(i + n - 1) % n], b = left[i], c = left[(i + 1) % n];
      if (cross(ring[a], ring[b], ring[c]) <= 0) continue;
      const bool ear = std::none_of(left.begin(), left.end(), [&](std::size_t p) {
        if (p == a || p == b || p == c || ring[p] == ring[a] || ring[p] == ring[b] || ring[p] == ring[c]) return false;
        return cross(ring[a], ring[b], ring[p]) >= 0 && cross(ring[b], ring[c], ring[p]) >= 0 &&
               cross(ring[c], ring[a], ring[p]) >= 0;
      });
      if (!ear) continue;
      cuts.push_back({a, b, c});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
      found = true;
    }
    if (!found) return false;
  }
  cuts.push_back({left[0], left[1], left[2]});
  return true;
}

bool isConvex(const std::vector<Vector2d>& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (cross(ring[i], ring[(i + 1) % ring.size()], ring[(i + 2) % ring.size()]) < 0) return false;
  return true;
}

/// Appends the triangles of one face.
void cutFace(const Polygons& polygons, std::size_t face, MeshEffort& effort, std::vector<Cut>& cuts) {
  const std::size_t begin = polygons.start[face], count = polygons.start[face + 1] - begin;
  if (count < 3) return;
  std::vector<Cut> own;
  bool done = false;
  if (!polygons.convex && count > 3) {
    // Into the polygon's plane, so that it runs counter-clockwise.
    std::vector<Vector3d> ring(count);
    for (std::size_t i = 0; i < count; ++i)
      ring[i] = polygons.points[static_cast<std::size_t>(polygons.corners[begin + i])].cast<double>();
    const Vector3d normal = newell(ring);
    if (normal.norm() > 0) {
      const Vector3d z = normal.normalized(), x = z.unitOrthogonal(), y = z.cross(x);
      std::vector<Vector2d> flat(count);
      for (std::size_t i = 0; i < count; ++i) flat[i] = {ring[i].dot(x), ring[i].dot(y)};
      if (!isConvex(flat)) done = clipEars(flat, effort, own);
    }
  }
  if (!done) {
    own.clear();
    for (std::size_t i = 1; i + 1 < count; ++i) own.push_back({0, i, i + 1});
  }
  for (const Cut& cut : own) cuts.push_back({begin + cut[0], begin + cut[1], begin + cut[2]});
}

/// The part of the triangles that has one colour, with normals.
class MeshBuilder {
 public:
  MeshBuilder(const Polygons& polygons, const std::vector<Cut>& cuts) : polygons_(polygons), cuts_(cuts) {
    if (!polygons.counterClockwise)
      for (Cut& cut : cuts_) std::swap(cut[1], cut[2]);
    dropEmpty();
  }

  Mesh build() {
    if (!polygons_.cornerNormals.empty())
      withGivenNormals();
    else if (polygons_.creaseAngle < 1e-6f)
      flat();
    else
      creased();
    return std::move(mesh_);
  }

 private:
  int point(std::size_t corner) const { return polygons_.corners[corner]; }
  const Vector3f& at(std::size_t corner) const { return polygons_.points[static_cast<std::size_t>(point(corner))]; }

  void dropEmpty() {
    std::vector<Cut> kept;
    for (const Cut& cut : cuts_) {
      const Vector3d a = at(cut[0]).cast<double>(), b = at(cut[1]).cast<double>(), c = at(cut[2]).cast<double>();
      const Vector3d area = (b - a).cross(c - a);
      if (!(area.norm() > 1e-18) || !area.allFinite()) continue;
      kept.push_back(cut);
      areas_.push_back(area);
    }
    cuts_ = std::move(kept);
  }

  int addVertex(std::size_t corner, const Vector3f& normal) {
    mesh_.vertices.push_back(at(corner));
    mesh_.normals.push_back(normal);
    return static_cast<int>(mesh_.vertices.size()) - 1;
  }

  void withGivenNormals() {
    std::unordered_map<std::uint64_t, int> known;
    for (const Cut& cut : cuts_) {
      std::array<int, 3> triangle{};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto normal = static_cast<std::uint32_t>(polygons_.cornerNormals[cut[i]]);
        const std::uint64_t key = (static_cast<std::uint64_t>(point(cut[i])) << 32) | normal;
        const auto [entry, isNew] = known.try_emplace(key, 0);
        if (isNew) entry->second = addVertex(cut[i], polygons_.normals[normal]);
        triangle[i] = entry->second;
      }
      mesh_.triangles.push_back(triangle);
    }
  }

  void flat() {
    for (std::size_t t = 0; t < cuts_.size(); ++t) {
      const Vector3f normal = areas_[t].normalized().cast<float>();
      std::array<int, 3> triangle{};
      for (std::size_t i = 0; i < 3; ++i) triangle[i] = addVertex(cuts_[t][i], normal);
      mesh_.triangles.push_back(triangle);
    }
  }

  /// Each corner's normal is the area-weighted mean over the triangles at its point that lie within the crease angle.
  void creased() {
    constexpr std::size_t most = 64;  // triangles at one point; a point with more is smooth all round
    const bool allSmooth = polygons_.creaseAngle >= 3.14f;
    const double limit = std::cos(static_cast<double>(polygons_.creaseAngle));
    std::unordered_map<int, std::vector<std::size_t>> around;
    for (std::size_t t = 0; t < cuts_.size(); ++t)
      for (const std::size_t corner : cuts_[t]) around[point(corner)].push_back(t);
    std::unordered_map<int, Vector3d> sums;
    for (const auto& [where, triangles] : around) {
      Vector3d sum = Vector3d::Zero();
      for (const std::size_t t : triangles) sum += areas_[t];
      sums[where] = sum;
    }

    std::unordered_map<int, std::vector<int>> made;  // vertices by point
    for (std::size_t t = 0; t < cuts_.size(); ++t) {
      const Vector3d own = areas_[t].normalized();
      std::array<int, 3> triangle{};
      for (std::size_t i = 0; i < 3; ++i) {
        const int where = point(cuts_[t][i]);
        const auto& neighbours = around[where];
        Vector3d sum = Vector3d::Zero();
        if (allSmooth || neighbours.size() > most)
          sum = sums[where];
        else
          for (const std::size_t other : neighbours)
            if (areas_[other].normalized().dot(own) >= limit) sum += areas_[other];
        const Vector3f normal = (sum.norm() > 0 ? sum.normalized() : own).cast<float>();
        triangle[i] = share(cuts_[t][i], normal, made[where]);
      }
      mesh_.triangles.push_back(triangle);
    }
  }

  int share(std::size_t corner, const Vector3f& normal, std::vector<int>& made) {
    for (const int vertex : made)
      if ((mesh_.normals[static_cast<std::size_t>(vertex)] - normal).squaredNorm() < 1e-8f) return vertex;
    made.push_back(addVertex(corner, normal));
    return made.back();
  }

  const Polygons& polygons_;
  std::vector<Cut> cuts_;
  std::vector<Vector3d> areas_;  ///< normal times twice the area of each cut
  Mesh mesh_;
};

}  // namespace

void Polygons::addFace(std::initializer_list<std::int32_t> face) {
  corners.insert(corners.end(), face);
  endFace();
}

std::vector<Mesh> triangulate(const Polygons& polygons, MeshEffort& effort) {
  std::map<int, std::vector<Cut>> byColour;
  for (std::size_t face = 0; face < polygons.faces(); ++face)
    cutFace(polygons, face, effort, byColour[polygons.faceColours.empty() ? -1 : polygons.faceColours[face]]);
  std::vector<Mesh> meshes;
  for (const auto& [colour, cuts] : byColour) {
    Mesh mesh = MeshBuilder(polygons, cuts).build();
    if (mesh.triangles.empty()) continue;
    mesh.colour = colour;
    meshes.push_back(std::move(mesh));
  }
  return meshes;
}

}  // namespace btr::vrml
