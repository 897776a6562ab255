#include "ui/live/panels/selection_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/plugin/plugin_host.h"
#include "core/spec/error.h"
#include "ui/common/database/database_reader.h"
#include "ui/common/form_undo.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/decimal_spin_box.h"
#include "ui/common/numbers/format.h"
#include "ui/live/hand_acts.h"
#include "ui/live/live_world.h"
#include "ui/live/panels/individual_dialog.h"
#include "ui/live/panels/parameter_sets.h"
#include "ui/live/panels/slider_form.h"

namespace btr::ui {
namespace {

using Eigen::Isometry3d;

QDoubleSpinBox* placeBox(const QString& name, const QString& unit, double from, double to, double step, int decimals) {
  auto* box = new DecimalSpinBox;
  box->setDecimals(decimals);
  box->setRange(from, to);
  box->setSingleStep(step);
  box->setSuffix(unit);
  box->setAccessibleName(name);
  for (QWidget* inside : box->findChildren<QWidget*>()) leaveUndoToForm(inside);
  return box;
}

constexpr double degree = 1 / inDegrees;

}  // namespace

SelectionPanel::SelectionPanel(LiveWorld& world, QWidget* parent) : QWidget(parent), world_(world) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  what_ = new QLabel(this);
  hand_ = new QLabel(this);
  hand_->setObjectName("liveHand");
  hand_->setWordWrap(true);
  column->addWidget(what_);
  column->addWidget(hand_);
  column->addWidget(place_ = makePlace());
  column->addWidget(throw_ = makeThrow());
  column->addWidget(player_ = makePlayer(), 1);
  column->addStretch();
}

QWidget* SelectionPanel::makePlace() {
  auto* part = new QWidget(this);
  auto* form = new QFormLayout(part);
  form->setContentsMargins(0, 0, 0, 0);
  x_ = placeBox(tr("x"), " m", -50, 50, 0.05, 3);
  y_ = placeBox(tr("y"), " m", -50, 50, 0.05, 3);
  z_ = placeBox(tr("z"), " m", -5, 50, 0.05, 3);
  heading_ = placeBox(tr("Heading"), tr("°"), -180, 180, 5, 1);
  x_->setObjectName("liveX");
  y_->setObjectName("liveY");
  z_->setObjectName("liveZ");
  heading_->setObjectName("liveHeading");
  form->addRow(tr("x"), x_);
  form->addRow(tr("y"), y_);
  form->addRow(tr("z"), z_);
  form->addRow(tr("Heading"), heading_);
  auto* put = new QPushButton(themeIcon("transform-move"), tr("Pu&t there"), part);
  put->setObjectName("livePut");
  put->setToolTip(tr("At rest, upright"));
  connect(put, &QPushButton::clicked, this, &SelectionPanel::placeAsTyped);
  form->addRow(put);
  return part;
}

QWidget* SelectionPanel::makeThrow() {
  auto* part = new QWidget(this);
  auto* form = new QFormLayout(part);
  form->setContentsMargins(0, 0, 0, 0);
  speed_ = placeBox(tr("Speed"), " m/s", 0, 20, 0.5, 2);
  speed_->setValue(1.5);
  direction_ = placeBox(tr("Direction"), tr("°"), -180, 180, 15, 0);
  rise_ = placeBox(tr("Upwards"), tr("°"), -90, 90, 15, 0);
  rise_->setValue(30);
  form->addRow(tr("Speed"), speed_);
  form->addRow(tr("Direction"), direction_);
  form->addRow(tr("Upwards"), rise_);
  auto* go = new QPushButton(themeIcon("go-up"), tr("Thro&w"), part);
  go->setObjectName("liveThrow");
  connect(go, &QPushButton::clicked, this, &SelectionPanel::throwSelected);
  form->addRow(go);
  return part;
}

QWidget* SelectionPanel::makePlayer() {
  auto* part = new QWidget(this);
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  controller_ = new QComboBox(part);
  controller_->setObjectName("liveController");
  controller_->setAccessibleName(tr("Controller"));
  controller_->addItem(tr("stands still"));
  // One that wants a path is none to be chosen by its name alone.
  for (const std::string& name : world_.host().controllers())
    if (world_.host().controller(name)->paths().empty()) controller_->addItem(QString::fromStdString(name));
  controller_->addItem(tr("OPEN-R stick…"), true);
  connect(controller_, &QComboBox::activated, this, [this] { changeController(); });
  column->addWidget(controller_);
  stored_ = new QPushButton(themeIcon("view-list-details"), tr("Stored &individual…"), part);
  stored_->setObjectName("liveStored");
  stored_->setToolTip(tr("An individual of a run of the open database plays"));
  stored_->hide();
  connect(stored_, &QPushButton::clicked, this, &SelectionPanel::chooseStored);
  column->addWidget(stored_);
  column->addWidget(stick_ = makeStick());
  sets_ = new ParameterSets(world_, part);
  connect(sets_, &ParameterSets::problem, this, &SelectionPanel::problem);
  connect(sets_, &ParameterSets::used, this, &SelectionPanel::showParameters);
  column->addWidget(sets_);
  form_ = new SliderForm(part);
  form_->setObjectName("liveTuning");
  connect(form_, &SliderForm::edited, this, &SelectionPanel::tune);
  connect(form_, &SliderForm::dragBegan, &world_.process(), &LiveProcess::beginGesture);
  connect(form_, &SliderForm::dragEnded, &world_.process(), &LiveProcess::endGesture);
  auto* area = new QScrollArea(part);
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setWidget(form_);
  column->addWidget(area, 1);
  return part;
}

QWidget* SelectionPanel::makeStick() {
  auto* part = new QWidget(this);
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  folder_ = new QLabel(part);
  folder_->setObjectName("stickFolder");
  folder_->setWordWrap(true);
  folder_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  column->addWidget(folder_);
  motorPower_ = new QCheckBox(tr("&Motors are on at its start"), part);
  motorPower_->setObjectName("stickMotors");
  motorPower_->setToolTip(tr("For programs that leave that to another one, as MovingHead7 does"));
  camera_ = new QCheckBox(tr("Its &camera looks"), part);
  camera_->setObjectName("stickCamera");
  camera_->setToolTip(tr("For programs that look at images; drawing takes time"));
  for (QCheckBox* box : {motorPower_, camera_}) {
    connect(box, &QCheckBox::clicked, this, [this] { putIn(folder_->property("folder").toString()); });
    column->addWidget(box);
  }
  auto* row = new QHBoxLayout;
  auto* again = new QPushButton(themeIcon("view-refresh"), tr("&Restart"), part);
  again->setObjectName("stickRestart");
  again->setToolTip(tr("The program begins anew"));
  connect(again, &QPushButton::clicked, this, [this] { putIn(folder_->property("folder").toString()); });
  auto* stop = new QPushButton(themeIcon("media-playback-stop"), tr("&Stop"), part);
  stop->setObjectName("stickStop");
  stop->setToolTip(tr("The program ends; the robot stays as it is now"));
  connect(stop, &QPushButton::clicked, this, [this] {
    world_.act(ControllerAct{world_.selected(), std::nullopt});
    showController();
  });
  row->addWidget(again);
  row->addWidget(stop);
  column->addLayout(row);
  column->addStretch();
  part->hide();
  return part;
}

void SelectionPanel::showStick() {
  const GameRobot player = world_.playerOf(world_.selected());
  stick_->setVisible(player.hasStick());
  if (!player.hasStick()) return;
  const GameStick& stick = *player.controller->openr;
  folder_->setText(word(stick.folder));
  folder_->setProperty("folder", QString::fromStdString(stick.folder));
  motorPower_->setChecked(stick.motorPower);
  camera_->setChecked(stick.camera);
}

/// The program on this stick begins, with what is ticked.
void SelectionPanel::putIn(const QString& folder) {
  GameController controller;
  controller.openr = GameStick{folder.toStdString(), "", motorPower_->isChecked(), camera_->isChecked()};
  if (const GameRobot player = world_.playerOf(world_.selected()); player.hasStick())
    controller.openr->design = player.controller->openr->design;
  world_.act(ControllerAct{world_.selected(), controller});
  showController();
}

void SelectionPanel::showSelected() {
  const LiveObject* object = world_.isReady() ? world_.selectedObject() : nullptr;
  place_->setEnabled(object);
  throw_->setVisible(object && object->moves);
  const bool robot = object && object->kind == LiveObject::Kind::robot;
  player_->setVisible(robot);
  if (world_.selection().size() > 1)
    what_->setText(tr("<b>%1</b> and %n more", nullptr, int(world_.selection().size()) - 1)
                       .arg(word(world_.selected()).toHtmlEscaped()));
  if (!object) {
    hand_->hide();
    what_->setText(tr("Nothing is selected."));
    return;
  }
  if (world_.selection().size() == 1) {
    const QString kind = robot ? tr("robot") : object->kind == LiveObject::Kind::ball ? tr("ball") : tr("obstacle");
    what_->setText(tr("<b>%1</b>, %2").arg(QString::fromStdString(object->name).toHtmlEscaped(), kind));
  }
  showPlace();
  if (robot) showController();
}

void SelectionPanel::showPlace() {
  const auto pull = world_.pulls().find(world_.selected());
  hand_->setVisible(pull != world_.pulls().end());
  if (pull != world_.pulls().end()) {
    const auto force = world_.row().hands_n.find(world_.selected());
    hand_->setText(tr("A hand pulls with %1 of at most %2 N. Esc lets go.")
                       .arg(force == world_.row().hands_n.end() ? 0 : force->second.norm(), 0, 'f', 1)
                       .arg(pull->second.most_n));
  }
  if (!world_.isReady() || !world_.selectedObject()) return;
  for (const QDoubleSpinBox* box : {x_, y_, z_, heading_})
    if (box->hasFocus()) return;
  const Isometry3d pose = world_.poseOf(world_.selected());
  for (const auto& [box, value] : {std::pair{x_, pose.translation().x()},
                                   {y_, pose.translation().y()},
                                   {z_, pose.translation().z()},
                                   {heading_, headingOf(pose) * inDegrees}}) {
    const QSignalBlocker quiet(box);
    box->setValue(value);
  }
}

void SelectionPanel::showController() {
  const GameRobot player = world_.playerOf(world_.selected());
  const int plugin = player.hasPlugin() ? controller_->findText(QString::fromStdString(player.controller->plugin)) : 0;
  controller_->setCurrentIndex(player.hasStick() ? controller_->count() - 1 : std::max(0, plugin));
  showStick();
  form_->setVisible(!player.hasStick());
  sets_->setVisible(player.hasPlugin());
  sets_->showRobot(world_.selected());
  std::vector<Parameter> parameters;
  if (player.hasPlugin()) try {
      parameters = world_.host().controller(player.controller->plugin)->genotype();
    } catch (const InputError& error) {
      emit problem(QString::fromUtf8(error.what()));
    }
  form_->setParameters(parameters, {});
  showParameters();
}

void SelectionPanel::showParameters() {
  const GameRobot player = world_.playerOf(world_.selected());
  form_->setValues(player.controller ? player.controller->parameters : Values{});
}

void SelectionPanel::tune(const std::string& name, std::optional<double>) {
  if (world_.playerOf(world_.selected()).hasPlugin())
    world_.act(ParameterAct{world_.selected(), name, form_->value(name)});
}

void SelectionPanel::changeController() {
  if (controller_->currentData().toBool()) {
    const QString folder =
        QFileDialog::getExistingDirectory(this, tr("OPEN-R memory stick: the folder with OPEN-R in it"));
    return folder.isEmpty() ? showController() : putIn(folder);
  }
  ControllerAct act{world_.selected(), std::nullopt};
  if (controller_->currentIndex() > 0)
    act.controller = GameController{controller_->currentText().toStdString(), {}, {}, true};
  world_.act(act);
  showController();
}

void SelectionPanel::setDatabase(DatabaseReader* reader) {
  reader_ = reader;
  stored_->setVisible(reader);
}

void SelectionPanel::chooseStored() {
  if (!reader_ || !reader_->isOpen()) return emit problem(tr("No database is open."));
  auto* dialog = new IndividualDialog(*reader_, world_.host(), this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &IndividualDialog::chosen, this, [this, robot = world_.selected()](const GameController& controller) {
    if (world_.indexOf(robot) < 0) return;
    world_.act(ControllerAct{robot, controller});
    if (world_.selected() == robot) showController();
  });
  dialog->open();
}

void SelectionPanel::placeAsTyped() {
  if (!world_.selectedObject()) return;
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() << x_->value(), y_->value(), z_->value();
  pose.rotate(Eigen::AngleAxisd(heading_->value() * degree, Eigen::Vector3d::UnitZ()));
  world_.act(placeAct(world_.selected(), pose));
}

void SelectionPanel::throwSelected() {
  if (!world_.selectedObject()) return;
  const double rise = rise_->value() * degree, direction = direction_->value() * degree, speed = speed_->value();
  world_.act(ThrowAct{world_.selected(),
                      {speed * std::cos(rise) * std::cos(direction), speed * std::cos(rise) * std::sin(direction),
                       speed * std::sin(rise)},
                      {0, 0, 0}});
}

}  // namespace btr::ui
