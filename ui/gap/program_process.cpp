#include "ui/gap/program_process.h"

#include <QCoreApplication>

#include "ui/common/give_way.h"

namespace btr::ui {

ProgramProcess::ProgramProcess(const QString& program, QObject* parent)
    : QObject(parent), program_(program.isEmpty() ? QCoreApplication::applicationDirPath() + "/btr" : program) {
  process_.setStandardInputFile(QProcess::nullDevice());
  giveWay(process_);
  connect(&process_, &QProcess::started, this, &ProgramProcess::started);
  connect(&process_, &QProcess::readyReadStandardError, this, &ProgramProcess::read);
  connect(&process_, &QProcess::finished, this, &ProgramProcess::end);
  connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart)
      emit failed(tr("%1 cannot be started: %2").arg(program_, process_.errorString()));
  });
}

ProgramProcess::~ProgramProcess() {
  process_.disconnect(this);
  if (!isRunning()) return;
  process_.terminate();
  if (!process_.waitForFinished(3000)) {
    process_.kill();
    process_.waitForFinished(1000);
  }
}

void ProgramProcess::start(const QStringList& arguments) {
  if (isRunning()) return emit failed(tr("An analysis is running already."));
  words_.clear();
  line_.clear();
  cancelling_ = false;
  process_.start(program_, arguments);
}

void ProgramProcess::cancel() {
  if (!isRunning()) return;
  cancelling_ = true;
  process_.terminate();
}

// Lines "STAGE SHARE"; any other line is something to tell when it goes wrong.
void ProgramProcess::read() {
  line_ += process_.readAllStandardError();
  for (qsizetype end = line_.indexOf('\n'); end >= 0; end = line_.indexOf('\n')) {
    const QString text = QString::fromUtf8(line_.left(end)).trimmed();
    line_.remove(0, end + 1);
    if (text.isEmpty()) continue;
    const qsizetype space = text.lastIndexOf(' ');
    bool isNumber = false;
    const double share = text.mid(space + 1).toDouble(&isNumber);
    if (space > 0 && isNumber && share >= 0 && share <= 1)
      emit progressed(text.left(space), share);
    else
      words_ = text;
  }
}

void ProgramProcess::end(int code, QProcess::ExitStatus status) {
  line_ += process_.readAllStandardError() + '\n';
  read();
  if (status == QProcess::NormalExit && code == 0) return emit done(process_.readAllStandardOutput());
  if (cancelling_) return emit cancelled();
  emit failed(words_.isEmpty() ? tr("The analysis ended without saying why (exit code %1).").arg(code) : words_);
}

}  // namespace btr::ui
