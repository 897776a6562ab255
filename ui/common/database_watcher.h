#pragma once
#include <QObject>
#include <QTimer>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/run/back_to_reality.h"
#include "core/store/database.h"

namespace btr::ui {

/// Looks at a database that other processes write: every quarter of a second it asks for the data version and tells, as
/// plain values, what became new. It reads only. One run at a time is followed in detail. Errors of reading are told
/// once by failed() and tried again at the next change.
class DatabaseWatcher : public QObject {
  Q_OBJECT
 public:
  using ActiveTest = std::function<bool(const std::string& database, Id run)>;
  /// `isActive` is isRunActive() but in tests.
  explicit DatabaseWatcher(ActiveTest isActive, int interval_ms = 250, QObject* parent = nullptr);

  using Names = std::map<Id, std::string>;
  /// Opens another database and tells everything anew; `names` stand in for those of the stored experiments. Throws
  /// InputError and keeps the old one.
  void open(const QString& path, const Names& names = {});
  void setNames(const Names& names);
  bool isOpen() const { return database_.has_value(); }
  QString path() const;
  const Database& database() const { return *database_; }  ///< only while isOpen(); of the window's thread

  /// The run to follow, 0 for none; everything about it is told anew.
  void follow(Id run);
  Id followed() const { return run_; }
  std::set<Id> activeRuns() const { return active_; }  ///< also those of active grids that are not finished
  std::set<Id> activeGrids() const { return activeGrids_; }
  const std::vector<RunRecord>& runs() const { return runs_; }
  /// A grid and the runs of its cells.
  struct Grid {
    GridRecord record;
    std::map<Id, int> cellOfRun;  ///< number of the cell
  };
  const std::vector<Grid>& grids() const { return grids_; }
  const Grid* grid(Id id) const;  ///< or nothing

  /// What the timer does; also called after an own write, so that it is seen at once.
  void poll();

 signals:
  void opened(const QString& path);
  void runsChanged(const std::vector<btr::ExperimentRecord>& experiments, const std::vector<btr::RunRecord>& runs);
  /// Of any run, when it is first seen and whenever it has adapted.
  void versionsChanged(btr::Id run, const std::vector<btr::SimulatorRecord>& simulators);
  /// The versions of all rigs, by rig and number: at first, and when one came along.
  void rigsChanged(const std::vector<btr::SimulatorRecord>& versions);
  void activeChanged(const std::set<btr::Id>& active);  ///< runs or grids
  // About the followed run:
  void runChanged(const btr::RunRecord& run, const btr::RunProgress& progress, bool active);
  void generationsReset(btr::Id run, const std::vector<btr::GenerationRecord>& all);
  void generationsAdded(btr::Id run, const std::vector<btr::GenerationRecord>& added);
  void simulatorsChanged(btr::Id run, const std::vector<btr::SimulatorRecord>& simulators);
  void gapsChanged(btr::Id run, const std::vector<btr::GapRecord>& gaps);
  void tasksChanged(btr::Id run, const std::vector<btr::MeasurementTask>& tasks,
                    const std::vector<btr::MeasurementRecord>& measurements);
  void failed(const QString& message);

 private:
  void readGrids();
  void readAll();
  void readRun(const RunRecord& run, bool stageTold);
  bool readActive();

  ActiveTest isActive_;
  QTimer timer_;
  std::optional<Database> database_;
  std::int64_t version_ = -1;
  std::vector<RunRecord> runs_;
  Names names_;
  std::vector<Grid> grids_;
  std::map<Id, int> stages_;  ///< of each run, when its simulators were told
  std::set<Id> active_, activeGrids_;
  Id run_ = 0;
  std::optional<std::size_t> rigVersions_;  ///< that were told
  bool fresh_ = true;                       ///< nothing of the followed run was told yet
  bool wasFailing_ = false;
  int lastGeneration_ = 0;
  std::size_t simulators_ = 0, gaps_ = 0;
  std::vector<MeasurementTask> tasks_;
  std::vector<MeasurementRecord> measurements_;
};

}  // namespace btr::ui
