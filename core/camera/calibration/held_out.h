#pragma once
#include <cstdint>
#include <vector>

#include "core/camera/twin.h"

namespace btr {

/// For each of `count` photographs whether it is held out: a share of them, at least one, drawn by the seed.
std::vector<bool> heldOutPhotos(std::size_t count, const TwinOptions& options);

/// Root mean square over the photographs that are held out, or over the others; `before` or after.
double rootMeanSquare(const std::vector<TwinPhoto>& photos, bool heldOut, bool before);

/// A term that is less than so many of its standard deviations is not told from 0 (95 %).
inline constexpr double identifiedDeviations = 2;

}  // namespace btr
