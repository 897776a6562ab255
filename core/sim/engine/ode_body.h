#pragma once
#include <ode/ode.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace btr {

/// Puts an ODE body at a pose, world frame.
inline void setPose(dBodyID body, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d& p = pose.translation();
  const Eigen::Matrix3d& r = pose.linear();
  dBodySetPosition(body, p.x(), p.y(), p.z());
  const dMatrix3 rotation = {r(0, 0), r(0, 1), r(0, 2), 0, r(1, 0), r(1, 1), r(1, 2), 0, r(2, 0), r(2, 1), r(2, 2), 0};
  dBodySetRotation(body, rotation);
}

/// Quaternion and matrix as the engine has them: by its own functions each would be computed anew from the other one.
inline std::array<double, 16> attitudeOf(dBodyID body) {
  std::array<double, 16> attitude;
  std::copy_n(dBodyGetQuaternion(body), 4, attitude.begin());
  std::copy_n(dBodyGetRotation(body), 12, attitude.begin() + 4);
  return attitude;
}
inline void setAttitude(dBodyID body, const std::array<double, 16>& attitude) {
  std::copy_n(attitude.begin(), 4, const_cast<dReal*>(dBodyGetQuaternion(body)));
  std::copy_n(attitude.begin() + 4, 12, const_cast<dReal*>(dBodyGetRotation(body)));
}

/// Whether what this thread gives to dBodySetMass() is known to be positive definite: ODE then does not factor it twice
/// to find out.
bool& massIsChecked();

/// Mass and inertia about its centre of mass, which is ODE's origin of a body.
inline void setMass(dBodyID body, double mass_kg, const Eigen::Matrix3d& inertia_kg_m2) {
  const Eigen::Matrix3d& i = inertia_kg_m2;
  // As dMassSetParameters() writes it, which also tests twice that it is positive definite.
  dMass mass;
  mass.mass = mass_kg;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      mass.I[4 * row + column] = i(std::min(row, column), std::max(row, column));
  dBodySetMass(body, &mass);
}

/// The same of a body whose inertia was checked when it was made and is only larger now.
inline void setLargerInertia(dBodyID body, double mass_kg, const Eigen::Matrix3d& inertia_kg_m2) {
  massIsChecked() = true;
  setMass(body, mass_kg, inertia_kg_m2);
  massIsChecked() = false;
}

}  // namespace btr
