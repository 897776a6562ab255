#pragma once
#include <ode/ode.h>

#include <Eigen/Geometry>

namespace btr {

/// Puts an ODE body at a pose, world frame.
inline void setPose(dBodyID body, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d& p = pose.translation();
  const Eigen::Matrix3d& r = pose.linear();
  dBodySetPosition(body, p.x(), p.y(), p.z());
  const dMatrix3 rotation = {r(0, 0), r(0, 1), r(0, 2), 0, r(1, 0), r(1, 1), r(1, 2), 0, r(2, 0), r(2, 1), r(2, 2), 0};
  dBodySetRotation(body, rotation);
}

/// Mass and inertia about its centre of mass, which is ODE's origin of a body.
inline void setMass(dBodyID body, double mass_kg, const Eigen::Matrix3d& inertia_kg_m2) {
  const Eigen::Matrix3d& i = inertia_kg_m2;
  dMass mass;
  dMassSetParameters(&mass, mass_kg, 0, 0, 0, i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2));
  dBodySetMass(body, &mass);
}

}  // namespace btr
