// Gap analysis in the window: its page, adoption and going back, ghosts.
#include <QDockWidget>

#include "ui/experiment/experiment_tree.h"
#include "ui/gap/analysis_setup.h"
#include "ui/gap/gap_page.h"
#include "ui/gap/ghost_replay.h"
#include "ui/gap/report_view.h"
#include "ui/main_window.h"
#include "ui/scene3d/replay_panel.h"

namespace btr::ui {

void MainWindow::makeGapPage() {
  gapPage_ = new GapPage(launcher_.program(), this);
  layout_.addPage("analysis", tr("Gap analysis"), "office-chart-area", gapPage_, {"tree", "replay"});
}

void MainWindow::connectGap() {
  connect(gapPage_, &GapPage::failed, this, &MainWindow::report);
  connect(gapPage_, &GapPage::informed, this, &MainWindow::inform);
  connect(gapPage_, &GapPage::adoptRequested, this,
          [this](const QString& simulator, const QString& folder, const QString& rig) {
            if (run_.id != 0 || !rig.isEmpty()) launcher_.adopt(databasePath(), run_.id, rig, simulator, folder);
          });
  connect(gapPage_, &GapPage::revertRequested, this, [this](const QString& rig) {
    if (run_.id != 0 || !rig.isEmpty()) launcher_.revert(databasePath(), run_.id, rig);
  });
  connect(gapPage_, &GapPage::reportOpened, this, &MainWindow::showRigs);
  connect(&gapPage_->setup(), &AnalysisSetup::sceneChanged, this, &MainWindow::showRigs);
  connect(&watcher_, &DatabaseWatcher::rigsChanged, this, &MainWindow::takeRigs);
  connect(tree_, &ExperimentTree::rigSelected, this, &MainWindow::selectRig);
  connect(&launcher_, &RunLauncher::simulatorChanged, this, [this](Id run, const QString& rig) {
    watcher_.poll();
    if (rig.isEmpty()) {
      if (run == run_.id && !simulators_.empty())
        inform(tr("Run %1 goes on with simulator version %2.").arg(run).arg(simulators_.back().number));
    } else if (!reportRig_.versions.empty()) {
      inform(tr("%1 has simulator version %2 now.").arg(reportRig_.name).arg(reportRig_.versions.back().number));
    }
  });
  connect(&launcher_, &RunLauncher::recordingsKept, this,
          [this](int files) { inform(tr("%1 recordings are kept in the database.").arg(files)); });
  connect(gapPage_, &GapPage::timeChosen, this, &MainWindow::showGhosts);
  connect(&gapPage_->setup(), &AnalysisSetup::keepRequested, this, &MainWindow::keepRecordings);
  connect(&gapPage_->setup(), &AnalysisSetup::storedRequested, this, &MainWindow::takeStoredRecordings);
  showAdoption();
}

void MainWindow::showGapPage(bool on) {
  layout_.showPage(on ? QStringLiteral("analysis") : QString());
  if (on) gapPage_->setFocus();
}

bool MainWindow::openReport(const QString& folder) {
  showGapPage(true);
  return gapPage_->openReport(folder);
}

// The chosen trial in 3D, in the scene that the report was made with; else the pane says why not.
void MainWindow::showGhosts(std::size_t trial, double time_s) {
  if (const std::pair wanted(gapPage_->view().report(), trial); ghosts_ != wanted) {
    guard([&] {
      ghosts_ = wanted;
      const ReportScene known = sceneOf(*wanted.first);
      if (!known.problem.isEmpty()) return replay_->showMessage(known.problem);
      const auto shown = ghostTrial(*wanted.first, trial, known.scene, known.models);
      if (!shown) return replay_->showMessage(tr("Nothing of the report's scene was recorded in this trial."));
      replay_->setReplay(shown->recorded);
      replay_->setGhosts(shown->ghosts);
    });
  }
  replay_->showTime(time_s);
}

}  // namespace btr::ui
