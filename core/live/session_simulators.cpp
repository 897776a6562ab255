// Numbers and effects of a session's simulators, which its world is built anew with.
#include <algorithm>
#include <utility>

#include "core/live/session.h"
#include "core/spec/error.h"

namespace btr {

/// A robot's own simulator, which it gets if it has none yet; with "" that of all others.
SimulatorSpec& Session::simulatorOf(Game& game, const std::string& robot) const {
  if (robot.empty()) return game.simulator;
  robotOf(robot);
  GameRobot& player = game.robots[robot];
  if (!player.simulator) player.simulator = game.simulator;
  return *player.simulator;
}

void Session::change(const NumberAct& act) {
  Game game = game_;
  SimulatorSpec& simulator = simulatorOf(game, act.robot);
  if (act.value)
    simulator.values[act.name] = *act.value;
  else if (simulator.values.erase(act.name) == 0)
    throw InputError("name", "\"" + act.name + "\"", "a number that was changed");
  rebuild(std::move(game), world_->memory());
}

void Session::change(const EffectAct& act) {
  Game game = game_;
  SimulatorSpec& simulator = simulatorOf(game, act.robot);
  const auto same = [&](const PlacedEffect& each) {
    return each.effect == act.effect.effect && each.at == act.effect.at;
  };
  const auto found = std::ranges::find_if(simulator.effects, same);
  if (act.there) {
    if (found != simulator.effects.end())
      found->parameters = act.effect.parameters;
    else
      simulator.effects.push_back(act.effect);
  } else if (found == simulator.effects.end()) {
    throw InputError("effect", act.effect.text(), "an effect that is there");
  } else {
    simulator.effects.erase(found);
  }
  rebuild(std::move(game), world_->memory());
}

void Session::change(const SimulatorAct& act) {
  Game game = game_;
  if (act.robot.empty()) {
    game.simulator = act.simulator.value_or(SimulatorSpec{});
  } else {
    robotOf(act.robot);
    game.robots[act.robot].simulator = act.simulator;
  }
  rebuild(std::move(game), world_->memory());
}

}  // namespace btr
