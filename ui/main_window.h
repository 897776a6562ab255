#pragma once
#include <QMainWindow>
#include <QTimer>
#include <functional>
#include <memory>
#include <optional>
#include <set>

#include "core/gap/search/gap_report.h"
#include "core/plugin/plugin_host.h"
#include "core/run/rig.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/scene_spec.h"
#include "core/store/database.h"
#include "ui/common/database_watcher.h"
#include "ui/common/settings.h"
#include "ui/experiment/run_launcher.h"
#include "ui/window/dock_layout.h"

class QDockWidget;
class QLabel;
class QMenu;

namespace btr {
struct GapReport;
struct GridSummary;
}  // namespace btr
namespace btr::ui {
class Alarm;
class ComparePage;
class ExperimentForm;
class ExperimentTree;
struct RunGroup;
class FitnessChart;
class GapChart;
class GapPage;
class GridForm;
class GridPage;
struct GridState;
struct ReplayData;
class ProgramProcess;
class MeasurementSheet;
class MessageBanner;
class PolicyPage;
class IndividualsTable;
class ReplayJob;
class ReplayPanel;
class RunPanel;
class SimulatorsPage;

struct WindowOptions {
  QString settingsFile = {};  ///< empty: the user's own
  QString program = {};       ///< that works on runs; empty: btr beside this executable
  DatabaseWatcher::ActiveTest isActive = isRunActive;
};

/// The workbench. Puts the parts together and does nothing itself: the watcher reads, the launcher starts processes,
/// the docks show. What it writes to the database are the user's own words: measurements, notes, the wish to stop.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  MainWindow(std::shared_ptr<const PluginHost> host, Theme& theme, const WindowOptions& options = {});
  ~MainWindow() override;

  /// Opens (or makes) a database and selects the run that was selected last. False, with a message, keeps the old one.
  bool openDatabase(const QString& path);
  QString databasePath() const { return watcher_.path(); }
  void selectRun(Id run);
  /// Puts an experiment file into the form. False, with a message, keeps what was there.
  bool openExperiment(const QString& file);
  void startDraft();
  void continueRun(Id run);
  void stopRun(Id run);
  void replayIndividual(Id individual);
  void replayPair(Id first, Id second);
  void replayBest();  ///< of the last generation

  /// Opens a gap report's folder in the gap page. False, with a message, keeps what was there.
  bool openReport(const QString& folder);
  /// The gap page with the experiments beside it, or the runs again.
  void showGapPage(bool on);
  /// The page of grids in their place, or the runs again.
  void showGridPage(bool on);
  void showGrid(Id grid);
  /// Copies all runs of another database into the one that is open.
  void mergeDatabase(const QString& from);

  MessageBanner& banner() { return *banner_; }
  DatabaseWatcher& watcher() { return watcher_; }
  GapPage& gapPage() { return *gapPage_; }
  GridPage& gridPage() { return *gridPage_; }
  ComparePage& comparePage() { return *comparePage_; }
  /// The page that compares runs, these ticked beside those that are ticked already.
  void compareRuns(const std::vector<Id>& runs);
  ExperimentForm& draft() { return *draft_; }
  const Settings& settings() const { return settings_; }

 protected:
  void closeEvent(QCloseEvent* event) override;
  void showEvent(QShowEvent* event) override;
  bool focusNextPrevChild(bool next) override;

 private:
  // main_window.cpp
  void makeDocks();
  void restoreWindow();
  void resetLayout();
  void keepOnScreen();
  QSize defaultSize() const;
  void report(const QString& error);
  void inform(const QString& text);
  /// Runs an action that may throw; false, with a message, if it did.
  bool guard(const std::function<void()>& action);

  // main_window_menus.cpp
  void makeMenus();
  void makeEditMenu();  ///< main_window_edit.cpp
  void fillRecent();
  void fillRunMenu();
  void fillExamples(QMenu& menu);
  void about();

  // main_window_experiment.cpp
  void newExperiment();
  void openExperimentWithDialog();
  void saveExperiment();
  void copyToDraft();
  void keepDraft();
  void restoreDraft();

  // main_window_runs.cpp
  void connectRuns();
  void launch(Id run);
  void checkLaunched();
  void checkProcesses();
  void duplicateRun(Id run);
  void editRunNote(Id run);
  void editExperimentNote(Id experiment);
  void exportRun(Id run, const QString& what);
  enum class CloseAnswer { stop, leave, cancel };
  CloseAnswer askWhileActive(const std::set<Id>& active);

  // main_window_measure.cpp
  void connectMeasure();
  void submit(const std::vector<MeasurementRecord>& measurements);
  void voidMeasurement(Id measurement, bool isVoid, const QString& note);
  void importMeasurements();
  QString parametersCsv(const std::vector<Id>& individuals) const;
  void giveParameters(const std::vector<Id>& individuals, bool asFile);
  void showTasks(const std::vector<MeasurementTask>& tasks, const std::vector<MeasurementRecord>& measurements);
  void keepMeasurements();
  void hideSimulated();
  std::function<ReplayData(Id)> replayer() const;  ///< for another thread
  void showWaiting();
  void callForPerson(const std::vector<RunRecord>& runs);
  void showPolicies(const RunProgress& progress);
  void endRealityLearning();

  // main_window_show.cpp
  void connectShow();
  void showRun(const RunRecord& run, const RunProgress& progress, bool active);
  void showSpec(const RunRecord& run);
  void showTitle();

  // main_window_compare.cpp
  void makeComparePage();
  void connectCompare();

  // main_window_grid.cpp
  void makeGridPage();
  void connectGrid();
  void readGrids();
  GridState stateOf(const GridSummary& grid) const;
  void describeGrid();
  void startGrids(const GridForm& form);
  void watchGrid();
  void stopGrid(Id grid);
  void checkGridProcess();
  bool isGridLearning();
  std::vector<RunGroup> gridsInTree() const;
  void playKick(Id grid, double distance_m, double bearing_rad, double direction_rad);

  // main_window_merge.cpp
  void connectMerge();
  void mergeWithDialog();
  void backUpWithDialog();
  QString whereItStands();

  // main_window_gap.cpp
  void makeGapPage();
  void connectGap();
  void showGhosts(std::size_t trial, double time_s);

  /// A scene that a page of gap analysis names, as the database knows it.
  struct KnownRig {
    QString file, name;  ///< empty: none
    Rig rig;
    std::vector<SimulatorRecord> versions;
  };
  void readRig(KnownRig& rig, const QString& file);
  void findVersions(KnownRig& rig);
  void showRigs();
  void takeRigs(const std::vector<SimulatorRecord>& versions);
  std::vector<SimulatorRecord> versionsOf(Id rig) const;
  void selectRig(Id rig, Id simulator);
  void showAdoption();
  QString ownerOfRecordings() const;  ///< the rig's scene; empty: the selected run's experiment
  void keepRecordings(const QStringList& files, const QString& scene);
  void takeStoredRecordings();

  /// The connection for the user's own words, opened when it is first needed.
  Database& writer();

  std::shared_ptr<const PluginHost> host_;
  Theme& theme_;
  WindowOptions options_;
  DockLayout layout_;
  Settings settings_;
  RunLauncher launcher_;
  DatabaseWatcher watcher_;
  std::optional<Database> writer_;
  std::set<Id> launched_;  ///< processes of ours whose end was not seen yet
  /// Runs whose last value was saved while their process was at work: it may have looked for the last time before.
  std::set<Id> measuredMeanwhile_;
  QTimer processes_;           ///< runs while one of them may end
  bool gridLaunched_ = false;  ///< a process of ours that learns grids, whose end was not seen yet
  RunRecord run_;              ///< the followed run as last seen
  QString unit_;
  std::vector<Parameter> genotype_;        ///< of its controller
  std::vector<std::size_t> policiesSeen_;  ///< what the page of L2 was made from
  SceneSpec runScene_;
  std::vector<SimulatorRecord> simulators_, rigVersions_;
  KnownRig setupRig_, reportRig_;
  Id shownRig_ = 0;  ///< whose versions the page of simulators shows in place of a run's
  std::vector<GapRecord> gaps_;
  std::vector<MeasurementTask> tasks_;
  std::vector<MeasurementRecord> measurements_;
  QString sheetDatabase_;  ///< that the sheet's run is of

  MessageBanner* banner_ = nullptr;
  ExperimentTree* tree_ = nullptr;
  ExperimentForm *draft_ = nullptr, *spec_ = nullptr;
  RunPanel* panel_ = nullptr;
  FitnessChart* fitness_ = nullptr;
  GapChart* gap_ = nullptr;
  GapPage* gapPage_ = nullptr;
  GridPage* gridPage_ = nullptr;
  ProgramProcess* merging_ = nullptr;
  QString mergedFrom_;
  ComparePage* comparePage_ = nullptr;
  QAction *gapAction_ = nullptr, *gridAction_ = nullptr;
  std::pair<std::shared_ptr<const GapReport>, std::size_t> ghosts_;  ///< report and trial that the 3D view shows
  bool runActive_ = false;
  SimulatorsPage* versions_ = nullptr;
  IndividualsTable* individuals_ = nullptr;
  MeasurementSheet* sheet_ = nullptr;
  PolicyPage* policies_ = nullptr;
  Alarm* alarm_ = nullptr;
  QWidget* alarmPlace_ = nullptr;
  Id waitingRun_ = 0;         ///< that the alarm leads to
  bool sheetWanted_ = false;  ///< the selected run waits for values
  ReplayPanel* replay_ = nullptr;
  ReplayJob* replayJob_ = nullptr;
  QMenu *recentMenu_ = nullptr, *runMenu_ = nullptr, *viewMenu_ = nullptr;
  QLabel *databaseLabel_ = nullptr, *activeLabel_ = nullptr;
};

}  // namespace btr::ui
