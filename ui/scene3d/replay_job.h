#pragma once
#include <QObject>
#include <QThread>
#include <functional>
#include <memory>

#include "ui/scene3d/replay_data.h"

namespace btr::ui {

/// Makes a ReplayData on a thread of its own, so that the window never waits. One piece of work at a time (a process
/// has one simulated world): what is asked for meanwhile waits, and only the last request is answered. Keep one such
/// object.
class ReplayJob : public QObject {
  Q_OBJECT

 public:
  /// Runs in the other thread; touches no widget. May ask QThread::currentThread()->isInterruptionRequested() and
  /// return early. An exception becomes failed().
  using Work = std::function<ReplayData()>;

  explicit ReplayJob(QObject* parent = nullptr);
  /// Asks the work to stop, waits for its end, emits nothing.
  ~ReplayJob() override;

  /// Replaces a request that waits; drops the answer of the one that runs.
  void start(Work work);
  /// No answer comes any more to what was asked so far.
  void cancel();
  bool running() const { return thread_ != nullptr; }

 signals:
  void started();
  void finished(const btr::ui::ReplayData& data);
  void failed(const QString& reason);

 private:
  class Worker;
  void startNext();
  void workEnded();

  std::unique_ptr<Worker> thread_;
  Work next_;
  bool dropped_ = false;  ///< nobody wants the answer of what runs
};

}  // namespace btr::ui
