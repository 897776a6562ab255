#include "ui/live/live_page.h"

#include <QAction>
#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QSplitter>
#include <QTabWidget>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "core/live/session_log.h"
#include "core/live/session_players.h"
#include "core/spec/error.h"
#include "core/spec/file_kind.h"
#include "core/spec/json_reader.h"
#include "ui/common/look/message_banner.h"
#include "ui/common/numbers/format.h"
#include "ui/common/resources.h"
#include "ui/live/drawn/object_copies.h"
#include "ui/live/live_desk.h"
#include "ui/live/live_hands.h"
#include "ui/live/live_replayer.h"
#include "ui/live/live_tools.h"
#include "ui/live/live_world.h"
#include "ui/live/panels/joints_panel.h"
#include "ui/live/panels/object_tree.h"
#include "ui/live/panels/parameter_sets.h"
#include "ui/live/panels/replay_bar.h"
#include "ui/live/panels/selection_panel.h"
#include "ui/live/panels/signals_panel.h"
#include "ui/live/panels/simulator_panel.h"
#include "ui/live/panels/thing_palette.h"
#include "ui/live/panels/things_to_add.h"
#include "ui/window/scroll_page.h"

namespace btr::ui {

using Eigen::Vector3d;

LivePage::LivePage(const PluginHost& host, const QString& program, const QString& logs, QWidget* parent)
    : QWidget(parent),
      logs_(logs),
      process_(new LiveProcess(program, this)),
      world_(new LiveWorld(host, *process_, this)),
      hands_(new LiveHands(*world_, this)),
      tools_(new LiveTools(this)),
      bar_(new ReplayBar(this)),
      replayer_(new LiveReplayer(*world_, *bar_, this)),
      view_(new LiveView(this)),
      desk_(new LiveDesk(*world_, view_, this)),
      banner_(new MessageBanner(this)),
      signals_(new SignalsPanel(*world_, this)) {
  setObjectName("livePage");
  auto* split = new QSplitter(this);
  auto* middle = new QSplitter(Qt::Vertical, split);
  middle->addWidget(desk_);
  middle->addWidget(signals_);
  middle->setStretchFactor(0, 1);
  middle->setCollapsible(0, false);
  signals_->hide();
  bar_->hide();
  split->addWidget(middle);
  split->addWidget(makeSide());
  split->setStretchFactor(0, 1);
  split->setCollapsible(0, false);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->addWidget(tools_);
  layout->addWidget(bar_);
  layout->addWidget(banner_);
  layout->addWidget(split, 1);
  view_->setGround(Ground::plain);
  view_->setCaption({tr("Open a game, a scene or a robot file; or drop one here, or a session\'s log.")});
  fillAdd(tools_->addMenu());
  fillViews(tools_->viewMenu());
  connectTools();
  connectWorld();
  showSelected();
}

const Game& LivePage::game() const { return world_->game(); }
const LiveRow& LivePage::row() const { return world_->row(); }

bool LivePage::canUndo() const { return tools_->undoAction()->isEnabled(); }
bool LivePage::canRedo() const { return tools_->redoAction()->isEnabled(); }

void LivePage::connectTools() {
  connect(tools_, &LiveTools::openChosen, this, &LivePage::openWithDialog);
  connect(tools_, &LiveTools::gameChosen, this, &LivePage::open);
  connect(tools_, &LiveTools::playChosen, process_, &LiveProcess::play);
  connect(tools_, &LiveTools::stepChosen, process_, [this] { process_->step(1); });
  connect(tools_, &LiveTools::resetChosen, this, &LivePage::reset);
  connect(tools_, &LiveTools::speedChosen, replayer_, &LiveReplayer::setSpeed);
  connect(tools_, &LiveTools::removeChosen, hands_, &LiveHands::removeSelected);
  connect(tools_, &LiveTools::duplicateChosen, this, &LivePage::duplicate);
  connect(tools_, &LiveTools::undoChosen, this, &LivePage::undo);
  connect(tools_, &LiveTools::redoChosen, this, &LivePage::redo);
  connect(tools_, &LiveTools::kickOffChosen, process_, &LiveProcess::kickOff);
  connect(tools_, &LiveTools::followChosen, view_, &LiveView::setFollowing);
  connect(tools_, &LiveTools::saveChosen, this, &LivePage::saveGame);
  connect(tools_, &LiveTools::saveSceneChosen, this, &LivePage::saveScene);
  connect(tools_, &LiveTools::experimentChosen, this, &LivePage::saveExperiment);
  connect(tools_, &LiveTools::replayFileChosen, this, &LivePage::replayWithDialog);
  connect(tools_, &LiveTools::replaySessionChosen, this, &LivePage::replaySession);
  connect(replayer_, &LiveReplayer::goneOn, this, [this] {
    process_->askGame();  // what the log's hands hold and pull is ours now
    showReplaying();
    banner_->showMessage(MessageBanner::Kind::information,
                         tr("A session again, from %1 s on. Undo leads back to the replay.")
                             .arg(world_->scene().time_s(row()), 0, 'f', 2));
  });
  connect(tools_, &LiveTools::signalsChosen, signals_, &QWidget::setVisible);
  connect(signals_, &SignalsPanel::problem, banner_,
          [this](const QString& why) { banner_->showMessage(MessageBanner::Kind::warning, why); });
  connect(tools_, &LiveTools::saveLogChosen, this, &LivePage::saveLog);
}

void LivePage::connectWorld() {
  connect(world_, &LiveWorld::objectsChanged, this, &LivePage::showObjects);
  connect(world_, &LiveWorld::firstRow, this, [this] {
    if (std::exchange(fresh_, false)) {
      lookAtAll();
      desk_->restore(game().view);
    }
    showSelected();
  });
  connect(world_, &LiveWorld::gameChanged, this, &LivePage::showGame);
  connect(process_, &LiveProcess::gameTold, this, [this] { takeBack(0); });
  connect(world_, &LiveWorld::handsChanged, this, &LivePage::showHands);
  connect(process_, &LiveProcess::undoTold, this, [this](const QString& undo, const QString& redo) {
    undo_ = undo;
    redo_ = redo;
    showUndo();
  });
  connect(world_, &LiveWorld::handsRefused, this, [this] {
    banner_->showMessage(
        MessageBanner::Kind::warning,
        process_->isReady()
            ? tr("Hands are off while a session is played again; “Go on from here” makes it one of yours.")
            : tr("Nothing can be done here: the world has ended. “Reset” opens it again."));
    process_->askGame();  // what was not done is shown as it is
    showSelected();
  });
  connect(view_, &LiveView::dropped, this, [this](int thing, const Eigen::Vector2d& at) {
    if (thing >= 0 && thing < palette_->count()) add(palette_->thing(thing), at);
  });
  connect(world_, &LiveWorld::rowChanged, this, &LivePage::showRow);
  connect(world_, &LiveWorld::selectionChanged, this, &LivePage::showSelected);
  connect(process_, &LiveProcess::refused, this, [this](const QString& why) {
    banner_->showMessage(MessageBanner::Kind::warning, why);
    process_->askGame();  // what was refused did not change anything there
    showSelected();
  });
  connect(process_, &LiveProcess::hangs, banner_,
          [this](const QString& who) { banner_->showMessage(MessageBanner::Kind::warning, who); });
  constexpr std::size_t shown = 3;
  const auto warn = [this](const std::vector<std::string>& all, const QString& more) {
    QStringList lines;
    for (const std::string& each : all)
      if (static_cast<std::size_t>(lines.size()) < shown) lines += QString::fromStdString(each);
    if (all.size() > shown) lines += more.arg(all.size() - shown);
    if (!lines.empty()) banner_->showMessage(MessageBanner::Kind::warning, lines.join('\n'));
  };
  connect(process_, &LiveProcess::lossesTold, banner_, [warn](const std::vector<std::string>& losses) {
    warn(losses, tr("… and %1 more: btr model check shows all"));
  });
  connect(process_, &LiveProcess::overlapsTold, banner_,
          [warn](const std::vector<std::string>& overlaps) { warn(overlaps, tr("… and %1 more")); });
  connect(process_, &LiveProcess::saved, this, [this](const QString& path, const QString& what) {
    banner_->showMessage(MessageBanner::Kind::information, tr("Saved: %1").arg(path));
    if (what == "experiment") emit experimentMade(path);
  });
  connect(process_, &LiveProcess::failed, this, [this](const QString& why) {
    banner_->showMessage(MessageBanner::Kind::error, why);
    undo_.clear();
    redo_.clear();
    showReplaying();  // nothing can be done or saved any more
    tools_->setFailed();
  });
  connect(process_, &LiveProcess::logLost, this, &LivePage::loseLog);
  connect(view_, &LiveView::picked, world_, [this](const std::string& object, bool toggle) { pick(object, toggle); });
  connect(view_, &LiveView::ledTo, hands_, &LiveHands::lead);
  connect(view_, &LiveView::letGo, this, [this] {
    hands_->endDrag();
    showSelected();
  });
}

void LivePage::fillViews(QMenu& menu) {
  connect(menu.addAction(tr("New &view")), &QAction::triggered, desk_, &LiveDesk::addView);
  connect(menu.addAction(tr("Robot's &camera")), &QAction::triggered, desk_, &LiveDesk::addEye);
  connect(menu.addAction(tr("Robots' &programs")), &QAction::triggered, desk_, &LiveDesk::showConsole);
  menu.addSeparator();
  menu.addActions(view_->viewActions());
}

void LivePage::fillAdd(QMenu& menu) {
  bool robots = false;
  for (const ThingToAdd& thing : thingsToAdd()) {
    if (std::holds_alternative<QString>(thing.what) && !std::exchange(robots, true)) menu.addSeparator();
    connect(menu.addAction(thing.text), &QAction::triggered, this, [this, thing] { addInMiddle(thing); });
  }
  connect(menu.addAction(tr("Robot from a file…")), &QAction::triggered, this, [this] {
    const QString file =
        QFileDialog::getOpenFileName(this, tr("Robot"), resourceDirectory() + "/robots", tr("Robots (*.wrl *.urdf)"));
    if (!file.isEmpty()) addInMiddle(robotToAdd(file));
  });
}

QWidget* LivePage::makeSide() {
  auto* things = new QTabWidget(this);
  things->setDocumentMode(true);
  tree_ = new ObjectTree(*world_, things);
  palette_ = new ThingPalette(things);
  things->addTab(tree_, tr("Objects"));
  things->addTab(palette_, tr("Palette"));
  auto* panels = new QTabWidget(this);
  panels->setObjectName("livePanels");
  panels->setDocumentMode(true);
  selection_ = new SelectionPanel(*world_, panels);
  joints_ = new JointsPanel(*world_, panels);
  simulator_ = new SimulatorPanel(*world_, panels);
  // Scrolled on their own: what they ask for would make the whole page higher than a small screen.
  panels->addTab(new ScrollPage(selection_, panels), tr("Selected"));
  panels->addTab(joints_, tr("Joints"));
  panels->addTab(new ScrollPage(simulator_, panels), tr("Simulator"));
  const auto warn = [this](const QString& why) { banner_->showMessage(MessageBanner::Kind::warning, why); };
  connect(selection_, &SelectionPanel::problem, this, warn);
  connect(desk_, &LiveDesk::problem, this, warn);
  connect(simulator_, &SimulatorPanel::problem, this, warn);
  connect(&selection_->sets(), &ParameterSets::used, signals_, &SignalsPanel::mark);
  connect(palette_, &ThingPalette::chosen, this, [this](int thing) { addInMiddle(palette_->thing(thing)); });
  connect(tree_, &ObjectTree::renameWanted, this, &LivePage::rename);
  connect(tree_, &ObjectTree::jointChosen, this, [this, panels](const std::string&, const std::string& joint) {
    panels->setCurrentWidget(joints_);
    joints_->showJoint(joint);
  });
  auto* hint = new QLabel(
      tr("Drag an object to lead it: by a spring while it runs, by hand while it waits; with Ctrl up and down."), this);
  hint->setWordWrap(true);
  auto* lower = new QWidget(this);
  auto* column = new QVBoxLayout(lower);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(panels, 1);
  column->addWidget(hint);
  auto* side = new QSplitter(Qt::Vertical, this);
  side->addWidget(things);
  side->addWidget(lower);
  side->setStretchFactor(1, 2);
  side->setSizes({180, 420});
  side->setChildrenCollapsible(false);
  side->setMinimumWidth(270);
  return side;
}

/// Of the session that is about to begin; "" where none is written.
QString LivePage::newLog() const {
  if (logs_.isEmpty() || !QDir().mkpath(logs_)) return {};
  return QDir(logs_).filePath(QDateTime::currentDateTime().toString("yyyy-MM-dd'T'HH-mm-ss-zzz") + ".log");
}

void LivePage::sayIfNoLog() {
  if (log_.isEmpty() && !logs_.isEmpty())
    banner_->showMessage(MessageBanner::Kind::warning,
                         tr("No log of this session is kept: the folder %1 cannot be made.").arg(logs_));
}

/// The world goes on without. What was written until then is whole.
void LivePage::loseLog(const QString& why) {
  const bool begun = QFileInfo(log_).size() > 0 && isSessionLog(log_.toStdString());
  if (!begun) log_.clear();
  banner_->showMessage(MessageBanner::Kind::warning,
                       begun ? tr("The world goes on, but this session's log ends here: %1.").arg(why)
                             : tr("The world runs, but no log of this session is kept: %1.").arg(why));
  showSelected();
}

/// For another world.
void LivePage::prepare() {
  log_ = newLog();
  banner_->clear();
  undo_.clear();
  redo_.clear();
  undosLeft_ = 0;
  world_->forget();
  fresh_ = true;
  if (isVisible()) view_->setFocus();  // whoever opens a world goes on with its keys: Space plays it
}

/// A world that runs is given up only for a file that can be one. What else is wrong with it its process says.
bool LivePage::canBecomeWorld(const QString& file) {
  if (!world_->isReady()) return true;
  try {
    const Game game = loadGame(file.toStdString());
    loadModels(game.scene);
    checkPlayers(game, world_->host());
    return true;
  } catch (const std::exception& error) {
    banner_->showMessage(MessageBanner::Kind::error, tr("%1. The world that was open goes on.").arg(error.what()));
    return false;
  }
}

void LivePage::open(const QString& file) {
  if (isSessionLog(file.toStdString())) return openReplay(file);
  if (!canBecomeWorld(file)) return;
  replayer_->stop();
  file_ = file;
  prepare();
  process_->start(file, log_);
  showReplaying();
  sayIfNoLog();
  emit opened(file);
}

void LivePage::openReplay(const QString& log, long at) {
  QString game;
  try {
    const LogHead head = headOfSessionLog(log.toStdString());
    if (world_->isReady()) loadSessionLog(log.toStdString());  // a damaged one is nothing to give a world up for
    if (!head.hasGame) {
      QStringList files{file_};
      for (const QString& folder : {QFileInfo(log).path(), resourceDirectory() + "/games"})
        for (const QFileInfo& file : QDir(folder).entryInfoList({"*.json"}, QDir::Files)) files << file.filePath();
      game = gameWithHash(head.gameSha256, files);
      if (game.isEmpty())
        game = QFileDialog::getOpenFileName(this, tr("Which game was it a session of?"), QFileInfo(log).path(),
                                            tr("Games, scenes, robots (*.json *.wrl *.urdf)"));
      if (game.isEmpty()) return;
    }
  } catch (const InputError& error) {
    return banner_->showMessage(MessageBanner::Kind::error, QString::fromUtf8(error.what()));
  }
  file_ = log;
  prepare();
  replayer_->start(log, game, log_, at);
  replayer_->setSpeed(tools_->speed());
  showReplaying();
  sayIfNoLog();
}

void LivePage::replayWithDialog() {
  const QString log = QFileDialog::getOpenFileName(this, tr("Replay a session"), logs_.isEmpty() ? QString() : logs_,
                                                   tr("Session logs (*.log);;All files (*)"));
  if (!log.isEmpty()) openReplay(log);
}

/// The log is whole once its session has ended.
void LivePage::replaySession() {
  const QString log = log_;
  process_->end();
  openReplay(log);
}

/// Hands are off, or on.
void LivePage::showReplaying() {
  const bool hands = world_->handsAreOn() && !process_->hasFailed();
  for (QWidget* panel : std::initializer_list<QWidget*>{selection_, joints_, simulator_, palette_})
    panel->setEnabled(hands);
  showUndo();
  showSelected();
}

void LivePage::showUndo() {
  const bool back = undo_.isEmpty() && replayer_->wentOnAt();
  tools_->setUndo(back ? tr("go on from here") : undo_, redo_);
}

void LivePage::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (later_.isEmpty()) return;
  // Whoever shows the page may be about to open something.
  QTimer::singleShot(0, this, [this, file = std::exchange(later_, {})] {
    if (file_.isEmpty() && QFile::exists(file)) open(file);
  });
}

void LivePage::setDatabase(DatabaseReader& reader) { selection_->setDatabase(&reader); }

void LivePage::reset() {
  if (!file_.isEmpty()) open(file_);
}

void LivePage::openWithDialog() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Open a game, a scene or a robot"), resourceDirectory() + "/games",
                                   tr("Games, scenes, robots, session logs (*.json *.wrl *.urdf *.log)"));
  if (!file.isEmpty()) openIfWorld(file);
}

void LivePage::openIfWorld(const QString& file) {
  const std::string plain = file.toStdString();
  const FileKind kind = kindOfFile(plain);
  if (isSessionLog(plain) || kind == FileKind::game || kind == FileKind::scene || kind == FileKind::robot)
    return open(file);
  const std::string words = kindInWords(plain);
  banner_->showMessage(
      MessageBanner::Kind::error,
      tr("%1 is %2; games, scenes, robots and session logs are opened here.").arg(file, QString::fromStdString(words)));
}

QString LivePage::askJson(const QString& title, const QString& proposed, const QString& kind) {
  const QString file = QFileDialog::getSaveFileName(this, title, proposed, kind + " (*.json)");
  return file.isEmpty() || file.endsWith(".json") ? file : file + ".json";
}

void LivePage::saveGame() {
  const QString file = askJson(tr("Save game"), "game.json", tr("Games"));
  if (!file.isEmpty()) process_->save(file, desk_->state());
}

void LivePage::saveScene() {
  const QString file = askJson(tr("Save this moment as scene"), "moment.json", tr("Scenes"));
  if (!file.isEmpty()) process_->saveScene(file);
}

void LivePage::saveExperiment() {
  const QString file = askJson(tr("Start an experiment from here"), "from-here.json", tr("Experiments"));
  if (file.isEmpty()) return;
  const LiveObject* selected = world_->selectedObject();
  process_->saveExperiment(file, selected && selected->kind == LiveObject::Kind::robot ? selected->name : "");
}

void LivePage::saveLog() {
  const QString file = QFileDialog::getSaveFileName(this, tr("Save log"), "session.log", tr("Session logs (*.log)"));
  if (file.isEmpty()) return;
  try {
    if (QFileInfo(file) != QFileInfo(log_)) writeFile(file.toStdString(), readFile(log_.toStdString()));
    banner_->showMessage(MessageBanner::Kind::information, tr("Saved: %1").arg(file));
  } catch (const InputError& error) {
    banner_->showMessage(MessageBanner::Kind::error, QString::fromUtf8(error.what()));
  }
}

void LivePage::showObjects() {
  view_->setScene(world_->scene());
  view_->setGround(game().scene.floor ? Ground::plain : Ground::none);
  view_->setCaption({});
  tree_->showObjects();
  simulator_->showObjects();
}

void LivePage::showGame() {
  selection_->showSelected();
  simulator_->showValues();
}

void LivePage::showHands() {
  std::map<std::string, Vector3d> targets;
  for (const auto& [object, pull] : world_->pulls())
    targets[object] = {pull.target_m[0], pull.target_m[1], pull.target_m[2]};
  view_->setHands(targets);
}

void LivePage::showRow() {
  view_->setMoving(row().playing);
  view_->setRow(row());
  if (selection_->isVisible()) selection_->showPlace();
  if (joints_->isVisible()) joints_->showRow();
  tools_->showRow(row(), world_->scene().time_s(row()));
  if (!row().fault.isEmpty())
    banner_->showMessage(
        MessageBanner::Kind::error,
        tr("The world stopped: %1. It is shown as it was just before; “Reset” opens it again.").arg(row().fault));
}

void LivePage::showSelected() {
  view_->select(world_->selection());
  tree_->showSelected();
  tools_->setState(process_->isReady(), !file_.isEmpty(), !log_.isEmpty(),
                   world_->isReady() && world_->selectedObject(), world_->handsAreOn());
  selection_->showSelected();
  joints_->showRobot();
  simulator_->showSelected();
}

void LivePage::lookAtAll() { view_->setCamera(view_->homeCamera()); }

void LivePage::pick(const std::string& object, bool toggle) {
  if (!toggle) return world_->select({object});
  std::vector<std::string> objects = world_->selection();
  if (std::erase(objects, object) == 0) objects.push_back(object);
  world_->select(objects);
}

void LivePage::add(const ThingToAdd& thing, const Eigen::Vector2d& at_m) {
  if (!world_->isReady()) return;
  try {
    addThing(*world_, thing, at_m);
  } catch (const InputError& error) {
    banner_->showMessage(MessageBanner::Kind::error, QString::fromUtf8(error.what()));
  }
}

void LivePage::duplicate() {
  if (world_->isReady()) duplicateSelected(*world_);
}

void LivePage::rename(const std::string& object, const std::string& name) {
  if (!world_->isReady()) return;
  if (const QString why = renameObject(*world_, object, name); !why.isEmpty())
    banner_->showMessage(MessageBanner::Kind::warning, why);
}

// Numbers may have changed that only the game tells.
void LivePage::undo() {
  if (undo_.isEmpty() && replayer_->wentOnAt()) return openReplay(replayer_->log(), *replayer_->wentOnAt());
  takeBack(-1);
}
void LivePage::redo() { takeBack(1); }

/// One after the other, and never more than there is, however fast a key repeats: the game is told behind each.
void LivePage::takeBack(int steps) {
  undosLeft_ += steps;
  if (process_->isUndoing() || undosLeft_ == 0) return;
  const bool back = undosLeft_ < 0;
  if (!process_->isReady() || (back ? undo_ : redo_).isEmpty()) {
    undosLeft_ = 0;
    return;
  }
  undosLeft_ += back ? 1 : -1;
  back ? process_->undo() : process_->redo();
  process_->askGame();
}

bool LivePage::replayKey(const QKeyEvent& event) {
  const bool acts = event.modifiers() & Qt::ShiftModifier;
  switch (event.key()) {
    case Qt::Key_Left:
    case Qt::Key_Right: {
      const bool on = event.key() == Qt::Key_Right;
      acts ? bar_->chooseAct(on) : bar_->chooseTime(on ? 1 : -1);
      return true;
    }
    case Qt::Key_Home:
    case Qt::Key_End:
      bar_->chooseEnd(event.key() == Qt::Key_End);
      return true;
    default:
      return false;
  }
}

void LivePage::keyPressEvent(QKeyEvent* event) {
  if (replayer_->isOn() && replayKey(*event)) return;
  const bool far = event->modifiers() & Qt::ShiftModifier;
  const double way = far ? 0.1 : 0.01, turn = (far ? 45 : 5) / inDegrees;
  if (event->matches(QKeySequence::Undo)) return tools_->trigger(tools_->undoAction());
  if (event->matches(QKeySequence::Redo)) return tools_->trigger(tools_->redoAction());
  if (event->modifiers() & Qt::ControlModifier && event->key() == Qt::Key_D) return duplicate();
  switch (event->key()) {
    case Qt::Key_Escape:
      return hands_->letGo();
    case Qt::Key_X:
      return selection_->sets().change();
    case Qt::Key_Space:
      return tools_->trigger(tools_->playAction());
    case Qt::Key_Period:
      return tools_->trigger(tools_->stepAction());
    case Qt::Key_Delete:
      return hands_->removeSelected();
    case Qt::Key_Right:
      return hands_->move({way, 0, 0}, 0);
    case Qt::Key_Left:
      return hands_->move({-way, 0, 0}, 0);
    case Qt::Key_Up:
      return hands_->move({0, way, 0}, 0);
    case Qt::Key_Down:
      return hands_->move({0, -way, 0}, 0);
    case Qt::Key_PageUp:
      return hands_->move({0, 0, way}, 0);
    case Qt::Key_PageDown:
      return hands_->move({0, 0, -way}, 0);
    case Qt::Key_BracketLeft:
      return hands_->move({0, 0, 0}, turn);
    case Qt::Key_BracketRight:
      return hands_->move({0, 0, 0}, -turn);
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace btr::ui
