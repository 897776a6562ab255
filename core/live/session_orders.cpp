// What robots' own programs order. They run elsewhere; a session knows what they ordered, and when.
#include "core/live/session.h"
#include "core/spec/error.h"

namespace btr {

/// Of each robot that is moved by a stick: what it was ordered before, or what holds when its program starts.
std::map<std::string, Orders> Session::ordersOf(const Game& game, const std::map<std::string, Orders>& before) const {
  std::map<std::string, Orders> all;
  for (const auto& [name, player] : game.robots) {
    if (!player.hasStick()) continue;
    if (const auto was = before.find(name); was != before.end())
      all[name] = was->second;
    else
      all[name].motorPower = player.controller->openr->motorPower;
  }
  return all;
}

/// A joint that was never enabled is limp; one that a hand holds is not.
void Session::obey(std::size_t robot) {
  const auto found = orders_.find(scene_.robots[robot].name);
  if (found == orders_.end()) return;
  const Orders& orders = found->second;
  const bool power = orders.motorPower.value_or(false);
  const auto held = held_.find(found->first);
  for (std::size_t j = 0; j < inputs_[robot].size(); ++j) {
    const std::string& joint = scene_.robots[robot].model.joints[j].name;
    JointInput& input = inputs_[robot][j];
    const auto on = orders.enabled.find(joint);
    input.enabled =
        (power && on != orders.enabled.end() && on->second) || (held != held_.end() && held->second.contains(joint));
    const auto gain = orders.gains.find(joint);
    std::array<double, 3> times{1, 1, 1};
    if (gain != orders.gains.end()) times = gain->second;
    input.pTimes = times[0];
    input.iTimes = times[1];
    input.dTimes = times[2];
  }
}

void Session::change(const OrdersAct& act) {
  const std::size_t robot = robotOf(act.robot);
  if (!orders_.contains(act.robot)) throw InputError("robot", act.robot, "a robot whose controller is an OPEN-R stick");
  std::map<std::size_t, double> targets;
  for (const auto& [joint, target] : act.targets) targets[jointOf(robot, joint)] = target;
  for (const auto& gain : act.orders.gains) jointOf(robot, gain.first);
  for (const auto& on : act.orders.enabled) jointOf(robot, on.first);
  for (const auto& [joint, target] : targets) inputs_[robot][joint].command = target;
  orders_[act.robot].add(act.orders);
}

}  // namespace btr
