// What the robots of a session sense.
#include <algorithm>

#include "core/live/session.h"

namespace btr {

/// Those of the game, and those that the robot's controller needs beside them.
std::vector<SenseSpec> Session::sensesOf(const Game& game, const std::string& robot) const {
  const auto player = game.robots.find(robot);
  if (player == game.robots.end()) return {};
  std::vector<SenseSpec> all = player->second.senses;
  if (!player->second.hasPlugin()) return all;
  for (const SenseSpec& wanted : host_.controller(player->second.controller->plugin)->senses())
    if (std::ranges::none_of(all, [&](const SenseSpec& has) { return has.sense == wanted.sense; }))
      all.push_back(wanted);
  return all;
}

std::vector<Session::Sensing> Session::sensingOf(const Game& game, const Scene& scene) const {
  std::vector<Sensing> all;
  for (std::size_t i = 0; i < scene.robots.size(); ++i) {
    const std::string& name = scene.robots[i].name;
    const std::vector<SenseSpec> senses = sensesOf(game, name);
    if (!senses.empty()) all.push_back({i, Senses(senses, scene.robots[i], game.seed, "robots " + name + "/senses")});
  }
  return all;
}

void Session::takeSenses(std::vector<Sensing> sensing) {
  for (Sensing& now : sensing)
    for (const Sensing& was : sensing_)
      if (was.senses.channels() == now.senses.channels() && !was.senses.memory().empty())
        now.senses.remember(was.senses.memory(), "senses");
  sensing_ = std::move(sensing);
}

void Session::sense(bool onlyNew) {
  for (Sensing& each : sensing_) {
    if (onlyNew && !each.senses.memory().empty()) continue;
    const SceneRobot& robot = scene_.robots[each.robot];
    std::vector<Touch> touches;
    if (const auto pull = pulls_.find(robot.name); pull != pulls_.end()) {
      const auto& p = pull->second.point_m;
      const std::string& link = pull->second.link;
      touches.push_back({link.empty() ? 0 : robot.model.findLink(link), {p[0], p[1], p[2]}});
    }
    each.senses.sense(*world_, each.robot, touches, periods_, scene_.controlPeriod_s);
  }
}

std::vector<std::string> Session::channels() const {
  std::vector<std::string> names = world_->channels();
  for (const Sensing& each : sensing_)
    names.insert(names.end(), each.senses.channels().begin(), each.senses.channels().end());
  return names;
}

void Session::sample(std::vector<double>& row) const {
  world_->sample(row);
  for (const Sensing& each : sensing_) each.senses.sample(row);
}

}  // namespace btr
