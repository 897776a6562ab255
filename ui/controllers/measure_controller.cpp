#include "ui/controllers/measure_controller.h"

#include <QApplication>
#include <QClipboard>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <optional>
#include <set>

#include "core/run/reality/adoption.h"
#include "core/run/reality/resting_simulator.h"
#include "core/spec/json_reader.h"
#include "ui/charts/plot_data.h"
#include "ui/controllers/run_controller.h"
#include "ui/database/individuals_table.h"
#include "ui/experiment/run_text.h"
#include "ui/measure/alarm.h"
#include "ui/measure/measured_questions.h"
#include "ui/measure/measurement_sheet.h"
#include "ui/measure/policy_page.h"

namespace btr::ui {

MeasureController::MeasureController(Workbench& bench, RunController& runs, const Views& views)
    : QObject(&bench), bench_(bench), runs_(runs), views_(views) {
  DatabaseWatcher& watcher = bench_.watcher();
  connect(&bench_, &Workbench::databaseLeft, this, [this] { views_.sheet.finishEditing(); });
  // Numbers of runs begin anew in each database.
  connect(&bench_, &Workbench::databaseOpened, this, [this] { views_.sheet.setTasks({}); });
  connect(&bench_, &Workbench::runLeft, this, [this] { views_.sheet.finishEditing(); });
  connect(&bench_, &Workbench::runSelected, this, &MeasureController::selectRun);
  connect(&watcher, &DatabaseWatcher::tasksChanged, this,
          [this](Id, const auto& tasks, const auto& measurements) { showTasks(tasks, measurements); });
  connect(&watcher, &DatabaseWatcher::runChanged, this, [this](const RunRecord&, const RunProgress& progress) {
    showWaiting();
    showPolicies(progress);
  });
  connect(&watcher, &DatabaseWatcher::runsChanged, this,
          [this](const auto&, const std::vector<RunRecord>& all) { countWaiting(all); });
  MeasurementSheet& sheet = views_.sheet;
  connect(&sheet.model(), &MeasurementModel::draftChanged, this, &MeasureController::keepMeasurements);
  connect(&sheet.model(), &MeasurementModel::changed, this, &MeasureController::hideSimulated);
  connect(&sheet, &MeasurementSheet::submitted, this, &MeasureController::submit);
  connect(&sheet, &MeasurementSheet::voidRequested, this, &MeasureController::voidMeasurement);
  connect(&sheet, &MeasurementSheet::replayRequested, &bench_, &Workbench::replayWanted);
  connect(&sheet, &MeasurementSheet::importRequested, this, &MeasureController::importMeasurements);
  connect(&sheet, &MeasurementSheet::continueRequested, this, [this] { runs_.resume(bench_.run().id); });
  connect(&sheet, &MeasurementSheet::parametersRequested, this, &MeasureController::giveParameters);
  connect(&views_.policies, &PolicyPage::replayRequested, &bench_, &Workbench::replayWanted);
  connect(&views_.policies, &PolicyPage::endRequested, this, &MeasureController::endRealityLearning);
  connect(&views_.alarm, &Alarm::sheetRequested, this, [this] {
    bench_.selectRun(waitingRun_);
    emit bench_.dockWanted("sheet");
    bench_.whenSelected([this] { views_.sheet.showNewest(); });
  });
}

void MeasureController::selectRun(const RunRecord& run) {
  tasks_.clear();
  measurements_.clear();
  policiesSeen_.clear();
  sheetWanted_ = false;
  if (run.id == 0) {
    views_.sheet.setTasks({});
    views_.policies.setReports({});
    return;
  }
  const ExperimentSpec spec = experimentFromJson(run.specJson, "run " + std::to_string(run.id), "");
  const auto fitness = bench_.host()->fitness(spec.fitness.name);
  unit_ = QString::fromStdString(fitness->unit());
  genotype_ = bench_.host()->controller(spec.controller.name)->genotype();
  views_.policies.setUnit(unit_);
  views_.sheet.setUnit(unit_);
  canBeNegative_ = fitness->canBeNegative();
  views_.sheet.setAllowed({canBeNegative_ ? std::optional<double>() : 0.0, {}});
  views_.sheet.setStandIn(isStandIn(run));
  views_.sheet.model().setSimulatedShown(valueOf(stageParameters(), spec.stages, "hide_simulated") == 0);
}

// What an earlier session or another look at this run has left unsaved comes back with it.
void MeasureController::showTasks(const std::vector<MeasurementTask>& tasks,
                                  const std::vector<MeasurementRecord>& measurements) {
  tasks_ = tasks;
  measurements_ = measurements;
  const Id before = views_.sheet.model().run();
  views_.sheet.setTasks(tasks);
  views_.sheet.setMeasurements(measurements);
  if (views_.sheet.model().run() != before) {
    sheetDatabase_ = bench_.path();
    views_.sheet.setDraft(
        draftFromText(bench_.settings().measurementDraft(sheetDatabase_, views_.sheet.model().run())));
  }
  views_.individuals.setMeasurements(measurements);
  hideSimulated();
  emit measuringChanged(countMeasured(bench_.run(), tasks, measurements));
  readMeasured();
  showWaiting();
  showPolicies({});
}

// Generation and simulated fitness of those that were measured, for the charts.
void MeasureController::readMeasured() {
  std::set<Id> wanted;
  for (const MeasurementRecord& measurement : measurements_) wanted.insert(measurement.individual);
  bench_.reader().read(
      this, "measured", tr("the measured individuals"),
      [wanted](const Database& database) {
        std::vector<IndividualRecord> individuals;
        for (const Id id : wanted) individuals.push_back(database.individual(id));
        return individuals;
      },
      [this](const std::vector<IndividualRecord>& individuals) { emit measured(individuals, measurements_); });
}

// Whoever measures shall not read elsewhere what the sheet hides.
void MeasureController::hideSimulated() {
  std::set<Id> hidden;
  std::set<double> fitness;
  const MeasuringCount count = countMeasured(bench_.run(), tasks_, measurements_);
  if (!views_.sheet.model().isSimulatedShown() && count.settled < count.wanted)
    for (const MeasurementTask& task : tasks_)
      if (task.stage == bench_.run().stage + 1 && task.iteration == count.iteration) {
        hidden.insert(task.individual);
        fitness.insert(task.simulatedFitness);
      }
  views_.individuals.setHidden(hidden);
  emit blindChanged(!hidden.empty());
  emit hiddenChanged(fitness);
}

// What the pages say while the selected run waits. Its process may be at work: right after the last value, or on L3
// while a person tries the policies of L2.
void MeasureController::showWaiting() {
  const MeasuringCount count = countMeasured(bench_.run(), tasks_, measurements_);
  const bool waits = bench_.run().state == RunState::waiting && (!bench_.isRunActive() || count.settled < count.wanted);
  const bool wanted = waits && !isStandIn(bench_.run()) && count.settled < count.wanted;
  // Who is on a page stays there; the alarm rings, and the sheet is in front when the page is left.
  const bool begins = wanted && !sheetWanted_;
  sheetWanted_ = wanted;
  if (begins) emit sheetWanted();
  views_.sheet.setWaiting(waits);
  views_.sheet.setGoesOnByItself(bench_.settings().flag("continueWhenMeasured", true));
  const bool learnsInReality =
      !tasks_.empty() && tasks_.back().iteration > 0 && tasks_.back().stage == bench_.run().stage + 1;
  views_.policies.setWaiting(waits && !isStandIn(bench_.run()) && learnsInReality);
}

// The alarm rings for a person while values are missing, whichever run is selected; a stand-in answers by itself.
void MeasureController::countWaiting(const std::vector<RunRecord>& runs) {
  std::vector<RunRecord> waiting;
  for (const RunRecord& run : runs)
    if (run.state == RunState::waiting && !isStandIn(run)) waiting.push_back(run);
  bench_.reader().read(
      this, "waiting", tr("what waits to be measured"),
      [waiting](const Database& database) {
        std::vector<WaitingRun> counted;
        for (const RunRecord& run : waiting)
          counted.push_back(
              {run, countMeasured(run, database.measurementTasks(run.id), database.measurements(run.id))});
        return counted;
      },
      [this](const std::vector<WaitingRun>& counted) { callForPerson(counted); });
}

void MeasureController::callForPerson(const std::vector<WaitingRun>& waiting) {
  QStringList others;
  QString message;
  Id first = 0;
  for (const auto& [run, count] : waiting) {
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
  if (first == 0) return views_.alarm.clear();
  if (!others.isEmpty())
    message += ' ' + (others.size() == 1 ? tr("Run %1 waits too.") : tr("Runs %1 wait too.")).arg(others.join(", "));
  views_.alarm.raiseAlarm(message);
}

// Made anew when a policy was asked for, a value came or an iteration ended.
void MeasureController::showPolicies(const RunProgress& progress) {
  const std::vector<std::size_t> seen{static_cast<std::size_t>(bench_.run().id),
                                      static_cast<std::size_t>(bench_.run().stage),
                                      static_cast<std::size_t>(bench_.run().state),
                                      static_cast<std::size_t>(bench_.run().generation),
                                      progress.stage == "L2" ? static_cast<std::size_t>(progress.stageDone) : 0,
                                      tasks_.size(),
                                      measurements_.size()};
  if (seen == policiesSeen_) return;
  policiesSeen_ = seen;
  bench_.reader().read(
      this, "policies", tr("the policies of L2"),
      [run = bench_.run(), genotype = genotype_](const Database& database) {
        return realityReports(database, run, genotype);
      },
      [this, run = bench_.run().id](const std::vector<RealityReport>& reports) {
        if (run == bench_.run().id) views_.policies.setReports(reports);
      });
}

// Typed beside the robot and not saved yet: kept for its run, whatever is looked at next.
void MeasureController::keepMeasurements() {
  const MeasurementModel& model = views_.sheet.model();
  if (model.run() != 0) bench_.settings().setMeasurementDraft(sheetDatabase_, model.run(), toText(model.draft()));
}

void MeasureController::endRealityLearning() {
  const Id run = bench_.run().id;
  bench_.guard([&] {
    bench_.writer().endRealityLearning(run, views_.sheet.who().toStdString());
    bench_.inform(tr("Learning in reality of %1 ends here.").arg(runName(bench_.run())));
    bench_.watcher().poll();
    runs_.resume(run);
  });
}

// People copy only the file: what was typed is in it, or it is said that it is not.
QString MeasureController::whereItStands() {
  bool inFile = false;
  bench_.guard([&] { inFile = bench_.writer().moveLogIntoFile(0); });
  return inFile ? QString()
                : tr("; another process reads an older state, so it still stands in the log beside the file: copy with "
                     "File, Back up");
}

// What was just written, in the sheet at once: nothing can be entered twice.
void MeasureController::showStored() {
  const Id run = bench_.run().id;
  bench_.guard([&] { showTasks(tasks_, bench_.writer().measurements(run)); });
  bench_.watcher().poll();
}

void MeasureController::submit(const std::vector<MeasurementRecord>& measurements) {
  try {
    bench_.writer().addMeasurements(measurements);
  } catch (const std::exception& error) {
    return views_.sheet.submissionFailed(QString::fromUtf8(error.what()));
  }
  showStored();
  bench_.inform((measurements.size() == 1 ? tr("1 value stored") : tr("%1 values stored").arg(measurements.size())) +
                whereItStands());
  const MeasuringCount count = countMeasured(bench_.run(), tasks_, measurements_);
  const bool complete = bench_.run().state == RunState::waiting && count.wanted > 0 && count.settled >= count.wanted;
  if (!complete || !bench_.settings().flag("continueWhenMeasured", true)) return;
  runs_.resumeMeasured(bench_.run().id);
}

void MeasureController::voidMeasurement(Id measurement, bool isVoid, const QString& note) {
  bench_.guard([&] {
    const MeasurementRecord before = bench_.writer().measurement(measurement);
    bench_.writer().setMeasurementVoid(measurement, isVoid, note.toStdString());
    if (const QString where = whereItStands(); !where.isEmpty()) bench_.inform(tr("Stored") + where);
    showStored();
    if (!isVoid || before.isVoid) return;
    if (const auto resting = simulatorRestingOn(bench_.writer(), before.run, before.individual))
      if (askToGoBack(bench_.window(), *resting)) {
        revertSimulator(bench_.writer(), before.run, resting->parent);
        bench_.watcher().poll();
      }
  });
}

void MeasureController::importMeasurements() {
  const QString file =
      QFileDialog::getOpenFileName(bench_.window(), tr("Import measured fitness"),
                                   QFileInfo(bench_.path()).absolutePath(), tr("Tables (*.csv);;All files (*)"));
  if (file.isEmpty()) return;
  bench_.guard([&] {
    const ImportAnswer answer =
        askAboutImport(bench_.window(), file, {tasks_, measurements_, unit_.toStdString(), canBeNegative_});
    if (answer != ImportAnswer::cancelled)
      bench_.launcher().importFitness(bench_.path(), bench_.run().id, file, answer == ImportAnswer::confirmed);
  });
}

// What a robot's own program needs: one line an individual, the controller's parameters by name in its order.
void MeasureController::giveParameters(const std::vector<Id>& individuals, bool asFile) {
  QString file;
  if (asFile) {
    file = QFileDialog::getSaveFileName(
        bench_.window(), tr("Save parameters"),
        QFileInfo(bench_.path()).dir().filePath(QStringLiteral("run%1-parameters.csv").arg(bench_.run().id)),
        tr("Tables (*.csv)"));
    if (file.isEmpty()) return;
  }
  bench_.reader().read(
      this, "parameters", tr("the parameters"),
      [individuals](const Database& database) {
        std::vector<IndividualRecord> read;
        for (const Id id : individuals) read.push_back(database.individual(id));
        return read;
      },
      [this, file](const std::vector<IndividualRecord>& read) {
        if (file.isEmpty()) {
          QApplication::clipboard()->setText(parametersCsv(read));
          return bench_.inform(tr("Copied the parameters of %1 individuals").arg(read.size()));
        }
        writeFile(file.toStdString(), parametersCsv(read).toStdString());
        bench_.inform(tr("Written: %1").arg(file));
      });
}

QString MeasureController::parametersCsv(const std::vector<IndividualRecord>& individuals) const {
  QStringList names{"individual"};
  for (const Parameter& parameter : genotype_) names << QString::fromStdString(parameter.name);
  QString text = names.join(',') + '\n';
  for (const IndividualRecord& individual : individuals) {
    QStringList cells{QString::number(individual.id)};
    for (const double value : individual.parameters) cells << exactText(value);
    text += cells.join(',') + '\n';
  }
  return text;
}

}  // namespace btr::ui
