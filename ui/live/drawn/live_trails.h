#pragma once
#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "ui/live/drawn/live_scene.h"

namespace btr::ui {

/// The ways that what moves has gone: a place every few millimetres, the oldest forgotten. Where something was put
/// elsewhere, or time goes back, its way begins anew.
class LiveTrails {
 public:
  static constexpr double spacing_m = 0.004;
  static constexpr std::size_t mostPlaces = 1500;

  void clear() { ways_.clear(); }
  void add(const LiveScene& scene, const LiveRow& row);
  std::vector<std::vector<Eigen::Vector3f>> ways() const;

 private:
  std::map<std::string, std::vector<Eigen::Vector3f>> ways_;  ///< by object
  double time_s_ = 0;
};

}  // namespace btr::ui
