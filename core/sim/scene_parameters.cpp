#include "core/sim/scene_parameters.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/spec/simulator_spec.h"

namespace btr {
namespace {

constexpr std::array groups{"head", "neck", "body", "leg"};

/// The group whose mass a parameter is; none for another parameter.
std::optional<std::string> groupOf(const std::string& parameter) {
  for (const std::string group : groups)
    if (parameter == group + "_mass_kg") return group;
  return std::nullopt;
}

bool isOfFloor(const std::string& parameter) {
  return parameter == "friction" || parameter == "slip1_m_s_n" || parameter == "slip2_m_s_n";
}

bool hasGroup(const RobotModel& model, const std::string& group) {
  return std::ranges::any_of(model.links, [&](const Link& link) { return isOfGroup(link.massGroup, group); });
}

bool isIn(const SceneSpec& scene, const ModelSet& models, const std::string& parameter) {
  if (parameter == "gravity_m_s2") return true;
  if (isOfFloor(parameter)) return scene.floor.has_value();
  const auto group = groupOf(parameter);
  return std::ranges::any_of(scene.robots, [&](const RobotSpec& robot) {
    const RobotModel& model = *models.at(robot.model);
    return group ? hasGroup(model, *group) : referenceJoint(model) >= 0;
  });
}

}  // namespace

bool isOfGroup(const std::string& massGroup, const std::string& group) {
  return massGroup == group || massGroup.starts_with(group + ":");
}

int referenceJoint(const RobotModel& model) {
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    if (model.joints[i].type == Joint::Type::rotate && model.links[i + 1].massGroup.starts_with("leg"))
      return static_cast<int>(i);
  return -1;
}

std::vector<Parameter> simulatorParametersOf(const SceneSpec& scene, const ModelSet& models) {
  std::vector<Parameter> all;
  for (const Parameter& parameter : simulatorParameters())
    if (isIn(scene, models, parameter.name)) all.push_back(parameter);
  return all;
}

std::string whoHas(const std::string& parameter) {
  if (isOfFloor(parameter)) return "only in a scene with a floor";
  if (const auto group = groupOf(parameter)) return "only for robots whose model has a " + *group;
  return "only for robots with legs";
}

}  // namespace btr
