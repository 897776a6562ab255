#pragma once
#include <span>
#include <vector>

#include "core/model/robot_model.h"

namespace btr {

/// Poses of all links in the world for a root pose and joint positions [rad or m] in the order of model.joints.
std::vector<Eigen::Isometry3d> forwardKinematics(const RobotModel& model, const Eigen::Isometry3d& root,
                                                 std::span<const double> positions);

/// Total mass [kg], centre of mass and inertia about it in the root's frame, at the given joint positions.
Inertial massProperties(const RobotModel& model, std::span<const double> positions);

/// The mass properties of two bodies joined, both in the same frame (Huygens and Steiner: I + m·(d²·1 − d·dᵀ)).
Inertial combined(const Inertial& a, const Inertial& b);

/// The same body seen from the frame in which its own frame has this pose.
Inertial carried(const Inertial& body, const Eigen::Isometry3d& pose);

}  // namespace btr
