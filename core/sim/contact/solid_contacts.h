#pragma once
#include <ode/ode.h>

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "core/sim/contact/collision.h"

namespace btr {

/// A collider as ODE's collision routines want it. Belongs to the thread that made it, needs ODE started.
class SolidGeom {
 public:
  explicit SolidGeom(const Collider& collider);
  ~SolidGeom();
  SolidGeom(SolidGeom&& other) noexcept;
  SolidGeom(const SolidGeom&) = delete;
  SolidGeom& operator=(const SolidGeom&) = delete;
  SolidGeom& operator=(SolidGeom&&) = delete;

  const Collider& collider() const { return collider_; }
  /// Puts it where the collider is when its body is there.
  void place(const Eigen::Isometry3d& body);
  const Eigen::Isometry3d& pose() const { return pose_; }  ///< of the collider in the world
  dGeomID id() const { return id_; }

 private:
  struct Convex;  ///< what ODE does not copy
  Collider collider_;
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
  /// ODE's axis of a cylinder is z, ours is y; its origin of a convex body must lie within it.
  Eigen::Isometry3d turn_ = Eigen::Isometry3d::Identity();
  std::unique_ptr<Convex> convex_;
  dGeomID id_ = nullptr;
};

/// Where two convex solids touch: at most four points, the deepest among them, normals towards the first. ODE (and
/// libccd) give the direction in which they part; the points are those of the two faces, edges or corners that meet
/// along it, clipped against each other, so that what lies flat on something has more than one. Clears `contacts`
/// first. False if they do not touch.
bool solidContacts(const SolidGeom& first, const SolidGeom& second, std::vector<ContactPoint>& contacts);

}  // namespace btr
