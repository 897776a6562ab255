#pragma once
#include <string>

namespace btr::openr {

/// A format of printf() as the robot reads it: its `long` has 32 bits like its `int`, so that "%ld" may be given
/// either.
std::string robotFormat(const char* format);

}  // namespace btr::openr
