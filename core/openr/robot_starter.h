#pragma once
#include <memory>
#include <string>

#include "core/openr/live_programs.h"

namespace btr::openr {

/// The objects of a stick in a process of their own (RobotProcess). Throws InputError if they cannot be started.
std::unique_ptr<RunningProgram> startRobot(const std::string& stick, const RobotDesign& design);

/// The same; a program that has not answered a frame within so much real time is ended.
LivePrograms::Starter robotStarter(double patience_s);

}  // namespace btr::openr
