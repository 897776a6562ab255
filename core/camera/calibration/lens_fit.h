#pragma once
#include <array>
#include <span>

#include "core/camera/twin.h"

namespace btr {

/// The numbers of a lens in this order.
enum LensNumber { focal, centreX, centreY, k1, k2, k3, p1, p2 };
inline constexpr std::size_t lensNumberCount = 8;
using LensNumbers = std::array<double, lensNumberCount>;

struct LensFit {
  LensNumbers value{}, deviation{};
};

/// From `start`; numbers that are not `free` keep its value. Poses are all known or all unknown.
LensFit fitLensNumbers(std::span<const PointView> views, int width, int height, const LensNumbers& start,
                       const std::array<bool, lensNumberCount>& free);

/// Root mean square distance [px] between where points are seen and where the lens puts them. An unknown pose is fitted
/// to every other point, and the points between are judged.
double lensError(const PointView& view, const LensNumbers& lens);

}  // namespace btr
