#include "ui/live/drawn/view_mode.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace btr::ui {
namespace {

constexpr double straightDown = 1.55;  ///< rad; at π/2 right and left would be undefined

}  // namespace

const char* nameOf(ViewMode mode) {
  constexpr const char* names[kViewModes] = {"free", "follow", "aboard", "top"};
  return names[static_cast<int>(mode)];
}

ViewCamera cameraFor(ViewMode mode, const std::string& object, ViewCamera camera, const LiveScene& scene,
                     const LiveRow& row) {
  if (mode == ViewMode::free) return camera;
  if (mode == ViewMode::top) camera.elevation = straightDown;
  const auto& objects = scene.objects();
  const auto found = std::ranges::find(objects, object, &LiveObject::name);
  if (found == objects.end() || row.values.empty()) return camera;
  const Eigen::Isometry3d pose = scene.poseOf(static_cast<std::size_t>(found - objects.begin()), row);
  if (!pose.matrix().allFinite()) return camera;
  camera.focus = pose.translation();
  if (mode == ViewMode::aboard) {
    const Eigen::Vector3d ahead = pose.linear().col(0);
    camera.azimuth = std::remainder(std::atan2(ahead.y(), ahead.x()) + std::numbers::pi, 2 * std::numbers::pi);
  }
  return camera;
}

nlohmann::json toJson(const ViewCamera& camera) {
  return {{"focus_m", {camera.focus.x(), camera.focus.y(), camera.focus.z()}},
          {"distance_m", camera.distance},
          {"azimuth_rad", camera.azimuth},
          {"elevation_rad", camera.elevation}};
}

ViewCamera viewCameraFrom(const nlohmann::json& object) {
  ViewCamera camera;
  const auto number = [&](const char* key, double byDefault, double least, double most) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number()) return byDefault;
    return std::clamp(found->get<double>(), least, most);
  };
  if (!object.is_object()) return camera;
  camera.distance = number("distance_m", camera.distance, 0.08, 15);
  camera.azimuth = number("azimuth_rad", camera.azimuth, -7, 7);
  camera.elevation = number("elevation_rad", camera.elevation, -0.2, straightDown);
  constexpr double furthest_m = 1000;
  if (const auto focus = object.find("focus_m"); focus != object.end() && focus->is_array() && focus->size() == 3)
    for (int i = 0; i < 3; ++i)
      if ((*focus)[i].is_number()) camera.focus[i] = std::clamp((*focus)[i].get<double>(), -furthest_m, furthest_m);
  return camera;
}

}  // namespace btr::ui
