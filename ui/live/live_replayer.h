#pragma once
#include <QObject>
#include <QTimer>
#include <optional>

#include "ui/live/live_process.h"

namespace btr::ui {
class LiveWorld;
class ReplayBar;

/// A session's log that is played again on the page: begun, gone to and fro in, and left. Back in time is the log from
/// a moment that is kept before, as fast as possible: a world cannot run backwards. Where none can be kept (a
/// controller looks through a camera), from its start.
class LiveReplayer : public QObject {
  Q_OBJECT
 public:
  /// Borrows all three.
  LiveReplayer(LiveWorld& world, ReplayBar& bar, QObject* parent = nullptr);

  /// Plays `log` of the game in the file `game`, "": that in the log itself, to control period `at`, −1: its start.
  /// What happens is written into `newLog`, "": nowhere.
  void start(const QString& log, const QString& game, const QString& newLog, long at = -1);
  /// Another world was opened.
  void stop();
  void setSpeed(double times);
  void jumpTo(long period);
  /// A session from here on; goneOn() follows.
  void goOn();

  /// Hands are off.
  bool isOn() const { return on_; }
  /// The log, also after it was gone on from; "" without one.
  const QString& log() const { return log_; }
  /// Where hands took over; none in a replay.
  std::optional<long> wentOnAt() const { return wentOnAt_; }

 signals:
  void goneOn();

 private:
  void begin();
  void takeGame();
  void takeRow(const LiveRow& row);

  LiveWorld& world_;
  LiveProcess& process_;
  ReplayBar& bar_;
  QTimer back_;  ///< of several wishes that follow each other only the last is played to
  QString log_, game_, newLog_;
  double speed_ = 1;
  bool on_ = false, starting_ = false, playing_ = false, goesBack_ = false;
  long goal_ = -1;  ///< once it has started; −1: its start
  std::optional<long> wentOnAt_;
};

/// The first of these files whose game has that hash; "" if none has.
QString gameWithHash(const std::string& sha256, const QStringList& files);

}  // namespace btr::ui
