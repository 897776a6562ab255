#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/run/loop/back_to_reality.h"
#include "core/spec/grid_spec.h"

namespace btr {

/// Where a grid is, for progress bars.
struct GridProgress {
  std::string phase;        ///< "learning", "settling", "points between", "finished"
  int done = 0, total = 0;  ///< generations of all learning cells; then trials of the phase
  int cellsDone = 0, cells = 0;
  long trials = 0;  ///< simulated since this call
  double trialsPerSecond = 0;
  double secondsLeft = -1;  ///< of the learning; negative: not known yet
  double meanBest = 0;      ///< of the cells that have one
};

struct GridOptions {
  int workers = 0;                                    ///< processes, 0: as many as processors
  Workforce* workforce = nullptr;                     ///< evaluates the trials in place of them, if there is one
  std::function<void(const GridProgress&)> progress;  ///< about once a second
};

/// The settings of the experiment's controller that are a grid's axes, in their order, with their bounds. Throws
/// InputError where it has none of that name, or the experiment cannot be read.
std::vector<Parameter> axisParameters(const PluginHost& host, const GridSpec& spec);

/// Starts a grid with one method and seed, or finds it if it is stored: grid, cells and first runs are in the database
/// then. Checks the experiment, the axes (settings of its controller that are named like GridSpec::axisNames) and that
/// the controller has mirrored motions where the grid derives cells. Throws InputError.
Id startGrid(Database& database, const PluginHost& host, const GridSpec& spec, GridSpec::Method method,
             std::uint64_t seed);

/// Goes on with a grid until it is finished or `stop` is raised (or requested in the database for one of its runs that
/// learn). All learning cells (of contamination: those of a wave) take their generations in step; a round of one
/// generation each is one transaction. So after kill -9 at any moment the next call goes on with the same bits, with
/// any number of workers.
///
///   independent    every cell learns for itself
///   contamination  from the cell nearest to straight ahead outwards (wavesOf): the population of a cell begins as
///                  copies (share, flip) of the best of that finished neighbour which did best, if it is good (not
///                  below the failure threshold); else as the experiment says
///   similarity     all cells at once; the learner is told fitness weighted by the mean similarity to the neighbours'
///                  bests of the round before (weightedFitness); a cell's best is the individual so far whose weighted
///                  fitness is highest
/// The best of the other methods is the individual so far with the highest fitness; the earlier of equals.
///
/// In the end cells whose best is below the threshold have failed. They try the solutions of their neighbours that have
/// not, as one more generation of their runs, and take the best of these if it beats their own. Then mirrored cells try
/// the images of their sources' solutions, the one generation of their runs. Last, interpolated kicks are tried at
/// points drawn (uniformly, from the seed, the same for all methods) between the cells.
RunEnd continueGrid(Database& database, const PluginHost& host, Id grid, const StopFlag& stop,
                    const GridOptions& options);

/// True while some process works on it.
bool isGridActive(const std::string& databasePath, Id grid);
/// True when solutions and points are all there.
bool isGridFinished(const Database& database, Id grid);

}  // namespace btr
