#pragma once
#include <Eigen/Core>

namespace btr {

/// Where two bodies touched in the last step, and the force there on the one that moves (where both do, on one of
/// them).
struct ContactForce {
  Eigen::Vector3d place_m, force_n;  ///< world; no torque: contacts are points
};

}  // namespace btr
