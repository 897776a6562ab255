#pragma once
#include "core/camera/camera_spec.h"
#include "core/camera/stages/light.h"

namespace btr {

/// The signal, kept between 0 and 1 (what is no number is 0), to the power of 1/gamma; from a table, wrong by less than
/// half of 1/255.
class GammaCurve {
 public:
  explicit GammaCurve(const CameraSpec& spec);
  void apply(LightPicture& picture) const;

 private:
  std::vector<float> table_;
};

}  // namespace btr
