#include "core/camera/stages/shutter.h"

#include <algorithm>

namespace btr {

Shutter::Shutter(const CameraSpec& spec)
    : on_(spec[CameraStage::shutter].on),
      rows_(spec.height),
      exposure_s_(spec.number(CameraStage::shutter, "exposure_s")),
      readout_s_(spec.number(CameraStage::shutter, "readout_s")),
      brightness_(exposure_s_ / spec.number(CameraStage::shutter, "full_light_s")) {
  if (!on_) return;
  const auto count = static_cast<std::size_t>(spec.number(CameraStage::shutter, "moments"));
  const double part_s = (exposure_s_ + readout_s_) / static_cast<double>(count);
  moments_s_.clear();
  for (std::size_t i = 0; i < count; ++i)
    moments_s_.push_back((static_cast<double>(i) - (static_cast<double>(count) - 1) / 2) * part_s);
}

std::vector<MomentShare> Shutter::sharesOfRow(int y) const {
  if (!on_) return {{0, 1.0f}};
  const double half_s = (exposure_s_ + readout_s_) / static_cast<double>(moments_s_.size()) / 2;
  const double middle_s = readout_s_ * (y / (rows_ - 1.0) - 0.5);
  std::vector<MomentShare> shares;
  for (std::size_t i = 0; i < moments_s_.size(); ++i) {
    const double from = std::max(moments_s_[i] - half_s, middle_s - exposure_s_ / 2);
    const double to = std::min(moments_s_[i] + half_s, middle_s + exposure_s_ / 2);
    if (to > from) shares.push_back({i, static_cast<float>((to - from) / exposure_s_ * brightness_)});
  }
  return shares;
}

}  // namespace btr
