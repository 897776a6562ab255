#include "ui/gap/analysis_process.h"

#include <QCoreApplication>

namespace btr::ui {

QStringList argumentsOf(const AnalysisJob& job) {
  QStringList arguments{"gap", "analyse", job.scene};
  for (const QString& recording : job.recordings) arguments << "--recording" << recording;
  for (const QString& recording : job.heldOut) arguments << "--held-out" << recording;
  if (!job.mapping.isEmpty()) arguments << "--mapping" << job.mapping;
  if (!job.simulator.isEmpty()) arguments << "--simulator" << job.simulator;
  if (job.jobs > 0) arguments << "--jobs" << QString::number(job.jobs);
  return arguments << "--seed" << QString::number(job.seed) << "--out" << job.out << "--progress";
}

AnalysisProcess::AnalysisProcess(const QString& program, QObject* parent)
    : QObject(parent), program_(program.isEmpty() ? QCoreApplication::applicationDirPath() + "/btr" : program) {
  process_.setStandardInputFile(QProcess::nullDevice());
  process_.setStandardOutputFile(QProcess::nullDevice());
  connect(&process_, &QProcess::started, this, &AnalysisProcess::started);
  connect(&process_, &QProcess::readyReadStandardError, this, &AnalysisProcess::read);
  connect(&process_, &QProcess::finished, this, &AnalysisProcess::end);
  connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart)
      emit failed(tr("%1 cannot be started: %2").arg(program_, process_.errorString()));
  });
}

AnalysisProcess::~AnalysisProcess() {
  process_.disconnect(this);
  if (!isRunning()) return;
  process_.terminate();
  if (!process_.waitForFinished(3000)) {
    process_.kill();
    process_.waitForFinished(1000);
  }
}

void AnalysisProcess::start(const AnalysisJob& job) {
  if (isRunning()) return emit failed(tr("An analysis is running already."));
  out_ = job.out;
  words_.clear();
  line_.clear();
  cancelling_ = false;
  process_.start(program_, argumentsOf(job));
}

void AnalysisProcess::cancel() {
  if (!isRunning()) return;
  cancelling_ = true;
  process_.terminate();
}

// Lines "STAGE SHARE"; any other line is something to tell when it goes wrong.
void AnalysisProcess::read() {
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

void AnalysisProcess::end(int code, QProcess::ExitStatus status) {
  line_ += process_.readAllStandardError() + '\n';
  read();
  if (status == QProcess::NormalExit && code == 0) return emit finished(out_);
  if (cancelling_) return emit cancelled();
  emit failed(words_.isEmpty() ? tr("The analysis ended without saying why (exit code %1).").arg(code) : words_);
}

}  // namespace btr::ui
