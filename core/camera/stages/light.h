#pragma once
#include <vector>

namespace btr {

/// A picture of floats inside the pipeline: 3 a pixel, rows from the upper left.
struct LightPicture {
  int width = 0, height = 0;
  std::vector<float> rgb;
};

}  // namespace btr
