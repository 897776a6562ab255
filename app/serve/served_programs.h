#pragma once
#include "core/remote/stick_programs.h"

namespace btr::cli {

/// OPEN-R programs for the worlds of a server, each in a process of its own, with their cameras.
remote::StickProgramsMaker stickProgramsMaker();

}  // namespace btr::cli
