#pragma once
#include <functional>
#include <string>

#include "core/plugin/plugin_host.h"

namespace btr {

/// How large a database is made. The default is the one that the figures in resources/results.md speak of.
struct LargeDatabase {
  int runs = 200;
  int runsOfAnExperiment = 10;  ///< seeds 1, 2, … of one experiment
  int generations = 125;        ///< of each run
  int population = 40;
  int stages = 2;            ///< measurement stages with an update each, at equal distances
  int measured = 10;         ///< individuals measured in a stage
  int repeats = 2;           ///< values typed in for each
  int adaptations = 10;      ///< generations of L3 in a stage
  int candidates = 12;       ///< in each of these
  int trace_bytes = 54'000;  ///< packed trace of a measured kick; 0: only hashes are kept
  long individuals() const { return long{runs} * generations * population; }
};

/// Writes such a database of runs of the experiment in `experimentPath` that nobody has simulated: specification,
/// scene, model files and genotype are those of the experiment, populations evolve by mutation, everything else has the
/// size that it has in a real run. All is written as a run writes it, generation by generation. The same arguments give
/// the same individuals. Refuses a file that is there. `goesOn` is asked after each generation; where it says no, the
/// file stays as it is.
void makeLargeDatabase(const std::string& path, const PluginHost& host, const std::string& experimentPath,
                       const LargeDatabase& size, const std::function<bool(int runsDone)>& goesOn = nullptr);

}  // namespace btr
