#include "ui/live/live_world.h"

#include <algorithm>
#include <utility>

namespace btr::ui {
namespace {

SimulatorSpec& simulatorFor(Game& game, const std::string& robot) {
  if (robot.empty()) return game.simulator;
  GameRobot& player = game.robots[robot];
  if (!player.simulator) player.simulator = game.simulator;
  return *player.simulator;
}

struct Changer {
  Game& game;

  void operator()(const ParameterAct& act) const {
    auto& controller = game.robots[act.robot].controller;
    if (!controller) return;
    if (act.value)
      controller->parameters[act.name] = *act.value;
    else
      controller->parameters.erase(act.name);
  }
  void operator()(const ControllerAct& act) const { game.robots[act.robot].controller = act.controller; }
  void operator()(const NumberAct& act) const {
    SimulatorSpec& simulator = simulatorFor(game, act.robot);
    if (act.value)
      simulator.values[act.name] = *act.value;
    else
      simulator.values.erase(act.name);
  }
  void operator()(const EffectAct& act) const {
    SimulatorSpec& simulator = simulatorFor(game, act.robot);
    const auto found = std::ranges::find_if(simulator.effects, [&](const PlacedEffect& each) {
      return each.effect == act.effect.effect && each.at == act.effect.at;
    });
    if (found == simulator.effects.end()) {
      if (act.there) simulator.effects.push_back(act.effect);
    } else if (act.there) {
      found->parameters = act.effect.parameters;
    } else {
      simulator.effects.erase(found);
    }
  }
  template <class Other>
  void operator()(const Other&) const {}
};

}  // namespace

void changePlayers(Game& game, const Act& act) { std::visit(Changer{game}, act); }

LiveWorld::LiveWorld(const PluginHost& host, LiveProcess& process, QObject* parent)
    : QObject(parent), host_(host), process_(process) {
  connect(&process_, &LiveProcess::gameTold, this, &LiveWorld::takeGame);
  connect(&process_, &LiveProcess::rowTold, this, &LiveWorld::takeRow);
}

void LiveWorld::forget() {
  row_ = {};
  later_.clear();
  held_.clear();
  pulls_.clear();
  emit forgotten();
  emit handsChanged();
}

void LiveWorld::act(const Act& act) {
  if (!hands_ || process_.hasFailed()) return emit handsRefused();
  process_.act(act);
  changePlayers(game_, act);
  takeHands(act);
  emit acted(act);
}

void LiveWorld::takeHands(const Act& act) {
  if (const auto* hold = std::get_if<HoldAct>(&act)) {
    if (hold->position)
      held_[hold->robot][hold->joint] = *hold->position;
    else
      held_[hold->robot].erase(hold->joint);
  }
  if (const auto* pull = std::get_if<PullAct>(&act)) pulls_[pull->object] = *pull;
  if (const auto* let = std::get_if<LetGoAct>(&act)) pulls_.erase(let->object);
  if (const auto* removed = std::get_if<RemoveAct>(&act)) {
    pulls_.erase(removed->object);
    held_.erase(removed->object);
  }
  emit handsChanged();
}

Values LiveWorld::held(const std::string& robot) const {
  const auto found = held_.find(robot);
  return found == held_.end() ? Values{} : found->second;
}

void LiveWorld::pullTo(const std::string& object, const Eigen::Vector3d& target_m) {
  PullAct pull;
  pull.object = object;
  pull.target_m = {target_m.x(), target_m.y(), target_m.z()};
  act(pull);
}

void LiveWorld::takeGame(const Game& game, const ModelSet& models, const std::vector<std::string>& channels) {
  const bool same = !row_.values.empty() && channels == channels_ && game.scene == game_.scene;
  game_ = game;
  models_ = models;
  // After undo, in a game that was saved with them, or where a replay was gone on from: not what was done here.
  if (const auto& grips = process_.grips()) {
    held_ = grips->held;
    pulls_ = grips->pulls;
    emit handsChanged();
  }
  if (same) return emit gameChanged();
  channels_ = channels;
  scene_ = LiveScene(game, models, channels);
  row_ = {};
  emit objectsChanged();
  std::vector<std::string> came = later_;
  std::erase_if(came, [this](const std::string& name) { return indexOf(name) < 0; });
  if (came.size() == later_.size()) later_.clear();
  select(came.empty() ? selection_ : came);
}

void LiveWorld::takeRow(const LiveRow& row) {
  const bool first = row_.values.empty();
  row_ = row;
  emit rowChanged();
  if (first) emit firstRow();
}

int LiveWorld::indexOf(const std::string& object) const {
  for (std::size_t i = 0; i < objects().size(); ++i)
    if (objects()[i].name == object) return static_cast<int>(i);
  return -1;
}

Eigen::Isometry3d LiveWorld::poseOf(const std::string& object) const {
  const int index = indexOf(object);
  return index < 0 ? Eigen::Isometry3d::Identity() : scene_.poseOf(static_cast<std::size_t>(index), row_);
}

std::string LiveWorld::freeName(const std::string& word) const {
  std::string name = word;
  for (int number = 2; indexOf(name) >= 0 || std::ranges::find(later_, name) != later_.end(); ++number)
    name = word + std::to_string(number);
  return name;
}

GameRobot LiveWorld::playerOf(const std::string& robot) const {
  const auto player = game_.robots.find(robot);
  return player == game_.robots.end() ? GameRobot{} : player->second;
}

void LiveWorld::select(std::vector<std::string> objects) {
  std::erase_if(objects, [this](const std::string& name) { return indexOf(name) < 0; });
  selection_ = std::move(objects);
  emit selectionChanged();
}

void LiveWorld::selectLater(std::vector<std::string> objects) { later_ = std::move(objects); }

const LiveObject* LiveWorld::selectedObject() const {
  const int index = indexOf(selected());
  return index < 0 ? nullptr : &objects()[static_cast<std::size_t>(index)];
}

}  // namespace btr::ui
