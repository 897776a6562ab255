#pragma once
#include <vector>

#include "core/camera/camera_spec.h"

namespace btr {

/// Which moment counts how much in a row.
struct MomentShare {
  std::size_t moment = 0;
  float weight = 1;
};

/// A rolling shutter: row y is exposed around readout·(y/(rows − 1) − ½), for the time of exposure. The time of all
/// rows is divided into equal parts, one rendered picture in the middle of each; a row takes from each part what it
/// overlaps.
class Shutter {
 public:
  explicit Shutter(const CameraSpec& spec);
  const std::vector<double>& moments_s() const { return moments_s_; }
  /// Sum of weights: exposure over the exposure for full light.
  std::vector<MomentShare> sharesOfRow(int y) const;

 private:
  bool on_;
  int rows_;
  double exposure_s_, readout_s_, brightness_;
  std::vector<double> moments_s_{0.0};
};

}  // namespace btr
