#include "ui/controllers/machines_controller.h"

#include <signal.h>

#include <QCoreApplication>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QRegularExpression>
#include <QStandardPaths>

#include "core/spec/error.h"
#include "core/spec/file_kind.h"
#include "core/spec/json_reader.h"

namespace btr::ui {
namespace {

constexpr int betweenLooks_ms = 2000;
constexpr const char *ranksFile = "ranks.json", *placesFile = "places.json";

/// "compare", "grid" or "run"; empty for a file that is none of them.
QString commandFor(const QString& file) {
  const std::string path = file.toStdString();
  const FileKind kind = kindOfFile(path);
  if (kind == FileKind::grid) return "grid";
  if (kind == FileKind::experiment) return "run";
  if (kind == FileKind::otherFormat && kindInWords(path).find("uchilsim-comparison-") != std::string::npos)
    return "compare";
  return {};
}

QStringList hostLines(const QString& text) {
  QStringList lines;
  for (QString line : text.split('\n')) {
    line = line.section('#', 0, 0).trimmed();
    if (!line.isEmpty()) lines << line;
  }
  return lines;
}

/// "2/lab7" is how many at a time, and where, in a file of hosts; "lab7 slots=2" in one of Open MPI's.
QString mpiHosts(const QStringList& lines) {
  static const QRegularExpression counted(QStringLiteral("^(\\d+)/(.+)$"));
  QString all;
  for (const QString& line : lines) {
    const QRegularExpressionMatch match = counted.match(line);
    all += match.hasMatch() ? match.captured(2) + " slots=" + match.captured(1) : line + " slots=1";
    all += '\n';
  }
  return all;
}

/// Of a command that takes them.
QString workersOption(const QString& command) { return command == "grid" ? "--workers" : "--jobs"; }

/// What a program that ended said, as one sentence: the last line of btr's own, else the first paragraph. mpirun draws
/// lines around its own.
QString sentenceIn(const QString& words) {
  static const QRegularExpression drawn(QStringLiteral("^-{5,}$"));
  QString own;
  QStringList paragraph;
  bool isOver = false;
  for (const QString& each : words.split('\n')) {
    const QString line = each.simplified();
    const bool isBetween = line.isEmpty() || drawn.match(line).hasMatch();
    if (line.startsWith("btr: ")) own = line;
    if (isBetween)
      isOver = isOver || !paragraph.isEmpty();
    else if (!isOver)
      paragraph << line;
  }
  return own.isEmpty() ? paragraph.join(' ') : own;
}

QString tr(const char* text) { return QCoreApplication::translate("MachinesController", text); }

}  // namespace

QString objectionTo(const MachinesOrder& order) {
  if (order.file.isEmpty()) return tr("Choose what is to be worked on.");
  if (!QFileInfo(order.file).isFile()) return tr("%1 is not there.").arg(order.file);
  const QString command = commandFor(order.file);
  if (command.isEmpty())
    return tr("%1 is %2; a comparison, a grid or an experiment is expected.")
        .arg(order.file, QString::fromStdString(kindInWords(order.file.toStdString())));
  if (command == "run" && order.way != MachinesOrder::Way::ranks)
    return tr("%1 is one experiment; that is worked on by ranks of MPI. Comparisons and grids go over ssh and to "
              "Slurm.")
        .arg(order.file);
  if (order.database.isEmpty()) return tr("Open or make a database first: it gets the results.");
  if (order.folder.isEmpty()) return tr("Name a folder for the job.");
  const QFileInfo folder(order.folder);
  if (folder.exists() && !folder.isDir()) return tr("%1 is a file; name a folder for the job.").arg(order.folder);
  if (folder.exists() && !QDir(order.folder).isEmpty())
    return tr("%1 holds something; name a new folder for the job, or open the job that is in it.").arg(order.folder);
  if (order.way == MachinesOrder::Way::ssh && hostLines(order.hosts).isEmpty())
    return tr("Name the computers that ssh reaches, one a line.");
  return {};
}

MachinesController::MachinesController(const QString& program, QObject* parent)
    : QObject(parent), program_(program.isEmpty() ? QCoreApplication::applicationDirPath() + "/btr" : program) {
  timer_.setInterval(betweenLooks_ms);
  connect(&timer_, &QTimer::timeout, this, &MachinesController::poll);
}

// Short commands that are under way may end; nobody hears of it.
MachinesController::~MachinesController() {
  constexpr int patience_ms = 5000;
  for (QProcess* process : findChildren<QProcess*>()) {
    process->disconnect(this);
    if (process->state() != QProcess::NotRunning && !process->waitForFinished(patience_ms)) process->kill();
    process->waitForFinished(patience_ms);
  }
  work_.forget();
}

QString MachinesController::path(const char* name) const { return QDir(folder_).filePath(name); }
bool MachinesController::isRanks() const { return QFileInfo::exists(path(ranksFile)); }

bool MachinesController::isGoing() const {
  if (folder_.isEmpty()) return false;
  if (work_.isAlive()) return true;
  if (!isRanks()) return known_ && status_.isGoing();
  QFile file(path(ranksFile));
  if (!file.open(QIODevice::ReadOnly)) return false;
  const qint64 process = QJsonDocument::fromJson(file.readAll())["process"].toInteger();
  QFile words(QStringLiteral("/proc/%1/cmdline").arg(process));
  // The number may be another process's by now.
  return isProcessAlive(process) && words.open(QIODevice::ReadOnly) &&
         words.readAll().contains(path(placesFile).toUtf8());
}

QString MachinesController::hosts() const {
  QFile file(path(isRanks() ? "hosts.txt" : "hosts"));
  return !folder_.isEmpty() && file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()).trimmed() : QString();
}

void MachinesController::follow(const QString& folder) {
  work_.forget();
  work_ = {};
  working_ = false;
  hostsFile_.clear();
  said_.clear();
  complaint_.clear();
  folder_ = folder.isEmpty() ? folder : QDir(folder).absolutePath();
  status_ = {};
  known_ = false;
  ++generation_;
  timer_.start();
  emit changed();
}

void MachinesController::open(const QString& folder) {
  follow(folder);
  poll();
}

bool MachinesController::start(const MachinesOrder& order) {
  if (const QString objection = objectionTo(order); !objection.isEmpty()) {
    emit told(objection, true);
    return false;
  }
  follow(order.folder);
  return order.way == MachinesOrder::Way::ranks ? startRanks(order) : startArray(order);
}

bool MachinesController::launch(const QString& program, const QStringList& arguments) {
  const QString problem = work_.start(program, arguments, QStringLiteral("machines-%1").arg(generation_));
  if (!problem.isEmpty()) {
    emit told(problem, true);
    return false;
  }
  working_ = true;
  emit changed();
  return true;
}

bool MachinesController::startArray(const MachinesOrder& order) {
  const QString command = commandFor(order.file);
  QStringList arguments{
      command, order.file, "--db", order.database, workersOption(command), QString::number(order.workers), "--quiet"};
  if (order.way == MachinesOrder::Way::ssh) {
    const QString hosts = QStringLiteral("%1/uchilsim-%2-hosts-%3")
                              .arg(QStandardPaths::writableLocation(QStandardPaths::TempLocation))
                              .arg(QCoreApplication::applicationPid())
                              .arg(generation_);
    try {
      writeFile(hosts.toStdString(), hostLines(order.hosts).join('\n').toStdString() + "\n");
    } catch (const InputError& error) {
      emit told(QString::fromUtf8(error.what()), true);
      return false;
    }
    hostsFile_ = hosts;
    return launch(program_, arguments << "--ssh" << folder_ << "--hosts" << hosts);
  }
  arguments << "--slurm" << folder_;
  for (const QString& option : order.options.split(QRegularExpression(QStringLiteral("\\s+")), Qt::SkipEmptyParts))
    arguments << "--slurm-option=" + option;
  ask(arguments, [this](const QByteArray&) { emit told(tr("The job is in Slurm's queue."), false); });
  return true;
}

bool MachinesController::startRanks(const MachinesOrder& order) {
  const QString command = commandFor(order.file);
  QStringList words{"-n", QString::number(order.ranks)};
  const QStringList hosts = hostLines(order.hosts);
  try {
    if (!QDir().mkpath(folder_)) throw InputError(folder_.toStdString() + ": the folder cannot be made");
    if (hosts.isEmpty()) {
      words << "--oversubscribe"
            << "--bind-to"
            << "none";
    } else {
      writeFile(path("hosts.txt").toStdString(), hosts.join('\n').toStdString() + "\n");
      writeFile(path("hostfile").toStdString(), mpiHosts(hosts).toStdString());
      words << "--hostfile" << path("hostfile");
    }
    words << program_ << command << order.file << "--db" << order.database << workersOption(command)
          << QString::number(order.workers) << "--quiet"
          << "--places" << path(placesFile);
    const QJsonObject job{{"format", "uchilsim-ranks-1"}, {"words", QJsonArray::fromStringList(words)}};
    writeFile(path(ranksFile).toStdString(), QJsonDocument(job).toJson().toStdString());
  } catch (const InputError& error) {
    emit told(QString::fromUtf8(error.what()), true);
    return false;
  }
  return goRanks();
}

// The same command goes on from the database.
bool MachinesController::goRanks() {
  QFile file(path(ranksFile));
  if (!file.open(QIODevice::ReadOnly)) return false;
  QJsonObject job = QJsonDocument::fromJson(file.readAll()).object();
  file.close();
  QStringList words;
  for (const QJsonValue& word : job["words"].toArray()) words << word.toString();
  if (QStandardPaths::findExecutable("mpirun").isEmpty()) {
    emit told(tr("mpirun is not installed (package openmpi-bin)."), true);
    return false;
  }
  if (!launch("mpirun", words)) return false;
  job["process"] = work_.process();
  try {
    writeFile(path(ranksFile).toStdString(), QJsonDocument(job).toJson().toStdString());
  } catch (const InputError& error) {
    emit told(QString::fromUtf8(error.what()), true);
  }
  return true;
}

// One short command of the program; one that cannot be started is told.
void MachinesController::run(const QStringList& arguments, const std::function<void(const Answer&)>& ended,
                             const std::function<void()>& notStarted) {
  auto* process = new QProcess(this);
  connect(process, &QProcess::finished, this, [process, ended](int code, QProcess::ExitStatus status) {
    process->deleteLater();
    const bool wasKilled = status != QProcess::NormalExit;
    const QString words = lastLine(QString::fromUtf8(process->readAllStandardError()));
    ended({wasKilled ? -1 : code, process->readAllStandardOutput(),
           wasKilled && words.isEmpty() ? tr("%1 was killed").arg(process->program()) : words});
  });
  connect(process, &QProcess::errorOccurred, this, [this, process, notStarted](QProcess::ProcessError error) {
    if (error != QProcess::FailedToStart) return;
    process->deleteLater();
    emit told(tr("%1 cannot be started: %2").arg(program_, process->errorString()), true);
    notStarted();
  });
  process->setStandardInputFile(QProcess::nullDevice());
  process->start(program_, arguments);
}

void MachinesController::ask(const QStringList& arguments, const std::function<void(const QByteArray&)>& done) {
  ++busy_;
  const auto over = [this] {
    --busy_;
    emit changed();
    poll();
  };
  run(
      arguments,
      [this, done, over](const Answer& answer) {
        constexpr int stoppedEarly = 3;  // with what is missing in its answer
        if (answer.code == 0 || answer.code == stoppedEarly)
          done(answer.out);
        else
          emit told(answer.lastWords, true);
        over();
      },
      over);
  emit changed();
}

void MachinesController::cancel() {
  if (folder_.isEmpty()) return;
  if (!isRanks()) {
    ask({"array", "cancel", folder_},
        [this](const QByteArray&) { emit told(tr("Asked to stop; what has been done is kept."), false); });
    return;
  }
  if (!isGoing()) return emit told(tr("%1: nobody works on it.").arg(folder_), true);
  QFile file(path(ranksFile));
  if (!file.open(QIODevice::ReadOnly)) return emit told(tr("%1 cannot be read.").arg(file.fileName()), true);
  ::kill(static_cast<pid_t>(QJsonDocument::fromJson(file.readAll())["process"].toInteger()), SIGINT);
  emit told(tr("Asked to stop; what has been done is kept."), false);
}

void MachinesController::resume(const QString& hosts) {
  if (folder_.isEmpty()) return;
  if (isGoing()) return emit told(tr("The job is being worked on."), true);
  said_.clear();
  if (isRanks()) {
    goRanks();
    return;
  }
  const QStringList lines = hostLines(hosts);
  if (lines.isEmpty() && !status_.isSlurms)
    return emit told(tr("Name the computers that ssh reaches, one a line."), true);
  if (lines.isEmpty()) {
    ask({"array", "resume", folder_},
        [this](const QByteArray& answer) { emit told(lastLine(QString::fromUtf8(answer)), false); });
    return;
  }
  const QString file = path("hosts-again");
  try {
    writeFile(file.toStdString(), lines.join('\n').toStdString() + "\n");
  } catch (const InputError& error) {
    return emit told(QString::fromUtf8(error.what()), true);
  }
  launch(program_, {"array", "resume", folder_, "--hosts", file});
}

void MachinesController::collect() {
  if (folder_.isEmpty() || isRanks()) return;
  ask({"array", "collect", folder_}, [this](const QByteArray& answer) {
    emit told(lastLine(QString::fromUtf8(answer)), false);
    emit collected(status_.into);
  });
}

void MachinesController::poll() {
  if (folder_.isEmpty()) return;
  noticeEnd();
  if (isRanks()) return readPlaces();
  if (asking_ || busy_ > 0) return;
  if (work_.process() > 0 && !QFileInfo::exists(path("job.json"))) {
    // It is being written, or what should have written it has said why not.
    if (!working_) timer_.stop();
    return;
  }
  asking_ = true;
  run(
      {"--json", "array", "status", folder_},
      [this, generation = generation_](const Answer& answer) {
        asking_ = false;
        if (generation != generation_) return poll();
        QString problem;
        if (answer.code != 0) problem = answer.lastWords;
        try {
          if (problem.isEmpty()) take(arrayStatus(answer.out));
        } catch (const InputError& error) {
          problem = QString::fromUtf8(error.what());
        }
        // Said once: a queue that does not answer may do so later.
        if (!problem.isEmpty() && problem != complaint_) emit told(problem, true);
        if (!problem.isEmpty() && !known_) timer_.stop();
        complaint_ = problem;
      },
      [this] {
        asking_ = false;
        timer_.stop();
      });
}

void MachinesController::readPlaces() {
  QFile file(path(placesFile));
  if (!file.open(QIODevice::ReadOnly)) return;  // the first one has not come yet
  try {
    take(placesStatus(file.readAll(), file.fileName()));
  } catch (const InputError& error) {
    emit told(QString::fromUtf8(error.what()), true);
  }
}

void MachinesController::take(const JobStatus& status) {
  status_ = status;
  known_ = true;
  emit changed();
}

// What works over ssh, or as ranks, says on standard error what went wrong: a host that is left out, a folder that
// cannot be written.
void MachinesController::noticeEnd() {
  if (!working_) return;
  const bool isAlive = work_.isAlive();
  if (const QString words = sentenceIn(work_.words()); !words.isEmpty() && words != said_) {
    said_ = words;
    emit told(words, !isAlive);
  }
  if (isAlive) return;
  if (!hostsFile_.isEmpty()) QFile::remove(hostsFile_);
  working_ = false;
  emit changed();
}

}  // namespace btr::ui
