#pragma once
#include <QWidget>
#include <string>

#include "ui/live/drawn/live_view.h"
#include "ui/live/live_process.h"

class QMenu;

namespace btr {
class PluginHost;
}
namespace btr::ui {
class DatabaseReader;
class JointsPanel;
class LiveDesk;
class LiveHands;
class LiveReplayer;
class LiveTools;
class LiveWorld;
class ObjectTree;
class ReplayBar;
class MessageBanner;
class SelectionPanel;
class SignalsPanel;
class SimulatorPanel;
class ThingPalette;
struct ThingToAdd;

/// A world that runs and is reached into: opened from a game, a scene or a robot file; played, stepped, slowed down;
/// objects added, led with the mouse, thrown and taken away; controllers changed and tuned while they run; simulator,
/// joints and signals beside it. Keys: Space plays, . steps, Delete removes, Ctrl+D duplicates, Ctrl+Z undoes, X
/// changes between two sets of parameters. Arrows, Page up and down move what is selected (Shift: ten times as far), by
/// a spring while it runs, which Esc lets go of; [ and ] turn it. A session's log is played again here, too: hands are
/// off, left and right go a second back and on, with Shift to the acts, Home and End to its ends.
class LivePage : public QWidget {
  Q_OBJECT
 public:
  /// `program` is btr, "" beside this executable. Logs of sessions are written into `logs`, "": none.
  LivePage(const PluginHost& host, const QString& program, const QString& logs, QWidget* parent = nullptr);

  /// A session's log is played again.
  void open(const QString& file);
  /// Open it where it is a game, a scene, a robot or a log; else it is said what it is, and the world that is there
  /// goes on.
  void openIfWorld(const QString& file);
  /// A log that has no game in it is asked for one if none of those at hand is its game. `at`: a control period.
  void openReplay(const QString& log, long at = -1);
  void replayWithDialog();
  /// Opened when the page is first shown, unless another one is by then.
  void openWhenShown(const QString& file) { later_ = file; }
  /// Whose individuals can play.
  void setDatabase(DatabaseReader& reader);
  LiveView& view() { return *view_; }
  LiveProcess& process() { return *process_; }
  LiveWorld& world() { return *world_; }
  LiveDesk& desk() { return *desk_; }
  LiveReplayer& replayer() { return *replayer_; }
  SignalsPanel& signalsPanel() { return *signals_; }
  const Game& game() const;
  const LiveRow& row() const;
  const QString& file() const { return file_; }
  bool canUndo() const;
  bool canRedo() const;
  /// The last session's log; "" if there is none.
  const QString& log() const { return log_; }

 signals:
  void opened(const QString& file);
  void experimentMade(const QString& file);

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void showEvent(QShowEvent* event) override;

 private:
  void connectTools();
  void connectWorld();
  QWidget* makeSide();
  void fillAdd(QMenu& menu);
  void fillViews(QMenu& menu);
  void openWithDialog();
  void reset();
  /// Of a file to be written; "" where nobody wants one.
  QString askJson(const QString& title, const QString& proposed, const QString& kind);
  void saveGame();
  void saveScene();
  void saveExperiment();
  void saveLog();
  QString newLog() const;
  bool canBecomeWorld(const QString& file);
  void sayIfNoLog();
  void loseLog(const QString& why);
  void prepare();
  void replaySession();
  void showReplaying();
  void showUndo();
  bool replayKey(const QKeyEvent& event);

  void showObjects();
  void showGame();
  void showHands();
  void showRow();
  void showSelected();
  void lookAtAll();
  void pick(const std::string& object, bool toggle);
  void add(const ThingToAdd& thing, const Eigen::Vector2d& at_m);
  void addInMiddle(const ThingToAdd& thing) { add(thing, view_->camera().focus.head<2>()); }
  void duplicate();
  void rename(const std::string& object, const std::string& name);
  void undo();
  void redo();
  void takeBack(int steps);

  QString logs_, file_, log_, later_;
  QString undo_, redo_;  ///< as the session says
  LiveProcess* process_;
  LiveWorld* world_;
  LiveHands* hands_;
  LiveTools* tools_;
  ReplayBar* bar_;
  LiveReplayer* replayer_;
  LiveView* view_;
  LiveDesk* desk_;
  MessageBanner* banner_;
  ObjectTree* tree_;
  SelectionPanel* selection_;
  JointsPanel* joints_;
  SimulatorPanel* simulator_;
  ThingPalette* palette_;
  SignalsPanel* signals_;
  int undosLeft_ = 0;  ///< that were asked for; redos where positive
  bool fresh_ = true;  ///< nothing of the opened game was shown yet
};

}  // namespace btr::ui
