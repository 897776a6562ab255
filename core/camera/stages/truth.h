#pragma once
#include "core/camera/camera_pipeline.h"
#include "core/camera/stages/lens.h"

namespace btr {

/// Depth and objects through the lens, and what is seen of each. A picture without depth or objects has nothing.
PictureTruth truthOf(const PinholePicture& picture, const LensMap& lens, int width, int height);

}  // namespace btr
