#pragma once
#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "core/live/act.h"

namespace btr::ui {

/// About z, of the frame's x axis [rad].
double headingOf(const Eigen::Isometry3d& pose);
PlaceAct placeAct(const std::string& object, const Eigen::Isometry3d& pose);
/// An act for each declared parameter whose value differs; what is absent has its default.
std::vector<ParameterAct> differences(const std::string& robot, std::span<const Parameter> declared, const Values& from,
                                      const Values& to);

}  // namespace btr::ui
