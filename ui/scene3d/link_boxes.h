#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "core/model/robot_model.h"

namespace btr::ui {

/// The box of what is drawn of each link, in the link's frame; empty for a link that shows nothing.
std::vector<Eigen::AlignedBox3d> linkBoxes(const RobotModel& model);

/// The box that holds these boxes, each carried by its link's pose.
Eigen::AlignedBox3d boxOf(const std::vector<Eigen::AlignedBox3d>& links, const std::vector<Eigen::Isometry3d>& poses);

}  // namespace btr::ui
