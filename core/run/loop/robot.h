#pragma once
#include <memory>

#include "core/plugin/reality.h"

namespace btr {

class RunContext;

/// Opens the robot of a run; nullptr where nobody answers but people. Throws InputError.
std::unique_ptr<RealRobot> openRobot(RunContext& context);

}  // namespace btr
