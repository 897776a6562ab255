#include "ui/experiment/detached_program.h"

#include <signal.h>

#include <QCoreApplication>
#include <QFile>
#include <QProcess>
#include <QStandardPaths>

#include "ui/common/give_way.h"

namespace btr::ui {

QString DetachedProgram::start(const QString& program, const QStringList& arguments, const QString& name) {
  const QString folder = QStandardPaths::writableLocation(QStandardPaths::TempLocation);
  const QString log =
      QStringLiteral("%1/uchilsim-%2-%3.log").arg(folder).arg(QCoreApplication::applicationPid()).arg(name);
  QProcess starter;
  starter.setProgram(program);
  starter.setArguments(arguments);
  starter.setStandardInputFile(QProcess::nullDevice());
  starter.setStandardOutputFile(QProcess::nullDevice());
  starter.setStandardErrorFile(log);
  if (!startDetachedGivingWay(starter, &process_))
    return QCoreApplication::translate("DetachedProgram", "%1 cannot be started: %2")
        .arg(program, starter.errorString());
  log_ = log;
  return {};
}

bool DetachedProgram::isAlive() const { return isProcessAlive(process_); }

QString DetachedProgram::words() const {
  QFile log(log_);
  if (log_.isEmpty() || !log.open(QIODevice::ReadOnly)) return {};
  if (log.size() > 4096) log.seek(log.size() - 4096);
  return QString::fromUtf8(log.readAll()).trimmed();
}

QString DetachedProgram::lastWords() const { return lastLine(words()); }

void DetachedProgram::forget() {
  if (!log_.isEmpty()) QFile::remove(log_);
}

QString lastLine(const QString& text) {
  const QStringList lines = text.split('\n', Qt::SkipEmptyParts);
  return lines.isEmpty() ? QString() : lines.last().trimmed();
}

// A process that has ended may stay as a zombie until the system collects it: state Z after the name in parentheses.
bool isProcessAlive(qint64 process) {
  if (process <= 0 || ::kill(static_cast<pid_t>(process), 0) != 0) return false;
  QFile stat(QStringLiteral("/proc/%1/stat").arg(process));
  if (!stat.open(QIODevice::ReadOnly)) return true;
  const QByteArray text = stat.readAll();
  return !text.mid(text.lastIndexOf(')') + 1).trimmed().startsWith('Z');
}

}  // namespace btr::ui
