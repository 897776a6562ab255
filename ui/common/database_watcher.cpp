#include "ui/common/database_watcher.h"

#include <algorithm>
#include <exception>

#include "core/run/grid/grid.h"

namespace btr::ui {
namespace {

bool same(const std::vector<MeasurementTask>& a, const std::vector<MeasurementTask>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.individual == y.individual && x.stage == y.stage && x.position == y.position;
  });
}

// Measurements are never deleted or edited, only voided.
bool same(const std::vector<MeasurementRecord>& a, const std::vector<MeasurementRecord>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.id == y.id && x.isVoid == y.isVoid && x.note == y.note;
  });
}

bool mayWork(RunState state) { return state != RunState::finished && state != RunState::failed; }

}  // namespace

DatabaseWatcher::DatabaseWatcher(ActiveTest isActive, int interval_ms, QObject* parent)
    : QObject(parent), isActive_(std::move(isActive)) {
  timer_.setInterval(interval_ms);
  connect(&timer_, &QTimer::timeout, this, &DatabaseWatcher::poll);
}

void DatabaseWatcher::open(const QString& path, const Names& names) {
  Database opened = Database::open(path.toStdString(), Database::Mode::readOnly);
  database_ = std::move(opened);
  names_ = names;
  version_ = -1;
  run_ = 0;
  runs_.clear();
  stages_.clear();
  rigVersions_.reset();
  grids_.clear();
  active_.clear();
  activeGrids_.clear();
  timer_.start();
  emit this->opened(path);
  poll();
}

void DatabaseWatcher::setNames(const Names& names) {
  names_ = names;
  version_ = -1;
  poll();
}

QString DatabaseWatcher::path() const { return database_ ? QString::fromStdString(database_->path()) : QString(); }

const DatabaseWatcher::Grid* DatabaseWatcher::grid(Id id) const {
  const auto found = std::ranges::find(grids_, id, [](const Grid& grid) { return grid.record.id; });
  return found == grids_.end() ? nullptr : &*found;
}

void DatabaseWatcher::follow(Id run) {
  run_ = run;
  fresh_ = true;
  version_ = -1;
  poll();
}

void DatabaseWatcher::poll() {
  if (!database_) return;
  try {
    const auto version = database_->dataVersion();
    const bool changed = version != version_;
    version_ = version;
    if (changed) {
      const std::size_t before = runs_.size();
      runs_ = database_->runs();
      if (runs_.size() != before) readGrids();
    }
    const bool activity = readActive();
    if (changed) {
      readAll();
    } else if (activity) {
      for (const RunRecord& run : runs_)
        if (run.id == run_) emit runChanged(run, progressFromJson(run.progressJson), active_.count(run.id) > 0);
    }
    wasFailing_ = false;
  } catch (const std::exception& error) {
    // Said once; the same error four times a second would bury everything else.
    if (!wasFailing_) emit failed(QString::fromUtf8(error.what()));
    wasFailing_ = true;
  }
}

// A grid and each of its cells come with the runs that learn them, so nothing is new where no run is.
void DatabaseWatcher::readGrids() {
  grids_.clear();
  for (GridRecord& record : database_->grids()) {
    Grid& grid = grids_.emplace_back();
    for (const GridCellRecord& cell : database_->gridCells(record.id))
      if (cell.run) grid.cellOfRun[cell.run] = cell.number;
    grid.record = std::move(record);
  }
}

// A process may begin or end without writing: asked every time, for the runs that can have one.
bool DatabaseWatcher::readActive() {
  std::set<Id> active, activeGrids, ofGrids;
  for (const Grid& grid : grids_)
    if (isGridActive(database_->path(), grid.record.id)) {
      activeGrids.insert(grid.record.id);
      for (const auto& [run, cell] : grid.cellOfRun) ofGrids.insert(run);
    }
  for (const RunRecord& run : runs_)
    if ((mayWork(run.state) && ofGrids.contains(run.id)) ||
        ((mayWork(run.state) || active_.count(run.id)) && isActive_(database_->path(), run.id)))
      active.insert(run.id);
  if (active == active_ && activeGrids == activeGrids_) return false;
  active_ = active;
  activeGrids_ = activeGrids;
  emit activeChanged(active_);
  return true;
}

void DatabaseWatcher::readAll() {
  std::vector<ExperimentRecord> experiments = database_->experiments();
  for (ExperimentRecord& experiment : experiments)
    if (const auto given = names_.find(experiment.id); given != names_.end()) experiment.name = given->second;
  emit runsChanged(experiments, runs_);
  if (const auto rigs = database_->rigSimulators(0); rigVersions_ != rigs.size()) {
    rigVersions_ = rigs.size();
    emit rigsChanged(rigs);
  }
  for (const RunRecord& run : runs_) {
    const auto told = stages_.find(run.id);
    const bool stageTold = told == stages_.end() || told->second != run.stage;
    if (stageTold) {
      stages_[run.id] = run.stage;
      emit versionsChanged(run.id, database_->simulators(run.id));
    }
    if (run.id == run_) readRun(run, stageTold);
  }
}

void DatabaseWatcher::readRun(const RunRecord& run, bool stageTold) {
  const bool all = fresh_;
  fresh_ = false;
  emit runChanged(run, progressFromJson(run.progressJson), active_.count(run.id) > 0);

  // Simulators before generations: charts mark updates with them.
  const auto simulators = database_->simulators(run.id);
  if (all || simulators.size() != simulators_) {
    simulators_ = simulators.size();
    emit simulatorsChanged(run.id, simulators);
    // One that was adopted between two stages. (A stage that ended has told already.)
    if (!all && !stageTold) emit versionsChanged(run.id, simulators);
  }
  const auto generations = database_->generations(run.id, all ? 0 : lastGeneration_);
  if (all) lastGeneration_ = 0;
  if (!generations.empty()) lastGeneration_ = generations.back().number;
  if (all)
    emit generationsReset(run.id, generations);
  else if (!generations.empty())
    emit generationsAdded(run.id, generations);

  const auto gaps = database_->gaps(run.id);
  if (all || gaps.size() != gaps_) {
    gaps_ = gaps.size();
    emit gapsChanged(run.id, gaps);
  }
  auto tasks = database_->measurementTasks(run.id);
  auto measurements = database_->measurements(run.id);
  if (all || !same(tasks, tasks_) || !same(measurements, measurements_)) {
    tasks_ = std::move(tasks);
    measurements_ = std::move(measurements);
    emit tasksChanged(run.id, tasks_, measurements_);
  }
}

}  // namespace btr::ui
