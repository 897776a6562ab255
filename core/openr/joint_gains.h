#pragma once
#include <array>
#include <string>

#include "core/openr/robot_link.h"

namespace btr::openr {

/// The gains that Sony's Model Information gives for a joint of a robot ("ERS-7", "NECK_TILT"). Throws InputError for a
/// joint that has none.
JointGain standardGain(const std::string& design, const std::string& joint);

/// P, I and D as times those of the robot's drives: a gain is its number times 2^shift, and the standard ones are what
/// the scene's drives have (nobody published their unit). A standard gain of 0 says nothing: then it is 1.
std::array<double, 3> timesStandard(const JointGain& gain, const JointGain& standard);

}  // namespace btr::openr
