#include "app/btr_openr_process.h"

#include "core/spec/error.h"

namespace btr::cli {

std::unique_ptr<openr::RunningProgram> startOpenrProcess(const std::string& stick, const openr::RobotDesign&) {
  throw InputError(stick, "no run-time of OPEN-R", "a build with openr_robot");
}

}  // namespace btr::cli
