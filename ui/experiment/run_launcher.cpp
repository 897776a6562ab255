#include "ui/experiment/run_launcher.h"

#include <QCoreApplication>
#include <QProcess>

#include "core/run/loop/back_to_reality.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/store/database.h"

namespace btr::ui {
namespace {

QStringList ownerWords(Id run, const QString& rig) {
  return rig.isEmpty() ? QStringList{"--run", QString::number(run)} : QStringList{"--rig", rig};
}

}  // namespace

RunLauncher::RunLauncher(std::shared_ptr<const PluginHost> host, const QString& program, QObject* parent)
    : QObject(parent),
      host_(std::move(host)),
      program_(program.isEmpty() ? QCoreApplication::applicationDirPath() + "/btr" : program) {}

RunLauncher::~RunLauncher() {
  if (thread_) thread_->wait();
  // A process that goes on without the window keeps its open file.
  for (auto& [name, process] : processes_) process.forget();
}

void RunLauncher::store(const QString& database, const ExperimentSpec& spec, quint64 seed, bool again) {
  inThread([this, path = database.toStdString(), spec, seed, again, host = host_] {
    Database db = Database::open(path, Database::Mode::readWrite);
    std::string differs;
    const Id run = startRun(db, *host, spec, seed, again, &differs);
    QStringList remarks;
    if (!differs.empty()) remarks << QString::fromStdString(differs);
    for (const std::string& loss : runLosses(db.run(run), *host)) remarks << QString::fromStdString(loss);
    if (!remarks.isEmpty()) QMetaObject::invokeMethod(this, [this, text = remarks.join('\n')] { emit remarked(text); });
    return run;
  });
}

void RunLauncher::duplicate(const QString& database, Id run, quint64 seed) {
  inThread([path = database.toStdString(), run, seed, host = host_] {
    Database db = Database::open(path, Database::Mode::readWrite);
    const RunRecord old = db.run(run);
    const PreparedExperiment prepared = prepareFromRun(old, *host);
    SimulatorRecord first;
    first.simulator = prepared.spec.simulator;
    first.madeBy = "start";
    return db.addRun(makeRunRecord(prepared, old.experiment, seed), first);
  });
}

// One task at a time: the window disables what would start a second.
void RunLauncher::inThread(std::function<Id()> task) {
  if (thread_) return emit failed(tr("Another run is just being prepared."));
  thread_.reset(QThread::create([this, task = std::move(task)] {
    Id run = 0;
    QString error;
    try {
      run = task();
    } catch (const std::exception& problem) {
      error = QString::fromUtf8(problem.what());
    }
    QMetaObject::invokeMethod(this, [this, run, error] {
      thread_->wait();
      thread_.reset();
      if (error.isEmpty())
        emit stored(run);
      else
        emit failed(error);
    });
  }));
  thread_->start();
}

bool RunLauncher::work(const QString& database, Id run, int jobs) {
  return start(nameOf(run), {"run", "--db", database, "--run", QString::number(run), "--quiet"}, "--jobs", jobs);
}

bool RunLauncher::learnGrids(const QString& database, const QString& file, int workers) {
  return start(grids, {"grid", file, "--db", database, "--quiet"}, "--workers", workers);
}

bool RunLauncher::continueGrid(const QString& database, Id grid, int workers) {
  return start(grids, {"grid", "--db", database, "--grid", QString::number(grid), "--quiet"}, "--workers", workers);
}

bool RunLauncher::start(const QString& name, QStringList arguments, const QString& jobsOption, int jobs) {
  if (jobs > 0) arguments << jobsOption << QString::number(jobs);
  DetachedProgram process;
  if (const QString problem = process.start(program_, arguments, name); !problem.isEmpty()) {
    emit failed(problem);
    return false;
  }
  processes_[name] = process;
  return true;
}

QString RunLauncher::lastWords(const QString& name) const {
  const auto found = processes_.find(name);
  return found == processes_.end() ? QString() : found->second.lastWords();
}

bool RunLauncher::isAlive(const QString& name) const {
  const auto found = processes_.find(name);
  return found != processes_.end() && found->second.isAlive();
}

void RunLauncher::exportCsv(const QString& database, Id run, const QString& what, const QString& file) {
  runToEnd({"export", "--db", database, "--run", QString::number(run), "--what", what, "--csv", file},
           [this, file] { emit exported(file); });
}

void RunLauncher::backUp(const QString& database, const QString& file) {
  runToEnd({"backup", "--db", database, file, "--force"}, [this, file] { emit backedUp(file); });
}

void RunLauncher::importFitness(const QString& database, Id run, const QString& file, bool confirmed) {
  QStringList arguments{"fitness", "import", "--db", database, "--run", QString::number(run), file};
  if (confirmed) arguments << "--yes";
  runToEnd(arguments, [this, file] { emit imported(file); });
}

void RunLauncher::adopt(const QString& database, Id run, const QString& rig, const QString& simulator,
                        const QString& report) {
  runToEnd(QStringList{"gap", "adopt", "--db", database, "--simulator", simulator, "--report", report} +
               ownerWords(run, rig),
           [this, run, rig] { emit simulatorChanged(run, rig); });
}

void RunLauncher::revert(const QString& database, Id run, const QString& rig) {
  runToEnd(QStringList{"gap", "revert", "--db", database} + ownerWords(run, rig),
           [this, run, rig] { emit simulatorChanged(run, rig); });
}

void RunLauncher::keepRecordings(const QString& database, Id run, const QString& rig, const QStringList& files,
                                 const QString& scene) {
  QStringList arguments = QStringList{"gap", "recordings", "import", "--db", database} + ownerWords(run, rig);
  if (!scene.isEmpty()) arguments += {"--scene", scene};
  runToEnd(arguments + files, [this, count = int(files.size())] { emit recordingsKept(count); });
}

void RunLauncher::checkModel(const QString& file) {
  runToEnd({"model", "check", file},
           std::function<void(const QString&)>([this, file](const QString& text) { emit modelChecked(file, text); }));
}

// Short commands run beside the window; one line on their standard error says what is wrong.
void RunLauncher::runToEnd(const QStringList& arguments, const std::function<void()>& done) {
  runToEnd(arguments, std::function<void(const QString&)>([done](const QString&) { done(); }));
}

void RunLauncher::runToEnd(const QStringList& arguments, const std::function<void(const QString&)>& done) {
  auto* process = new QProcess(this);
  connect(process, &QProcess::finished, this, [this, process, done](int code, QProcess::ExitStatus status) {
    if (status == QProcess::NormalExit && code == 0)
      done(QString::fromUtf8(process->readAllStandardOutput()));
    else
      emit failed(QString::fromUtf8(process->readAllStandardError()).trimmed());
    process->deleteLater();
  });
  connect(process, &QProcess::errorOccurred, this, [this, process](QProcess::ProcessError error) {
    if (error != QProcess::FailedToStart) return;
    emit failed(tr("%1 cannot be started: %2").arg(program_, process->errorString()));
    process->deleteLater();
  });
  process->start(program_, arguments);
}

}  // namespace btr::ui
