#pragma once
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/model/robot_model.h"

namespace btr {

/// A mesh simplified to a convex body: the mesh's outermost points in 42 directions and the planes that enclose them.
struct Hull {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> faces;
  std::vector<Eigen::Vector4d> planes;  ///< of each face: outward unit normal and offset, n·x ≤ w inside
};
std::shared_ptr<const Hull> convexHull(const std::vector<Eigen::Vector3f>& vertices);

/// Whether a link's shape can touch something in a scene whose `collision` is "mesh", "primitives" or "none". Where the
/// model's meshes replace primitives, only those of the kind that was asked for do, but a link that lacks that kind
/// collides with the other one.
bool collidesIn(const RobotModel& model, const Link& link, const Shape& shape, const std::string& collision);

/// A solid that can touch floor or ball. Poses are in its body's frame.
struct Collider {
  Shape::Kind kind = Shape::Kind::sphere;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< cylinder and capsule lie along their y axis
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();        ///< as in Shape
  double bound_m = 0;                                      ///< radius of a sphere about the pose's origin that holds it
  std::shared_ptr<const Hull> hull;                        ///< Kind::mesh
  int link = -1;                                           ///< of the model
};
/// The collider of a shape whose frame is placed at `linkInBody`; a mesh's hull is made if it has none yet.
Collider makeCollider(const Shape& shape, const Eigen::Isometry3d& linkInBody, int link);

struct ContactPoint {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal =
      Eigen::Vector3d::UnitZ();  ///< towards the first body (floor: the collider's; sphere: the sphere)
  double depth_m = 0;            ///< negative: still apart by that much
};

/// Points of the collider below z = margin, the same set for mirrored poses. Clears `contacts` first.
void floorContacts(const Collider& collider, const Eigen::Isometry3d& body, double margin,
                   std::vector<ContactPoint>& contacts);
/// Contact of a sphere with the collider; the normal points to the sphere. False if they are further apart than margin.
bool sphereContact(const Collider& collider, const Eigen::Isometry3d& body, const Eigen::Vector3d& centre,
                   double radius, double margin, ContactPoint& contact);

}  // namespace btr
