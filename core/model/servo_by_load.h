#pragma once
#include "core/model/robot_model.h"

namespace btr {

/// The gains of a servo whose file gives none and whose load it can hold: those of the ERS-7's legs.
inline constexpr double defaultServoP_nm_rad = 7.5, defaultServoD_nm_s_rad = 0.05;

/// Gives gains and a torque limit to joints whose file names none and whose load an ERS-7's servo
/// (defaultServoLimit()) could not hold: without them a large robot sags like a rope. To slide joints always.
///
/// The load of a joint is the weight that it carries times its distance from the axis, summed over the links behind it
/// with all joints at 0 (so it bounds the torque in every posture that keeps these distances); on a slide joint the
/// weight. In a free robot the joints of limbs that reach down to its lowest point also carry half of what is in front
/// of them: it stands on them. The servo gives way by 0.02 rad (1 mm on a slide joint) under that load, is critically
/// damped for the inertia that it moves, and has up to three times the torque; what the file gives stays.
/// Adds one warning that says for how many joints, if there are any. A model of more than 1000 links is left as it is.
void chooseServosByLoad(RobotModel& model);

}  // namespace btr
