#pragma once
#include <string>

#include "core/gap/replay/residual.h"

namespace btr {

/// Self-contained SVG: recorded and simulated over time, and their difference below.
std::string overlaySvg(const ChannelError& error);

}  // namespace btr
