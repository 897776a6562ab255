#pragma once
#include <string>

namespace btr::openr {

/// From now on this process changes files below `folder` only and starts no programs, whatever the code in it tries.
/// False on a kernel that cannot do it (before Linux 5.13, or without Landlock): then the run-time's own functions
/// alone keep programs on the stick.
bool confine(const std::string& folder);

}  // namespace btr::openr
