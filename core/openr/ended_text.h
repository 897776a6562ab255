#pragma once
#include <string>

#include "core/openr/robot_link.h"

namespace btr::openr {

/// One sentence: "MovingHead7 crashed in Ready: it read at address 0".
std::string sentenceOf(const Ended& ended);

}  // namespace btr::openr
