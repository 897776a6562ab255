// Hands in a session: springs that pull objects, joints that are held.
#include <utility>

#include "core/live/session.h"
#include "core/live/session_objects.h"
#include "core/spec/error.h"

namespace btr {

void Session::setPulls() {
  std::vector<Pull> pulls;
  for (const auto& [name, act] : pulls_) {
    const objects::Place found = objects::placeOf(game_.scene, name, "object");
    Pull pull;
    pull.what = found.kind == objects::Place::Kind::robot  ? Pull::What::link
                : found.kind == objects::Place::Kind::ball ? Pull::What::ball
                                                           : Pull::What::obstacle;
    pull.object = found.index;
    if (found.kind == objects::Place::Kind::robot && !act.link.empty())
      pull.link = static_cast<std::size_t>(scene_.robots[found.index].model.findLink(act.link));
    pull.point_m = objects::vectorOf(act.point_m);
    pull.target_m = objects::vectorOf(act.target_m);
    pull.stiffness_n_m = act.stiffness_n_m;
    pull.most_n = act.most_n;
    pulls.push_back(pull);
  }
  world_->setPulls(std::move(pulls));
}

Eigen::Vector3d Session::handForce_n(const std::string& object) const {
  std::size_t i = 0;
  for (const auto& [name, act] : pulls_) {
    if (name == object) return world_->pullForce_n(i);
    ++i;
  }
  return Eigen::Vector3d::Zero();
}

void Session::change(const PullAct& act) {
  const objects::Place found = objects::placeOf(game_.scene, act.object, "object");
  if (!act.link.empty() &&
      (found.kind != objects::Place::Kind::robot || scene_.robots[found.index].model.findLink(act.link) < 0))
    throw InputError("link", "\"" + act.link + "\"", "a link of the robot that is pulled");
  pulls_[act.object] = act;
  setPulls();
}

void Session::change(const LetGoAct& act) {
  if (pulls_.erase(act.object) == 0) throw InputError("object", "\"" + act.object + "\"", "an object that is pulled");
  setPulls();
}

void Session::change(const HoldAct& act) {
  const std::size_t robot = robotOf(act.robot), joint = jointOf(robot, act.joint);
  if (act.position) {
    held_[act.robot][act.joint] = *act.position;
    if (act.command && !players_.contains(act.robot)) inputs_[robot][joint].command = *act.command;
    return;
  }
  if (!held_.contains(act.robot) || held_[act.robot].erase(act.joint) == 0)
    throw InputError("joint", act.robot + "." + act.joint, "a joint that is held");
  if (held_[act.robot].empty()) held_.erase(act.robot);
  if (!players_.contains(act.robot))
    inputs_[robot][joint].command = act.command.value_or(world_->robot(robot).position[joint]);
}

}  // namespace btr
