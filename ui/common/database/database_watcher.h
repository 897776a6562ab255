#pragma once
#include <QObject>
#include <QTimer>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "core/run/loop/back_to_reality.h"
#include "ui/common/database/database_reader.h"

namespace btr::ui {

struct SeenBefore;
struct DatabaseNews;
struct RunNews;

/// Looks at a database that other processes write: every quarter of a second it asks the reader for the data version
/// and tells, as plain values, what became new. One run at a time is followed in detail. Errors of reading are reported
/// once by failed(), until reading succeeds again.
class DatabaseWatcher : public QObject {
  Q_OBJECT
 public:
  /// Whether a process holds the run's lock; called in the reader's thread.
  using ActiveTest = std::function<bool(const std::string& database, Id run)>;
  /// Whether a process of ours lives that works on the run: until it holds the lock nobody else can tell.
  using OwnTest = std::function<bool(Id run)>;
  /// `isActive` is isRunActive() but in tests.
  DatabaseWatcher(DatabaseReader& reader, ActiveTest isActive, OwnTest isOurs = {}, int interval_ms = 250,
                  QObject* parent = nullptr);

  using Names = std::map<Id, std::string>;
  /// Opens another database and tells its runs; `names` stand in for those of the stored experiments. Returns when they
  /// are told (see DatabaseReader::open, also for `mode` and what is returned). Throws InputError and keeps the old
  /// one.
  std::optional<Database> open(const QString& path, const Names& names = {},
                               Database::Mode mode = Database::Mode::readOnly);
  void setNames(const Names& names);
  bool isOpen() const { return reader_.isOpen(); }
  QString path() const { return reader_.path(); }

  /// The run to follow, 0 for none; everything about it is reported anew, after followed(). What is not told by then of
  /// the run that was followed before never is.
  void follow(Id run);
  Id followed() const { return run_; }
  std::set<Id> activeRuns() const { return active_; }  ///< also those of active grids that are not finished
  std::set<Id> activeGrids() const { return activeGrids_; }
  const std::vector<RunRecord>& runs() const { return runs_; }  ///< as last seen, without files and genes
  const RunRecord* run(Id id) const;                            ///< or nothing
  std::vector<ExperimentRecord> experiments() const;            ///< with the user's names
  /// A grid and the runs of its cells.
  struct Grid {
    GridRecord record;
    std::map<Id, int> cellOfRun;  ///< number of the cell
  };
  const std::vector<Grid>& grids() const { return *grids_; }
  const Grid* grid(Id id) const;  ///< or nothing

  /// What the timer does; also asked for after an own write, so that it is seen soon. `then` is called when what was
  /// stored by now has been reported.
  void poll(std::function<void()> then = {});

 signals:
  void opened(const QString& path);
  void runsChanged(const std::vector<btr::ExperimentRecord>& experiments, const std::vector<btr::RunRecord>& runs);
  /// Of any run, when it is first seen and whenever it has adapted.
  void versionsChanged(btr::Id run, const std::vector<btr::SimulatorRecord>& simulators);
  /// The versions of all rigs, by rig and number: at first, and when one came along.
  void rigsChanged(const std::vector<btr::SimulatorRecord>& versions);
  void activeChanged(const std::set<btr::Id>& active);  ///< runs or grids
  /// Before and after all that is reported of another run to follow.
  void followedRun(const btr::RunRecord& run);
  void followedRunTold();
  void followFailed(btr::Id run, const QString& why);  ///< it cannot be read; nothing is followed
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
  SeenBefore seen() const;
  void ask();
  void take(DatabaseNews& news, quint64 asked);
  void tellNews(DatabaseNews& news);
  void tellRun(RunNews& found, bool versionsTold);
  bool tellActive();
  void tellActivity();
  void fail(const QString& why);
  bool mayBeActive(const RunRecord& run) const;

  DatabaseReader& reader_;
  ActiveTest isActive_;
  OwnTest isOurs_;
  QTimer timer_;
  bool asking_ = false, again_ = false;
  quint64 asked_ = 0;
  std::vector<std::pair<quint64, std::function<void()>>> then_;  ///< and the number of the look that they wait for
  std::int64_t version_ = -1;
  std::vector<RunRecord> runs_;
  std::vector<ExperimentRecord> experiments_;  ///< as stored
  Names names_;
  std::shared_ptr<const std::vector<Grid>> grids_ = std::make_shared<const std::vector<Grid>>();
  std::map<Id, int> stages_;           ///< of each run, when its simulators were reported
  std::set<Id> locked_, lockedGrids_;  ///< by some process
  std::set<Id> active_, activeGrids_;
  Id run_ = 0;
  std::optional<std::size_t> rigVersions_;  ///< that were reported
  bool fresh_ = true;                       ///< nothing of the followed run was reported yet
  bool wasFailing_ = false;
  int lastGeneration_ = 0;
  std::size_t simulators_ = 0, gaps_ = 0;
  std::vector<MeasurementTask> tasks_;
  std::vector<MeasurementRecord> measurements_;
};

}  // namespace btr::ui
