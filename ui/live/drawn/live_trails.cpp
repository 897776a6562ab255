#include "ui/live/drawn/live_trails.h"

namespace btr::ui {

void LiveTrails::add(const LiveScene& scene, const LiveRow& row) {
  const double time_s = scene.time_s(row), passed_s = time_s - time_s_;
  if (passed_s < 0) clear();
  time_s_ = time_s;
  for (std::size_t i = 0; i < scene.objects().size(); ++i) {
    if (!scene.objects()[i].moves) continue;
    const Eigen::Vector3f place = scene.poseOf(i, row).translation().cast<float>();
    auto& way = ways_[scene.objects()[i].name];
    if (!place.allFinite()) continue;
    const double gone_m = way.empty() ? 0 : double((place - way.back()).norm());
    constexpr double fastest_m_s = 20;  // a hand put it elsewhere
    if (gone_m > 0.05 + fastest_m_s * passed_s) way.clear();
    if (!way.empty() && gone_m < spacing_m) continue;
    if (way.size() == mostPlaces) way.erase(way.begin());
    way.push_back(place);
  }
}

std::vector<std::vector<Eigen::Vector3f>> LiveTrails::ways() const {
  std::vector<std::vector<Eigen::Vector3f>> ways;
  for (const auto& [object, way] : ways_) ways.push_back(way);
  return ways;
}

}  // namespace btr::ui
