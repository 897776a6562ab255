#pragma once
#include <cstdint>
#include <vector>

namespace btr {

/// A camera without lens errors; pixels are square, the centre of the upper left pixel is (0, 0), x right, y down.
struct Pinhole {
  int width = 208, height = 160;
  double focal_px = 191.9, centreX_px = 103.5, centreY_px = 79.5;
};

/// Rows of a picture, the last one included.
struct PictureRows {
  int first = 0, last = 0;
};

/// What it sees at one moment; row by row from the upper left.
struct PinholePicture {
  Pinhole pinhole;
  std::vector<float> rgb;             ///< 3 a pixel, linear light, 1 is white in full light
  std::vector<float> depth_m;         ///< along the optical axis; infinity where nothing is
  std::vector<std::uint16_t> object;  ///< 0 nothing; else 1 + index into the list of object names
};

}  // namespace btr
