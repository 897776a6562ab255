#include "ui/live/live_replayer.h"

#include "core/live/session_log.h"
#include "core/spec/error.h"
#include "ui/live/live_world.h"
#include "ui/live/panels/replay_bar.h"

namespace btr::ui {

LiveReplayer::LiveReplayer(LiveWorld& world, ReplayBar& bar, QObject* parent)
    : QObject(parent), world_(world), process_(world.process()), bar_(bar) {
  constexpr int patience_ms = 120;
  back_.setSingleShot(true);
  back_.setInterval(patience_ms);
  connect(&back_, &QTimer::timeout, this, [this] {
    if (!goesBack_ || !process_.isReady()) return begin();
    process_.goTo(goal_);
    if (playing_) process_.play(true);
  });
  connect(&bar_, &ReplayBar::jumpWanted, this, &LiveReplayer::jumpTo);
  connect(&bar_, &ReplayBar::goOnWanted, this, &LiveReplayer::goOn);
  connect(&process_, &LiveProcess::gameTold, this, [this] { takeGame(); });
  connect(&process_, &LiveProcess::logTold, this, [this](const LiveLog& log) {
    goesBack_ = log.goesBack;
    if (on_) bar_.showLog(log, world_.game().scene.controlPeriod_s);
  });
  connect(&process_, &LiveProcess::rowTold, this, &LiveReplayer::takeRow);
}

void LiveReplayer::start(const QString& log, const QString& game, const QString& newLog, long at) {
  log_ = log;
  game_ = game;
  newLog_ = newLog;
  goal_ = at;
  on_ = true;
  playing_ = false;
  wentOnAt_.reset();
  world_.setHands(false);
  bar_.begin(log);
  bar_.show();
  begin();
}

void LiveReplayer::begin() {
  back_.stop();
  starting_ = true;
  goesBack_ = false;
  process_.start(game_, newLog_, log_);
}

void LiveReplayer::stop() {
  back_.stop();
  on_ = starting_ = false;
  log_.clear();
  wentOnAt_.reset();
  world_.setHands(true);
  bar_.hide();
}

void LiveReplayer::takeGame() {
  if (!starting_) return;
  starting_ = false;
  process_.setSpeed(speed_);
  if (goal_ >= 0) process_.goTo(goal_);
  if (playing_) process_.play(true);
}

void LiveReplayer::takeRow(const LiveRow& row) {
  if (!on_ || starting_ || back_.isActive()) return;
  if (row.replay) {
    playing_ = row.playing;
    return bar_.showRow(row);
  }
  on_ = false;
  wentOnAt_ = row.period;
  world_.setHands(true);
  bar_.hide();
  emit goneOn();
}

void LiveReplayer::setSpeed(double times) {
  speed_ = times;
  process_.setSpeed(times);
}

void LiveReplayer::jumpTo(long period) {
  if (!on_) return;
  goal_ = period;
  if (starting_ || back_.isActive()) return;
  if (period >= world_.row().period) return process_.goTo(period);
  process_.play(false);
  back_.start();
}

void LiveReplayer::goOn() {
  if (on_ && !starting_ && !back_.isActive()) process_.goOn();
}

QString gameWithHash(const std::string& sha256, const QStringList& files) {
  for (const QString& file : files) {
    try {
      if (gameSha256(loadGame(file.toStdString())) == sha256) return file;
    } catch (const InputError&) {
      continue;  // no game, or one whose files are gone: not this one
    }
  }
  return {};
}

}  // namespace btr::ui
