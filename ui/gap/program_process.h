#pragma once
#include <QObject>
#include <QProcess>
#include <QStringList>

namespace btr::ui {

/// Runs a command of btr beside the window that says "STAGE SHARE" on standard error: tells its progress, can be
/// cancelled, and ends with what it wrote to standard output, or with a message. One at a time. It ends with the
/// window.
class ProgramProcess : public QObject {
  Q_OBJECT
 public:
  /// `program`: empty means btr beside this executable.
  explicit ProgramProcess(const QString& program = {}, QObject* parent = nullptr);
  ~ProgramProcess() override;

  void start(const QStringList& arguments);
  /// Asks it to stop; cancelled(), done() or failed() follows.
  void cancel();
  bool isRunning() const { return process_.state() != QProcess::NotRunning; }

 signals:
  void started();
  /// `share` 0 … 1.
  void progressed(const QString& stage, double share);
  void done(const QByteArray& output);
  void cancelled();
  void failed(const QString& message);

 private:
  void read();
  void end(int code, QProcess::ExitStatus status);

  QString program_, words_;
  QByteArray line_;
  bool cancelling_ = false;
  QProcess process_;
};

}  // namespace btr::ui
