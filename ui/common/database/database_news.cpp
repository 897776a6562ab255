#include "ui/common/database/database_news.h"

#include <algorithm>

#include "core/run/grid/grid.h"
#include "core/spec/error.h"

namespace btr::ui {
namespace {

// A grid and each of its cells come with the runs that learn them, so nothing is new where no run is.
std::vector<DatabaseWatcher::Grid> readGrids(const Database& database) {
  std::vector<DatabaseWatcher::Grid> grids;
  for (GridRecord& record : database.grids()) {
    DatabaseWatcher::Grid& grid = grids.emplace_back();
    for (const GridCellRecord& cell : database.gridCells(record.id))
      if (cell.run) grid.cellOfRun[cell.run] = cell.number;
    grid.record = std::move(record);
  }
  return grids;
}

// A process may begin or end without writing: asked every time, for the runs that can have one.
void readLocks(const Database& database, const SeenBefore& seen, const DatabaseWatcher::ActiveTest& isActive,
               DatabaseNews& news) {
  std::set<Id> ofGrids;
  for (const DatabaseWatcher::Grid& grid : *news.grids)
    if (isGridActive(database.path(), grid.record.id)) {
      news.lockedGrids.insert(grid.record.id);
      for (const auto& [run, cell] : grid.cellOfRun) ofGrids.insert(run);
    }
  std::vector<Id> asked = seen.mayBeActive;
  if (news.changed) {
    asked.clear();
    for (const RunRecord& run : news.runs)
      if (mayWork(run.state) || seen.active.contains(run.id)) asked.push_back(run.id);
  }
  for (const Id run : asked)
    if (!ofGrids.contains(run) && isActive(database.path(), run)) news.locked.insert(run);
}

RunNews readRun(const Database& database, const SeenBefore& seen, const std::vector<RunRecord>& runs) {
  RunNews news;
  news.all = seen.fresh;
  const auto listed = std::ranges::find(runs, seen.run, &RunRecord::id);
  news.record = listed != runs.end() ? *listed : database.run(seen.run);
  news.simulators = database.simulators(seen.run);
  news.generations = database.generations(seen.run, seen.fresh ? 0 : seen.lastGeneration);
  news.gaps = database.gaps(seen.run);
  news.tasks = database.measurementTasks(seen.run);
  news.measurements = database.measurements(seen.run);
  return news;
}

}  // namespace

DatabaseNews readNews(const Database& database, const SeenBefore& seen, const DatabaseWatcher::ActiveTest& isActive) {
  DatabaseNews news;
  news.version = database.dataVersion();
  news.changed = news.version != seen.version;
  news.grids = seen.grids;
  if (news.changed) {
    news.runs = database.runs();
    if (news.runs.size() != seen.runs)
      news.grids = std::make_shared<const std::vector<DatabaseWatcher::Grid>>(readGrids(database));
    news.experiments = database.experiments();
    news.rigs = database.rigSimulators(0);
    for (const RunRecord& run : news.runs)
      if (const auto told = seen.stages.find(run.id); told == seen.stages.end() || told->second != run.stage)
        news.versions[run.id] = database.simulators(run.id);
    try {
      if (seen.run != 0) news.run = readRun(database, seen, news.runs);
    } catch (const InputError& error) {
      // One that is followed already is read again with the next look; another one hides no other news.
      if (!seen.fresh) throw;
      news.failedRun = seen.run;
      news.runProblem = error.what();
    }
  }
  readLocks(database, seen, isActive, news);
  return news;
}

}  // namespace btr::ui
