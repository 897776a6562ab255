// What robots' own programs order. They run elsewhere; a session knows what they ordered, and when.
#include "core/live/orders.h"
#include "core/live/session.h"
#include "core/spec/error.h"

namespace btr {

/// Of each robot that no plugin moves: what it was ordered before, or what holds when its stick's program starts.
std::map<std::string, Orders> Session::ordersOf(const Game& game, const std::map<std::string, Orders>& before) const {
  std::map<std::string, Orders> all;
  for (const RobotSpec& robot : game.scene.robots) {
    const auto player = game.robots.find(robot.name);
    const auto was = before.find(robot.name);
    if (was != before.end() && (player == game.robots.end() || !player->second.controller)) all.insert(*was);
  }
  for (const auto& [name, player] : game.robots) {
    if (!player.hasStick()) continue;
    if (const auto was = before.find(name); was != before.end())
      all[name] = was->second;
    else
      all[name].motorPower = player.controller->openr->motorPower;
  }
  return all;
}

void applyOrders(const Orders& orders, const RobotModel& model, std::span<JointInput> inputs) {
  const bool power = orders.motorPower.value_or(false);
  for (std::size_t j = 0; j < inputs.size(); ++j) {
    const std::string& joint = model.joints[j].name;
    const auto on = orders.enabled.find(joint);
    inputs[j].enabled = power && on != orders.enabled.end() && on->second;
    const auto gain = orders.gains.find(joint);
    std::array<double, 3> times{1, 1, 1};
    if (gain != orders.gains.end()) times = gain->second;
    inputs[j].pTimes = times[0];
    inputs[j].iTimes = times[1];
    inputs[j].dTimes = times[2];
  }
}

/// A joint that a hand holds is not limp.
void Session::obey(std::size_t robot) {
  const auto orders = orders_.find(scene_.robots[robot].name);
  if (orders == orders_.end()) return;
  applyOrders(orders->second, scene_.robots[robot].model, inputs_[robot]);
  if (const auto held = held_.find(orders->first); held != held_.end())
    for (const auto& joint : held->second) inputs_[robot][jointOf(robot, joint.first)].enabled = true;
}

void Session::change(const OrdersAct& act) {
  const std::size_t robot = robotOf(act.robot);
  if (players_.contains(act.robot)) throw InputError("robot", act.robot, "a robot that no controller plugin moves");
  std::map<std::size_t, double> targets;
  for (const auto& [joint, target] : act.targets) targets[jointOf(robot, joint)] = target;
  for (const auto& gain : act.orders.gains) jointOf(robot, gain.first);
  for (const auto& on : act.orders.enabled) jointOf(robot, on.first);
  for (const auto& [joint, target] : targets) inputs_[robot][joint].command = target;
  if (act.orders.empty()) return;
  // Without a stick its motors are on until a program says otherwise.
  if (!orders_.contains(act.robot)) {
    Orders& all = orders_[act.robot];
    all.motorPower = true;
    for (const Joint& joint : scene_.robots[robot].model.joints) all.enabled[joint.name] = true;
  }
  orders_[act.robot].add(act.orders);
}

}  // namespace btr
