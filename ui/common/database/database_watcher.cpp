#include "ui/common/database/database_watcher.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "ui/common/database/database_news.h"

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

}  // namespace

DatabaseWatcher::DatabaseWatcher(DatabaseReader& reader, ActiveTest isActive, OwnTest isOurs, int interval_ms,
                                 QObject* parent)
    : QObject(parent), reader_(reader), isActive_(std::move(isActive)), isOurs_(std::move(isOurs)) {
  timer_.setInterval(interval_ms);
  connect(&timer_, &QTimer::timeout, this, [this] {
    if (!asking_) poll();
  });
}

std::optional<Database> DatabaseWatcher::open(const QString& path, const Names& names, Database::Mode mode) {
  std::optional<Database> writer = reader_.open(path, mode);
  names_ = names;
  version_ = -1;
  run_ = 0;
  asking_ = again_ = false;
  then_.clear();
  runs_.clear();
  experiments_.clear();
  stages_.clear();
  rigVersions_.reset();
  grids_ = std::make_shared<const std::vector<Grid>>();
  locked_.clear();
  lockedGrids_.clear();
  active_.clear();
  activeGrids_.clear();
  timer_.start();
  emit opened(path);
  poll();
  reader_.waitUntilIdle(QEventLoop::ExcludeUserInputEvents);
  return writer;
}

void DatabaseWatcher::setNames(const Names& names) {
  names_ = names;
  emit runsChanged(experiments(), runs_);
}

std::vector<ExperimentRecord> DatabaseWatcher::experiments() const {
  std::vector<ExperimentRecord> named = experiments_;
  for (ExperimentRecord& experiment : named)
    if (const auto given = names_.find(experiment.id); given != names_.end()) experiment.name = given->second;
  return named;
}

const RunRecord* DatabaseWatcher::run(Id id) const {
  const auto found = std::ranges::find(runs_, id, &RunRecord::id);
  return found == runs_.end() ? nullptr : &*found;
}

const DatabaseWatcher::Grid* DatabaseWatcher::grid(Id id) const {
  const auto found = std::ranges::find(*grids_, id, [](const Grid& grid) { return grid.record.id; });
  return found == grids_->end() ? nullptr : &*found;
}

void DatabaseWatcher::follow(Id run) {
  run_ = run;
  fresh_ = true;
  version_ = -1;
  if (isOpen()) ask();
}

void DatabaseWatcher::poll(std::function<void()> then) {
  if (!isOpen()) return;
  if (then) then_.emplace_back(asked_ + 1, std::move(then));
  try {
    tellActivity();
  } catch (const std::exception& error) {
    emit failed(QString::fromUtf8(error.what()));
  }
  if (asking_)
    again_ = true;
  else
    ask();
}

bool DatabaseWatcher::mayBeActive(const RunRecord& run) const { return mayWork(run.state) || active_.contains(run.id); }

SeenBefore DatabaseWatcher::seen() const {
  SeenBefore seen{version_, grids_, {}, active_, runs_.size(), stages_, run_, fresh_, lastGeneration_};
  for (const RunRecord& run : runs_)
    if (mayBeActive(run)) seen.mayBeActive.push_back(run.id);
  return seen;
}

// A look that is under way is given up for this one.
void DatabaseWatcher::ask() {
  asking_ = true;
  again_ = false;
  const quint64 asked = ++asked_;
  reader_.read(
      this, "news", tr("the runs"),
      [seen = seen(), isActive = isActive_](const Database& database) { return readNews(database, seen, isActive); },
      [this, asked](DatabaseNews news) { take(news, asked); }, [this](const QString& why) { fail(why); });
}

void DatabaseWatcher::take(DatabaseNews& news, quint64 asked) {
  asking_ = false;
  try {
    tellNews(news);
    wasFailing_ = false;
  } catch (const std::exception& error) {
    fail(QString::fromUtf8(error.what()));
  }
  std::vector<std::function<void()>> now;
  for (auto& [number, then] : then_)
    if (number <= asked) now.push_back(std::exchange(then, {}));
  std::erase_if(then_, [](const auto& waiting) { return !waiting.second; });
  for (const auto& then : now) then();
  if (again_ && !asking_) ask();
}

void DatabaseWatcher::fail(const QString& why) {
  asking_ = false;
  // Said once; the same error four times a second would bury everything else.
  if (!std::exchange(wasFailing_, true)) emit failed(why);
  if (again_) ask();
}

// Who follows another run by now, in a slot of what is told here, gets that run's news by itself.
void DatabaseWatcher::tellNews(DatabaseNews& news) {
  locked_ = std::move(news.locked);
  lockedGrids_ = std::move(news.lockedGrids);
  grids_ = news.grids;
  if (!news.changed) return tellActivity();
  version_ = news.version;
  runs_ = std::move(news.runs);
  experiments_ = std::move(news.experiments);
  tellActive();
  emit runsChanged(experiments(), runs_);
  if (rigVersions_ != news.rigs.size()) {
    rigVersions_ = news.rigs.size();
    emit rigsChanged(news.rigs);
  }
  for (const RunRecord& run : std::vector(runs_)) {
    const auto versions = news.versions.find(run.id);
    if (versions != news.versions.end()) {
      stages_[run.id] = run.stage;
      emit versionsChanged(run.id, versions->second);
    }
    if (news.run && run.id == news.run->record.id) tellRun(*news.run, versions != news.versions.end());
  }
  if (news.failedRun != 0 && news.failedRun == run_ && fresh_)
    emit followFailed(std::exchange(run_, 0), QString::fromStdString(news.runProblem));
}

// A process of ours counts from its start on. True if somebody began or ended.
bool DatabaseWatcher::tellActive() {
  std::set<Id> active, ofGrids;
  for (const Grid& grid : *grids_)
    if (lockedGrids_.contains(grid.record.id))
      for (const auto& [run, cell] : grid.cellOfRun) ofGrids.insert(run);
  for (const RunRecord& run : runs_)
    if ((mayWork(run.state) && ofGrids.contains(run.id)) ||
        (mayBeActive(run) && (locked_.contains(run.id) || (isOurs_ && isOurs_(run.id)))))
      active.insert(run.id);
  if (active == active_ && lockedGrids_ == activeGrids_) return false;
  active_ = active;
  activeGrids_ = lockedGrids_;
  emit activeChanged(active_);
  return true;
}

void DatabaseWatcher::tellActivity() {
  if (!tellActive() || fresh_) return;
  if (const RunRecord* followed = run(run_))
    emit runChanged(RunRecord(*followed), progressFromJson(followed->progressJson), active_.contains(run_));
}

void DatabaseWatcher::tellRun(RunNews& found, bool versionsTold) {
  const RunRecord& run = found.record;
  const bool all = found.all;
  if (run.id != run_ || all != fresh_) return;
  fresh_ = false;
  if (all) emit followedRun(run);
  emit runChanged(run, progressFromJson(run.progressJson), active_.contains(run.id));

  // Simulators before generations: charts mark updates with them.
  if (all || found.simulators.size() != simulators_) {
    simulators_ = found.simulators.size();
    emit simulatorsChanged(run.id, found.simulators);
    // One that was adopted between two stages. (A stage that ended has told already.)
    if (!all && !versionsTold) emit versionsChanged(run.id, found.simulators);
  }
  if (all) lastGeneration_ = 0;
  if (!found.generations.empty()) lastGeneration_ = found.generations.back().number;
  if (all)
    emit generationsReset(run.id, found.generations);
  else if (!found.generations.empty())
    emit generationsAdded(run.id, found.generations);

  if (all || found.gaps.size() != gaps_) {
    gaps_ = found.gaps.size();
    emit gapsChanged(run.id, found.gaps);
  }
  if (all || !same(found.tasks, tasks_) || !same(found.measurements, measurements_)) {
    tasks_ = std::move(found.tasks);
    measurements_ = std::move(found.measurements);
    emit tasksChanged(run.id, tasks_, measurements_);
  }
  if (all) emit followedRunTold();
}

}  // namespace btr::ui
