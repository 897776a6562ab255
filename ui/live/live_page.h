#pragma once
#include <QSet>
#include <QUndoStack>
#include <QWidget>
#include <vector>

#include "ui/live/live_process.h"
#include "ui/live/live_view.h"

class QAction;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QListWidget;
class QMenu;
class QScrollArea;
class QToolBar;

namespace btr {
class PluginHost;
}
namespace btr::ui {
class MessageBanner;
class ParameterForm;

/// A world that runs and is reached into: opened from a game, a scene or a robot file; played, stepped, slowed down;
/// objects added, led with the mouse, thrown and taken away; controllers changed and tuned while they run. Keys: Space
/// plays, . steps, Delete removes, arrows move what is selected (Shift: ten times as far), Page up and down lift it,
/// [ and ] turn it.
class LivePage : public QWidget {
  Q_OBJECT
 public:
  /// `program` is btr, "" beside this executable. Logs of sessions are written into `logs`, "": none.
  LivePage(const PluginHost& host, const QString& program, const QString& logs, QWidget* parent = nullptr);

  void open(const QString& file);
  LiveView& view() { return *view_; }
  LiveProcess& process() { return *process_; }
  const Game& game() const { return game_; }
  const LiveRow& row() const { return row_; }
  const QString& file() const { return file_; }
  /// The last session's log; "" if there is none.
  const QString& log() const { return log_; }

 signals:
  void opened(const QString& file);

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QToolBar* makeTools();
  QWidget* makeSide();
  void fillAdd(QMenu& menu);
  void openWithDialog();
  void reset();
  void saveGame();
  void saveLog();

  void showGame(const Game& game, const ModelSet& models, const std::vector<std::string>& channels);
  void showRow(const LiveRow& row);
  void select(const std::string& object);
  void showSelected();
  void lookAtAll();
  void showPlace();
  void showController();
  void lead(const std::string& object, const Eigen::Vector3d& place_m);
  void letGo(const std::string& object);

  int selectedIndex() const;
  /// A name that no object has: "ball", "ball2" …
  std::string freeName(const std::string& word) const;
  void add(const ObstacleSpec& obstacle);
  void addBall();
  void addRobot(const QString& file);
  void removeSelected();
  void placeSelected(const Eigen::Isometry3d& pose);
  void placeAsTyped();
  void throwSelected();
  void changeController();
  void tune(const Values& values);

  const PluginHost& host_;
  QString logs_, file_, log_;
  LiveProcess* process_;
  LiveView* view_;
  MessageBanner* banner_;
  Game game_;
  LiveScene scene_;
  LiveRow row_;
  QSet<QString> pulled_;
  QAction *open_, *play_, *step_, *reset_, *remove_, *save_, *saveLog_, *follow_, *addAction_;
  QComboBox *speed_, *controller_;
  QLabel *clock_, *what_, *hint_;
  QListWidget* list_;
  QWidget *place_, *throw_, *plays_;
  QDoubleSpinBox *x_, *y_, *z_, *heading_, *speedOut_, *direction_, *rise_;
  QScrollArea* tuning_;
  QUndoStack undo_;
  ParameterForm* form_ = nullptr;
  bool fresh_ = true;  ///< nothing of the opened game was shown yet
  Values tuned_;       ///< as the running controller has them
};

}  // namespace btr::ui
