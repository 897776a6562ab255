#pragma once
#include <QObject>
#include <QProcess>
#include <QString>

#include "core/live/act.h"
#include "core/live/game.h"
#include "core/sim/scene.h"
#include "ui/live/live_scene.h"

namespace btr::ui {

/// A session in a process of its own (btr live --steered): the window never waits for it, and survives it. What it
/// tells comes as signals; of rows that came together only the newest.
class LiveProcess : public QObject {
  Q_OBJECT
 public:
  /// `program`: empty means btr beside this executable.
  explicit LiveProcess(const QString& program = {}, QObject* parent = nullptr);
  ~LiveProcess() override;

  /// Ends what runs and starts this game, scene or robot file, paused. `log` is written.
  void start(const QString& file, const QString& log);
  void end();
  bool isRunning() const { return process_.state() != QProcess::NotRunning; }
  /// Whether act() and ask() are obeyed: from the first game on until it ends.
  bool isReady() const { return ready_; }

  void act(const Act& act);
  void play(bool on);
  void step(int periods);
  void setSpeed(double times);  ///< 0: as fast as possible
  void save(const QString& path);

 signals:
  /// The objects, at the start and when some came or went.
  void gameTold(const btr::Game& game, const btr::ModelSet& models, const std::vector<std::string>& channels);
  void rowTold(const btr::ui::LiveRow& row);
  void refused(const QString& why);
  void saved(const QString& path);
  /// It ended by itself: why.
  void failed(const QString& why);

 private:
  void send(const QByteArray& line);
  void read();
  void tell(const QByteArray& line);
  void finished(int code, QProcess::ExitStatus status);

  QString program_;
  QProcess process_;
  QByteArray pending_, words_;
  bool ready_ = false;
};

}  // namespace btr::ui
