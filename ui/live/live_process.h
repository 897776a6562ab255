#pragma once
#include <QObject>
#include <QProcess>
#include <QString>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "core/live/act.h"
#include "core/live/game.h"
#include "core/sim/scene.h"
#include "ui/live/drawn/live_scene.h"

namespace btr::ui {

/// What every control period since the last row had of the chosen channels.
struct LiveSamples {
  std::vector<std::string> channels;
  std::vector<long> periods;
  std::vector<double> values;  ///< period by period, channels.size() numbers each; NaN where there is no such channel
};

/// Acts of the same name that followed each other in a log, by the control periods before which they were done.
struct LoggedActs {
  long from = 0, to = 0;
  QString name;
};

/// A session's log that is played again.
struct LiveLog {
  long from = 0, until = 0;  ///< control periods
  long marks = 0;            ///< places where bits can be compared
  bool goesBack = false;     ///< without beginning anew
  std::vector<LoggedActs> acts;
};

/// What hands hold and pull, as the session says.
struct LiveGrips {
  std::map<std::string, Values> held;    ///< by robot and joint
  std::map<std::string, PullAct> pulls;  ///< by object
};

/// A session in a process of its own (btr live --steered): the window never waits for it, and survives it. What it
/// tells comes as signals; of rows that came together only the newest, and those
/// that tell what happened once.
class LiveProcess : public QObject {
  Q_OBJECT
 public:
  /// `program`: empty means btr beside this executable.
  explicit LiveProcess(const QString& program = {}, QObject* parent = nullptr);
  ~LiveProcess() override;

  /// Ends what runs and starts this game, scene or robot file, paused. `log` is written. `replay` is a session's log
  /// that is played again; its game may be in it, then `file` is "".
  void start(const QString& file, const QString& log, const QString& replay = {});
  void end();
  bool isRunning() const { return process_.state() != QProcess::NotRunning; }
  /// Whether act() and ask() are obeyed: from the first game on until it ends.
  bool isReady() const { return ready_; }
  /// Whether the last one ended by itself.
  bool hasFailed() const { return failed_; }

  void act(const Act& act);
  void play(bool on);
  void step(int periods);
  /// 0: as fast as possible. Also in sessions that are started later.
  void setSpeed(double times);
  /// `view`: what the window wants to find again, JSON; "" nothing.
  void save(const QString& path, const std::string& view = {});
  void saveScene(const QString& path);
  /// An experiment in which this robot learns, "": one that suits, and its scene beside it.
  void saveExperiment(const QString& path, const std::string& robot = {});
  /// Of a log that is played again: as fast as possible to a period, an earlier one too if it goes back; what is left
  /// of it is given up.
  void goTo(long period);
  void goOn();
  /// Whether rows tell the contacts of their step.
  void setContacts(bool on);
  /// The game is told again.
  void askGame();
  /// From now on, also in sessions that are started later, these channels are told of every control period.
  void setSignals(const std::vector<std::string>& channels);

  /// With the game that was told last; nothing while acts are under way that it does not know yet.
  const std::optional<LiveGrips>& grips() const { return grips_; }

  /// What is done between these two is one step of undo. May be nested.
  void beginGesture();
  void endGesture();
  void undo();
  /// Until a game is told behind the last undo or redo.
  bool isUndoing() const { return undosTold_ != undos_; }
  /// On the console of a robot's program, as if a line was typed there.
  void type(const std::string& robot, const QString& line);
  void kickOff();  ///< of the referee, where there is one
  void redo();

 signals:
  /// The objects, at the start and when some came or went.
  void gameTold(const btr::Game& game, const btr::ModelSet& models, const std::vector<std::string>& channels);
  void rowTold(const btr::ui::LiveRow& row);
  /// Before the row that came with them; none is left out.
  void sampled(const btr::ui::LiveSamples& samples);
  /// The names of what would be undone and redone; empty: nothing.
  void undoTold(const QString& undo, const QString& redo);
  void refused(const QString& why);
  /// Somebody does not answer; the world waits for him.
  void hangs(const QString& who);
  /// `what`: "game", "scene" or "experiment".
  void saved(const QString& path, const QString& what);
  /// Once, of a log that is played again.
  void logTold(const btr::ui::LiveLog& log);
  /// Its log has no more room, or cannot be written; it goes on. Once.
  void logLost(const QString& why);
  /// What robots that have come lack of what their files say, or have that was assumed: see modelLosses().
  void lossesTold(const std::vector<std::string>& losses);
  /// What stands in something else and will be thrown out of it, a sentence each; empty: nothing any more.
  void overlapsTold(const std::vector<std::string>& overlaps);
  /// It ended by itself: why.
  void failed(const QString& why);

 private:
  void send(const QByteArray& line);
  void read();
  void tell(const QByteArray& line);
  void tellGame(const nlohmann::json& line);
  void tellGrips(const nlohmann::json& line);
  void tellLosses(std::vector<std::string> losses);
  void tellLog(const nlohmann::json& line);
  void tellSamples(const nlohmann::json& line);
  ModelSet modelsOf(const SceneSpec& scene);
  void sendSignals();
  void finished(int code, QProcess::ExitStatus status);
  void fail(const QString& why);

  QString program_;
  QProcess process_;
  QByteArray pending_, words_;
  bool ready_ = false, contacts_ = false, failed_ = false;
  double speed_ = 1;                  ///< also of sessions that are started later
  std::vector<std::string> signals_;  ///< that are wanted
  std::vector<std::string> told_;     ///< to which the samples belong that are told
  ModelSet models_;                   ///< of files that were read for this session
  std::string modelsFrom_;            ///< where their relative paths start
  std::optional<LiveGrips> grips_;
  std::vector<std::string> losses_;  ///< of the game that was told last
  long acts_ = 0, undos_ = 0;        ///< that were sent to this session
  long undosTold_ = 0;               ///< that the game that was told last knows
  int gestureDepth_ = 0;
  long gesture_ = 0;
};

}  // namespace btr::ui
