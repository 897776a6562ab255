#include "core/sim/contact/obstacle_shape.h"

#include <cmath>
#include <cstdlib>

#include "core/sim/contact/collision.h"

namespace btr {
namespace {
using Eigen::Vector3d;

std::shared_ptr<const Surface> wedge(const Vector3d& half) {
  auto surface = std::make_shared<Surface>();
  for (const double y : {-half.y(), half.y()})
    for (const auto& [x, z] : {std::pair{-half.x(), -half.z()}, {half.x(), -half.z()}, {half.x(), half.z()}})
      surface->vertices.emplace_back(Vector3d(x, y, z).cast<float>());
  surface->triangles = {{0, 1, 2}, {3, 5, 4}, {0, 4, 1}, {0, 3, 4}, {1, 5, 2}, {1, 4, 5}, {0, 2, 5}, {0, 5, 3}};
  return surface;
}

}  // namespace

Shape obstacleShape(const ObstacleSpec& obstacle) {
  Shape shape;
  const Vector3d size(obstacle.size_m[0], obstacle.size_m[1], obstacle.size_m[2]);
  if (obstacle.shape == "sphere") {
    shape.kind = Shape::Kind::sphere;
    shape.size_m = {obstacle.radius_m, 0, 0};
  } else if (obstacle.shape == "cylinder") {
    shape.kind = Shape::Kind::cylinder;
    shape.size_m = {obstacle.radius_m, size.z(), 0};
    shape.pose.rotate(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()));
  } else if (obstacle.shape == "ramp") {
    shape.kind = Shape::Kind::mesh;
    shape.surface = wedge(size / 2);
    shape.hull = convexHull(shape.surface->vertices);
  } else {
    shape.kind = Shape::Kind::box;
    shape.size_m = size;
  }
  for (std::size_t i = 0; i < 3; ++i)
    shape.colour[i] = static_cast<float>(std::strtol(obstacle.colour.substr(1 + 2 * i, 2).c_str(), nullptr, 16)) / 255;
  return shape;
}

Inertial obstacleInertial(const ObstacleSpec& obstacle) {
  const double m = obstacle.mass_kg, r2 = obstacle.radius_m * obstacle.radius_m;
  const auto& [x, y, z] = obstacle.size_m;
  Inertial inertial{m};
  auto& inertia = inertial.inertia_kg_m2;
  if (obstacle.shape == "sphere") {
    inertia = Vector3d::Constant(0.4 * r2).asDiagonal();
  } else if (obstacle.shape == "cylinder") {
    inertia = Vector3d(r2 / 4 + z * z / 12, r2 / 4 + z * z / 12, r2 / 2).asDiagonal();
  } else if (obstacle.shape == "ramp") {
    // A right-angled triangle of legs x and z about its centroid: x²/18, z²/18 and xz/36 a unit of mass.
    inertial.centreOfMass_m = {x / 6, 0, -z / 6};
    inertia = Vector3d(z * z / 18 + y * y / 12, (x * x + z * z) / 18, x * x / 18 + y * y / 12).asDiagonal();
    inertia(0, 2) = inertia(2, 0) = -x * z / 36;
  } else {
    inertia = Vector3d(y * y + z * z, x * x + z * z, x * x + y * y).asDiagonal();
    inertia /= 12;
  }
  inertia *= m;
  return inertial;
}

}  // namespace btr
