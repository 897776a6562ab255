#pragma once
#include <QMainWindow>
#include <memory>

#include "ui/controllers/workbench.h"
#include "ui/window/dock_layout.h"
#include "ui/window/window_pages.h"

namespace btr::ui {
class CompareController;
class DraftController;
class GridController;
class MeasureController;
class MessageBanner;
class ReplayController;
class RunController;
class WindowMessages;
class WindowPlace;

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
  /// A game, scene or robot file, or a session's log, on the scene page.
  void openScene(const QString& file);
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
  MessageBanner& banner();
  ExperimentForm& draft() { return *pages_.draft; }
  GapPage& gapPage() { return *pages_.gapPage; }
  GridPage& gridPage() { return *pages_.gridPage; }
  ComparePage& comparePage() { return *pages_.comparePage; }

 protected:
  void closeEvent(QCloseEvent* event) override;
  bool focusNextPrevChild(bool next) override;

 private:
  void makeControllers();
  void raise(const QString& dock);

  Theme& theme_;
  DockLayout layout_;
  Workbench bench_;
  WindowPages pages_;
  // Owned by the workbench.
  DraftController* drafts_ = nullptr;
  RunController* runs_ = nullptr;
  MeasureController* measuring_ = nullptr;
  ReplayController* replays_ = nullptr;
  GridController* grids_ = nullptr;
  CompareController* comparing_ = nullptr;
  // Owned by the window.
  WindowMessages* messages_ = nullptr;
  WindowPlace* place_ = nullptr;
};

}  // namespace btr::ui
