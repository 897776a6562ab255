#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace btr::vrml {

/// Polygons as files hold them: corners index points; face f has the corners start[f] … start[f + 1] − 1.
struct Polygons {
  std::vector<Eigen::Vector3f> points;
  std::vector<std::int32_t> corners;  ///< all within points
  std::vector<std::size_t> start{0};
  std::vector<Eigen::Vector3f> normals;     ///< given ones, or empty
  std::vector<std::int32_t> cornerNormals;  ///< one a corner, within normals, or empty
  std::vector<int> faceColours;             ///< one a face, or empty
  bool counterClockwise = true;
  bool convex = true;
  float creaseAngle = 0;  ///< edges up to this angle [rad] are smooth

  std::size_t faces() const { return start.size() - 1; }
  /// Ends the face whose corners were appended last.
  void endFace() { start.push_back(corners.size()); }
  void addFace(std::initializer_list<std::int32_t> face);
};

/// Triangles with one normal a vertex.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::array<int, 3>> triangles;
  int colour = -1;  ///< index of the faces' colour, −1 none
};

/// Steps that triangulation may still take for one file: clipping a polygon of n corners takes up to n³ of them.
/// When they are used up, polygons are cut as if they were convex.
struct MeshEffort {
  std::size_t left = 50'000'000;
  bool wasShort = false;
};

/// Cuts polygons into triangles (a fan where they are convex, ear clipping otherwise) and computes normals by the
/// crease angle where none are given. One mesh for each colour. Triangles without area are dropped.
std::vector<Mesh> triangulate(const Polygons& polygons, MeshEffort& effort);

/// Surfaces as polygons, in VRML's frames: cylinder and cone stand on the y axis, centred.
Polygons boxPolygons(const Eigen::Vector3d& size);
Polygons spherePolygons(double radius);
Polygons conePolygons(double bottomRadius, double topRadius, double height, bool side, bool bottom, bool top);

/// VRML97 Extrusion: a cross section (x, z) swept along a spine. scale and orientation may be empty or single.
struct ExtrusionData {
  std::vector<Eigen::Vector2f> crossSection;
  std::vector<Eigen::Vector3f> spine;
  std::vector<Eigen::Vector2f> scale;
  std::vector<Eigen::Quaternionf> orientation;
  bool beginCap = true, endCap = true;
};
Polygons extrude(const ExtrusionData& data);

}  // namespace btr::vrml
