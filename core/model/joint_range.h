#pragma once
#include <vector>

#include "core/model/robot_model.h"

namespace btr {

/// Joint stops lie this far beyond a rotary joint's limits (ERS-7: mechanical stop 5° beyond the software limit), and
/// at the limits of a slide joint.
inline constexpr double stopBeyond_rad = 0.0873;

/// Positions between which a joint moves [rad or m].
struct JointRange {
  double lower, upper;
};

JointRange stopsOf(const Joint& joint);

/// Where a joint starts of which nobody says anything: at 0, or, where 0 lies beyond its stop, at the place within its
/// limits that is nearest to 0.
double startOf(const Joint& joint);

/// The same of all joints of a model; a joint that follows another one is where that puts it.
std::vector<double> startPositions(const RobotModel& model);

}  // namespace btr
