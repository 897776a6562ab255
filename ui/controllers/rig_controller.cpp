#include "ui/controllers/rig_controller.h"

#include <QFileDialog>
#include <QTableWidget>
#include <algorithm>
#include <set>
#include <utility>

#include "core/run/reality/stored_recordings.h"
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
  connect(&page_, &GapPage::mended, &bench_, &Workbench::mend);
  connect(&page_.setup(), &AnalysisSetup::changed, this, [this] {
    const bool hasFiles = page_.setup().recordings().rowCount() > 0;
    if (refused_ == needsRecordings() && hasFiles) bench_.mend(std::exchange(refused_, {}));
    if (refused_ == needsOwner() && hasOwner()) bench_.mend(std::exchange(refused_, {}));
  });
  connect(&page_, &GapPage::informed, &bench_, &Workbench::inform);
  connect(&page_, &GapPage::adoptRequested, this,
          [this](const QString& simulator, const QString& folder, const QString& rig) {
            const Id run = bench_.run().id;
            if (run == 0 && rig.isEmpty()) return;
            emit bench_.messagesOver();
            bench_.launcher().adopt(bench_.path(), run, rig, simulator, folder);
          });
  connect(&page_, &GapPage::revertRequested, this, [this](const QString& rig) {
    const Id run = bench_.run().id;
    if (run == 0 && rig.isEmpty()) return;
    emit bench_.messagesOver();
    bench_.launcher().revert(bench_.path(), run, rig);
  });
  connect(&page_, &GapPage::reportOpened, this, &RigController::showRigs);
  connect(&page_.setup(), &AnalysisSetup::sceneChanged, this, &RigController::showRigs);
  connect(&page_.setup(), &AnalysisSetup::keepRequested, this, &RigController::keepRecordings);
  connect(&page_.setup(), &AnalysisSetup::storedRequested, this, &RigController::takeStoredRecordings);
  connect(&tree_, &ExperimentTree::rigSelected, this, &RigController::select);
  connect(&launcher, &RunLauncher::simulatorChanged, this, [this](Id run, const QString& rig) {
    bench_.watcher().poll([this, run, rig] {
      if (!rig.isEmpty()) {
        rigChanged_ = true;
        findVersions(reportRig_);
      } else if (run == bench_.run().id && !simulators_.empty()) {
        bench_.inform(tr("Run %1 goes on with simulator version %2.").arg(run).arg(simulators_.back().number));
      }
    });
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

// Known at once are the versions that were known; what the database has of the rig comes later.
void RigController::findVersions(KnownRig& rig) {
  if (!bench_.watcher().isOpen() || rig.file.isEmpty()) return;
  bench_.reader().read(
      this, &rig == &setupRig_ ? "setup's rig" : "report's rig", tr("the versions of the %1").arg(rig.name),
      [spec = rig.rig](const Database& database) { return findRig(database, spec); },
      [this, &rig, file = rig.file](std::optional<Id> id) {
        if (rig.file != file) return;
        rig.versions = id ? versionsOf(*id) : std::vector<SimulatorRecord>();
        showAdoption();
        if (&rig == &reportRig_ && !rig.versions.empty() && std::exchange(rigChanged_, false))
          bench_.inform(tr("%1 has simulator version %2 now.").arg(rig.name).arg(rig.versions.back().number));
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

QString RigController::needsRecordings() { return tr("Add recordings first."); }
QString RigController::needsOwner() { return tr("Choose a scene or select a run first: recordings are kept with it."); }

bool RigController::hasOwner() const {
  return bench_.watcher().isOpen() && (bench_.run().id != 0 || !ownerOfRecordings().isEmpty());
}

void RigController::refuse(const QString& why) {
  refused_ = why;
  bench_.report(why);
}

void RigController::keepRecordings(const QStringList& files, const QString& scene) {
  if (files.isEmpty()) return refuse(needsRecordings());
  if (!hasOwner()) return refuse(needsOwner());
  const QString rig = ownerOfRecordings();
  bench_.launcher().keepRecordings(bench_.path(), bench_.run().id, rig, files, scene);
}

// Written out as files, beside which mappings and the report stay.
void RigController::takeStoredRecordings() {
  if (!hasOwner()) return refuse(needsOwner());
  const QString rig = ownerOfRecordings();
  const QString none = rig.isEmpty() ? tr("No recordings are kept with the experiment of run %1.").arg(bench_.run().id)
                                     : tr("No recordings are kept with the %1.").arg(setupRig_.name);
  bench_.reader().read(
      this, "list of recordings", tr("the recordings"),
      [experiment = rig.isEmpty() ? std::optional(bench_.run().experiment) : std::nullopt,
       spec = setupRig_.rig](const Database& database) {
        const std::optional<Id> owner = experiment ? experiment : findRig(database, spec);
        return owner ? database.recordings(*owner) : std::vector<RecordingRecord>();
      },
      [this, none](const std::vector<RecordingRecord>& stored) {
        if (stored.empty()) return bench_.inform(none);
        const QString folder = QFileDialog::getExistingDirectory(bench_.window(), tr("Folder for the recordings"));
        if (!folder.isEmpty()) exportRecordings(stored, folder);
      });
}

void RigController::exportRecordings(const std::vector<RecordingRecord>& recordings, const QString& folder) {
  std::vector<Id> ids;
  for (const RecordingRecord& recording : recordings) ids.push_back(recording.id);
  bench_.reader().read(
      this, "recordings", tr("the recordings"),
      [ids, folder = folder.toStdString()](const Database& database) {
        QStringList files;
        for (const Id id : ids) files << QString::fromStdString(exportRecording(database, id, folder));
        return files;
      },
      [this](const QStringList& files) { page_.setup().addRecordings(files); });
}

}  // namespace btr::ui
