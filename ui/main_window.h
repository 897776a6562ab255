#pragma once
#include <QMainWindow>
#include <memory>

#include "ui/controllers/workbench.h"
#include "ui/window/dock_layout.h"

class QLabel;
class QToolBar;

namespace btr::ui {
class CompareController;
class ComparePage;
class DraftController;
class ExperimentForm;
class GapPage;
class GridController;
class GridPage;
class MeasureController;
class MessageBanner;
class ReplayController;
class RigController;
class RunController;
class RunViews;
struct WindowPages;

/// The workbench. Puts the parts together and does nothing itself: the workbench knows database and selection, the
/// controllers act, the docks show.
class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  MainWindow(std::shared_ptr<const PluginHost> host, Theme& theme, const WindowOptions& options = {});
  ~MainWindow() override;

  /// Opens a database and selects the run that was selected last. False, with a message, keeps the old one.
  bool openDatabase(const QString& path, Workbench::Absent absent = Workbench::Absent::ask);
  void selectRun(Id run) { bench_.selectRun(run); }
  /// Opens a gap report's folder in the gap page. False, with a message, keeps what was there.
  bool openReport(const QString& folder);
  /// One of "start", "analysis" and "grid" in place of the runs' docks; an empty name: the runs again.
  void showPage(const QString& page);
  /// The start page, if nothing waits to be gone on with and the user has not turned it off.
  void showStartIfIdle();
  void compareRuns(const std::vector<Id>& runs);

  Workbench& bench() { return bench_; }
  DraftController& drafts() { return *drafts_; }
  RunController& runs() { return *runs_; }
  ReplayController& replays() { return *replays_; }
  GridController& grids() { return *grids_; }
  MessageBanner& banner() { return *banner_; }
  ExperimentForm& draft();
  GapPage& gapPage();
  GridPage& gridPage();
  ComparePage& comparePage();

 protected:
  void closeEvent(QCloseEvent* event) override;
  void showEvent(QShowEvent* event) override;
  bool focusNextPrevChild(bool next) override;

 private:
  void makeDocks();
  void makeMessages();
  void makeControllers();
  void connectTree();
  void connectStart();
  void connectDrops();
  void raise(const QString& dock);
  void restoreWindow();
  void resetLayout();
  void keepOnScreen();
  QSize defaultSize() const;
  void showTitle();

  Theme& theme_;
  DockLayout layout_;
  Workbench bench_;
  std::unique_ptr<WindowPages> pages_;
  // Owned by the workbench.
  DraftController* drafts_ = nullptr;
  RunController* runs_ = nullptr;
  RunViews* views_ = nullptr;
  MeasureController* measuring_ = nullptr;
  ReplayController* replays_ = nullptr;
  GridController* grids_ = nullptr;
  RigController* rigs_ = nullptr;
  CompareController* comparing_ = nullptr;

  MessageBanner* banner_ = nullptr;
  QToolBar* messages_ = nullptr;
  QLabel *databaseLabel_ = nullptr, *activeLabel_ = nullptr;
};

}  // namespace btr::ui
