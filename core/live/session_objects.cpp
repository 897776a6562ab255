// Objects of a session: put somewhere, thrown, added and taken away.
#include <utility>

#include "core/live/session.h"
#include "core/live/session_objects.h"
#include "core/spec/error.h"

namespace btr {

void Session::change(const PlaceAct& act) {
  const objects::Place found = objects::placeOf(game_.scene, act.object, "object");
  const Eigen::Isometry3d pose = objects::poseOf(act.position_m, act.orientation_wxyz);
  if (!(act.joints.empty() && act.commands.empty()) && found.kind != objects::Place::Kind::robot)
    throw InputError("joints", act.object, "joints of a robot only");
  if (found.kind == objects::Place::Kind::ball) {
    BallState state;
    state.position_m = pose.translation();
    state.time = world_->time();
    world_->setBall(found.index, state);
    if (refereeBall() == found.index) referee_.ball.reset();  // it did not go there
  } else if (found.kind == objects::Place::Kind::obstacle) {
    ObstacleState state;
    state.pose = pose;
    world_->setObstacle(found.index, state);
  } else {
    std::vector<double> positions = world_->jointPositions(found.index);
    std::vector<JointInput> inputs = inputs_[found.index];
    for (const auto& [joint, position] : act.joints) {
      const std::size_t j = jointOf(found.index, joint);
      positions[j] = position;
      if (!players_.contains(act.object)) inputs[j].command = position;
    }
    for (const auto& [joint, command] : act.commands) inputs[jointOf(found.index, joint)].command = command;
    inputs_[found.index] = std::move(inputs);
    world_->setRobot(found.index, pose, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), positions,
                     std::vector<double>(positions.size(), 0));
  }
}

void Session::change(const ThrowAct& act) {
  const objects::Place found = objects::placeOf(game_.scene, act.object, "object");
  const Eigen::Vector3d velocity = objects::vectorOf(act.velocity_m_s), spin = objects::vectorOf(act.spin_rad_s);
  if (found.kind == objects::Place::Kind::ball) {
    BallState state = world_->ball(found.index);
    state.velocity_m_s = velocity;
    state.spin_rad_s = spin;
    world_->setBall(found.index, state);
  } else if (found.kind == objects::Place::Kind::obstacle) {
    if (game_.scene.obstacles[found.index].mass_kg == 0)
      throw InputError("object", act.object, "something that moves; this obstacle has no mass");
    world_->setObstacle(found.index, {world_->obstacle(found.index).pose, velocity, spin});
  } else {
    if (!scene_.robots[found.index].freeBase)
      throw InputError("object", act.object, "something that moves; its base is fixed");
    const std::vector<double> positions = world_->jointPositions(found.index);
    world_->setRobot(found.index, world_->robot(found.index).base, velocity, spin, positions,
                     std::vector<double>(positions.size(), 0));
  }
}

void Session::change(const AddAct& act) {
  Game game = game_;
  const std::string name = std::visit([](const auto& spec) { return spec.name; }, act.what);
  const auto taken = [&](const auto& specs) { return objects::indexOf(specs, name) < specs.size(); };
  if (taken(game.scene.robots) || taken(game.scene.balls) || taken(game.scene.obstacles))
    throw InputError("name", "\"" + name + "\"", "a name that no other object of this game has");
  const auto insert = [&](auto& specs, const auto& spec) {
    if (act.index && *act.index > specs.size())
      throw InputError("index", std::to_string(*act.index), "at most " + std::to_string(specs.size()));
    specs.insert(specs.begin() + static_cast<std::ptrdiff_t>(act.index.value_or(specs.size())), spec);
  };
  if (const auto* robot = std::get_if<RobotSpec>(&act.what)) {
    insert(game.scene.robots, *robot);
    if (act.player != GameRobot{}) game.robots[name] = act.player;
  } else if (const auto* ball = std::get_if<BallSpec>(&act.what)) {
    insert(game.scene.balls, *ball);
  } else {
    insert(game.scene.obstacles, std::get<ObstacleSpec>(act.what));
  }
  rebuild(std::move(game), world_->memory());
}

void Session::change(const RemoveAct& act) {
  const objects::Place found = objects::placeOf(game_.scene, act.object, "object");
  Game game = game_;
  const auto at = static_cast<std::ptrdiff_t>(found.index);
  if (found.kind == objects::Place::Kind::robot) game.scene.robots.erase(game.scene.robots.begin() + at);
  if (found.kind == objects::Place::Kind::ball) game.scene.balls.erase(game.scene.balls.begin() + at);
  if (found.kind == objects::Place::Kind::obstacle) game.scene.obstacles.erase(game.scene.obstacles.begin() + at);
  game.robots.erase(act.object);
  const auto pull = pulls_.extract(act.object);
  const auto held = held_.extract(act.object);
  try {
    rebuild(std::move(game), world_->memory());
  } catch (const InputError&) {
    // An effect, say, that acts at what should go.
    if (pull) pulls_[act.object] = pull.mapped();
    if (held) held_[act.object] = held.mapped();
    setPulls();
    throw;
  }
}

}  // namespace btr
