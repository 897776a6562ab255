#pragma once
#include <QToolBar>

class QAction;
class QComboBox;
class QLabel;
class QMenu;

namespace btr::ui {
struct LiveRow;

/// The page's tool bar. It says what was chosen and shows the state that it is told.
class LiveTools : public QToolBar {
  Q_OBJECT
 public:
  explicit LiveTools(QWidget* parent = nullptr);

  void showRow(const LiveRow& row, double time_s);
  /// Whether a world runs (or waits), whether one was opened, whether it has a log, whether something is selected,
  /// whether hands are on.
  void setState(bool ready, bool opened, bool logged, bool selected, bool hands);
  void setFailed();
  /// What would be undone and redone; empty: nothing.
  void setUndo(const QString& undo, const QString& redo);
  double speed() const;
  QMenu& addMenu() { return *things_; }
  QMenu& viewMenu() { return *views_; }

  void trigger(QAction* action);  ///< if it is enabled
  QAction* playAction() const { return play_; }
  QAction* stepAction() const { return step_; }
  QAction* signalsAction() const { return signals_; }
  QAction* undoAction() const { return undo_; }
  QAction* redoAction() const { return redo_; }

 signals:
  void openChosen();
  void gameChosen(const QString& file);
  void playChosen(bool on);
  void stepChosen();
  void resetChosen();
  void speedChosen(double times);
  void undoChosen();
  void redoChosen();
  void removeChosen();
  void duplicateChosen();
  void kickOffChosen();
  void followChosen(bool on);
  void saveChosen();
  void saveLogChosen();
  void saveSceneChosen();
  void experimentChosen();
  void replayFileChosen();     ///< which one is to be asked
  void replaySessionChosen();  ///< this one
  void signalsChosen(bool on);

 private:
  void iconOnly(QAction* action);
  void makeSaves();
  QAction* add(const QString& name, const QString& icon, const QString& text, const QString& tip);

  QMenu *things_, *views_;
  QAction *play_, *step_, *reset_, *add_, *remove_, *save_, *saveScene_, *experiment_, *saveLog_, *replay_, *signals_,
      *undo_, *redo_, *duplicate_, *kickOff_;
  QComboBox* speed_;
  QLabel *clock_, *score_;
  QAction* scoreAction_;
  QString event_;  ///< the referee's last one
};

}  // namespace btr::ui
