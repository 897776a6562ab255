// From the watcher to the docks: every value goes one way.
#include <QDockWidget>
#include <QFileInfo>
#include <QLabel>

#include "core/run/replay.h"
#include "core/spec/scene_spec.h"
#include "ui/charts/fitness_chart.h"
#include "ui/charts/gap_chart.h"
#include "ui/database/individuals_table.h"
#include "ui/experiment/experiment_form.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/experiment/run_panel.h"
#include "ui/experiment/simulators_page.h"
#include "ui/main_window.h"
#include "ui/measure/measurement_sheet.h"
#include "ui/measure/policy_page.h"
#include "ui/scene3d/replay_job.h"
#include "ui/scene3d/replay_panel.h"

namespace btr::ui {

void MainWindow::connectShow() {
  connect(tree_, &ExperimentTree::runSelected, this, &MainWindow::selectRun);
  connect(tree_, &ExperimentTree::specRequested, this, [this](Id run) {
    selectRun(run);
    layout_.raise("spec");
  });
  connect(tree_, &ExperimentTree::simulatorSelected, this, [this](Id, Id simulator) {
    versions_->select(simulator);
    layout_.raise("simulators");
  });

  connect(&watcher_, &DatabaseWatcher::failed, this, &MainWindow::report);
  connect(&watcher_, &DatabaseWatcher::runsChanged, this,
          [this](const std::vector<ExperimentRecord>& experiments, const std::vector<RunRecord>& runs) {
            tree_->setContent(experiments, runs, gridsInTree());
          });
  connect(&watcher_, &DatabaseWatcher::versionsChanged, tree_, &ExperimentTree::setSimulators);
  connect(&watcher_, &DatabaseWatcher::simulatorsChanged, tree_, &ExperimentTree::setSimulators);
  connect(&watcher_, &DatabaseWatcher::activeChanged, this, [this](const std::set<Id>& active) {
    tree_->setActive(active);
    activeLabel_->setText(active.empty()       ? QString()
                          : active.size() == 1 ? tr("1 run is working")
                                               : tr("%1 runs are working").arg(active.size()));
    checkProcesses();
  });
  connect(&watcher_, &DatabaseWatcher::runChanged, this, &MainWindow::showRun);
  connect(&watcher_, &DatabaseWatcher::generationsReset, this,
          [this](Id run, const std::vector<GenerationRecord>& all) {
            fitness_->setGenerations(all);
            if (!all.empty()) panel_->setGeneration(all.back());
            individuals_->load(all.empty() ? 0 : all.back().number,
                               [this, run](int number) { return watcher_.database().individuals(run, number); });
          });
  connect(&watcher_, &DatabaseWatcher::generationsAdded, this,
          [this](Id run, const std::vector<GenerationRecord>& added) {
            panel_->setGeneration(added.back());
            for (const GenerationRecord& generation : added) {
              fitness_->append(generation);
              guard([&] {
                GenerationRecord whole = generation;
                whole.individuals = watcher_.database().individuals(run, generation.number);
                individuals_->append(whole);
              });
            }
          });
  connect(&watcher_, &DatabaseWatcher::simulatorsChanged, this,
          [this](Id, const std::vector<SimulatorRecord>& simulators) {
            simulators_ = simulators;
            fitness_->setSimulators(simulators_);
            gap_->setGaps(gaps_, simulators_);
            versions_->setSimulators(simulators_);
            individuals_->setSimulators(simulators_);
            showAdoption();
          });
  connect(&watcher_, &DatabaseWatcher::gapsChanged, this, [this](Id, const std::vector<GapRecord>& gaps) {
    gaps_ = gaps;
    gap_->setGaps(gaps_, simulators_);
    versions_->setGaps(gaps_);
  });
  connect(individuals_, &IndividualsTable::replayRequested, this, &MainWindow::replayIndividual);
  connect(individuals_, &IndividualsTable::pairRequested, this, &MainWindow::replayPair);
}

void MainWindow::selectRun(Id run) {
  if (!watcher_.isOpen() || (run != 0 && run == run_.id && watcher_.followed() == run)) return;
  sheet_->finishEditing();
  run_ = {};
  runScene_ = {};
  shownRig_ = 0;
  gaps_.clear();
  simulators_.clear();
  tasks_.clear();
  measurements_.clear();
  sheetWanted_ = runActive_ = false;
  if (run == 0) {
    panel_->clear();
    fitness_->setRun({});
    gap_->setGaps({}, {});
    versions_->clear();
    individuals_->clear();
    sheet_->setTasks({});
    policies_->setReports({});
    showAdoption();
  } else {
    guard([&] { showSpec(watcher_.database().run(run)); });
    settings_.setSelectedRun(databasePath(), run);
  }
  watcher_.follow(run);
  tree_->selectRun(run);
}

// What is fixed for a run: its settings, the unit of its fitness, its label.
void MainWindow::showSpec(const RunRecord& run) {
  run_ = run;
  runScene_ = sceneFromJson(run.sceneJson, "run " + std::to_string(run.id), "");
  unit_.clear();
  FitnessRun shown;
  shown.run = run.id;
  shown.name = runName(run);
  shown.standIn = isStandIn(run);
  fitness_->setRun(shown);
  gap_->setStandIn(shown.standIn);
  ExperimentSpec spec = experimentFromJson(run.specJson, "run " + std::to_string(run.id), "");
  // Runs of one experiment share its specification; each has a seed of its own.
  spec.seed = run.seed;
  spec_->setSpec(spec);
  unit_ = QString::fromStdString(host_->fitness(spec.fitness.name)->unit());
  panel_->setUnit(unit_);
  fitness_->setUnit(unit_);
  gap_->setUnit(unit_);
  gap_->setNorm(
      static_cast<GapNorm>(static_cast<int>(valueOf(adaptationParameters(), spec.adaptationSettings, "norm"))));
  versions_->setUnit(unit_);
  individuals_->setUnit(unit_);
  individuals_->setStandIn(shown.standIn);
  genotype_ = host_->controller(spec.controller.name)->genotype();
  individuals_->setGenotype(genotype_);
  policies_->setUnit(unit_);
  policiesSeen_.clear();
  sheet_->setUnit(unit_);
  const bool canBeNegative = host_->fitness(spec.fitness.name)->canBeNegative();
  sheet_->setAllowed({canBeNegative ? std::optional<double>() : 0.0, {}});
  sheet_->setStandIn(shown.standIn);
  sheet_->model().setSimulatedShown(valueOf(stageParameters(), spec.stages, "hide_simulated") == 0);
}

void MainWindow::showRun(const RunRecord& run, const RunProgress& progress, bool active) {
  run_ = run;
  runActive_ = active;
  panel_->showRun(run, progress, active);
  showAdoption();
  showWaiting();
  showPolicies(progress);
}

// Made again in a thread of its own, from a connection of its own.
std::function<ReplayData(Id)> MainWindow::replayer() const {
  return [path = databasePath().toStdString(), run = run_.id, host = host_, unit = unit_,
          hidden = individuals_->model().hidden()](Id individual) {
    const Database database = Database::open(path, Database::Mode::readOnly);
    const RunRecord record = database.run(run);
    const IndividualRecord stored = database.individual(individual);
    std::vector<ReplayBall> balls;
    for (const BallSpec& ball : sceneFromJson(record.sceneJson, "scene", "").balls)
      balls.push_back({ball.name, ball.radius_m});
    ReplayData shown =
        toReplayData(replay(database, *host, run, individual), balls,
                     tr("run %1, generation %2, individual %3").arg(run).arg(stored.generation).arg(individual), unit);
    shown.simulator = tr("simulator %1").arg(database.simulator(stored.simulator).number);
    shown.standIn = isStandIn(record);
    shown.fitnessHidden = hidden.contains(individual) || hidden.contains(stored.sameAs);
    return shown;
  };
}

void MainWindow::replayIndividual(Id individual) {
  if (!watcher_.isOpen() || run_.id == 0) return;
  layout_.raise("replay");
  ghosts_ = {};
  individuals_->select(individual);
  replayJob_->start([replay = replayer(), individual] { return replay(individual); });
}

void MainWindow::replayPair(Id first, Id second) {
  if (!watcher_.isOpen() || run_.id == 0) return;
  layout_.raise("replay");
  ghosts_ = {};
  replayJob_->start([replay = replayer(), first, second] {
    ReplayData shown = replay(first);
    shown.beside = std::make_shared<const ReplayData>(replay(second));
    return shown;
  });
}

void MainWindow::replayBest() {
  if (!watcher_.isOpen() || run_.generation == 0) return;
  guard([this] {
    const auto best = watcher_.database().bestIndividuals(run_.id, 1, run_.generation, run_.generation);
    if (!best.empty()) replayIndividual(best.front().id);
  });
}

void MainWindow::showTitle() {
  const QString path = watcher_.isOpen() ? databasePath() : QString();
  setWindowTitle(path.isEmpty() ? QStringLiteral("UCHILSIM")
                                : QFileInfo(path).fileName() + QStringLiteral(" — UCHILSIM"));
  setWindowFilePath(QString());
  databaseLabel_->setText(path.isEmpty() ? tr("No database") : QFileInfo(path).fileName());
  databaseLabel_->setToolTip(path);
}

}  // namespace btr::ui
