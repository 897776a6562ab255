#include "core/run/grid/grid_losses.h"

#include <cmath>

#include "core/sim/trial.h"

namespace btr {

std::vector<GridLoss> lossesOf(const GridMap& map) {
  const auto figure = [](const GridPoint& point, const char* name, double otherwise) {
    const auto found = point.figures.find(name);
    return found == point.figures.end() ? otherwise : found->second;
  };
  std::vector<GridLoss> losses;
  for (const GridPoint& point : map.points) {
    GridLoss loss = GridLoss::none;
    if (!isFinished(point.outcome))
      loss = GridLoss::trial;
    else if (figure(point, "falls", 0) > 0 || figure(point, "largest_tilt_rad", 0) > lostTilt_rad)
      loss = GridLoss::balance;
    else if (figure(point, "way_m", 0) < lostDistanceShare * figure(point, cellsWay, 0))
      loss = GridLoss::distance;
    else if (std::abs(figure(point, "off_direction_rad", 0)) > lostDirection_rad)
      loss = GridLoss::direction;
    losses.push_back(loss);
  }
  return losses;
}

}  // namespace btr
