#pragma once
#include <string>

namespace btr::openr {

/// Preprocessed source in which a `long` has 32 bits, as on the robot: in what the program's own files say it is an
/// `int`, and 1L and 1UL are 1 and 1U; `ulong` and `u_long` of the system's headers have 32 bits, too. `long long` and
/// `long double` stay, and so do the system's headers and those in the folder `kit`. What is written is as long as what
/// stood there, so that complaints name the source's own columns. The same text where the program's files have no
/// `long`.
std::string withRobotLongs(const std::string& preprocessed, const std::string& kit);

}  // namespace btr::openr
