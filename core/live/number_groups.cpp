#include "core/live/number_groups.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/sim/effect_places.h"
#include "core/sim/scene_parameters.h"
#include "core/sim/world/scene_build.h"

namespace btr {
namespace {

/// Mass of the first of a model's groups of that name; none if it has none.
std::optional<double> groupMass(const RobotModel& model, const std::string& group) {
  std::string first;
  double sum = 0;
  for (const Link& link : model.links) {
    if (!isOfGroup(link.massGroup, group)) continue;
    if (first.empty()) first = link.massGroup;
    if (link.massGroup == first) sum += link.inertial.mass_kg;
  }
  // A sum of a file's decimals is one of them again.
  constexpr double perKilogram = 1e9;
  return first.empty() ? std::nullopt : std::optional(std::round(sum * perKilogram) / perKilogram);
}

/// What scene and models say of one of simulatorParameters(); none where it means nothing.
std::optional<double> usualOf(const Scene& scene, const SceneRobot* robot, const std::string& name, bool shared) {
  if (shared) {
    if (name == "gravity_m_s2") return scene.gravity_m_s2.norm();
    if (name == "friction" && scene.floor) return scene.floor->friction;
    if (name == "slip1_m_s_n" && scene.floor) return scene.floor->slip1_m_s_n;
    if (name == "slip2_m_s_n" && scene.floor) return scene.floor->slip2_m_s_n;
  }
  if (!robot) return std::nullopt;
  for (const char* group : {"head", "neck", "body", "leg"})
    if (name == std::string(group) + "_mass_kg") return groupMass(robot->model, group);
  const int reference = referenceJoint(robot->model);
  if (reference < 0) return std::nullopt;
  const Drive* drive = &robot->drives[static_cast<std::size_t>(reference)];
  if (name == "servo_p_nm_rad") return drive->p;
  if (name == "servo_i_nm_rad_s") return drive->i;
  if (name == "servo_d_nm_s_rad") return drive->d;
  if (name == "servo_max_torque_nm") return drive->maxTorque;
  return std::nullopt;
}

NumberGroup wholeGroup(const Scene& scene, const SceneRobot* robot, bool shared) {
  NumberGroup group{shared ? NumberGroup::Of::world : NumberGroup::Of::robot, "", {}, {}, {}};
  for (const Parameter& parameter : simulatorParameters()) {
    const auto usual = usualOf(scene, robot, parameter.name, shared);
    if (!usual) continue;
    group.parameters.push_back(parameter);
    group.key[parameter.name] = parameter.name;
    group.usual[parameter.name] = *usual;
  }
  return group;
}

NumberGroup jointGroup(SceneRobot& robot, std::size_t joint) {
  const std::string& name = robot.model.joints[joint].name;
  NumberGroup group{NumberGroup::Of::joint, name, {}, {}, {}};
  const auto take = [&](const std::vector<Parameter>& declared, const std::string& kind) {
    for (const Parameter& parameter : declared) {
      const double* number = driveNumber(robot.drives[joint], robot.model.joints[joint], parameter.name);
      if (!number) continue;
      group.parameters.push_back(parameter);
      group.key[parameter.name] = "robots." + robot.name + "." + kind + "." + name + "." + parameter.name;
      group.usual[parameter.name] = *number;
    }
  };
  take(btr::servoNumbers(), "servos");
  take(btr::jointNumbers(), "joints");
  return group;
}

NumberGroup linkGroup(const SceneRobot& robot, const Link& link) {
  NumberGroup group{NumberGroup::Of::link, link.name, btr::linkNumbers(), {}, {}};
  for (const Parameter& parameter : group.parameters) {
    group.key[parameter.name] = "robots." + robot.name + ".links." + link.name + "." + parameter.name;
    double& usual = group.usual[parameter.name];
    if (parameter.name == "mass_kg")
      usual = link.inertial.mass_kg;
    else if (parameter.name.starts_with("com_"))
      usual = link.inertial.centreOfMass_m[parameter.name[4] - 'x'];
    else
      usual = link.inertial.inertia_kg_m2(parameter.name[8] - 'x', parameter.name[8] - 'x');
  }
  return group;
}

}  // namespace

std::vector<NumberGroup> numberGroups(const Game& game, const ModelSet& models, const std::string& robot) {
  Scene scene = sceneFromModels(game.scene, models);
  const auto found = std::ranges::find(scene.robots, robot, &SceneRobot::name);
  if (robot.empty()) return {wholeGroup(scene, scene.robots.empty() ? nullptr : &scene.robots.front(), true)};
  if (found == scene.robots.end()) return {};
  std::vector<NumberGroup> groups{wholeGroup(scene, &*found, false)};
  if (groups.front().parameters.empty()) groups.clear();
  for (std::size_t joint = 0; joint < found->model.joints.size(); ++joint)
    if (found->model.joints[joint].type != Joint::Type::fixed) groups.push_back(jointGroup(*found, joint));
  for (const Link& link : found->model.links)
    if (link.inertial.mass_kg > 0) groups.push_back(linkGroup(*found, link));
  return groups;
}

std::vector<std::string> placesFor(const Effect& effect, const Game& game, const ModelSet& models,
                                   const std::string& robot) {
  const bool isOfRobots = effect.place() == Effect::Place::joint || effect.place() == Effect::Place::link;
  if (!robot.empty() && !isOfRobots) return {};
  const Scene scene = sceneFromModels(game.scene, models);
  const std::span<const SceneRobot> all = scene.robots;
  if (robot.empty()) return effectPlaces(effect.place(), scene, all);
  const auto found = std::ranges::find(all, robot, &SceneRobot::name);
  return found == all.end() ? std::vector<std::string>{} : effectPlaces(effect, scene, {found, 1});
}

const SimulatorSpec& simulatorIn(const Game& game, const std::string& robot) {
  const auto player = game.robots.find(robot);
  return player != game.robots.end() && player->second.simulator ? *player->second.simulator : game.simulator;
}

}  // namespace btr
