// Measuring: the sheet and the alarm that calls for it; what a person enters goes to the database here.
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>

#include "ui/charts/fitness_chart.h"
#include "ui/database/individuals_table.h"
#include "ui/experiment/run_panel.h"
#include "ui/gap/gap_page.h"
#include "ui/main_window.h"
#include "ui/measure/alarm.h"
#include "ui/measure/measurement_sheet.h"
#include "ui/measure/policy_page.h"

namespace btr::ui {

void MainWindow::connectMeasure() {
  connect(&watcher_, &DatabaseWatcher::tasksChanged, this,
          [this](Id, const auto& tasks, const auto& measurements) { showTasks(tasks, measurements); });
  connect(sheet_, &MeasurementSheet::submitted, this, &MainWindow::submit);
  connect(sheet_, &MeasurementSheet::voidRequested, this, &MainWindow::voidMeasurement);
  connect(sheet_, &MeasurementSheet::replayRequested, this, &MainWindow::replayIndividual);
  connect(sheet_, &MeasurementSheet::importRequested, this, &MainWindow::importMeasurements);
  connect(sheet_, &MeasurementSheet::continueRequested, this, [this] { continueRun(run_.id); });
  connect(policies_, &PolicyPage::replayRequested, this, &MainWindow::replayIndividual);
  connect(policies_, &PolicyPage::endRequested, this, &MainWindow::endRealityLearning);
  connect(alarm_, &Alarm::sheetRequested, this, [this] { raiseDock(sheetDock_); });
}

// The sheet shows the measurement that waits (of a stage, or of an iteration of L2), else the last one that was made.
void MainWindow::showTasks(const std::vector<MeasurementTask>& tasks,
                           const std::vector<MeasurementRecord>& measurements) {
  tasks_ = tasks;
  measurements_ = measurements;
  std::vector<MeasurementTask> latest;
  for (const MeasurementTask& task : tasks) {
    if (!latest.empty() && (latest.front().stage != task.stage || latest.front().iteration != task.iteration))
      latest.clear();
    latest.push_back(task);
  }
  sheet_->setTasks(latest);
  sheet_->setMeasurements(measurements);
  individuals_->setMeasurements(measurements);
  panel_->setMeasuring(countMeasured(run_, tasks, measurements));
  std::set<Id> withFitness;
  for (const MeasurementRecord& measurement : measurements)
    if (!measurement.isVoid) withFitness.insert(measurement.individual);
  gapPage_->setMeasured(databasePath(), run_.id, int(withFitness.size()));
  guard([&] {
    std::vector<IndividualRecord> measured;
    std::set<Id> seen;
    for (const MeasurementRecord& measurement : measurements)
      if (seen.insert(measurement.individual).second)
        measured.push_back(watcher_.database().individual(measurement.individual));
    fitness_->setMeasurements(measured, measurements);
  });
  showWaiting();
  showPolicies({});
}

// The alarm rings for a person while values are missing; a stand-in answers by itself.
void MainWindow::showWaiting() {
  const bool waits = run_.state == RunState::waiting && !isStandIn(run_);
  const MeasuringCount count = countMeasured(run_, tasks_, measurements_);
  sheet_->setWaiting(run_.state == RunState::waiting);
  const bool learnsInReality = !tasks_.empty() && tasks_.back().iteration > 0 && tasks_.back().stage == run_.stage + 1;
  policies_->setWaiting(waits && learnsInReality);
  if (waits && count.settled < count.wanted) {
    if (alarm_->state() == Alarm::State::quiet) raiseDock(sheetDock_);
    const int iteration = tasks_.empty() ? 0 : tasks_.back().iteration;
    alarm_->raiseAlarm((iteration > 0 ? tr("%1, stage %2: %3 policies of L2 wait for their real fitness.")
                                      : tr("%1, stage %2: %3 individuals wait for their real fitness."))
                           .arg(runName(run_))
                           .arg(run_.stage + 1)
                           .arg(count.wanted));
  } else {
    alarm_->clear();
  }
}

// Made anew when a policy was asked for, a value came or an iteration ended.
void MainWindow::showPolicies(const RunProgress& progress) {
  const std::vector<std::size_t> seen{static_cast<std::size_t>(run_.id),
                                      static_cast<std::size_t>(run_.stage),
                                      static_cast<std::size_t>(run_.state),
                                      static_cast<std::size_t>(run_.generation),
                                      progress.stage == "L2" ? static_cast<std::size_t>(progress.stageDone) : 0,
                                      tasks_.size(),
                                      measurements_.size()};
  if (seen == policiesSeen_) return;
  guard([&] { policies_->setReports(realityReports(watcher_.database(), run_, genotype_)); });
  policiesSeen_ = seen;
}

void MainWindow::endRealityLearning() {
  const Id run = run_.id;
  guard([&] {
    writer().endRealityLearning(run, sheet_->who().toStdString());
    inform(tr("Learning in reality of %1 ends here.").arg(runName(run_)));
    watcher_.poll();
    continueRun(run);
  });
}

void MainWindow::submit(const std::vector<MeasurementRecord>& measurements) {
  try {
    writer().addMeasurements(measurements);
  } catch (const std::exception& error) {
    return sheet_->submissionFailed(QString::fromUtf8(error.what()));
  }
  watcher_.poll();
  inform(measurements.size() == 1 ? tr("1 value stored") : tr("%1 values stored").arg(measurements.size()));
  const MeasuringCount count = countMeasured(run_, tasks_, measurements_);
  const bool complete = run_.state == RunState::waiting && count.wanted > 0 && count.settled >= count.wanted;
  if (complete && settings_.flag("continueWhenMeasured", true)) continueRun(run_.id);
}

void MainWindow::voidMeasurement(Id measurement, bool isVoid, const QString& note) {
  guard([&] {
    writer().setMeasurementVoid(measurement, isVoid, note.toStdString());
    watcher_.poll();
  });
}

void MainWindow::importMeasurements() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Import measured fitness"), QFileInfo(databasePath()).absolutePath(),
                                   tr("Tables (*.csv);;All files (*)"));
  if (!file.isEmpty()) launcher_.importFitness(databasePath(), run_.id, file);
}

}  // namespace btr::ui
