#include "ui/gap/analysis_process.h"

namespace btr::ui {

QStringList argumentsOf(const AnalysisJob& job) {
  QStringList arguments{"gap", "analyse", job.scene};
  for (const QString& recording : job.recordings) arguments << "--recording" << recording;
  for (const QString& recording : job.heldOut) arguments << "--held-out" << recording;
  if (!job.mapping.isEmpty()) arguments << "--mapping" << job.mapping;
  if (!job.simulator.isEmpty()) arguments << "--simulator" << job.simulator;
  if (job.jobs > 0) arguments << "--jobs" << QString::number(job.jobs);
  constexpr int minute_s = 60;
  if (job.within_min > 0) arguments << "--within" << QString::number(minute_s * job.within_min);
  if (job.asRecorded) arguments << "--as-recorded";
  return arguments << "--seed" << QString::number(job.seed) << "--out" << job.out << "--progress";
}

AnalysisProcess::AnalysisProcess(const QString& program, QObject* parent) : ProgramProcess(program, parent) {
  connect(this, &ProgramProcess::done, this, [this] { emit finished(out_); });
}

void AnalysisProcess::start(const AnalysisJob& job) {
  if (!isRunning()) out_ = job.out;
  ProgramProcess::start(argumentsOf(job));
}

}  // namespace btr::ui
