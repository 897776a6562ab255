#include "ui/live/panels/simulator_panel.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "core/plugin/plugin_host.h"
#include "core/spec/error.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/live/live_world.h"
#include "ui/live/panels/slider_form.h"

namespace btr::ui {
namespace {

constexpr int soon_ms = 120;

QString titleOf(const NumberGroup& group) {
  const QString item = word(group.item);
  switch (group.of) {
    case NumberGroup::Of::world:
      return SimulatorPanel::tr("floor, gravity and all robots");
    case NumberGroup::Of::robot:
      return SimulatorPanel::tr("whole robot");
    case NumberGroup::Of::joint:
      return SimulatorPanel::tr("joint %1").arg(item);
    case NumberGroup::Of::link:
      return SimulatorPanel::tr("link %1").arg(item);
  }
  return item;
}

QComboBox* comboOf(const QString& object, const QString& name, const QString& tip, QWidget* parent) {
  auto* box = new QComboBox(parent);
  box->setObjectName(object);
  box->setAccessibleName(name);
  box->setToolTip(tip);
  box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  box->setMinimumContentsLength(12);
  return box;
}

QScrollArea* scrolled(QWidget* content, QWidget* parent) {
  auto* area = new QScrollArea(parent);
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setWidget(content);
  return area;
}

}  // namespace

SimulatorPanel::SimulatorPanel(LiveWorld& world, QWidget* parent) : QWidget(parent), world_(world) {
  whose_ =
      comboOf("liveWhose", tr("Whose simulator"), tr("A robot's own numbers, or those of all that have none"), this);
  connect(whose_, &QComboBox::activated, this, &SimulatorPanel::showWhose);
  auto* split = new QSplitter(Qt::Vertical, this);
  split->addWidget(makeNumbers());
  split->addWidget(makeEffects());
  split->setChildrenCollapsible(false);
  split->setStretchFactor(0, 3);
  split->setStretchFactor(1, 2);
  split->setSizes({360, 240});
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 4, 0, 0);
  column->addWidget(whose_);
  column->addWidget(split, 1);
  soon_.setSingleShot(true);
  soon_.setInterval(soon_ms);
  connect(&soon_, &QTimer::timeout, this, &SimulatorPanel::doLater);
}

QWidget* SimulatorPanel::makeNumbers() {
  auto* part = new QWidget(this);
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  group_ = comboOf("liveNumberGroup", tr("Numbers of"), tr("The numbers of a joint, a link, or the whole"), part);
  connect(group_, &QComboBox::activated, this, &SimulatorPanel::showGroup);
  numbers_ = new SliderForm(part);
  numbers_->setObjectName("liveNumbers");
  connect(numbers_, &SliderForm::edited, this, &SimulatorPanel::changeNumber);
  connectDrags(*numbers_);
  differences_ = new QLabel(part);
  differences_->setObjectName("liveDifferences");
  differences_->setWordWrap(true);
  reset_ = new QPushButton(themeIcon("edit-undo"), tr("As the &scene says"), part);
  reset_->setObjectName("liveResetNumbers");
  reset_->setToolTip(tr("Takes all changed numbers back"));
  connect(reset_, &QPushButton::clicked, this, &SimulatorPanel::resetAll);
  column->addWidget(group_);
  column->addWidget(scrolled(numbers_, part), 1);
  column->addWidget(differences_);
  column->addWidget(reset_);
  return part;
}

QWidget* SimulatorPanel::makeEffects() {
  auto* part = new QWidget(this);
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  effect_ = comboOf("liveEffect", tr("Effect"), tr("What the simulator shall have besides"), part);
  for (const std::string& name : world_.host().effects()) effect_->addItem(word(name));
  connect(effect_, &QComboBox::currentIndexChanged, this, &SimulatorPanel::showPlaces);
  place_ = comboOf("liveEffectPlace", tr("Place of the effect"), tr("Where it acts"), part);
  add_ = new QPushButton(themeIcon("list-add"), tr("Add &effect"), part);
  add_->setObjectName("liveAddEffect");
  connect(add_, &QPushButton::clicked, this, &SimulatorPanel::addEffect);
  effects_ = new QListWidget(part);
  effects_->setObjectName("liveEffects");
  effects_->setAccessibleName(tr("Effects"));
  effects_->setMinimumHeight(40);
  effects_->setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
  connect(effects_, &QListWidget::currentRowChanged, this, &SimulatorPanel::showEffect);
  remove_ = new QPushButton(themeIcon("list-remove"), tr("Ta&ke effect away"), part);
  remove_->setObjectName("liveRemoveEffect");
  connect(remove_, &QPushButton::clicked, this, &SimulatorPanel::removeEffect);
  parameters_ = new SliderForm(part);
  parameters_->setObjectName("liveEffectParameters");
  connect(parameters_, &SliderForm::edited, this, &SimulatorPanel::changeEffect);
  connectDrags(*parameters_);
  auto* form = new QFormLayout;
  form->addRow(tr("Effect"), effect_);
  form->addRow(tr("at"), place_);
  column->addLayout(form);
  column->addWidget(add_);
  column->addWidget(effects_, 1);
  column->addWidget(scrolled(parameters_, part), 2);
  column->addWidget(remove_);
  return part;
}

void SimulatorPanel::connectDrags(SliderForm& form) {
  connect(&form, &SliderForm::dragBegan, &world_.process(), &LiveProcess::beginGesture);
  connect(&form, &SliderForm::dragEnded, this, [this] {
    doLater();
    world_.process().endGesture();
  });
}

void SimulatorPanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  if (!stale_) return;
  showObjects();
  showSelected();
}

std::string SimulatorPanel::whose() const { return whose_->currentData().toString().toStdString(); }

void SimulatorPanel::showObjects() {
  stale_ = !isVisible();
  if (stale_) return;
  const std::string before = whose();
  {
    const QSignalBlocker quiet(whose_);
    whose_->clear();
    whose_->addItem(tr("All robots"), QString());
    for (const RobotSpec& robot : world_.game().scene.robots) whose_->addItem(word(robot.name), word(robot.name));
    whose_->setCurrentIndex(std::max(0, whose_->findData(word(before))));
  }
  showWhose();
}

void SimulatorPanel::showSelected() {
  const int index = whose_->findData(word(world_.selected()));
  if (index <= 0 || index == whose_->currentIndex()) return;
  whose_->setCurrentIndex(index);
  showWhose();
}

void SimulatorPanel::showWhose() {
  doLater();
  const QString before = group_->currentText();
  groups_ = numberGroups(world_.game(), world_.models(), whose());
  {
    const QSignalBlocker quiet(group_);
    group_->clear();
    for (const NumberGroup& group : groups_) group_->addItem(titleOf(group));
    group_->setCurrentIndex(std::max(0, group_->findText(before)));
  }
  showGroup();
  showPlaces();
}

void SimulatorPanel::showGroup() {
  doLater();
  const int index = group_->currentIndex();
  if (index >= 0 && std::size_t(index) < groups_.size())
    numbers_->setParameters(groups_[std::size_t(index)].parameters, groups_[std::size_t(index)].usual);
  else
    numbers_->setParameters({}, {});
  showValues();
}

void SimulatorPanel::showValues() {
  if (stale_) return;
  const SimulatorSpec& simulator = simulatorIn(world_.game(), whose());
  const int index = group_->currentIndex();
  Values values;
  if (index >= 0 && std::size_t(index) < groups_.size())
    for (const auto& [name, key] : groups_[std::size_t(index)].key)
      if (const auto found = simulator.values.find(key); found != simulator.values.end()) values[name] = found->second;
  numbers_->setValues(values);
  showDifferences();
  showEffects();
}

void SimulatorPanel::showDifferences() {
  const SimulatorSpec& simulator = simulatorIn(world_.game(), whose());
  QStringList names;
  for (const auto& [key, value] : simulator.values) names << QString("%1 = %2").arg(word(key), shortNumber(value));
  differences_->setText(names.isEmpty() ? tr("All numbers are the scene's.")
                                        : tr("Not the scene's: %1").arg(names.join(", ")));
  reset_->setEnabled(!names.isEmpty());
}

void SimulatorPanel::changeNumber(const std::string& name, std::optional<double> value) {
  const auto& key = groups_[std::size_t(group_->currentIndex())].key.at(name);
  if (!value && !simulatorIn(world_.game(), whose()).values.contains(key)) {
    later_.erase(key);
    return;
  }
  later(key, NumberAct{whose(), key, value});
}

void SimulatorPanel::resetAll() {
  doLater();
  world_.process().beginGesture();
  const Values changed = simulatorIn(world_.game(), whose()).values;
  for (const auto& number : changed) world_.act(NumberAct{whose(), number.first, std::nullopt});
  world_.process().endGesture();
  showValues();
}

const PlacedEffect* SimulatorPanel::shownEffect() const {
  const auto& effects = simulatorIn(world_.game(), whose()).effects;
  const int index = effects_->currentRow();
  return index >= 0 && std::size_t(index) < effects.size() ? &effects[std::size_t(index)] : nullptr;
}

void SimulatorPanel::showEffects() {
  const int before = effects_->currentRow();
  {
    const QSignalBlocker quiet(effects_);
    effects_->clear();
    for (const PlacedEffect& effect : simulatorIn(world_.game(), whose()).effects)
      effects_->addItem(word(effect.text()));
    effects_->setCurrentRow(std::min(std::max(0, before), effects_->count() - 1));
  }
  showEffect();
}

void SimulatorPanel::showEffect() {
  const PlacedEffect* effect = shownEffect();
  remove_->setEnabled(effect);
  if (!effect) return parameters_->setParameters({}, {});
  parameters_->setParameters(world_.host().effect(effect->effect)->parameters(), {});
  parameters_->setValues(effect->parameters);
}

void SimulatorPanel::showPlaces() {
  place_->clear();
  if (effect_->currentIndex() < 0) return;
  const auto effect = world_.host().effect(effect_->currentText().toStdString());
  for (const std::string& place : placesFor(*effect, world_.game(), world_.models(), whose()))
    place_->addItem(word(place));
  add_->setEnabled(place_->count() > 0);
}

void SimulatorPanel::addEffect() {
  if (place_->currentIndex() < 0) return;
  EffectAct act{whose(), {effect_->currentText().toStdString(), place_->currentText().toStdString(), {}}, true};
  for (const Parameter& parameter : world_.host().effect(act.effect.effect)->parameters())
    act.effect.parameters[parameter.name] = parameter.byDefault;
  world_.act(act);
  showEffects();
  effects_->setCurrentRow(effects_->count() - 1);
}

void SimulatorPanel::changeEffect(const std::string&, std::optional<double>) {
  const PlacedEffect* effect = shownEffect();
  if (!effect) return;
  EffectAct act{whose(), *effect, true};
  for (const Parameter& parameter : world_.host().effect(effect->effect)->parameters())
    act.effect.parameters[parameter.name] = parameters_->value(parameter.name);
  later(effect->text(), act);
}

void SimulatorPanel::removeEffect() {
  doLater();
  if (const PlacedEffect* effect = shownEffect()) world_.act(EffectAct{whose(), *effect, false});
  showEffects();
}

void SimulatorPanel::later(const std::string& key, const Act& act) {
  later_.insert_or_assign(key, act);
  if (!soon_.isActive()) soon_.start();
}

void SimulatorPanel::doLater() {
  soon_.stop();
  const auto acts = std::exchange(later_, {});
  for (const auto& each : acts) world_.act(each.second);
  if (!acts.empty()) showDifferences();
}

}  // namespace btr::ui
