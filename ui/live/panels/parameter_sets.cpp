#include "ui/live/panels/parameter_sets.h"

#include <QFileDialog>
#include <QGridLayout>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>
#include <nlohmann/json.hpp>

#include "core/plugin/plugin_host.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "ui/common/look/theme.h"
#include "ui/common/numbers/format.h"
#include "ui/live/hand_acts.h"
#include "ui/live/live_world.h"

namespace btr::ui {
namespace {
QString letterOf(int set) { return set == 0 ? "A" : "B"; }
}  // namespace

ParameterSets::ParameterSets(LiveWorld& world, QWidget* parent) : QWidget(parent), world_(world) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  for (const int set : {0, 1}) {
    const QString letter = letterOf(set);
    use_[std::size_t(set)] = new QPushButton(letter, this);
    use_[std::size_t(set)]->setObjectName("liveUse" + letter);
    use_[std::size_t(set)]->setCheckable(true);
    use_[std::size_t(set)]->setAccessibleName(tr("Play with set %1").arg(letter));
    use_[std::size_t(set)]->setToolTip(tr("Plays with set %1 (X: the other one)").arg(letter));
    connect(use_[std::size_t(set)], &QPushButton::clicked, this, [this, set] { use(set); });
    auto* more = new QToolButton(this);
    more->setObjectName("liveStore" + letter);
    more->setIcon(themeIcon("document-save"));
    more->setAccessibleName(tr("Store as set %1").arg(letter));
    more->setToolTip(tr("Stores the parameters as they are now as set %1").arg(letter));
    more->setFocusPolicy(Qt::StrongFocus);
    more->setPopupMode(QToolButton::MenuButtonPopup);
    auto* menu = new QMenu(more);
    connect(menu->addAction(tr("Save set %1…").arg(letter)), &QAction::triggered, this,
            [this, set] { saveWithDialog(set); });
    connect(menu->addAction(tr("Load set %1…").arg(letter)), &QAction::triggered, this,
            [this, set] { loadWithDialog(set); });
    more->setMenu(menu);
    connect(more, &QToolButton::clicked, this, [this, set] { store(set); });
    row->addWidget(use_[std::size_t(set)], 1);
    row->addWidget(more);
  }
  connect(&world_, &LiveWorld::forgotten, this, [this] { sets_.clear(); });
  connect(&world_, &LiveWorld::acted, this, [this](const Act& act) {
    // Another controller has other parameters; a parameter that is changed by hand is in neither set.
    if (const auto* other = std::get_if<ControllerAct>(&act)) sets_.erase(other->robot);
    if (const auto* tuned = std::get_if<ParameterAct>(&act)) sets_[tuned->robot].inUse = -1;
    showState();
  });
}

ParameterSets::Sets& ParameterSets::mine() { return sets_[robot_]; }

void ParameterSets::showRobot(const std::string& robot) {
  robot_ = robot;
  showState();
}

void ParameterSets::showState() {
  for (const int set : {0, 1}) {
    use_[std::size_t(set)]->setEnabled(mine().values[std::size_t(set)].has_value());
    use_[std::size_t(set)]->setChecked(mine().inUse == set);
  }
}

void ParameterSets::store(int set) {
  const GameRobot player = world_.playerOf(robot_);
  if (!player.hasPlugin()) return;
  mine().plugin = player.controller->plugin;
  mine().values[std::size_t(set)] = player.controller->parameters;
  mine().inUse = set;
  showState();
}

void ParameterSets::use(int set) {
  const GameRobot player = world_.playerOf(robot_);
  const std::optional<Values> wanted = mine().values[std::size_t(set)];
  if (!player.hasPlugin() || !wanted) return;
  world_.process().beginGesture();
  for (const ParameterAct& act : differences(robot_, world_.host().controller(player.controller->plugin)->genotype(),
                                             player.controller->parameters, *wanted))
    world_.act(act);
  world_.process().endGesture();
  mine().inUse = set;
  showState();
  emit used(tr("%1: %2").arg(word(robot_), letterOf(set)));
}

void ParameterSets::change() { use(mine().inUse == 0 ? 1 : 0); }

void ParameterSets::save(int set, const QString& path) const {
  const auto found = sets_.find(robot_);
  if (found == sets_.end() || !found->second.values[std::size_t(set)])
    throw InputError(path.toStdString(), "set " + letterOf(set).toStdString() + " is empty", "a set that was stored");
  const auto parameters = world_.host().controller(found->second.plugin)->genotype();
  // Complete: a default may change later.
  Values all;
  for (const Parameter& parameter : parameters)
    all[parameter.name] = valueOf(parameters, *found->second.values[std::size_t(set)], parameter.name);
  const nlohmann::json document{{"format", "uchilsim-parameters-1"},
                                {"plugin", found->second.plugin},
                                {"parameters", btr::toJson(all, parameters)}};
  writeFile(path.toStdString(), document.dump(2) + "\n");
}

void ParameterSets::load(int set, const QString& path) {
  const GameRobot player = world_.playerOf(robot_);
  if (!player.hasPlugin()) return;
  JsonReader reader = JsonReader::open(path.toStdString());
  reader.word("format", {"uchilsim-parameters-1"});
  reader.word("plugin", {player.controller->plugin});
  const Values values = reader.values("parameters", world_.host().controller(player.controller->plugin)->genotype());
  reader.finish();
  mine().plugin = player.controller->plugin;
  mine().values[std::size_t(set)] = values;
  if (mine().inUse == set) mine().inUse = -1;
  showState();
}

void ParameterSets::saveWithDialog(int set) {
  QString file = QFileDialog::getSaveFileName(this, tr("Save set %1").arg(letterOf(set)), "parameters.json",
                                              tr("Parameters (*.json)"));
  if (file.isEmpty()) return;
  if (!file.endsWith(".json")) file += ".json";
  try {
    save(set, file);
  } catch (const InputError& error) {
    emit problem(QString::fromUtf8(error.what()));
  }
}

void ParameterSets::loadWithDialog(int set) {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Load set %1").arg(letterOf(set)), {}, tr("Parameters (*.json)"));
  if (file.isEmpty()) return;
  try {
    load(set, file);
  } catch (const InputError& error) {
    emit problem(QString::fromUtf8(error.what()));
  }
}

}  // namespace btr::ui
