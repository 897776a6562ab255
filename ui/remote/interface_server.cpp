#include "ui/remote/interface_server.h"

#include <QCoreApplication>

namespace btr::ui {

InterfaceServer::InterfaceServer(const QString& program, QObject* parent)
    : QObject(parent),
      program_(program.isEmpty() ? QCoreApplication::applicationDirPath() + "/btr-serve" : program),
      state_(tr("Off.")) {
  process_.setStandardInputFile(QProcess::nullDevice());
  connect(&process_, &QProcess::readyReadStandardOutput, this, &InterfaceServer::read);
  connect(&process_, &QProcess::readyReadStandardError, this,
          [this] { errors_ = (errors_ + process_.readAllStandardError()).right(2000); });
  connect(&process_, &QProcess::finished, this, [this](int code) {
    errors_ += process_.readAllStandardError();
    tell(code == 0 ? tr("Off.") : QString::fromUtf8(errors_).trimmed().section('\n', -1));
  });
  connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) tell(tr("%1 cannot be started: %2").arg(program_, process_.errorString()));
  });
}

InterfaceServer::~InterfaceServer() {
  process_.disconnect(this);
  if (!isOn()) return;
  process_.terminate();
  constexpr int patience_ms = 5000;
  if (process_.waitForFinished(patience_ms)) return;
  process_.kill();
  process_.waitForFinished(1000);
}

void InterfaceServer::start(const InterfaceOptions& options) {
  if (isOn()) return;
  QStringList arguments{"--port", QString::number(options.port)};
  if (!options.folder.isEmpty()) arguments << "--games" << options.folder;
  if (!options.database.isEmpty()) arguments << "--db" << options.database;
  out_.clear();
  errors_.clear();
  process_.start(program_, arguments);
  if (isOn()) tell(tr("It starts …"));
}

void InterfaceServer::stop() {
  if (isOn()) process_.terminate();
}

// Its first line says where it listens.
void InterfaceServer::read() {
  out_ += process_.readAllStandardOutput();
  if (const qsizetype end = out_.indexOf('\n'); end >= 0) tell(QString::fromUtf8(out_.left(end)));
}

void InterfaceServer::tell(const QString& state) {
  state_ = state;
  emit changed();
}

}  // namespace btr::ui
