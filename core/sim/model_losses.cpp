#include "core/sim/model_losses.h"

#include <algorithm>
#include <set>

#include "core/model/drawing_loss.h"
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

std::vector<std::string> drawingLosses(const SceneSpec& spec, const ModelSet& models) {
  std::vector<std::string> losses;
  std::set<std::string> told;
  for (const RobotSpec& robot : spec.robots) {
    const auto found = models.find(robot.model);
    if (found == models.end() || !told.insert(robot.model).second) continue;
    std::size_t byCollision = 0, notDrawn = 0;
    for (const Warning& warning : found->second->warnings) {
      if (warning.at.empty()) continue;
      byCollision += warning.text.ends_with(drawingLoss::byCollision);
      notDrawn += warning.text.ends_with(drawingLoss::notDrawn);
    }
    const std::size_t all = byCollision + notDrawn;
    if (all == 0) continue;
    std::string text = robot.model + ": " + std::to_string(all) + (all == 1 ? " visual shape" : " visual shapes") +
                       " cannot be read: ";
    if (byCollision > 0) text += std::to_string(byCollision) + " drawn by their collision shapes";
    if (notDrawn > 0) text += (byCollision > 0 ? ", " : "") + std::to_string(notDrawn) + " not drawn";
    losses.push_back(text);
  }
  return losses;
}

}  // namespace btr
