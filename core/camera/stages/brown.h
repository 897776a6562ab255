#pragma once
#include <array>
#include <optional>

#include "core/camera/camera_spec.h"

namespace btr {

/// Brown's terms of a lens as OpenCV defines them (calib3d, "Detailed Description").
struct BrownTerms {
  double k1 = 0, k2 = 0, k3 = 0, p1 = 0, p2 = 0;
};

/// All 0 if the stage is off.
BrownTerms brownTerms(const CameraSpec& spec);

/// x, y in focal lengths (x right, y down): where a ray's ideal point comes to lie.
std::array<double, 2> distorted(const BrownTerms& terms, double x, double y);

/// The ideal point of a distorted one, by Newton's method from `guess`; nothing where the lens folds the picture over.
std::optional<std::array<double, 2>> undistorted(const BrownTerms& terms, std::array<double, 2> seen,
                                                 std::array<double, 2> guess);

}  // namespace btr
