#pragma once
#include <memory>
#include <string>

#include "core/openr/live_programs.h"

namespace btr::cli {

/// The objects of a stick in a process of their own. Throws InputError if they cannot be started.
std::unique_ptr<openr::RunningProgram> startOpenrProcess(const std::string& stick, const openr::RobotDesign& design);

}  // namespace btr::cli
