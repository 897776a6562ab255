#include "core/openr/robot_starter.h"

#include "core/spec/error.h"

namespace btr::openr {

std::unique_ptr<RunningProgram> startRobot(const std::string& stick, const RobotDesign&) {
  throw InputError(stick, "no run-time of OPEN-R", "a build with openr_robot");
}

}  // namespace btr::openr
