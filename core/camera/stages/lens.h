#pragma once
#include <cstddef>
#include <vector>

#include "core/camera/camera_spec.h"
#include "core/camera/pinhole.h"

namespace btr {

/// Where in the picture of a camera without errors each pixel of the sensor looks.
class LensMap {
 public:
  /// Throws InputError if the lens folds the picture over or looks further than four times the sensor.
  explicit LensMap(const CameraSpec& spec);

  const Pinhole& pinhole() const { return pinhole_; }
  /// Adds `weight` times a row of the sensor to `row` (3 floats a pixel), between pixels linearly.
  void addRow(const std::vector<float>& rgb, int y, float weight, float* row) const;
  /// What addRow() reads of the pinhole picture.
  PictureRows rowsFor(int y) const;
  /// The nearest pixel of the pinhole picture.
  std::size_t nearest(std::size_t pixel) const;
  /// Distance over depth along the optical axis.
  float rayLength(std::size_t pixel) const;

 private:
  void solve(const CameraSpec& spec);
  void enclose(const CameraSpec& spec);

  int width_, height_;
  bool identity_ = true;
  std::vector<float> x_px_, y_px_;  // a pixel of the sensor, in the pinhole picture
  Pinhole pinhole_;
};

}  // namespace btr
