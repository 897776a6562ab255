#include "ui/live/live_page.h"

#include <QAction>
#include <QComboBox>
#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QRegularExpression>
#include <QScrollArea>
#include <QSplitter>
#include <QStyle>
#include <QToolBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "core/plugin/plugin_host.h"
#include "core/spec/error.h"
#include "ui/common/decimal_spin_box.h"
#include "ui/common/format.h"
#include "ui/common/message_banner.h"
#include "ui/common/resources.h"
#include "ui/common/theme.h"
#include "ui/experiment/parameter_form.h"

namespace btr::ui {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

QDoubleSpinBox* numberBox(const QString& name, const QString& unit, double from, double to, double step, int decimals) {
  auto* box = new DecimalSpinBox;
  box->setDecimals(decimals);
  box->setRange(from, to);
  box->setSingleStep(step);
  box->setSuffix(unit);
  box->setAccessibleName(name);
  return box;
}

double headingOf(const Isometry3d& pose) { return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0)); }

std::array<double, 3> array(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

PlaceAct placeAct(const std::string& object, const Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  return {object, array(pose.translation()), {q.w(), q.x(), q.y(), q.z()}, {}};
}

constexpr double speeds[] = {0.1, 0.25, 0.5, 1, 2, 5, 0};
constexpr double degree = M_PI / 180;

}  // namespace

LivePage::LivePage(const PluginHost& host, const QString& program, const QString& logs, QWidget* parent)
    : QWidget(parent),
      host_(host),
      logs_(logs),
      process_(new LiveProcess(program, this)),
      view_(new LiveView(this)),
      banner_(new MessageBanner(this)) {
  setObjectName("livePage");
  auto* split = new QSplitter(this);
  split->addWidget(view_);
  split->addWidget(makeSide());
  split->setStretchFactor(0, 1);
  split->setCollapsible(0, false);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(8, 8, 8, 8);
  layout->addWidget(makeTools());
  layout->addWidget(banner_);
  layout->addWidget(split, 1);
  view_->setGround(Ground::plain);
  view_->setCaption({tr("Open a game, a scene or a robot file; or drop one here.")});

  connect(process_, &LiveProcess::gameTold, this, &LivePage::showGame);
  connect(process_, &LiveProcess::rowTold, this, &LivePage::showRow);
  connect(process_, &LiveProcess::refused, this, [this](const QString& why) {
    banner_->showMessage(MessageBanner::Kind::warning, why);
    showSelected();
  });
  connect(process_, &LiveProcess::saved, this, [this](const QString& path) {
    banner_->showMessage(MessageBanner::Kind::information, tr("Saved: %1").arg(path));
  });
  connect(process_, &LiveProcess::failed, this, [this](const QString& why) {
    banner_->showMessage(MessageBanner::Kind::error, why);
    play_->setChecked(false);
    play_->setEnabled(false);
    step_->setEnabled(false);
  });
  connect(view_, &LiveView::picked, this, &LivePage::select);
  connect(view_, &LiveView::ledTo, this, &LivePage::lead);
  connect(view_, &LiveView::letGo, this, &LivePage::letGo);
  showSelected();
}

QToolBar* LivePage::makeTools() {
  auto* tools = new QToolBar(this);
  tools->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  const auto add = [&](const QString& name, const QString& icon, const QString& text, const QString& tip, auto slot) {
    QAction* action = tools->addAction(themeIcon(icon), text);
    action->setObjectName(name);
    action->setToolTip(tip);
    connect(action, &QAction::triggered, this, slot);
    return action;
  };
  open_ = add("liveOpen", "document-open", tr("&Open…"), tr("A game, a scene or a robot file"),
              [this] { openWithDialog(); });
  auto* examples = new QMenu(this);
  for (const QFileInfo& file : QDir(resourceDirectory() + "/games").entryInfoList({"*.json"}, QDir::Files))
    connect(examples->addAction(file.completeBaseName()), &QAction::triggered, this,
            [this, path = file.filePath()] { open(path); });
  open_->setMenu(examples);
  play_ = add("livePlay", "media-playback-start", tr("&Play"), tr("Goes on, or waits (Space)"),
              [this](bool on) { process_->play(on); });
  play_->setCheckable(true);
  step_ =
      add("liveStep", "media-skip-forward", tr("&Step"), tr("One control period (.)"), [this] { process_->step(1); });
  reset_ = add("liveReset", "media-skip-backward", tr("&Reset"), tr("As it was opened"), [this] { reset(); });
  speed_ = new QComboBox(tools);
  speed_->setObjectName("liveSpeed");
  speed_->setAccessibleName(tr("Speed"));
  speed_->setToolTip(tr("Simulated seconds in a second"));
  for (const double speed : speeds) speed_->addItem(speed > 0 ? tr("%1 ×").arg(speed) : tr("as fast as it can"), speed);
  speed_->setCurrentIndex(3);
  connect(speed_, &QComboBox::activated, this, [this] { process_->setSpeed(speed_->currentData().toDouble()); });
  tools->addWidget(speed_);
  tools->addSeparator();
  addAction_ =
      add("liveAdd", "list-add", tr("&Add"), tr("A ball, an obstacle or a robot, in the middle of the view"), [] {});
  auto* things = new QMenu(this);
  fillAdd(*things);
  addAction_->setMenu(things);
  qobject_cast<QToolButton*>(tools->widgetForAction(addAction_))->setPopupMode(QToolButton::InstantPopup);
  qobject_cast<QToolButton*>(tools->widgetForAction(open_))->setPopupMode(QToolButton::MenuButtonPopup);
  remove_ = add("liveRemove", "list-remove", tr("Re&move"), tr("Takes what is selected away (Delete)"),
                [this] { removeSelected(); });
  follow_ = add("liveFollow", "crosshairs", tr("&Follow"), tr("Keeps what is selected in the middle"),
                [this](bool on) { view_->setFollowing(on); });
  follow_->setCheckable(true);
  tools->addSeparator();
  save_ = add("liveSave", "document-save", tr("Sa&ve game…"),
              tr("The game as it is now: it goes on with the same bits"), [this] { saveGame(); });
  saveLog_ =
      add("liveSaveLog", "document-save-as", tr("Save &log…"),
          tr("What was done since it was opened: “btr live GAME --replay LOG” plays it again with the same bits"),
          [this] { saveLog(); });
  tools->addSeparator();
  clock_ = new QLabel(tools);
  clock_->setObjectName("liveClock");
  clock_->setContentsMargins(6, 0, 6, 0);
  tools->addWidget(clock_);
  return tools;
}

void LivePage::fillAdd(QMenu& menu) {
  const auto obstacle = [&](const QString& text, const std::string& word, auto change) {
    connect(menu.addAction(text), &QAction::triggered, this, [this, word, change] {
      ObstacleSpec spec;
      spec.name = freeName(word);
      change(spec);
      add(spec);
    });
  };
  connect(menu.addAction(tr("Ball")), &QAction::triggered, this, [this] { addBall(); });
  obstacle(tr("Box that can be pushed"), "box", [](ObstacleSpec& s) { s.mass_kg = 0.2; });
  obstacle(tr("Cylinder that can be pushed"), "cylinder", [](ObstacleSpec& s) {
    s.shape = "cylinder";
    s.size_m[2] = 0.2;
    s.mass_kg = 0.3;
  });
  obstacle(tr("Ramp"), "ramp", [](ObstacleSpec& s) {
    s.shape = "ramp";
    s.size_m = {0.5, 0.4, 0.1};
  });
  obstacle(tr("Wall"), "wall", [](ObstacleSpec& s) { s.size_m = {0.05, 0.6, 0.2}; });
  menu.addSeparator();
  for (const char* robot : {"ers7", "ers210", "ers220"})
    connect(menu.addAction(QString("AIBO %1").arg(QString(robot).toUpper().insert(3, '-'))), &QAction::triggered, this,
            [this, robot] { addRobot(resourceDirectory() + "/robots/" + robot + ".wrl"); });
  connect(menu.addAction(tr("Robot from a file…")), &QAction::triggered, this, [this] {
    const QString file =
        QFileDialog::getOpenFileName(this, tr("Robot"), resourceDirectory() + "/robots", tr("Robots (*.wrl *.urdf)"));
    if (!file.isEmpty()) addRobot(file);
  });
}

QWidget* LivePage::makeSide() {
  auto* side = new QWidget(this);
  auto* column = new QVBoxLayout(side);
  column->setContentsMargins(8, 0, 0, 0);
  list_ = new QListWidget(side);
  list_->setObjectName("liveObjects");
  list_->setAccessibleName(tr("Objects"));
  connect(list_, &QListWidget::currentTextChanged, this, [this](const QString& name) { select(name.toStdString()); });
  column->addWidget(list_, 1);
  what_ = new QLabel(side);
  column->addWidget(what_);

  place_ = new QWidget(side);
  auto* placing = new QFormLayout(place_);
  placing->setContentsMargins(0, 0, 0, 0);
  x_ = numberBox(tr("x"), " m", -50, 50, 0.05, 3);
  y_ = numberBox(tr("y"), " m", -50, 50, 0.05, 3);
  z_ = numberBox(tr("z"), " m", -5, 50, 0.05, 3);
  heading_ = numberBox(tr("Heading"), tr("°"), -180, 180, 5, 1);
  placing->addRow(tr("x"), x_);
  placing->addRow(tr("y"), y_);
  placing->addRow(tr("z"), z_);
  placing->addRow(tr("Heading"), heading_);
  auto* put = new QPushButton(themeIcon("transform-move"), tr("Pu&t there"), place_);
  put->setObjectName("livePut");
  put->setToolTip(tr("At rest, upright"));
  connect(put, &QPushButton::clicked, this, &LivePage::placeAsTyped);
  placing->addRow(put);
  column->addWidget(place_);

  throw_ = new QWidget(side);
  auto* throwing = new QFormLayout(throw_);
  throwing->setContentsMargins(0, 0, 0, 0);
  speedOut_ = numberBox(tr("Speed"), " m/s", 0, 20, 0.5, 2);
  speedOut_->setValue(1.5);
  direction_ = numberBox(tr("Direction"), tr("°"), -180, 180, 15, 0);
  rise_ = numberBox(tr("Upwards"), tr("°"), -90, 90, 15, 0);
  rise_->setValue(30);
  throwing->addRow(tr("Speed"), speedOut_);
  throwing->addRow(tr("Direction"), direction_);
  throwing->addRow(tr("Upwards"), rise_);
  auto* go = new QPushButton(themeIcon("go-up"), tr("Thro&w"), throw_);
  go->setObjectName("liveThrow");
  connect(go, &QPushButton::clicked, this, &LivePage::throwSelected);
  throwing->addRow(go);
  column->addWidget(throw_);

  plays_ = new QWidget(side);
  auto* playing = new QVBoxLayout(plays_);
  playing->setContentsMargins(0, 0, 0, 0);
  controller_ = new QComboBox(plays_);
  controller_->setObjectName("liveController");
  controller_->setAccessibleName(tr("Controller"));
  controller_->addItem(tr("stands still"));
  for (const std::string& name : host_.controllers()) controller_->addItem(QString::fromStdString(name));
  connect(controller_, &QComboBox::activated, this, [this] { changeController(); });
  playing->addWidget(controller_);
  tuning_ = new QScrollArea(plays_);
  tuning_->setWidgetResizable(true);
  tuning_->setFrameShape(QFrame::NoFrame);
  playing->addWidget(tuning_, 1);
  column->addWidget(plays_, 3);
  hint_ = new QLabel(
      tr("Drag an object to lead it: by a spring while it runs, by hand while it waits; with Ctrl up and down."), side);
  hint_->setWordWrap(true);
  column->addWidget(hint_);
  side->setMinimumWidth(230);
  return side;
}

void LivePage::open(const QString& file) {
  file_ = file;
  log_.clear();
  if (!logs_.isEmpty() && QDir().mkpath(logs_))
    log_ = QDir(logs_).filePath(QDateTime::currentDateTime().toString("yyyy-MM-dd'T'HH-mm-ss-zzz") + ".log");
  banner_->clear();
  pulled_.clear();
  row_ = {};
  fresh_ = true;
  play_->setChecked(false);
  process_->start(file, log_);
  emit opened(file);
}

void LivePage::reset() {
  if (file_.isEmpty()) return;
  const double speed = speed_->currentData().toDouble();
  open(file_);
  connect(
      process_, &LiveProcess::gameTold, this, [this, speed] { process_->setSpeed(speed); }, Qt::SingleShotConnection);
}

void LivePage::openWithDialog() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Open a game, a scene or a robot"), resourceDirectory() + "/games",
                                   tr("Games, scenes, robots (*.json *.wrl *.urdf)"));
  if (!file.isEmpty()) open(file);
}

void LivePage::saveGame() {
  QString file = QFileDialog::getSaveFileName(this, tr("Save game"), "game.json", tr("Games (*.json)"));
  if (file.isEmpty()) return;
  if (!file.endsWith(".json")) file += ".json";
  process_->save(file);
}

void LivePage::saveLog() {
  const QString file = QFileDialog::getSaveFileName(this, tr("Save log"), "session.log", tr("Session logs (*.log)"));
  if (file.isEmpty()) return;
  QFile::remove(file);
  if (!QFile::copy(log_, file)) banner_->showMessage(MessageBanner::Kind::error, tr("%1 cannot be written.").arg(file));
}

void LivePage::showGame(const Game& game, const ModelSet& models, const std::vector<std::string>& channels) {
  const std::string before = view_->selected();
  game_ = game;
  scene_ = LiveScene(game, models, channels);
  row_ = {};
  view_->setScene(scene_);
  view_->setGround(game.scene.floor ? Ground::plain : Ground::none);
  view_->setCaption({});
  {
    const QSignalBlocker quiet(list_);
    list_->clear();
    for (const LiveObject& object : scene_.objects()) list_->addItem(QString::fromStdString(object.name));
  }
  select(before);
}

void LivePage::showRow(const LiveRow& row) {
  const bool first = row_.values.empty();
  row_ = row;
  if (std::exchange(fresh_, false)) lookAtAll();
  view_->setMoving(row.playing);
  view_->setRow(row);
  if (first)
    showSelected();
  else
    showPlace();
  play_->setChecked(row.playing);
  play_->setText(row.playing ? tr("&Pause") : tr("&Play"));
  play_->setIcon(themeIcon(row.playing ? "media-playback-pause" : "media-playback-start"));
  QString text = tr("%1 s").arg(scene_.time_s(row), 0, 'f', 2);
  if (row.playing && row.realTimeFactor > 0) text += tr(" · %1 × real time").arg(row.realTimeFactor, 0, 'f', 2);
  clock_->setText(text);
  const bool goesOn = row.fault.isEmpty();
  play_->setEnabled(goesOn);
  step_->setEnabled(goesOn && !row.playing);
  if (!goesOn)
    banner_->showMessage(
        MessageBanner::Kind::error,
        tr("The world stopped: %1. It is shown as it was just before; “Reset” opens it again.").arg(row.fault));
}

int LivePage::selectedIndex() const {
  for (std::size_t i = 0; i < scene_.objects().size(); ++i)
    if (scene_.objects()[i].name == view_->selected()) return int(i);
  return -1;
}

void LivePage::select(const std::string& object) {
  view_->select(object);
  const int index = selectedIndex();
  const QSignalBlocker quiet(list_);
  list_->setCurrentRow(index);
  if (index < 0) view_->select("");
  showSelected();
}

void LivePage::showSelected() {
  const int index = selectedIndex();
  const bool ready = process_->isReady(), any = index >= 0 && ready && !row_.values.empty();
  for (QAction* action : {play_, step_, reset_, addAction_, save_}) action->setEnabled(ready);
  reset_->setEnabled(!file_.isEmpty());
  saveLog_->setEnabled(!log_.isEmpty());
  remove_->setEnabled(any);
  place_->setEnabled(any);
  const bool moves = any && scene_.objects()[std::size_t(index)].moves;
  throw_->setVisible(moves);
  const bool robot = any && scene_.objects()[std::size_t(index)].kind == LiveObject::Kind::robot;
  plays_->setVisible(robot);
  if (!any) {
    what_->setText(tr("Nothing is selected."));
    return;
  }
  const LiveObject& object = scene_.objects()[std::size_t(index)];
  const QString kind = robot ? tr("robot") : object.kind == LiveObject::Kind::ball ? tr("ball") : tr("obstacle");
  what_->setText(tr("<b>%1</b>, %2").arg(QString::fromStdString(object.name).toHtmlEscaped(), kind));
  showPlace();
  if (robot) showController();
}

/// From above one corner, near enough to see a dog and far enough to see all.
void LivePage::lookAtAll() {
  Eigen::AlignedBox3d all;
  for (std::size_t i = 0; i < scene_.objects().size(); ++i) all.extend(scene_.poseOf(i, row_).translation());
  ViewCamera camera;
  if (!all.isEmpty()) {
    camera.focus = all.center();
    constexpr double perRadius = 2.2;
    camera.distance = std::clamp(perRadius * (all.diagonal().norm() / 2 + 0.3), camera.distance, 15.0);
    if (camera.distance > 3) camera.elevation = 0.6;
  }
  view_->setCamera(camera);
}

/// Where what is selected is now; numbers that are being typed stay.
void LivePage::showPlace() {
  const int index = selectedIndex();
  if (index < 0 || row_.values.empty()) return;
  for (const QDoubleSpinBox* box : {x_, y_, z_, heading_})
    if (box->hasFocus()) return;
  const Isometry3d pose = scene_.poseOf(std::size_t(index), row_);
  for (const auto& [box, value] : {std::pair{x_, pose.translation().x()},
                                   {y_, pose.translation().y()},
                                   {z_, pose.translation().z()},
                                   {heading_, headingOf(pose) / degree}}) {
    const QSignalBlocker quiet(box);
    box->setValue(value);
  }
}

void LivePage::showController() {
  const auto player = game_.robots.find(view_->selected());
  const bool plays = player != game_.robots.end() && player->second.controller;
  controller_->setCurrentIndex(
      plays ? std::max(0, controller_->findText(QString::fromStdString(player->second.controller->plugin))) : 0);
  form_ = nullptr;
  undo_.clear();
  tuned_.clear();
  if (!plays) {
    tuning_->setWidget(new QWidget);
    return;
  }
  try {
    form_ = new ParameterForm(host_.controller(player->second.controller->plugin)->genotype(), undo_);
    form_->setValues(player->second.controller->parameters);
  } catch (const InputError& error) {
    banner_->showMessage(MessageBanner::Kind::warning, QString::fromUtf8(error.what()));
  }
  if (!form_) return;
  tuned_ = player->second.controller->parameters;
  tuning_->setWidget(form_);
  connect(form_, &ParameterForm::changed, this, &LivePage::tune);
}

// Each number that differs from what the controller has is an act of its own.
void LivePage::tune(const Values& values) {
  const std::string robot = view_->selected();
  const auto player = game_.robots.find(robot);
  if (player == game_.robots.end() || !player->second.controller) return;
  for (const Parameter& parameter : host_.controller(player->second.controller->plugin)->genotype()) {
    const auto valueIn = [&](const Values& all) {
      const auto found = all.find(parameter.name);
      return found == all.end() ? parameter.byDefault : found->second;
    };
    if (valueIn(values) != valueIn(tuned_)) process_->act(ParameterAct{robot, parameter.name, valueIn(values)});
  }
  tuned_ = player->second.controller->parameters = values;
}

void LivePage::changeController() {
  ControllerAct act{view_->selected(), std::nullopt};
  if (controller_->currentIndex() > 0)
    act.controller = GameController{controller_->currentText().toStdString(), {}, {}, true};
  process_->act(act);
  game_.robots[act.robot].controller = act.controller;
  showController();
}

void LivePage::lead(const std::string& object, const Vector3d& place_m) {
  const int index = selectedIndex();
  if (index < 0) return;
  if (!row_.playing) {
    Isometry3d pose = scene_.poseOf(std::size_t(index), row_);
    pose.translation() = place_m;
    process_->act(placeAct(object, pose));
    return;
  }
  if (!scene_.objects()[std::size_t(index)].moves) return;
  PullAct pull;
  pull.object = object;
  pull.target_m = array(place_m);
  process_->act(pull);
  pulled_.insert(QString::fromStdString(object));
}

void LivePage::letGo(const std::string& object) {
  if (pulled_.remove(QString::fromStdString(object))) process_->act(LetGoAct{object});
  showSelected();
}

std::string LivePage::freeName(const std::string& word) const {
  const auto taken = [&](const std::string& name) {
    return std::ranges::any_of(scene_.objects(), [&](const LiveObject& object) { return object.name == name; });
  };
  std::string name = word;
  for (int number = 2; taken(name); ++number) name = word + std::to_string(number);
  return name;
}

void LivePage::add(const ObstacleSpec& obstacle) {
  ObstacleSpec spec = obstacle;
  const Vector3d& focus = view_->camera().focus;
  // What can be pushed falls onto what lies there; a wall or a ramp stands on the floor.
  const double above = spec.mass_kg > 0 ? 0.15 : 0;
  spec.position_m = {focus.x(), focus.y(), spec.size_m[2] / 2 + above};
  process_->act(AddAct{spec, {}});
  view_->select(spec.name);
}

void LivePage::addBall() {
  BallSpec ball;
  ball.name = freeName("ball");
  ball.rollingDeceleration_m_s2 = 0.4;
  ball.restitution = 0.4;
  const Vector3d& focus = view_->camera().focus;
  ball.position_m = {focus.x(), focus.y(), 0.2};
  process_->act(AddAct{ball, {}});
  view_->select(ball.name);
}

void LivePage::addRobot(const QString& file) {
  try {
    RobotSpec robot = loadGame(file.toStdString()).scene.robots.at(0);
    robot.name =
        freeName(QFileInfo(file).completeBaseName().replace(QRegularExpression("[^A-Za-z0-9_-]"), "_").toStdString());
    robot.model = std::filesystem::absolute(file.toStdString()).string();
    const Vector3d& focus = view_->camera().focus;
    robot.position_m[0] = focus.x();
    robot.position_m[1] = focus.y();
    process_->act(AddAct{robot, {}});
    view_->select(robot.name);
  } catch (const InputError& error) {
    banner_->showMessage(MessageBanner::Kind::error, QString::fromUtf8(error.what()));
  }
}

void LivePage::removeSelected() {
  if (selectedIndex() >= 0) process_->act(RemoveAct{view_->selected()});
}

void LivePage::placeSelected(const Isometry3d& pose) {
  if (selectedIndex() >= 0) process_->act(placeAct(view_->selected(), pose));
}

void LivePage::placeAsTyped() {
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() << x_->value(), y_->value(), z_->value();
  pose.rotate(Eigen::AngleAxisd(heading_->value() * degree, Vector3d::UnitZ()));
  placeSelected(pose);
}

void LivePage::throwSelected() {
  if (selectedIndex() < 0) return;
  const double rise = rise_->value() * degree, direction = direction_->value() * degree, speed = speedOut_->value();
  process_->act(ThrowAct{view_->selected(),
                         {speed * std::cos(rise) * std::cos(direction), speed * std::cos(rise) * std::sin(direction),
                          speed * std::sin(rise)},
                         {0, 0, 0}});
}

void LivePage::keyPressEvent(QKeyEvent* event) {
  const bool far = event->modifiers() & Qt::ShiftModifier;
  const double way = far ? 0.1 : 0.01, turn = (far ? 45 : 5) * degree;
  const int index = selectedIndex();
  const auto move = [&](double x, double y, double z, double heading) {
    if (index < 0 || row_.values.empty()) return;
    Isometry3d pose = scene_.poseOf(std::size_t(index), row_);
    pose.translation() += Vector3d(x, y, z);
    pose.linear() = Eigen::AngleAxisd(heading, Vector3d::UnitZ()) * pose.linear();
    placeSelected(pose);
  };
  switch (event->key()) {
    case Qt::Key_Space:
      return play_->isEnabled() ? play_->trigger() : void();
    case Qt::Key_Period:
      return step_->isEnabled() ? step_->trigger() : void();
    case Qt::Key_Delete:
      return removeSelected();
    case Qt::Key_Right:
      return move(way, 0, 0, 0);
    case Qt::Key_Left:
      return move(-way, 0, 0, 0);
    case Qt::Key_Up:
      return move(0, way, 0, 0);
    case Qt::Key_Down:
      return move(0, -way, 0, 0);
    case Qt::Key_PageUp:
      return move(0, 0, way, 0);
    case Qt::Key_PageDown:
      return move(0, 0, -way, 0);
    case Qt::Key_BracketLeft:
      return move(0, 0, 0, turn);
    case Qt::Key_BracketRight:
      return move(0, 0, 0, -turn);
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace btr::ui
