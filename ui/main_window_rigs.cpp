// Rigs in the window: scenes that no run belongs to, with their simulator versions and recordings, and who of the
// selected run and such a rig takes what gap analysis found.
#include <QFileDialog>

#include "core/run/stored_recordings.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/experiment/run_text.h"
#include "ui/experiment/simulators_page.h"
#include "ui/gap/analysis_setup.h"
#include "ui/gap/gap_page.h"
#include "ui/gap/report_view.h"
#include "ui/main_window.h"

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

// A scene that cannot be read is no rig: the setup and the report say what is wrong with it.
void MainWindow::readRig(KnownRig& rig, const QString& file) {
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

void MainWindow::findVersions(KnownRig& rig) {
  rig.versions.clear();
  if (!watcher_.isOpen() || rig.file.isEmpty()) return;
  guard([&] {
    if (const auto id = findRig(watcher_.database(), rig.rig)) rig.versions = versionsOf(*id);
  });
}

void MainWindow::showRigs() {
  const auto& report = gapPage_->view().report();
  readRig(setupRig_, gapPage_->setup().scene());
  readRig(reportRig_, report ? QString::fromStdString(report->scene) : gapPage_->setup().scene());
  showAdoption();
}

void MainWindow::takeRigs(const std::vector<SimulatorRecord>& versions) {
  rigVersions_ = versions;
  tree_->setRigs(versions);
  if (shownRig_ != 0) versions_->setSimulators(versionsOf(shownRig_));
  for (KnownRig* rig : {&setupRig_, &reportRig_}) findVersions(*rig);
  showAdoption();
}

std::vector<SimulatorRecord> MainWindow::versionsOf(Id rig) const {
  std::vector<SimulatorRecord> own;
  for (const SimulatorRecord& version : rigVersions_)
    if (version.rig == rig) own.push_back(version);
  return own;
}

void MainWindow::selectRig(Id rig, Id simulator) {
  if (shownRig_ != rig) {
    selectRun(0);
    shownRig_ = rig;
    versions_->setSimulators(versionsOf(rig));
  }
  if (simulator != 0) versions_->select(simulator);
  layout_.raise("simulators");
}

// A run takes another simulator while no process works on it and it is not finished; a rig at any time.
void MainWindow::showAdoption() {
  std::vector<AdoptionTarget> targets, starts;
  const bool open = watcher_.isOpen();
  if (!open || run_.id == 0) {
    gapPage_->setMeasured({}, 0, 0);
  } else {
    AdoptionTarget run{runName(run_), {}, simulators_, {}};
    if (runActive_ || watcher_.activeRuns().count(run_.id))
      run.why =
          tr("A process works on the run: another simulator is taken while it waits for measurements or is stopped.");
    else if (run_.state == RunState::finished)
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
  const bool runs = run_.id != 0 && isPartOf(reportRig_.rig.scene, runScene_);
  gapPage_->setTargets(targets, runs || targets.size() < 2 ? 0 : 1);
  gapPage_->setStarts(starts);
}

// With the experiment of the selected run where its scene has what was recorded, else with the rig.
QString MainWindow::ownerOfRecordings() const {
  return run_.id != 0 && isPartOf(setupRig_.rig.scene, runScene_) ? QString() : setupRig_.file;
}

void MainWindow::keepRecordings(const QStringList& files, const QString& scene) {
  if (files.isEmpty()) return report(tr("Add recordings first."));
  const QString rig = ownerOfRecordings();
  if (!watcher_.isOpen() || (run_.id == 0 && rig.isEmpty()))
    return report(tr("Choose a scene or select a run first: recordings are kept with it."));
  launcher_.keepRecordings(databasePath(), run_.id, rig, files, scene);
}

// Written out as files, beside which mappings and the report stay.
void MainWindow::takeStoredRecordings() {
  const QString rig = ownerOfRecordings();
  if (!watcher_.isOpen() || (run_.id == 0 && rig.isEmpty()))
    return report(tr("Choose a scene or select a run first: recordings are kept with it."));
  guard([&] {
    const Database& database = watcher_.database();
    const auto id = rig.isEmpty() ? std::optional(run_.experiment) : findRig(database, setupRig_.rig);
    const auto stored = id ? database.recordings(*id) : std::vector<RecordingRecord>();
    if (stored.empty())
      return inform(rig.isEmpty() ? tr("No recordings are kept with the experiment of run %1.").arg(run_.id)
                                  : tr("No recordings are kept with the %1.").arg(setupRig_.name));
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Folder for the recordings"));
    if (folder.isEmpty()) return;
    QStringList files;
    for (const RecordingRecord& recording : stored)
      files << QString::fromStdString(exportRecording(database, recording.id, folder.toStdString()));
    gapPage_->setup().addRecordings(files);
  });
}

}  // namespace btr::ui
