#pragma once
#include <string>

#include "core/model/robot_model.h"

namespace btr {

/// Makes a direction of an axis of any length. True if its length was none that a few digits of text explain. What has
/// no direction stays as it is, for checkModel() to refuse.
bool makeUnitAxis(Eigen::Vector3d& axis);

/// A joint whose lower and upper limit are one number. Where both are 0, nobody gave them (exporters fill in 0): it
/// moves without limits. Elsewhere it is fixed there: its origin [m, rad] has what it would have been moved by.
/// Returns what is to be said of it: "" where the limits are two numbers or the joint does not move.
std::string settleMeetingLimits(Joint& joint);

}  // namespace btr
