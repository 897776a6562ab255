// From a game to the world's numbers: every robot with its own simulator, in its starting posture, at its place.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/live/session.h"
#include "core/model/four_legs.h"
#include "core/sim/gait.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

using Eigen::Isometry3d;

bool isOf(const std::string& at, const std::string& robot) { return at.starts_with(robot + "."); }

/// One robot's numbers and effects as its own simulator makes them.
void simulateAlone(Scene& scene, std::size_t index, const SceneSpec& spec, const ModelSet& models,
                   const SimulatorSpec& simulator, const PluginHost& host) {
  SceneSpec alone = spec;
  alone.robots = {spec.robots[index]};
  alone.calibrate.clear();
  const std::string& name = spec.robots[index].name;
  // What it says of others is theirs.
  SimulatorSpec mine = simulator;
  std::erase_if(mine.values, [&](const auto& number) {
    return number.first.starts_with("robots.") && !number.first.starts_with("robots." + name + ".");
  });
  std::erase_if(mine.effects, [&](const PlacedEffect& effect) {
    return effect.at.find('.') != std::string::npos && !isOf(effect.at, name);
  });
  Scene own = makeScene(alone, models, mine, host.effectFactory());
  scene.robots[index] = std::move(own.robots.front());
  std::erase_if(scene.effects, [&](const SceneEffect& effect) { return isOf(effect.at, name); });
  for (SceneEffect& effect : own.effects)
    if (isOf(effect.at, name)) scene.effects.push_back(std::move(effect));
}

bool hasFourLegs(const RobotModel& model) {
  for (const char* leg : FourLegs::names)
    for (const char* joint : {"_J1", "_J2", "_J3"})
      if (model.findJoint(std::string(leg) + joint) < 0) return false;
  return true;
}

/// On its feet with these joints, the others at rest.
void takeStance(SceneRobot& robot, const Values& joints, const std::string& who) {
  std::vector<double> positions = restPositions(robot.model);
  for (const auto& [name, position] : joints) {
    const int j = robot.model.findJoint(name);
    if (j < 0) throw InputError(who + "/posture", "\"" + name + "\"", "joints of the robot");
    const Joint& joint = robot.model.joints[static_cast<std::size_t>(j)];
    if (!(position >= joint.lower && position <= joint.upper))
      throw InputError(who + "/posture/" + name, toText(position),
                       toText(joint.lower) + " to " + toText(joint.upper) + ", the joint's limits");
    positions[static_cast<std::size_t>(j)] = position;
  }
  standStill(robot, std::move(positions), who);
}

/// The posture at the place of the scene: x, y and heading from there, height and tilt from the posture.
void takePosture(SceneRobot& robot, const SceneRobot& arranged) {
  const Eigen::Matrix3d& r = robot.start.linear();
  const double heading = std::atan2(r(1, 0), r(0, 0));
  const Eigen::Vector3d place = robot.start.translation();
  Isometry3d posture = arranged.start;
  posture.translation().x() = posture.translation().y() = 0;
  robot.jointStart = arranged.jointStart;
  robot.jointStartRate = arranged.jointStartRate;
  robot.startVelocity_m_s = arranged.startVelocity_m_s;
  robot.startSpin_rad_s = arranged.startSpin_rad_s;
  robot.start =
      Eigen::Translation3d(place.x(), place.y(), 0) * Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()) * posture;
}

}  // namespace

Scene sceneOf(const Game& game, const ModelSet& models, const PluginHost& host) {
  for (const auto& player : game.robots)
    if (std::ranges::none_of(game.scene.robots, [&](const RobotSpec& robot) { return robot.name == player.first; }))
      throw InputError("robots", player.first, "a robot of the game's scene");
  Scene scene = makeScene(game.scene, models, game.simulator, host.effectFactory());
  for (std::size_t i = 0; i < scene.robots.size(); ++i) {
    const auto player = game.robots.find(game.scene.robots[i].name);
    const GameRobot plays = player == game.robots.end() ? GameRobot{} : player->second;
    try {
      if (plays.simulator) simulateAlone(scene, i, game.scene, models, *plays.simulator, host);
    } catch (const InputError& error) {
      throw InputError("robots " + game.scene.robots[i].name + "/simulator: " + error.what());
    }
    SceneRobot& robot = scene.robots[i];
    // What the scene has in motion is not put on its feet.
    if (!plays.posture || game.scene.robots[i].moves() || !robot.freeBase || !scene.floor) continue;
    const bool stands = !plays.hasPlugin() && !plays.stance.empty();
    if (!plays.hasPlugin() && !stands && (!game.scene.robots[i].jointStart.empty() || !hasFourLegs(robot.model)))
      continue;
    // A controller arranges the first robot of a scene.
    Scene posture = scene;
    std::swap(posture.robots.front(), posture.robots[i]);
    const std::string who = "robots " + robot.name;
    if (plays.hasPlugin())
      host.controller(plays.controller->plugin)->arrange(posture, plays.controller->settings);
    else if (stands)
      takeStance(posture.robots.front(), plays.stance, who);
    else
      arrangeStance(posture, who);
    takePosture(robot, posture.robots.front());
  }
  return scene;
}

}  // namespace btr
