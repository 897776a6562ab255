#include "ui/live/live_tools.h"

#include <QAction>
#include <QComboBox>
#include <QDir>
#include <QFileInfo>
#include <QLabel>
#include <QMenu>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "ui/common/look/theme.h"
#include "ui/common/resources.h"
#include "ui/live/drawn/live_scene.h"

namespace btr::ui {
namespace {
constexpr double speeds[] = {0.1, 0.25, 0.5, 1, 2, 5, 0};

/// The world's time and, where `factor` > 0, how many of its seconds pass in one.
QString clockText(double time_s, double factor) {
  QString text = LiveTools::tr("%1 s").arg(time_s, 0, 'f', 2);
  if (factor > 0) text += LiveTools::tr(" · %1 ×").arg(factor, 0, 'f', 2);
  return text;
}
}  // namespace

LiveTools::LiveTools(QWidget* parent) : QToolBar(parent), things_(new QMenu(this)), views_(new QMenu(this)) {
  setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  QAction* open = add("liveOpen", "document-open", tr("&Open…"), tr("A game, a scene or a robot file"));
  connect(open, &QAction::triggered, this, &LiveTools::openChosen);
  auto* examples = new QMenu(this);
  QAction* replay = examples->addAction(themeIcon("media-playback-start"), tr("&Replay a session…"));
  replay->setObjectName("liveReplayFile");
  replay->setToolTip(tr("Plays a session's log again, with the same bits"));
  connect(replay, &QAction::triggered, this, &LiveTools::replayFileChosen);
  examples->addSeparator();
  for (const QFileInfo& file : QDir(resourceDirectory() + "/games").entryInfoList({"*.json"}, QDir::Files))
    connect(examples->addAction(file.completeBaseName()), &QAction::triggered, this,
            [this, path = file.filePath()] { emit gameChosen(path); });
  open->setMenu(examples);
  qobject_cast<QToolButton*>(widgetForAction(open))->setPopupMode(QToolButton::MenuButtonPopup);
  play_ = add("livePlay", "media-playback-start", tr("&Play"), tr("Goes on, or waits (Space)"));
  play_->setCheckable(true);
  connect(play_, &QAction::triggered, this, &LiveTools::playChosen);
  // As wide as it becomes: no button moves under the mouse when the world plays.
  auto* play = widgetForAction(play_);
  play_->setText(tr("&Pause"));
  const int pause = play->sizeHint().width();
  play_->setText(tr("&Play"));
  play->setMinimumWidth(std::max(pause, play->sizeHint().width()));
  step_ = add("liveStep", "media-skip-forward", tr("&Step"), tr("One control period (.)"));
  connect(step_, &QAction::triggered, this, &LiveTools::stepChosen);
  reset_ = add("liveReset", "media-skip-backward", tr("&Reset"), tr("As it was opened"));
  connect(reset_, &QAction::triggered, this, &LiveTools::resetChosen);
  speed_ = new QComboBox(this);
  speed_->setObjectName("liveSpeed");
  speed_->setAccessibleName(tr("Speed"));
  speed_->setToolTip(tr("Simulated seconds in a second; “fastest” is as fast as it can"));
  for (const double speed : speeds) speed_->addItem(speed > 0 ? tr("%1 ×").arg(speed) : tr("fastest"), speed);
  speed_->setCurrentIndex(3);
  connect(speed_, &QComboBox::activated, this, [this] { emit speedChosen(speed()); });
  addWidget(speed_);
  clock_ = new QLabel(this);
  clock_->setObjectName("liveClock");
  clock_->setContentsMargins(6, 0, 6, 0);
  clock_->setToolTip(tr("Time of the world; how many of its seconds really pass in a second"));
  // As wide as it becomes: no button moves or goes away while the world plays.
  clock_->setMinimumWidth(fontMetrics().horizontalAdvance(clockText(999.99, 9.99)) + 12);
  addWidget(clock_);
  addSeparator();
  undo_ = add("liveUndo", "edit-undo", tr("&Undo"), {});
  connect(undo_, &QAction::triggered, this, &LiveTools::undoChosen);
  redo_ = add("liveRedo", "edit-redo", tr("Re&do"), {});
  connect(redo_, &QAction::triggered, this, &LiveTools::redoChosen);
  setUndo({}, {});
  add_ = add("liveAdd", "list-add", tr("&Add"), tr("A ball, an obstacle or a robot, in the middle of the view"));
  add_->setMenu(things_);
  qobject_cast<QToolButton*>(widgetForAction(add_))->setPopupMode(QToolButton::InstantPopup);
  remove_ = add("liveRemove", "list-remove", tr("Re&move"), tr("Takes what is selected away (Delete)"));
  connect(remove_, &QAction::triggered, this, &LiveTools::removeChosen);
  duplicate_ =
      add("liveDuplicate", "edit-copy", tr("D&uplicate"), tr("What is selected once more, beside it (Ctrl+D)"));
  connect(duplicate_, &QAction::triggered, this, &LiveTools::duplicateChosen);
  QAction* follow = add("liveFollow", "crosshairs", tr("&Follow"), tr("Keeps what is selected in the middle"));
  follow->setCheckable(true);
  connect(follow, &QAction::triggered, this, &LiveTools::followChosen);
  addSeparator();
  makeSaves();
  signals_ =
      add("liveShowSignals", "office-chart-line", tr("Si&gnals"), tr("Plots of angles, torques, contacts, speeds"));
  signals_->setCheckable(true);
  connect(signals_, &QAction::toggled, this, &LiveTools::signalsChosen);
  QAction* views = add("liveViews", "view-preview", tr("Vie&ws"), tr("Further views, robots' cameras, what is drawn"));
  views->setMenu(views_);
  qobject_cast<QToolButton*>(widgetForAction(views))->setPopupMode(QToolButton::InstantPopup);
  for (QAction* action : {undo_, redo_, remove_, duplicate_, follow}) iconOnly(action);
  addSeparator();
  kickOff_ = add("liveKickOff", "media-playback-start", tr("&Kick-off"),
                 tr("Robots and ball to their places, the clock goes on"));
  connect(kickOff_, &QAction::triggered, this, &LiveTools::kickOffChosen);
  kickOff_->setVisible(false);
  score_ = new QLabel(this);
  score_->setObjectName("liveScore");
  score_->setContentsMargins(6, 0, 6, 0);
  score_->setTextFormat(Qt::PlainText);
  scoreAction_ = addWidget(score_);
  scoreAction_->setVisible(false);
  // These are in no menu of the window: without a mouse they are reached by Tab, and Space opens their menus. So is the
  // one that shows what has no room.
  for (QToolButton* button : findChildren<QToolButton*>()) button->setFocusPolicy(Qt::TabFocus);
}

QAction* LiveTools::add(const QString& name, const QString& icon, const QString& text, const QString& tip) {
  QAction* action = addAction(themeIcon(icon), text);
  action->setObjectName(name);
  action->setToolTip(tip);
  return action;
}

/// What a moment, or the session up to it, becomes.
void LiveTools::makeSaves() {
  QAction* all = add("liveSaves", "document-save", tr("Sa&ve"), tr("This moment, or all that was done until now"));
  auto* menu = new QMenu(this);
  menu->setToolTipsVisible(true);
  const auto entry = [&](const char* name, const char* icon, const QString& text, const QString& tip, auto chosen) {
    QAction* action = menu->addAction(themeIcon(icon), text);
    action->setObjectName(name);
    action->setToolTip(tip);
    connect(action, &QAction::triggered, this, chosen);
    return action;
  };
  save_ = entry("liveSave", "document-save", tr("This moment as &game…"),
                tr("The game as it is now: it goes on with the same bits"), &LiveTools::saveChosen);
  saveScene_ = entry("liveSaveScene", "document-save-as", tr("This moment as &scene…"),
                     tr("Where everything is and how it moves, robots' joints included"), &LiveTools::saveSceneChosen);
  experiment_ =
      entry("liveExperiment", "run-build", tr("Start an &experiment from here…"),
            tr("The selected robot learns, from this moment's scene; opens in the form"), &LiveTools::experimentChosen);
  menu->addSeparator();
  saveLog_ = entry("liveSaveLog", "document-save-as", tr("The session's &log…"),
                   tr("What was done since it was opened: it plays again with the same bits, here or with “btr live "
                      "--replay LOG”"),
                   &LiveTools::saveLogChosen);
  replay_ = entry("liveReplaySession", "media-playback-start", tr("&Replay this session"),
                  tr("From its start, with the same bits; it ends here"), &LiveTools::replaySessionChosen);
  all->setMenu(menu);
  qobject_cast<QToolButton*>(widgetForAction(all))->setPopupMode(QToolButton::InstantPopup);
}

double LiveTools::speed() const { return speed_->currentData().toDouble(); }

void LiveTools::trigger(QAction* action) {
  if (action->isEnabled()) action->trigger();
}

void LiveTools::showRow(const LiveRow& row, double time_s) {
  play_->setChecked(row.playing);
  play_->setText(row.playing ? tr("&Pause") : tr("&Play"));
  play_->setIcon(themeIcon(row.playing ? "media-playback-pause" : "media-playback-start"));
  clock_->setText(clockText(time_s, row.playing ? row.realTimeFactor : 0));
  kickOff_->setVisible(row.score.has_value());
  scoreAction_->setVisible(row.score.has_value());
  if (row.score) {
    const long seconds = std::lround(std::max(0.0, row.clock_s));
    if (!row.events.isEmpty()) event_ = row.events.last();
    score_->setToolTip(event_.isEmpty() ? tr("Score, and the clock of this half") : tr("Last: %1").arg(event_));
    score_->setText(tr("red %1 : %2 blue · %3:%4")
                        .arg((*row.score)[0])
                        .arg((*row.score)[1])
                        .arg(seconds / 60)
                        .arg(seconds % 60, 2, 10, QChar('0')));
  }
  const bool goesOn = row.fault.isEmpty();
  const bool more = goesOn && !(row.replay && row.replay->over);
  play_->setEnabled(more);
  step_->setEnabled(more && !row.playing);
}

void LiveTools::setState(bool ready, bool opened, bool logged, bool selected, bool hands) {
  for (QAction* action : {play_, step_, save_, saveScene_, experiment_}) action->setEnabled(ready);
  reset_->setEnabled(opened);
  for (QAction* action : {saveLog_, replay_}) action->setEnabled(logged && hands);
  for (QAction* action : {remove_, duplicate_}) action->setEnabled(selected && hands);
  for (QAction* action : {add_, kickOff_}) action->setEnabled(ready && hands);
}

void LiveTools::setUndo(const QString& undo, const QString& redo) {
  undo_->setEnabled(!undo.isEmpty());
  undo_->setToolTip(undo.isEmpty() ? tr("Nothing to undo") : tr("Undo: %1 (Ctrl+Z)").arg(undo));
  redo_->setEnabled(!redo.isEmpty());
  redo_->setToolTip(redo.isEmpty() ? tr("Nothing to redo") : tr("Redo: %1 (Ctrl+Shift+Z)").arg(redo));
}

void LiveTools::iconOnly(QAction* action) {
  if (auto* button = qobject_cast<QToolButton*>(widgetForAction(action))) {
    button->setToolButtonStyle(Qt::ToolButtonIconOnly);
    button->setAccessibleName(QString(action->text()).remove('&'));
  }
}

void LiveTools::setFailed() {
  play_->setChecked(false);
  play_->setEnabled(false);
  step_->setEnabled(false);
}

}  // namespace btr::ui
