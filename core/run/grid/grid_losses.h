#pragma once
#include "core/run/grid/grid_kicks.h"

namespace btr {

/// What an interpolated kick has lost, by the figures that the fitness kick_distance tells. The first that applies.
enum class GridLoss {
  none,
  trial,      ///< it did not finish
  balance,    ///< the robot fell, or its body tilted by more than 45°
  distance,   ///< less than half of the way that the kicks of the surrounding cells have (cells_way_m)
  direction,  ///< more than 15° off: what k = 7.3 rad⁻² takes for one standard deviation
};
constexpr double lostTilt_rad = 0.785398, lostDirection_rad = 0.261799, lostDistanceShare = 0.5;

/// One for each point of the map. Without such figures only `trial` is told from `none`.
std::vector<GridLoss> lossesOf(const GridMap& map);

}  // namespace btr
