#include "core/live/undo.h"

#include <algorithm>

#include "core/live/session.h"
#include "core/spec/error.h"

namespace btr {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

std::array<double, 3> threeOf(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

template <class Specs>
std::optional<std::size_t> whereIn(const Specs& specs, const std::string& name) {
  const auto found = std::ranges::find_if(specs, [&](const auto& spec) { return spec.name == name; });
  if (found == specs.end()) return std::nullopt;
  return static_cast<std::size_t>(found - specs.begin());
}

PlaceAct placeAt(const std::string& object, const Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  return {object, threeOf(pose.translation()), {q.w(), q.x(), q.y(), q.z()}};
}

/// What the joints of a robot are told now.
Values commandsOf(const Session& session, const std::string& name) {
  Values commands;
  const auto robot = whereIn(session.game().scene.robots, name);
  if (!robot) return commands;
  const RobotModel& model = session.scene().robots[*robot].model;
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    if (model.joints[j].type != Joint::Type::fixed)
      commands[model.joints[j].name] = session.inputs()[*robot][j].command;
  return commands;
}

/// Where an object is, and how it moves.
std::vector<Act> placesOf(const Session& session, const std::string& object) {
  const SceneSpec& scene = session.game().scene;
  const World& world = session.world();
  std::vector<Act> acts;
  Vector3d velocity = Vector3d::Zero(), spin = Vector3d::Zero();
  if (const auto robot = whereIn(scene.robots, object)) {
    const RobotReadings now = world.robot(*robot);
    const std::vector<double> positions = world.jointPositions(*robot);
    const SceneRobot& model = session.scene().robots[*robot];
    PlaceAct place = placeAt(object, now.base);
    for (std::size_t j = 0; j < positions.size(); ++j) {
      const Joint& joint = model.model.joints[j];
      if (joint.type == Joint::Type::fixed) continue;
      place.joints[joint.name] = positions[j];
      place.commands[joint.name] = session.inputs()[*robot][j].command;
    }
    acts.emplace_back(std::move(place));
    if (model.freeBase) {
      velocity = now.baseVelocity_m_s;
      spin = now.baseSpin_rad_s;
    }
  } else if (const auto ball = whereIn(scene.balls, object)) {
    const BallState state = world.ball(*ball);
    acts.emplace_back(placeAt(object, world.ballPose(*ball)));
    velocity = state.velocity_m_s;
    spin = state.spin_rad_s;
  } else if (const auto obstacle = whereIn(scene.obstacles, object)) {
    const ObstacleState& state = world.obstacle(*obstacle);
    acts.emplace_back(placeAt(object, state.pose));
    velocity = state.velocity_m_s;
    spin = state.spin_rad_s;
  }
  if (!velocity.isZero(0) || !spin.isZero(0)) acts.emplace_back(ThrowAct{object, threeOf(velocity), threeOf(spin)});
  return acts;
}

/// The pull that there is now; without one, none from then on.
Act pullOf(const Session& session, const std::string& object) {
  const auto found = session.pulls().find(object);
  if (found != session.pulls().end()) return found->second;
  return LetGoAct{object};
}

std::vector<Act> before(const Session& session, const PlaceAct& act) { return placesOf(session, act.object); }
std::vector<Act> before(const Session& session, const ThrowAct& act) { return placesOf(session, act.object); }

std::vector<Act> before(const Session&, const AddAct& act) {
  return {RemoveAct{std::visit([](const auto& spec) { return spec.name; }, act.what)}};
}

std::vector<Act> before(const Session& session, const RemoveAct& act) {
  const SceneSpec& scene = session.game().scene;
  AddAct add;
  if (const auto robot = whereIn(scene.robots, act.object)) {
    add.what = scene.robots[*robot];
    add.index = *robot;
    const auto player = session.game().robots.find(act.object);
    if (player != session.game().robots.end()) add.player = player->second;
  } else if (const auto ball = whereIn(scene.balls, act.object)) {
    add.what = scene.balls[*ball];
    add.index = *ball;
  } else if (const auto obstacle = whereIn(scene.obstacles, act.object)) {
    add.what = scene.obstacles[*obstacle];
    add.index = *obstacle;
  } else {
    return {};
  }
  std::vector<Act> acts{std::move(add)};
  for (Act& place : placesOf(session, act.object)) acts.push_back(std::move(place));
  if (session.pulls().contains(act.object)) acts.push_back(pullOf(session, act.object));
  if (const auto held = session.held().find(act.object); held != session.held().end())
    for (const auto& [joint, position] : held->second) acts.emplace_back(HoldAct{act.object, joint, position});
  return acts;
}

std::vector<Act> before(const Session& session, const PullAct& act) {
  std::vector<Act> acts{pullOf(session, act.object)};
  for (Act& place : placesOf(session, act.object)) acts.push_back(std::move(place));
  return acts;
}

std::vector<Act> before(const Session& session, const LetGoAct& act) { return {pullOf(session, act.object)}; }

std::vector<Act> before(const Session& session, const HoldAct& act) {
  const Values told = commandsOf(session, act.robot);
  const auto command = told.find(act.joint);
  if (command == told.end()) return {};
  HoldAct was{act.robot, act.joint, std::nullopt, command->second};
  if (const auto held = session.held().find(act.robot); held != session.held().end())
    if (const auto joint = held->second.find(act.joint); joint != held->second.end()) was.position = joint->second;
  return {was};
}

const GameController* controllerOf(const Session& session, const std::string& robot) {
  const auto player = session.game().robots.find(robot);
  if (player == session.game().robots.end() || !player->second.controller) return nullptr;
  return &*player->second.controller;
}

std::vector<Act> before(const Session& session, const ParameterAct& act) {
  const GameController* controller = controllerOf(session, act.robot);
  if (!controller) return {};
  ParameterAct was{act.robot, act.name};
  if (const auto found = controller->parameters.find(act.name); found != controller->parameters.end())
    was.value = found->second;
  return {was};
}

std::vector<Act> before(const Session& session, const ControllerAct& act) {
  ControllerAct was{act.robot};
  if (const GameController* controller = controllerOf(session, act.robot))
    was.controller = *controller;
  else
    was.commands = commandsOf(session, act.robot);
  return {was};
}

/// No hand's doing: its program orders again.
std::vector<Act> before(const Session&, const OrdersAct&) { return {}; }

SimulatorAct simulatorOf(const Session& session, const std::string& robot) {
  if (robot.empty()) return {robot, session.game().simulator};
  const auto player = session.game().robots.find(robot);
  return {robot, player == session.game().robots.end() ? std::nullopt : player->second.simulator};
}

std::vector<Act> before(const Session& session, const NumberAct& act) { return {simulatorOf(session, act.robot)}; }
std::vector<Act> before(const Session& session, const EffectAct& act) { return {simulatorOf(session, act.robot)}; }
std::vector<Act> before(const Session& session, const SimulatorAct& act) { return {simulatorOf(session, act.robot)}; }
std::vector<Act> before(const Session& session, const KickOffAct&) {
  std::vector<Act> acts;
  const auto add = [&](const std::string& object) {
    for (Act& place : placesOf(session, object)) acts.push_back(std::move(place));
  };
  for (const RobotSpec& robot : session.game().scene.robots) add(robot.name);
  for (const BallSpec& ball : session.game().scene.balls) add(ball.name);
  return acts;
}

std::vector<Act> before(const Session& session, const ScoreAct&) {
  if (!session.referee()) return {};
  return {ScoreAct{session.referee()->red, session.referee()->blue}};
}

std::vector<Act> before(const Session&, const CheckpointAct&) { return {}; }

std::string named(const PlaceAct& act) { return "move " + act.object; }
std::string named(const ThrowAct& act) { return "throw " + act.object; }
std::string named(const AddAct& act) {
  return "add " + std::visit([](const auto& spec) { return spec.name; }, act.what);
}
std::string named(const RemoveAct& act) { return "remove " + act.object; }
std::string named(const PullAct& act) { return "pull " + act.object; }
std::string named(const LetGoAct& act) { return "let go of " + act.object; }
std::string named(const HoldAct& act) { return (act.position ? "hold " : "free ") + act.robot + "." + act.joint; }
std::string named(const ParameterAct& act) { return act.robot + " " + act.name; }
std::string named(const ControllerAct& act) { return "controller of " + act.robot; }
std::string named(const OrdersAct& act) { return "orders of " + act.robot; }
std::string named(const NumberAct& act) { return act.robot.empty() ? act.name : act.robot + " " + act.name; }
std::string named(const EffectAct& act) { return act.effect.text(); }
std::string named(const SimulatorAct& act) { return act.robot.empty() ? "simulator" : "simulator of " + act.robot; }
std::string named(const KickOffAct&) { return "kick-off"; }
std::string named(const ScoreAct&) { return "score"; }
std::string named(const CheckpointAct&) { return "checkpoint"; }

/// The object that an act moves by hand; "" if it does no such thing.
std::string movedBy(const Act& act) {
  if (const auto* place = std::get_if<PlaceAct>(&act)) return place->object;
  if (const auto* toss = std::get_if<ThrowAct>(&act)) return toss->object;
  if (const auto* pull = std::get_if<PullAct>(&act)) return pull->object;
  if (const auto* free = std::get_if<LetGoAct>(&act)) return free->object;
  return {};
}

/// A hand that is no longer there cannot let go.
bool isDone(const Session& session, const Act& act) {
  const auto* free = std::get_if<LetGoAct>(&act);
  return free && !session.pulls().contains(free->object);
}

}  // namespace

std::vector<Act> undoOf(const Session& session, const Act& act) {
  return std::visit([&](const auto& each) { return before(session, each); }, act);
}

std::string nameOf(const Act& act) {
  return std::visit([](const auto& each) { return named(each); }, act);
}

void UndoStack::apply(Session& session, const Act& act, std::optional<long> gesture) {
  const std::string moved = movedBy(act);
  Step* going = gesture && !done_.empty() && done_.back().gesture == gesture ? &done_.back() : nullptr;
  const bool known = going && !moved.empty() && std::ranges::find(going->restored, moved) != going->restored.end();
  std::vector<Act> back;
  if (!known) {
    // A drag gives back both place and pull, however it goes on.
    if (gesture && !moved.empty())
      back = before(session, PullAct{moved, "", {}, {}});
    else
      back = undoOf(session, act);
  }
  session.apply(act);
  if (std::holds_alternative<CheckpointAct>(act)) return;
  undone_.clear();
  if (going) {
    going->acts.insert(going->acts.begin(), back.begin(), back.end());
  } else {
    done_.push_back({nameOf(act), std::move(back), gesture});
    if (done_.size() > most) done_.pop_front();
    going = &done_.back();
  }
  if (gesture && !moved.empty() && !known) going->restored.push_back(moved);
}

UndoStack::Step UndoStack::takeBack(Session& session, const Step& step) {
  Step again{step.name, {}};
  for (const Act& act : step.acts) {
    if (isDone(session, act)) continue;
    const std::vector<Act> back = undoOf(session, act);
    session.apply(act);
    again.acts.insert(again.acts.begin(), back.begin(), back.end());
  }
  return again;
}

void UndoStack::undo(Session& session) {
  if (done_.empty()) throw InputError("undo", "nothing", "an act that can be taken back");
  const Step step = std::move(done_.back());
  done_.pop_back();
  undone_.push_back(takeBack(session, step));
}

void UndoStack::redo(Session& session) {
  if (undone_.empty()) throw InputError("redo", "nothing", "an act that was taken back");
  const Step step = std::move(undone_.back());
  undone_.pop_back();
  done_.push_back(takeBack(session, step));
}

}  // namespace btr
