#include "ui/controllers/run_controller.h"

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QInputDialog>
#include <QJsonDocument>
#include <QJsonObject>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>
#include <utility>

#include "ui/experiment/run_text.h"
#include "ui/gap/program_process.h"

namespace btr::ui {

RunController::RunController(Workbench& bench) : QObject(&bench), bench_(bench) {
  processes_.setInterval(500);
  connect(&processes_, &QTimer::timeout, this, &RunController::checkLaunched);
  connect(&bench_.watcher(), &DatabaseWatcher::activeChanged, this, &RunController::checkLaunched);
  connect(&bench_, &Workbench::databaseOpened, this, [this] { launched_.clear(); });

  RunLauncher& launcher = bench_.launcher();
  connect(&launcher, &RunLauncher::failed, this, [this](const QString& why) {
    bench_.inform({});
    bench_.report(why);
  });
  connect(&launcher, &RunLauncher::exported, this,
          [this](const QString& file) { bench_.inform(tr("Written: %1").arg(file)); });
  // Shown until the next message: in what the started run differs from the one whose experiment was edited.
  connect(&launcher, &RunLauncher::remarked, &bench_, &Workbench::inform, Qt::QueuedConnection);
  connect(&launcher, &RunLauncher::backedUp, this,
          [this](const QString& file) { bench_.inform(tr("A checked copy of the database is in %1").arg(file)); });
  connect(&launcher, &RunLauncher::imported, this, [this](const QString& file) {
    bench_.watcher().poll();
    bench_.inform(tr("Imported: %1").arg(file));
  });
  connect(&launcher, &RunLauncher::stored, this, [this](Id run) {
    bench_.watcher().poll();
    bench_.inform({});
    bench_.selectRun(run);
    emit bench_.dockWanted("fitness");  // in front may be the sheet of another run, where nothing happens now
    resume(run);
  });

  merging_ = new ProgramProcess(launcher.program(), this);
  connect(merging_, &ProgramProcess::failed, &bench_, &Workbench::report);
  connect(merging_, &ProgramProcess::done, this, [this](const QByteArray& output) {
    const QJsonObject copied = QJsonDocument::fromJson(output).object();
    bench_.note(tr("%1 runs with %2 individuals were copied from %3.")
                    .arg(copied["runs"].toInt())
                    .arg(copied["individuals"].toInt())
                    .arg(QFileInfo(mergedFrom_).fileName()));
  });
}

void RunController::readStanding(Id run, const QString& why, const std::function<void(const Standing&)>& then) {
  bench_.reader().read(
      this, why + QString::number(run), tr("run %1").arg(run),
      [run](const Database& database) {
        Standing standing{database.run(run), {}};
        standing.count = countMeasured(standing.run, database.measurementTasks(run), database.measurements(run));
        return standing;
      },
      then);
}

void RunController::resume(Id run) {
  if (run == 0 || bench_.watcher().activeRuns().count(run) || bench_.launcher().isAlive(run)) return;
  readStanding(run, "resume", [this](const Standing& standing) {
    const auto& [record, count] = standing;
    if (record.state == RunState::finished)
      return bench_.inform(tr("%1 is finished: the same experiment and seed give the same bits.").arg(runName(record)));
    if (record.stopRequested) bench_.writer().requestStop(record.id, false);
    launch(record.id);
    if (record.state == RunState::waiting && !isStandIn(record)) sayWhatItWaitsFor(standing);
  });
}

// Its process may find nothing to do and end at once, which nobody would see.
void RunController::sayWhatItWaitsFor(const Standing& standing) {
  const auto& [run, count] = standing;
  if (count.settled >= count.wanted) return;
  const QString waits =
      tr("%1 waits for real fitness: %2 of %3 are measured.").arg(runName(run)).arg(count.settled).arg(count.wanted);
  bench_.note(waits + ' ' +
              (isMeasuredByPerson(run)
                   ? tr("Enter the other values in the measurement sheet; the run goes on then.")
                   : tr("“%1” is asked for the others each time that the run goes on; values entered in the "
                        "measurement sheet count as well.")
                         .arg(QString::fromStdString(run.reality))));
  if (run.id == bench_.run().id) emit bench_.dockWanted("sheet");
}

void RunController::resumeMeasured(Id run) {
  if (bench_.watcher().activeRuns().count(run) > 0) measuredMeanwhile_.insert(run);
  resume(run);
}

void RunController::launch(Id run) {
  if (!bench_.launcher().work(bench_.path(), run, jobs_)) return;
  emit bench_.messagesOver();
  launched_.insert(run);
  processes_.start();
  bench_.watcher().poll();
}

void RunController::checkMeasured() {
  for (const Id run : std::exchange(measuredMeanwhile_, {})) {
    if (bench_.watcher().activeRuns().count(run) > 0) {
      measuredMeanwhile_.insert(run);
      continue;
    }
    readStanding(run, "measured", [this](const Standing& now) {
      if (now.run.state == RunState::waiting && now.count.settled >= now.count.wanted) resume(now.run.id);
    });
  }
}

// A process that ends without leaving its run waiting, stopped or finished has something to say; so has one whose robot
// failed: its run waits, and keeps the same words. One may end before it has locked anything.
void RunController::checkLaunched() {
  checkMeasured();
  const RunLauncher& launcher = bench_.launcher();
  for (auto run = launched_.begin(); run != launched_.end();) {
    if (launcher.isAlive(*run)) {
      ++run;
      continue;
    }
    readStanding(*run, "ended", [this](const Standing& end) {
      const RunState state = end.run.state;
      if (state == RunState::stopped || state == RunState::finished) return;
      const QString words = bench_.launcher().lastWords(end.run.id), kept = QString::fromStdString(end.run.message);
      if (state == RunState::waiting && (kept.isEmpty() || !words.endsWith(kept))) return;
      bench_.report(tr("%1 ended: %2")
                        .arg(runName(end.run), words.isEmpty()
                                                   ? tr("its process was ended, or crashed, and said nothing. What is "
                                                        "stored is kept; Continue goes on from there.")
                                                   : words));
    });
    run = launched_.erase(run);
  }
  if (launched_.empty()) processes_.stop();
}

void RunController::stop(Id run) {
  if (run == 0) return;
  bench_.guard([&] {
    bench_.writer().requestStop(run, true);
    bench_.watcher().poll();
    bench_.inform(tr("Asked run %1 to stop; what it has done is kept.").arg(run));
  });
}

/// The run of the same experiment that has that seed: a second one would be the same bits.
const RunRecord* RunController::runWith(const RunRecord& like, std::uint64_t seed) const {
  const std::vector<RunRecord>& runs = bench_.watcher().runs();
  const auto same = std::ranges::find_if(
      runs, [&](const RunRecord& other) { return other.specSha256 == like.specSha256 && other.seed == seed; });
  return same != runs.end() ? &*same : nullptr;
}

void RunController::duplicate(Id run) {
  const RunRecord* record = bench_.watcher().run(run);
  if (!record) return;
  std::uint64_t free = record->seed + 1;
  while (runWith(*record, free)) ++free;
  bench_.guard([&] {
    bool ok = false;
    const QString typed = QInputDialog::getText(bench_.window(), tr("Duplicate with another seed"),
                                                tr("Seed (a whole number from 0 to 9007199254740991):"),
                                                QLineEdit::Normal, QString::number(free), &ok);
    if (!ok) return;
    const quint64 seed = typed.trimmed().toULongLong(&ok);
    if (!ok || seed > 9007199254740991ULL)
      return bench_.report(tr("Seed: %1 is not allowed; a whole number from 0 to 9007199254740991").arg(typed));
    // Read anew: the dialog may have been open for long.
    const RunRecord* original = bench_.watcher().run(run);
    if (const RunRecord* same = original ? runWith(*original, seed) : nullptr)
      return bench_.report(tr("Seed: %1 is that of run %2 already, and would give the same run again; another one")
                               .arg(seed)
                               .arg(same->id));
    bench_.launcher().duplicate(bench_.path(), run, seed);
  });
}

void RunController::editRunNote(Id run) {
  const RunRecord* record = bench_.watcher().run(run);
  if (!record) return;
  bench_.guard([&] {
    bool ok = false;
    const QString note = QInputDialog::getText(bench_.window(), tr("Note"), tr("Note on %1:").arg(runName(*record)),
                                               QLineEdit::Normal, QString::fromStdString(record->note), &ok);
    if (!ok) return;
    bench_.writer().setRunNote(run, note.trimmed().toStdString());
    bench_.watcher().poll();
  });
}

void RunController::editExperimentNote(Id experiment) {
  bench_.guard([&] {
    bool ok = false;
    const std::vector<ExperimentRecord> all = bench_.watcher().experiments();
    const auto record = std::ranges::find(all, experiment, &ExperimentRecord::id);
    if (record == all.end()) return;
    const QString note =
        QInputDialog::getText(bench_.window(), tr("Note"), tr("Note on %1:").arg(bench_.nameOfExperiment(experiment)),
                              QLineEdit::Normal, QString::fromStdString(record->note), &ok);
    if (!ok) return;
    bench_.writer().setExperimentNote(experiment, note.trimmed().toStdString());
    bench_.watcher().poll();
  });
}

void RunController::renameExperiment(Id experiment) {
  bench_.guard([&] {
    bool ok = false;
    const QString before = bench_.nameOfExperiment(experiment);
    const QString name = QInputDialog::getText(bench_.window(), tr("Rename"),
                                               tr("Name of the experiment in this program (empty: as it is stored):"),
                                               QLineEdit::Normal, before, &ok)
                             .trimmed();
    if (ok && name != before) bench_.nameExperiment(experiment, name);
  });
}

void RunController::exportTable(Id run, const QString& what) {
  if (run == 0) return;
  const QString suggestion = QFileInfo(bench_.path()).dir().filePath(QStringLiteral("run%1-%2.csv").arg(run).arg(what));
  const QString file = QFileDialog::getSaveFileName(bench_.window(), tr("Export"), suggestion, tr("Tables (*.csv)"));
  if (!file.isEmpty()) bench_.launcher().exportCsv(bench_.path(), run, what, file);
}

void RunController::mergeWithDialog() {
  const QString path = QFileDialog::getOpenFileName(bench_.window(), tr("Add the runs of another database"),
                                                    bench_.path(), tr("Experiment databases (*.db);;All files (*)"));
  if (!path.isEmpty()) merge(path);
}

void RunController::backUpWithDialog() {
  const QString path = QFileDialog::getSaveFileName(bench_.window(), tr("Back up the database"),
                                                    bench_.path() + ".backup.db", tr("Experiment databases (*.db)"));
  if (!path.isEmpty())
    bench_.launcher().backUp(bench_.path(), QFileInfo(path).suffix().isEmpty() ? path + ".db" : path);
}

void RunController::merge(const QString& from) {
  if (!bench_.watcher().isOpen())
    return bench_.report(tr("No database is open that could take the runs: open or make one first"));
  if (merging_->isRunning()) return bench_.report(tr("Runs of %1 are still being copied").arg(mergedFrom_));
  mergedFrom_ = from;
  merging_->start({"--json", "merge", from, "--db", bench_.path()});
}

bool RunController::mayClose() {
  bench_.watcher().poll();
  const std::set<Id> active = bench_.watcher().activeRuns();
  if (active.empty()) return true;
  QMessageBox box(bench_.window());
  box.setObjectName("closeQuestion");
  box.setIcon(QMessageBox::Question);
  box.setWindowTitle(tr("A run is working"));
  box.setText(active.size() == 1 ? tr("Run %1 is still learning.").arg(*active.begin())
                                 : tr("%1 runs are still learning.").arg(active.size()));
  box.setInformativeText(
      tr("It can go on without the window and will be found here again. If it is stopped, it can be continued with the "
         "same bits."));
  auto* leave = box.addButton(tr("Leave it running"), QMessageBox::AcceptRole);
  auto* stopping = box.addButton(tr("Stop it"), QMessageBox::DestructiveRole);
  auto* cancel = box.addButton(tr("Cancel"), QMessageBox::RejectRole);
  leave->setObjectName("leave");
  stopping->setObjectName("stop");
  cancel->setObjectName("cancel");
  box.setDefaultButton(leave);
  box.setEscapeButton(cancel);
  box.exec();
  if (box.clickedButton() == stopping)
    for (const Id run : active) stop(run);
  return box.clickedButton() == stopping || box.clickedButton() == leave;
}

}  // namespace btr::ui
