#pragma once
#include <string>

#include "core/gap/replay/inverse.h"

namespace btr {

/// A row a joint and recording, then the relative error of each joint over all recordings, then the notes.
std::string inverseTable(const InverseReport& report);
/// The same as JSON, "format": "uchilsim-inverse-1".
std::string toJsonText(const InverseReport& report);

}  // namespace btr
