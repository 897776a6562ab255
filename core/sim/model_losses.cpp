#include "core/sim/model_losses.h"

#include <algorithm>

#include "core/sim/contact/collision.h"

namespace btr {
namespace {

bool matters(const Warning& warning, const RobotSpec& robot) {
  switch (warning.loss) {
    case Warning::Loss::none:
      return false;
    case Warning::Loss::limits:
    case Warning::Loss::inertia:
      return true;
    case Warning::Loss::collision:
      return robot.collision != "none";
    case Warning::Loss::effort: {
      const auto servo = robot.servos.find(warning.at);
      if (servo == robot.servos.end()) return true;
      const Values& numbers = servo->second.numbers;
      return servo->second.drive == "servo" && !numbers.contains("max_torque_nm") && !numbers.contains("max_force_n");
    }
  }
  return true;
}

bool collides(const RobotModel& model, const std::string& collision) {
  return std::ranges::any_of(model.links, [&](const Link& link) {
    return std::ranges::any_of(link.shapes,
                               [&](const Shape& shape) { return collidesIn(model, link, shape, collision); });
  });
}

}  // namespace

std::vector<std::string> modelLosses(const SceneSpec& spec, const ModelSet& models) {
  std::vector<std::string> losses;
  for (const RobotSpec& robot : spec.robots) {
    const auto found = models.find(robot.model);
    if (found == models.end()) continue;
    const RobotModel& model = *found->second;
    for (const Warning& warning : model.warnings)
      if (matters(warning, robot))
        losses.push_back(robot.name + " (" + robot.model + ", line " + std::to_string(warning.line) +
                         "): " + warning.text);
    if (robot.base == "free" && robot.collision != "none" && spec.floor && !collides(model, robot.collision))
      losses.push_back(robot.name + " (" + robot.model + "): no shape of it collides: the floor does not hold it");
  }
  return losses;
}

}  // namespace btr
