#pragma once
#include <string>

#include "core/gap/replay/residual.h"

namespace btr {

/// The numbers for people: a row a channel and recording, then the mean over the recordings, then the notes.
std::string residualTable(const ResidualReport& report);
/// The same as JSON, "format": "uchilsim-residual-1" (without the samples).
std::string toJsonText(const ResidualReport& report);

}  // namespace btr
