#pragma once
#include <string_view>

namespace btr::drawingLoss {

/// How a warning about a visual shape that cannot be read ends: what becomes of its link, which the warning names `at`.
inline constexpr std::string_view notDrawn = "; it is not drawn", byCollision = "; its collision shapes are drawn";

}  // namespace btr::drawingLoss
