#pragma once
#include <cstddef>
#include <span>

#include "core/sim/scene.h"

namespace btr {

/// Where a wind's own numbers end, along x and y, the drag number of the balls that it pushes may follow.
constexpr std::size_t windNumbers = 2;

/// 0.47, of a smooth sphere, where the wind was told of no other.
inline double dragNumberInWind(std::span<const double> values) {
  return values.size() > windNumbers ? values[windNumbers] : 0.47;
}

/// Still air and wind are one air: each constant_wind gets the drag number that air_drag gives the balls, the mean of
/// those above 0. Either effect may come first.
inline void tellWindOfDrag(Scene& scene) {
  double sum = 0, count = 0;
  for (const SceneEffect& placed : scene.effects)
    if (placed.name == "air_drag" && placed.values[0] > 0) sum += placed.values[0], ++count;
  if (count == 0) return;
  for (SceneEffect& placed : scene.effects)
    if (placed.name == "constant_wind") {
      placed.values.resize(windNumbers);
      placed.values.push_back(sum / count);
    }
}

}  // namespace btr
