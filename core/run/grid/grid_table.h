#pragma once
#include <string>
#include <vector>

#include "core/plugin/plugin_host.h"
#include "core/run/grid/grid.h"
#include "core/run/reality/spread.h"

namespace btr {

/// A settled cell as tables and pages show it.
struct GridRow {
  int cell = 0;
  std::array<double, 3> task{};  ///< distance [m], bearing and direction [rad]
  double fitness = 0;            ///< of its solution, in its own task
  double ownFitness = 0;         ///< of what it learned itself; of a mirrored cell that of its solution
  double similarity = 1;         ///< mean to its neighbours' solutions
  bool failed = false;
  int takenFrom = 0, mirrorOf = 0, begunAt = 0;
  int sourceTookFrom = 0;  ///< of a mirrored cell: takenFrom of the cell that it mirrors
  Id run = 0, individual = 0;
  std::vector<double> parameters;
};
/// How alike the solutions of two neighbours are.
struct GridEdge {
  int one = 0, other = 0;  ///< cells, one < other
  double similarity = 1;
};

/// One grid, as far as its cells are settled.
struct GridSummary {
  GridRecord grid;
  GridSpec spec;
  std::string unit;  ///< of fitness
  std::vector<GridRow> rows;
  std::vector<GridEdge> edges;
  int learning = 0;     ///< cells that learn by themselves
  double cellMean = 0;  ///< fitness of the solutions
  int failed = 0, taken = 0;
  double edgeMean = 0;   ///< similarity
  int points = 0;        ///< tried between the cells
  double pointMean = 0;  ///< their fitness
  Values figureMeans;    ///< over the points that finished: mean absolute value of what else the fitness tells
};
GridSummary summaryOf(const Database& database, const PluginHost& host, Id grid);

/// Finished grids of one spec with the same method, over their seeds.
struct GridMethodRow {
  std::string method;
  std::vector<Id> grids;  ///< by seed
  std::vector<std::uint64_t> seeds;
  Spread cells, points, edges;               ///< means of the grids
  Spread cellsDifference, pointsDifference;  ///< to the first method, seed by seed; empty in the first
  double failed = 0, taken = 0;              ///< cells, mean over the grids
};
struct GridComparison {
  std::string name, unit;
  std::vector<GridMethodRow> methods;  ///< in the order independent, contamination, similarity; those that are there
};
/// All finished grids of the spec with this hash.
GridComparison compareGrids(const Database& database, const PluginHost& host, const std::string& specSha256);

/// One line a cell: cell,distance_m,…,fitness_U,own_fitness_U,similarity,failed,taken_from,mirror_of,begun_at,run,
/// individual, then the parameters by name.
std::string cellsCsv(const GridSummary& summary, const std::vector<Parameter>& genotype);
/// One line a method: method,seeds, then mean and half of the 95 % interval of cells, points, edges and differences.
std::string methodsCsv(const GridComparison& comparison);
/// "format": "uchilsim-grids-1": the comparison, and each of its grids with its cells.
std::string toJsonText(const GridComparison& comparison, const std::vector<GridSummary>& grids);

}  // namespace btr
