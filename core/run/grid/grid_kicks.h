#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/learn/vector_grid.h"
#include "core/run/grid/grid.h"
#include "core/run/replay.h"

namespace btr {

/// The solutions of a grid whose cells are all settled, to be interpolated. Throws InputError if they are not.
VectorGrid solvedGrid(const Database& database, const PluginHost& host, Id grid);

/// An interpolated kick, run here and now with its trace. Throws InputError for a point outside the grid.
struct GridKick {
  Replay replay;  ///< nothing is stored to compare it with: `identical` says nothing
  std::vector<double> parameters;
  Values figures;
  std::vector<BallSpec> balls;  ///< of the scene
};
GridKick gridKick(const Database& database, const PluginHost& host, Id grid, const std::array<double, 3>& point);

/// Interpolated kicks at even steps over β and α at one distance, in worker processes.
struct GridMap {
  double distance_m = 0;
  std::vector<double> bearings_rad, directions_rad;  ///< ascending
  std::vector<GridPoint> points;                     ///< the direction runs fastest
  std::string unit;                                  ///< of fitness
};
/// Figure of a map's point: the way that the kicks of the cells around it have, interpolated as the kicks are.
inline constexpr const char* cellsWay = "cells_way_m";
/// `columns` bearings and `rows` directions, 1 … 1000 each, from one end of the grid's axes to the other (an axis
/// of one value gives that). Nothing if
/// `stop` was raised. `done(share)` is called from time to time.
std::optional<GridMap> gridMap(const Database& database, const PluginHost& host, Id grid, double distance_m,
                               int columns, int rows, int workers, const StopFlag& stop,
                               const std::function<void(double share)>& done = {});

/// "format": "uchilsim-grid-map-1", and the way back.
std::string toJsonText(const GridMap& map);
GridMap gridMapFromJson(const std::string& text, const std::string& place);
/// Columns distance_m,bearing_rad,direction_rad,fitness_U,outcome, then the figures by name.
std::string toCsv(const std::vector<GridPoint>& points, const std::string& unit);

}  // namespace btr
