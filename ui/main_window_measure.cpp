// Measuring: the sheet and the alarm that calls for it; what a person enters goes to the database here.
#include <QApplication>
#include <QClipboard>
#include <QDir>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>

#include "core/run/adoption.h"
#include "core/run/prepared_experiment.h"
#include "core/run/resting_simulator.h"
#include "core/spec/json_reader.h"
#include "ui/charts/fitness_chart.h"
#include "ui/charts/plot_data.h"
#include "ui/database/individuals_table.h"
#include "ui/experiment/run_panel.h"
#include "ui/gap/gap_page.h"
#include "ui/main_window.h"
#include "ui/measure/alarm.h"
#include "ui/measure/measured_questions.h"
#include "ui/measure/measurement_sheet.h"
#include "ui/measure/policy_page.h"

namespace btr::ui {

void MainWindow::connectMeasure() {
  connect(&watcher_, &DatabaseWatcher::tasksChanged, this,
          [this](Id, const auto& tasks, const auto& measurements) { showTasks(tasks, measurements); });
  connect(&sheet_->model(), &MeasurementModel::draftChanged, this, &MainWindow::keepMeasurements);
  connect(&sheet_->model(), &MeasurementModel::changed, this, &MainWindow::hideSimulated);
  connect(sheet_, &MeasurementSheet::submitted, this, &MainWindow::submit);
  connect(sheet_, &MeasurementSheet::voidRequested, this, &MainWindow::voidMeasurement);
  connect(sheet_, &MeasurementSheet::replayRequested, this, &MainWindow::replayIndividual);
  connect(sheet_, &MeasurementSheet::importRequested, this, &MainWindow::importMeasurements);
  connect(sheet_, &MeasurementSheet::continueRequested, this, [this] { continueRun(run_.id); });
  connect(sheet_, &MeasurementSheet::parametersRequested, this, &MainWindow::giveParameters);
  connect(policies_, &PolicyPage::replayRequested, this, &MainWindow::replayIndividual);
  connect(policies_, &PolicyPage::endRequested, this, &MainWindow::endRealityLearning);
  connect(&watcher_, &DatabaseWatcher::runsChanged, this,
          [this](const auto&, const std::vector<RunRecord>& runs) { guard([&] { callForPerson(runs); }); });
  connect(alarm_, &Alarm::sheetRequested, this, [this] {
    selectRun(waitingRun_);
    sheet_->showNewest();
    layout_.raise("sheet");
  });
}

// What an earlier session or another look at this run has left unsaved comes back with it.
void MainWindow::showTasks(const std::vector<MeasurementTask>& tasks,
                           const std::vector<MeasurementRecord>& measurements) {
  tasks_ = tasks;
  measurements_ = measurements;
  const Id before = sheet_->model().run();
  sheet_->setTasks(tasks);
  sheet_->setMeasurements(measurements);
  if (sheet_->model().run() != before) {
    sheetDatabase_ = databasePath();
    sheet_->setDraft(draftFromText(settings_.measurementDraft(sheetDatabase_, sheet_->model().run())));
  }
  individuals_->setMeasurements(measurements);
  hideSimulated();
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

// Whoever measures shall not read elsewhere what the sheet hides.
void MainWindow::hideSimulated() {
  std::set<Id> hidden;
  const MeasuringCount count = countMeasured(run_, tasks_, measurements_);
  if (!sheet_->model().isSimulatedShown() && count.settled < count.wanted)
    for (const MeasurementTask& task : tasks_)
      if (task.stage == run_.stage + 1 && task.iteration == count.iteration) hidden.insert(task.individual);
  individuals_->setHidden(hidden);
  panel_->setBlind(!hidden.empty());
}

// What the pages say while the selected run waits. Its process may be at work: right after the last value, or on L3
// while a person tries the policies of L2.
void MainWindow::showWaiting() {
  const MeasuringCount count = countMeasured(run_, tasks_, measurements_);
  const bool waits = run_.state == RunState::waiting && (!runActive_ || count.settled < count.wanted);
  const bool wanted = waits && !isStandIn(run_) && count.settled < count.wanted;
  // Who is on a page stays there; the alarm rings, and the sheet is in front when the page is left.
  if (wanted && !sheetWanted_ && layout_.page().isEmpty()) layout_.raise("sheet");
  sheetWanted_ = wanted;
  sheet_->setWaiting(waits);
  sheet_->setGoesOnByItself(settings_.flag("continueWhenMeasured", true));
  const bool learnsInReality = !tasks_.empty() && tasks_.back().iteration > 0 && tasks_.back().stage == run_.stage + 1;
  policies_->setWaiting(waits && !isStandIn(run_) && learnsInReality);
}

// The alarm rings for a person while values are missing, whichever run is selected; a stand-in answers by itself.
void MainWindow::callForPerson(const std::vector<RunRecord>& runs) {
  QStringList others;
  QString message;
  Id first = 0;
  for (const RunRecord& run : runs) {
    if (run.state != RunState::waiting || isStandIn(run)) continue;
    const MeasuringCount count =
        countMeasured(run, watcher_.database().measurementTasks(run.id), watcher_.database().measurements(run.id));
    if (count.settled >= count.wanted) continue;
    if (first != 0) {
      others << QString::number(run.id);
      continue;
    }
    first = run.id;
    message = (count.iteration > 0 ? tr("%1, stage %2: %3 policies of L2 wait for their real fitness.")
                                   : tr("%1, stage %2: %3 individuals wait for their real fitness."))
                  .arg(runName(run))
                  .arg(run.stage + 1)
                  .arg(count.wanted);
  }
  waitingRun_ = first;
  if (first == 0) return alarm_->clear();
  if (!others.isEmpty())
    message += ' ' + (others.size() == 1 ? tr("Run %1 waits too.") : tr("Runs %1 wait too.")).arg(others.join(", "));
  alarm_->raiseAlarm(message);
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

// Typed beside the robot and not saved yet: kept for its run, whatever is looked at next.
void MainWindow::keepMeasurements() {
  const MeasurementModel& model = sheet_->model();
  if (model.run() != 0) settings_.setMeasurementDraft(sheetDatabase_, model.run(), toText(model.draft()));
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

// People copy the file alone: what was typed is in it, or it is said that it is not.
QString MainWindow::whereItStands() {
  bool inFile = false;
  guard([&] { inFile = writer().moveLogIntoFile(0); });
  return inFile ? QString()
                : tr("; another process reads an older state, so it still stands in the log beside the file: copy with "
                     "File, Back up");
}

void MainWindow::submit(const std::vector<MeasurementRecord>& measurements) {
  try {
    writer().addMeasurements(measurements);
  } catch (const std::exception& error) {
    return sheet_->submissionFailed(QString::fromUtf8(error.what()));
  }
  watcher_.poll();
  inform((measurements.size() == 1 ? tr("1 value stored") : tr("%1 values stored").arg(measurements.size())) +
         whereItStands());
  const MeasuringCount count = countMeasured(run_, tasks_, measurements_);
  const bool complete = run_.state == RunState::waiting && count.wanted > 0 && count.settled >= count.wanted;
  if (!complete || !settings_.flag("continueWhenMeasured", true)) return;
  if (watcher_.activeRuns().count(run_.id) > 0) measuredMeanwhile_.insert(run_.id);
  continueRun(run_.id);
}

void MainWindow::voidMeasurement(Id measurement, bool isVoid, const QString& note) {
  guard([&] {
    const MeasurementRecord before = writer().measurement(measurement);
    writer().setMeasurementVoid(measurement, isVoid, note.toStdString());
    if (const QString where = whereItStands(); !where.isEmpty()) inform(tr("Stored") + where);
    watcher_.poll();
    if (!isVoid || before.isVoid) return;
    if (const auto resting = simulatorRestingOn(writer(), before.run, before.individual))
      if (askToGoBack(this, *resting)) {
        revertSimulator(writer(), before.run, resting->parent);
        watcher_.poll();
      }
  });
}

void MainWindow::importMeasurements() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Import measured fitness"), QFileInfo(databasePath()).absolutePath(),
                                   tr("Tables (*.csv);;All files (*)"));
  if (file.isEmpty()) return;
  guard([&] {
    const PreparedExperiment prepared = prepareFromRun(writer().run(run_.id), *host_);
    const ImportAnswer answer =
        askAboutImport(this, file, {tasks_, measurements_, unit_.toStdString(), prepared.fitness->canBeNegative()});
    if (answer != ImportAnswer::cancelled)
      launcher_.importFitness(databasePath(), run_.id, file, answer == ImportAnswer::confirmed);
  });
}

// What a robot's own program needs: one line an individual, the controller's parameters by name in its order.
QString MainWindow::parametersCsv(const std::vector<Id>& individuals) const {
  QStringList names{"individual"};
  for (const Parameter& parameter : genotype_) names << QString::fromStdString(parameter.name);
  QString text = names.join(',') + '\n';
  for (const Id id : individuals) {
    QStringList cells{QString::number(id)};
    for (const double value : watcher_.database().individual(id).parameters) cells << exactText(value);
    text += cells.join(',') + '\n';
  }
  return text;
}

void MainWindow::giveParameters(const std::vector<Id>& individuals, bool asFile) {
  guard([&] {
    const QString text = parametersCsv(individuals);
    if (!asFile) {
      QApplication::clipboard()->setText(text);
      return inform(tr("Copied the parameters of %1 individuals").arg(individuals.size()));
    }
    const QString file = QFileDialog::getSaveFileName(
        this, tr("Save parameters"),
        QFileInfo(databasePath()).dir().filePath(QStringLiteral("run%1-parameters.csv").arg(run_.id)),
        tr("Tables (*.csv)"));
    if (file.isEmpty()) return;
    writeFile(file.toStdString(), text.toStdString());
    inform(tr("Written: %1").arg(file));
  });
}

}  // namespace btr::ui
