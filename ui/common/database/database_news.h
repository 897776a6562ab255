#pragma once
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ui/common/database/database_watcher.h"

namespace btr::ui {

/// What the watcher knows already when it asks for news.
struct SeenBefore {
  std::int64_t version = -1;
  std::shared_ptr<const std::vector<DatabaseWatcher::Grid>> grids;
  std::vector<Id> mayBeActive;  ///< runs that a process can hold
  std::set<Id> active;
  std::size_t runs = 0;
  std::map<Id, int> stages;  ///< of each run, when its simulators were reported
  Id run = 0;                ///< to follow
  bool fresh = true;         ///< nothing of it was reported yet
  int lastGeneration = 0;
};

/// Everything about the run that is followed; of its generations those that are new, or all.
struct RunNews {
  bool all = true;
  RunRecord record;
  std::vector<SimulatorRecord> simulators;
  std::vector<GenerationRecord> generations;
  std::vector<GapRecord> gaps;
  std::vector<MeasurementTask> tasks;
  std::vector<MeasurementRecord> measurements;
};

/// What is in the database now. Without `changed` only who holds what.
struct DatabaseNews {
  std::int64_t version = -1;
  bool changed = false;
  std::vector<RunRecord> runs;
  std::vector<ExperimentRecord> experiments;
  std::shared_ptr<const std::vector<DatabaseWatcher::Grid>> grids;
  std::vector<SimulatorRecord> rigs;
  std::map<Id, std::vector<SimulatorRecord>> versions;  ///< of runs that have adapted since they were reported
  std::optional<RunNews> run;
  Id failedRun = 0;        ///< was to be followed from now on and cannot be read
  std::string runProblem;  ///< why
  std::set<Id> locked, lockedGrids;
};

/// Reads what became new, in the reader's thread. Throws InputError.
DatabaseNews readNews(const Database& database, const SeenBefore& seen, const DatabaseWatcher::ActiveTest& isActive);

/// A process can work on such a run.
inline bool mayWork(RunState state) { return state != RunState::finished && state != RunState::failed; }

}  // namespace btr::ui
