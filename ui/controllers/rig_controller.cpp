#include "ui/controllers/rig_controller.h"

#include <QFileDialog>
#include <algorithm>
#include <set>

#include "core/run/stored_recordings.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/experiment/run_text.h"
#include "ui/experiment/simulators_page.h"
#include "ui/gap/analysis_setup.h"
#include "ui/gap/gap_page.h"
#include "ui/gap/report_view.h"

namespace btr::ui {
namespace {

/// Whether the run's scene has all robots and balls of the other one.
bool isPartOf(const SceneSpec& scene, const SceneSpec& runs) {
  const auto has = [](const auto& all, const std::string& name) {
    return std::ranges::any_of(all, [&](const auto& one) { return one.name == name; });
  };
  return std::ranges::all_of(scene.robots, [&](const RobotSpec& r) { return has(runs.robots, r.name); }) &&
         std::ranges::all_of(scene.balls, [&](const BallSpec& b) { return has(runs.balls, b.name); });
}

}  // namespace

RigController::RigController(Workbench& bench, GapPage& page, ExperimentTree& tree, SimulatorsPage& shown)
    : QObject(&bench), bench_(bench), page_(page), tree_(tree), shown_(shown) {
  DatabaseWatcher& watcher = bench_.watcher();
  RunLauncher& launcher = bench_.launcher();
  connect(&page_, &GapPage::failed, &bench_, &Workbench::report);
  connect(&page_, &GapPage::informed, &bench_, &Workbench::inform);
  connect(&page_, &GapPage::adoptRequested, this,
          [this](const QString& simulator, const QString& folder, const QString& rig) {
            const Id run = bench_.run().id;
            if (run != 0 || !rig.isEmpty()) bench_.launcher().adopt(bench_.path(), run, rig, simulator, folder);
          });
  connect(&page_, &GapPage::revertRequested, this, [this](const QString& rig) {
    const Id run = bench_.run().id;
    if (run != 0 || !rig.isEmpty()) bench_.launcher().revert(bench_.path(), run, rig);
  });
  connect(&page_, &GapPage::reportOpened, this, &RigController::showRigs);
  connect(&page_.setup(), &AnalysisSetup::sceneChanged, this, &RigController::showRigs);
  connect(&page_.setup(), &AnalysisSetup::keepRequested, this, &RigController::keepRecordings);
  connect(&page_.setup(), &AnalysisSetup::storedRequested, this, &RigController::takeStoredRecordings);
  connect(&tree_, &ExperimentTree::rigSelected, this, &RigController::select);
  connect(&launcher, &RunLauncher::simulatorChanged, this, [this](Id run, const QString& rig) {
    bench_.watcher().poll();
    if (rig.isEmpty()) {
      if (run == bench_.run().id && !simulators_.empty())
        bench_.inform(tr("Run %1 goes on with simulator version %2.").arg(run).arg(simulators_.back().number));
    } else if (!reportRig_.versions.empty()) {
      bench_.inform(tr("%1 has simulator version %2 now.").arg(reportRig_.name).arg(reportRig_.versions.back().number));
    }
  });
  connect(&launcher, &RunLauncher::recordingsKept, this,
          [this](int files) { bench_.inform(tr("%1 recordings are kept in the database.").arg(files)); });

  connect(&bench_, &Workbench::runSelected, this, [this](const RunRecord& run) {
    shownRig_ = 0;
    simulators_.clear();
    runScene_ = run.id == 0 ? SceneSpec() : sceneFromJson(run.sceneJson, "run " + std::to_string(run.id), "");
    if (run.id == 0) showAdoption();
  });
  connect(&watcher, &DatabaseWatcher::rigsChanged, this, &RigController::takeRigs);
  connect(&watcher, &DatabaseWatcher::runChanged, this, &RigController::showAdoption);
  connect(&watcher, &DatabaseWatcher::simulatorsChanged, this,
          [this](Id, const std::vector<SimulatorRecord>& simulators) {
            simulators_ = simulators;
            showAdoption();
          });
  // Individuals of the run with a value that counts: what fitness by itself can say.
  connect(&watcher, &DatabaseWatcher::tasksChanged, this,
          [this](Id run, const auto&, const std::vector<MeasurementRecord>& measurements) {
            std::set<Id> measured;
            for (const MeasurementRecord& measurement : measurements)
              if (!measurement.isVoid) measured.insert(measurement.individual);
            page_.setMeasured(bench_.path(), run, int(measured.size()));
          });
  showAdoption();
}

// A scene that cannot be read is no rig: the setup and the report say what is wrong with it.
void RigController::readRig(KnownRig& rig, const QString& file) {
  rig = {};
  if (file.isEmpty()) return;
  try {
    rig.rig = loadRig(file.toStdString());
  } catch (const std::exception&) {
    return;
  }
  rig.name = tr("rig %1").arg(QString::fromStdString(rig.rig.name));
  rig.file = file;
  findVersions(rig);
}

void RigController::findVersions(KnownRig& rig) {
  rig.versions.clear();
  if (!bench_.watcher().isOpen() || rig.file.isEmpty()) return;
  bench_.guard([&] {
    if (const auto id = findRig(bench_.watcher().database(), rig.rig)) rig.versions = versionsOf(*id);
  });
}

void RigController::showRigs() {
  const auto& report = page_.view().report();
  readRig(setupRig_, page_.setup().scene());
  readRig(reportRig_, report ? QString::fromStdString(report->scene) : page_.setup().scene());
  showAdoption();
}

void RigController::takeRigs(const std::vector<SimulatorRecord>& versions) {
  rigVersions_ = versions;
  tree_.setRigs(versions);
  if (shownRig_ != 0) shown_.setSimulators(versionsOf(shownRig_));
  for (KnownRig* rig : {&setupRig_, &reportRig_}) findVersions(*rig);
  showAdoption();
}

std::vector<SimulatorRecord> RigController::versionsOf(Id rig) const {
  std::vector<SimulatorRecord> own;
  for (const SimulatorRecord& version : rigVersions_)
    if (version.rig == rig) own.push_back(version);
  return own;
}

void RigController::select(Id rig, Id simulator) {
  if (shownRig_ != rig) {
    bench_.selectRun(0);
    shownRig_ = rig;
    shown_.setSimulators(versionsOf(rig));
  }
  if (simulator != 0) shown_.select(simulator);
  emit bench_.dockWanted("simulators");
}

// A run takes another simulator while no process works on it and it is not finished; a rig at any time.
void RigController::showAdoption() {
  std::vector<AdoptionTarget> targets, starts;
  const bool open = bench_.watcher().isOpen();
  if (!open || bench_.run().id == 0) {
    page_.setMeasured({}, 0, 0);
  } else {
    AdoptionTarget run{runName(bench_.run()), {}, simulators_, {}};
    if (bench_.isRunActive() || bench_.watcher().activeRuns().count(bench_.run().id))
      run.why =
          tr("A process works on the run: another simulator is taken while it waits for measurements or is stopped.");
    else if (bench_.run().state == RunState::finished)
      run.why = tr("The run is finished: another simulator is taken while a run waits for measurements or is stopped.");
    targets.push_back(run);
    starts.push_back(std::move(run));
  }
  const auto add = [&](const KnownRig& rig, std::vector<AdoptionTarget>& to) {
    if (open && !rig.file.isEmpty()) to.push_back({rig.name, rig.file, rig.versions, {}});
  };
  add(reportRig_, targets);
  add(setupRig_, starts);
  // What was found about another robot is the rig's.
  const bool runs = bench_.run().id != 0 && isPartOf(reportRig_.rig.scene, runScene_);
  page_.setTargets(targets, runs || targets.size() < 2 ? 0 : 1);
  page_.setStarts(starts);
}

// With the experiment of the selected run where its scene has what was recorded, else with the rig.
QString RigController::ownerOfRecordings() const {
  return bench_.run().id != 0 && isPartOf(setupRig_.rig.scene, runScene_) ? QString() : setupRig_.file;
}

void RigController::keepRecordings(const QStringList& files, const QString& scene) {
  if (files.isEmpty()) return bench_.report(tr("Add recordings first."));
  const QString rig = ownerOfRecordings();
  if (!bench_.watcher().isOpen() || (bench_.run().id == 0 && rig.isEmpty()))
    return bench_.report(tr("Choose a scene or select a run first: recordings are kept with it."));
  bench_.launcher().keepRecordings(bench_.path(), bench_.run().id, rig, files, scene);
}

// Written out as files, beside which mappings and the report stay.
void RigController::takeStoredRecordings() {
  const QString rig = ownerOfRecordings();
  if (!bench_.watcher().isOpen() || (bench_.run().id == 0 && rig.isEmpty()))
    return bench_.report(tr("Choose a scene or select a run first: recordings are kept with it."));
  bench_.guard([&] {
    const Database& database = bench_.watcher().database();
    const auto id = rig.isEmpty() ? std::optional(bench_.run().experiment) : findRig(database, setupRig_.rig);
    const auto stored = id ? database.recordings(*id) : std::vector<RecordingRecord>();
    if (stored.empty())
      return bench_.inform(rig.isEmpty()
                               ? tr("No recordings are kept with the experiment of run %1.").arg(bench_.run().id)
                               : tr("No recordings are kept with the %1.").arg(setupRig_.name));
    const QString folder = QFileDialog::getExistingDirectory(bench_.window(), tr("Folder for the recordings"));
    if (folder.isEmpty()) return;
    QStringList files;
    for (const RecordingRecord& recording : stored)
      files << QString::fromStdString(exportRecording(database, recording.id, folder.toStdString()));
    page_.setup().addRecordings(files);
  });
}

}  // namespace btr::ui
