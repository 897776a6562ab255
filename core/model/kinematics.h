#pragma once
#include <span>
#include <vector>

#include "core/model/robot_model.h"

namespace btr {

/// Poses of all links in the world for a root pose and joint positions [rad or m] in the order of model.joints.
std::vector<Eigen::Isometry3d> forwardKinematics(const RobotModel& model, const Eigen::Isometry3d& root,
                                                 std::span<const double> positions);

/// Total mass [kg] and centre of mass in the root's frame [m] at the given joint positions.
Inertial massProperties(const RobotModel& model, std::span<const double> positions);

}  // namespace btr
