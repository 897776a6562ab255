// Gap analysis in the window: its page, what it needs of the selected run, adoption and going back.
#include <QDir>
#include <QDockWidget>
#include <QFileDialog>
#include <QMessageBox>

#include "core/run/stored_recordings.h"
#include "core/spec/json_reader.h"
#include "ui/experiment/run_text.h"
#include "ui/gap/analysis_setup.h"
#include "ui/gap/gap_page.h"
#include "ui/gap/ghost_replay.h"
#include "ui/gap/report_view.h"
#include "ui/main_window.h"
#include "ui/scene3d/replay_panel.h"

namespace btr::ui {

void MainWindow::makeGapPage() {
  gapPage_ = new GapPage(launcher_.program(), this);
  gapPageDock_ = addDock("analysis", tr("Gap analysis"), "office-chart-area", gapPage_);
}

void MainWindow::connectGap() {
  connect(gapPage_, &GapPage::failed, this, &MainWindow::report);
  connect(gapPage_, &GapPage::informed, this, &MainWindow::inform);
  connect(gapPage_, &GapPage::adoptRequested, this, [this](const QString& simulator, const QString& folder) {
    if (run_.id != 0) launcher_.adopt(databasePath(), run_.id, simulator, folder);
  });
  connect(gapPage_, &GapPage::revertRequested, this, [this] {
    if (run_.id != 0) launcher_.revert(databasePath(), run_.id);
  });
  connect(&launcher_, &RunLauncher::simulatorChanged, this, [this](Id run) {
    watcher_.poll();
    if (run == run_.id && !simulators_.empty())
      inform(tr("Run %1 goes on with simulator version %2.").arg(run).arg(simulators_.back().number));
  });
  connect(&launcher_, &RunLauncher::recordingsKept, this,
          [this](int files) { inform(tr("%1 recordings are kept in the database.").arg(files)); });
  connect(gapPage_, &GapPage::timeChosen, this, &MainWindow::showGhosts);
  connect(&gapPage_->setup(), &AnalysisSetup::keepRequested, this, &MainWindow::keepRecordings);
  connect(&gapPage_->setup(), &AnalysisSetup::storedRequested, this, &MainWindow::takeStoredRecordings);
  showAdoption();
}

// A run takes another simulator while no process works on it and it is not finished.
void MainWindow::showAdoption() {
  if (!watcher_.isOpen() || run_.id == 0) {
    gapPage_->setMeasured({}, 0, 0);
    return gapPage_->setRun({}, {}, {});
  }
  QString why;
  if (runActive_ || watcher_.activeRuns().count(run_.id))
    why = tr("A process works on the run: another simulator is taken while it waits for measurements or is stopped.");
  else if (run_.state == RunState::finished)
    why = tr("The run is finished: another simulator is taken while a run waits for measurements or is stopped.");
  gapPage_->setRun(runName(run_), simulators_, why);
}

void MainWindow::showGapPage(bool on) {
  givePage(gapPageDock_, gapAction_, on);
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

void MainWindow::keepRecordings(const QStringList& files, const QString& scene) {
  if (files.isEmpty()) return report(tr("Add recordings first."));
  if (!watcher_.isOpen() || run_.id == 0)
    return report(tr("Select a run first: recordings are kept with its experiment."));
  launcher_.keepRecordings(databasePath(), run_.id, files, scene);
}

// Written out as files, beside which mappings and the report stay.
void MainWindow::takeStoredRecordings() {
  if (!watcher_.isOpen() || run_.id == 0)
    return report(tr("Select a run first: recordings are kept with its experiment."));
  guard([this] {
    const auto stored = watcher_.database().recordings(run_.experiment);
    if (stored.empty()) return inform(tr("No recordings are kept with the experiment of run %1.").arg(run_.id));
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Folder for the recordings"));
    if (folder.isEmpty()) return;
    QStringList files;
    for (const RecordingRecord& recording : stored)
      files << QString::fromStdString(exportRecording(watcher_.database(), recording.id, folder.toStdString()));
    gapPage_->setup().addRecordings(files);
  });
}

}  // namespace btr::ui
