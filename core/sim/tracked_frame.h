#pragma once
#include <Eigen/Geometry>

#include "core/sim/scene.h"

namespace btr {

/// The scene's frame in that of what tracks its balls, by its effects: what is recorded of a ball at p is frame·p.
inline Eigen::Isometry3d trackedFrame(const Scene& scene) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  for (const SceneEffect& placed : scene.effects) frame = frame * placed.effect->trackedFrame(placed.values);
  return frame;
}

}  // namespace btr
