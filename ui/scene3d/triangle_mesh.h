#pragma once
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "core/model/robot_model.h"

namespace btr::ui {

using Colour = std::array<float, 4>;  ///< red, green, blue, opacity, 0…1, as in a picture (sRGB)

/// Coloured triangles with a normal at every vertex; what one drawable holds. Plain values, no OpenGL.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> positions, normals;
  std::vector<Colour> colours;
  std::vector<unsigned> indices;  ///< three a triangle, counter-clockwise seen from outside

  bool empty() const { return indices.empty(); }
  void addTriangle(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c, const Colour& colour);
  /// Corners counter-clockwise seen from outside.
  void addQuad(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c, const Eigen::Vector3f& d,
               const Colour& colour);
  void addBox(const Eigen::Isometry3d& pose, const Eigen::Vector3d& size_m, const Colour& colour);
  void addSphere(const Eigen::Isometry3d& pose, double radius_m, const Colour& colour);
  /// Along the pose's y axis, as in VRML.
  void addCylinder(const Eigen::Isometry3d& pose, double radius_m, double height_m, const Colour& colour);
  /// The same with half spheres on both ends, which `length_m` leaves out.
  void addCapsule(const Eigen::Isometry3d& pose, double radius_m, double length_m, const Colour& colour);
  /// A flat ring at height z about a vertical axis, seen from above.
  void addRing(double inner_m, double outer_m, double z_m, const Colour& colour,
               const Eigen::Vector2d& centre_m = Eigen::Vector2d::Zero());
  /// Any shape of a robot model. A mesh without normals is smoothed, but keeps edges sharper than 40°.
  void addShape(const Shape& shape, const Eigen::Isometry3d& pose, const Colour& colour);
};

/// A ball whose eight octants alternate between two oranges, so that one sees it roll.
TriangleMesh ballMesh(double radius_m);

/// Line segments, two points each, in one colour.
using LineSegments = std::vector<Eigen::Vector3f>;

/// The edges of what a shape collides as: box, sphere and cylinder outlines; a mesh shows its bounding box.
void addOutline(LineSegments& lines, const Shape& shape, const Eigen::Isometry3d& pose);

}  // namespace btr::ui
