#pragma once
#include <Eigen/Geometry>
#include <span>

#include "core/sim/scene.h"

namespace btr {

/// The effect by which what tracks the balls has another frame than the scene: its numbers are the height of the floor
/// in that frame [m] and its tilt about x, then about y [rad].
inline constexpr auto floorPlace = "floor_place";

inline Eigen::Matrix3d tiltOfFloor(std::span<const double> values) {
  return (Eigen::AngleAxisd(values[2], Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(values[1], Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

/// The scene's frame in that of what tracks its balls: what is recorded of a ball at p is frame·p.
inline Eigen::Isometry3d trackedFrame(const Scene& scene) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  for (const SceneEffect& placed : scene.effects) {
    if (placed.name != floorPlace) continue;
    frame.translation().z() = placed.values[0];
    frame.linear() = tiltOfFloor(placed.values);
  }
  return frame;
}

}  // namespace btr
