#pragma once
#include <QObject>
#include <QProcess>
#include <QStringList>

namespace btr::ui {

/// What is to be analysed: paths as the command line takes them.
struct AnalysisJob {
  QString scene;
  QStringList recordings, heldOut;
  QString mapping, simulator, out;  ///< empty: none; out is needed
  int jobs = 0;                     ///< 0: as the program decides
  quint64 seed = 1;
  bool operator==(const AnalysisJob&) const = default;
};

/// The arguments of "btr gap analyse" for a job.
QStringList argumentsOf(const AnalysisJob& job);

/// Runs "btr gap analyse" beside the window: tells its progress, can be cancelled, and ends with the report's folder or
/// a message. One at a time. It ends with the window: an analysis that nobody waits for is started with btr itself.
class AnalysisProcess : public QObject {
  Q_OBJECT
 public:
  /// `program`: empty means btr beside this executable.
  explicit AnalysisProcess(const QString& program = {}, QObject* parent = nullptr);
  ~AnalysisProcess() override;

  void start(const AnalysisJob& job);
  /// Asks it to stop; finished() or failed() follows.
  void cancel();
  bool isRunning() const { return process_.state() != QProcess::NotRunning; }

 signals:
  void started();
  /// `share` 0 … 1, negative if the step does not say.
  void progressed(const QString& stage, double share);
  void finished(const QString& reportFolder);
  void cancelled();
  void failed(const QString& message);

 private:
  void read();
  void end(int code, QProcess::ExitStatus status);

  QString program_, out_, words_;
  QByteArray line_;
  bool cancelling_ = false;
  QProcess process_;
};

}  // namespace btr::ui
