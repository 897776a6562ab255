#include "core/gap/fit/unit_at.h"

#include <algorithm>

namespace btr {
namespace {

bool isSlideJoint(const SceneSpec& scene, const ModelSet& models, const std::string& at) {
  for (const RobotSpec& robot : scene.robots) {
    const auto model = models.find(robot.model);
    if (model == models.end() || !model->second || !at.starts_with(robot.name + ".")) continue;
    const std::string name = at.substr(robot.name.size() + 1);
    for (const Joint& joint : model->second->joints)
      if (joint.name == name) return joint.type == Joint::Type::slide;
  }
  return false;
}

}  // namespace

std::string unitAt(const SceneSpec& scene, const ModelSet& models, const std::string& at, const Parameter& parameter) {
  static const std::string words = " on a slide joint";
  const std::string& text = parameter.meaning;
  if (!text.ends_with(words) || !isSlideJoint(scene, models, at)) return parameter.unit;
  const std::size_t comma = text.rfind(", ");
  const std::size_t from = comma == std::string::npos ? 0 : comma + 2;
  return text.substr(from, text.size() - words.size() - from);
}

}  // namespace btr
