// What the user asks of runs: start, continue, stop, duplicate, notes, exports, and what happens to them at the end.
#include <QApplication>
#include <QDir>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QInputDialog>
#include <QMessageBox>
#include <QPushButton>
#include <QStatusBar>
#include <utility>

#include "ui/common/message_banner.h"
#include "ui/experiment/experiment_form.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/experiment/run_panel.h"
#include "ui/experiment/run_text.h"
#include "ui/main_window.h"

namespace btr::ui {

void MainWindow::connectRuns() {
  processes_.setInterval(500);
  connect(&processes_, &QTimer::timeout, this, &MainWindow::checkProcesses);
  connect(tree_, &ExperimentTree::continueRequested, this, &MainWindow::continueRun);
  connect(tree_, &ExperimentTree::stopRequested, this, &MainWindow::stopRun);
  connect(tree_, &ExperimentTree::duplicateRequested, this, &MainWindow::duplicateRun);
  connect(tree_, &ExperimentTree::runNoteRequested, this, &MainWindow::editRunNote);
  connect(tree_, &ExperimentTree::experimentNoteRequested, this, &MainWindow::editExperimentNote);
  connect(tree_, &ExperimentTree::exportRequested, this, &MainWindow::exportRun);
  connect(panel_, &RunPanel::continueRequested, this, &MainWindow::continueRun);
  connect(panel_, &RunPanel::stopRequested, this, &MainWindow::stopRun);
  panel_->setJobs(settings_.jobs());
  connect(panel_, &RunPanel::jobsChanged, this, [this](int jobs) { settings_.setJobs(jobs); });

  connect(draft_, &ExperimentForm::startRequested, this, &MainWindow::startDraft);
  connect(draft_, &ExperimentForm::saveRequested, this, &MainWindow::saveExperiment);
  connect(draft_, &ExperimentForm::openRequested, this, &MainWindow::openExperimentWithDialog);
  connect(spec_, &ExperimentForm::copyRequested, this, &MainWindow::copyToDraft);

  connect(&launcher_, &RunLauncher::failed, this, [this](const QString& why) {
    statusBar()->clearMessage();
    report(why);
  });
  connect(&launcher_, &RunLauncher::exported, this,
          [this](const QString& file) { inform(tr("Written: %1").arg(file)); });
  // Shown until the next message: in what the started run differs from the one whose experiment was edited.
  connect(
      &launcher_, &RunLauncher::edited, this, [this](const QString& differences) { inform(differences); },
      Qt::QueuedConnection);
  connect(&launcher_, &RunLauncher::backedUp, this,
          [this](const QString& file) { inform(tr("A checked copy of the database is in %1").arg(file)); });
  connect(&launcher_, &RunLauncher::imported, this, [this](const QString& file) {
    watcher_.poll();
    inform(tr("Imported: %1").arg(file));
  });
  connect(&launcher_, &RunLauncher::stored, this, [this](Id run) {
    watcher_.poll();
    statusBar()->clearMessage();
    selectRun(run);
    continueRun(run);
  });
}

void MainWindow::startDraft() {
  if (!watcher_.isOpen())
    return report(tr("Open or make a database first: a run is stored from its first generation on."));
  if (!draft_->isValid()) {
    layout_.raise("draft");
    return report(draft_->problems().first());
  }
  const ExperimentSpec spec = draft_->spec();
  inform(tr("Preparing %1 …").arg(QString::fromStdString(spec.name)));
  launcher_.store(databasePath(), spec, spec.seed, false);
}

void MainWindow::continueRun(Id run) {
  if (run == 0 || watcher_.activeRuns().count(run)) return;
  guard([&] {
    const RunRecord record = watcher_.database().run(run);
    if (record.state == RunState::finished)
      return inform(tr("%1 is finished: the same experiment and seed give the same bits.").arg(runName(record)));
    if (record.stopRequested) writer().requestStop(run, false);
    launch(run);
  });
}

void MainWindow::launch(Id run) {
  if (!launcher_.work(databasePath(), run, panel_->jobs())) return;
  banner_->clear();
  launched_.insert(run);
  processes_.start();
  watcher_.poll();
}

// A process may end before it has locked anything.
void MainWindow::checkProcesses() {
  checkLaunched();
  checkGridProcess();
  if (launched_.empty() && !gridLaunched_) processes_.stop();
}

// A process that ends without leaving its run waiting, stopped or finished has something to say.
void MainWindow::checkLaunched() {
  for (const Id run : std::exchange(measuredMeanwhile_, {})) {
    if (watcher_.activeRuns().count(run) > 0)
      measuredMeanwhile_.insert(run);
    else
      guard([&] {
        const Database& db = watcher_.database();
        const RunRecord record = db.run(run);
        const MeasuringCount count = countMeasured(record, db.measurementTasks(run), db.measurements(run));
        if (record.state == RunState::waiting && count.settled >= count.wanted) continueRun(run);
      });
  }
  for (auto run = launched_.begin(); run != launched_.end();) {
    if (launcher_.isAlive(*run)) {
      ++run;
      continue;
    }
    guard([&] {
      const RunRecord record = watcher_.database().run(*run);
      const QString words = launcher_.lastWords(*run);
      const bool fine =
          record.state == RunState::waiting || record.state == RunState::stopped || record.state == RunState::finished;
      if (!fine)
        report(tr("%1 ended: %2").arg(runName(record), words.isEmpty() ? tr("its process said nothing.") : words));
    });
    run = launched_.erase(run);
  }
}

void MainWindow::stopRun(Id run) {
  if (run == 0) return;
  guard([&] {
    writer().requestStop(run, true);
    watcher_.poll();
    inform(tr("Asked run %1 to stop; what it has done is kept.").arg(run));
  });
}

void MainWindow::duplicateRun(Id run) {
  guard([&] {
    const RunRecord record = watcher_.database().run(run);
    bool ok = false;
    const QString typed = QInputDialog::getText(this, tr("Duplicate with another seed"),
                                                tr("Seed (a whole number from 0 to 9007199254740991):"),
                                                QLineEdit::Normal, QString::number(record.seed + 1), &ok);
    if (!ok) return;
    const quint64 seed = typed.trimmed().toULongLong(&ok);
    if (!ok || seed > 9007199254740991ULL)
      return report(tr("Seed: %1 is not allowed; a whole number from 0 to 9007199254740991").arg(typed));
    launcher_.duplicate(databasePath(), run, seed);
  });
}

void MainWindow::editRunNote(Id run) {
  guard([&] {
    bool ok = false;
    const RunRecord record = watcher_.database().run(run);
    const QString note = QInputDialog::getText(this, tr("Note"), tr("Note on %1:").arg(runName(record)),
                                               QLineEdit::Normal, QString::fromStdString(record.note), &ok);
    if (!ok) return;
    writer().setRunNote(run, note.trimmed().toStdString());
    watcher_.poll();
  });
}

void MainWindow::editExperimentNote(Id experiment) {
  guard([&] {
    bool ok = false;
    const ExperimentRecord record = watcher_.database().experiment(experiment);
    const QString note =
        QInputDialog::getText(this, tr("Note"), tr("Note on %1:").arg(QString::fromStdString(record.name)),
                              QLineEdit::Normal, QString::fromStdString(record.note), &ok);
    if (!ok) return;
    writer().setExperimentNote(experiment, note.trimmed().toStdString());
    watcher_.poll();
  });
}

void MainWindow::exportRun(Id run, const QString& what) {
  if (run == 0) return;
  const QString suggestion =
      QFileInfo(databasePath()).dir().filePath(QStringLiteral("run%1-%2.csv").arg(run).arg(what));
  const QString file = QFileDialog::getSaveFileName(this, tr("Export"), suggestion, tr("Tables (*.csv)"));
  if (!file.isEmpty()) launcher_.exportCsv(databasePath(), run, what, file);
}

MainWindow::CloseAnswer MainWindow::askWhileActive(const std::set<Id>& active) {
  QMessageBox box(this);
  box.setObjectName("closeQuestion");
  box.setIcon(QMessageBox::Question);
  box.setWindowTitle(tr("A run is working"));
  box.setText(active.size() == 1 ? tr("Run %1 is still learning.").arg(*active.begin())
                                 : tr("%1 runs are still learning.").arg(active.size()));
  box.setInformativeText(
      tr("It can go on without the window and will be found here again. If it is stopped, it can be continued with the "
         "same bits."));
  auto* leave = box.addButton(tr("Leave it running"), QMessageBox::AcceptRole);
  auto* stop = box.addButton(tr("Stop it"), QMessageBox::DestructiveRole);
  auto* cancel = box.addButton(tr("Cancel"), QMessageBox::RejectRole);
  leave->setObjectName("leave");
  stop->setObjectName("stop");
  cancel->setObjectName("cancel");
  box.setDefaultButton(leave);
  box.setEscapeButton(cancel);
  box.exec();
  if (box.clickedButton() == stop) return CloseAnswer::stop;
  return box.clickedButton() == leave ? CloseAnswer::leave : CloseAnswer::cancel;
}

}  // namespace btr::ui
