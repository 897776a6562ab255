// What the referee of a session does to its world. It is part of the simulation: a function of what the world did, so
// that a log without it plays again with the same bits.
#include <algorithm>
#include <cmath>

#include "core/live/session.h"
#include "core/spec/error.h"

namespace btr {
namespace {

using Eigen::Vector3d;

void needReferee(const Game& game, const std::string& act) {
  if (!game.referee) throw InputError("act", act, "a game with a referee");
}

}  // namespace

FieldSpec fieldOf(const Game& game) {
  const std::string& ball = game.referee->ball;
  if (!ball.empty() && std::ranges::none_of(game.scene.balls, [&](const BallSpec& b) { return b.name == ball; }))
    throw InputError("referee/ball", "\"" + ball + "\"", "a ball of the game's scene");
  for (const auto& place : game.referee->kickOff)
    if (std::ranges::none_of(game.scene.robots, [&](const RobotSpec& r) { return r.name == place.first; }))
      throw InputError("referee/kick_off", "\"" + place.first + "\"", "robots of the game's scene");
  if (game.referee->field) return *game.referee->field;
  if (!game.pitch.field) throw InputError("referee/field", "nothing", "the field's sizes, where the scene has none");
  return *game.pitch.field;
}

std::optional<std::size_t> Session::refereeBall() const {
  if (!game_.referee) return std::nullopt;
  const std::vector<BallSpec>& balls = game_.scene.balls;
  for (std::size_t i = 0; i < balls.size(); ++i)
    if (game_.referee->ball.empty() || balls[i].name == game_.referee->ball) return i;
  return std::nullopt;
}

void Session::officiate() {
  if (!game_.referee) return;
  RefereeView view{time_s(), scene_.controlPeriod_s};
  const auto ball = refereeBall();
  if (ball) {
    view.ball = world_->ball(*ball).position_m;
    view.radius_m = game_.scene.balls[*ball].radius_m;
  }
  for (std::size_t i = 0; i < scene_.robots.size(); ++i) view.robots.push_back(world_->robot(i).base.translation());
  const RefereeOrder order = btr::officiate(*game_.referee, field_, referee_, view);
  if (order.ball && ball) {
    BallState state;
    state.position_m = *order.ball;
    state.time = world_->time();
    world_->setBall(*ball, state);
    referee_.ball = {order.ball->x(), order.ball->y(), order.ball->z()};
  }
  if (!order.kickOff.empty()) kickOff(order.kickOff);
}

// Robots take the posture that they began the game in; their motions begin anew.
void Session::kickOff(const std::string& team) {
  std::vector<std::pair<std::string, std::string>> teams;
  for (const SceneRobot& robot : scene_.robots) {
    const auto player = game_.robots.find(robot.name);
    teams.emplace_back(robot.name, player == game_.robots.end() ? "" : player->second.team);
  }
  const auto places = kickOffPlaces(*game_.referee, field_, referee_, team, teams);
  for (std::size_t i = 0; i < scene_.robots.size(); ++i) {
    const SceneRobot& robot = scene_.robots[i];
    const auto place = places.find(robot.name);
    if (place == places.end() || !robot.freeBase) continue;
    const auto& [x, y, heading] = place->second;
    const double was = std::atan2(robot.start.linear()(1, 0), robot.start.linear()(0, 0));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::AngleAxisd(heading - was, Vector3d::UnitZ()) * robot.start.linear();
    pose.translation() << x, y, robot.start.translation().z();
    std::vector<double> joints = robot.jointStart;
    joints.resize(robot.model.joints.size());
    world_->setRobot(i, pose, Vector3d::Zero(), Vector3d::Zero(), joints, std::vector<double>(joints.size(), 0));
    for (std::size_t j = 0; j < joints.size(); ++j)
      inputs_[i][j].command = robot.drives[j].kind == Drive::Kind::torque ? 0 : joints[j];
    if (players_.contains(robot.name)) players_[robot.name] = playerOf(game_, scene_, robot.name, 0);
  }
  if (const auto ball = refereeBall()) {
    BallState state;
    state.position_m << 0, 0, game_.scene.balls[*ball].radius_m;
    state.time = world_->time();
    world_->setBall(*ball, state);
  }
  referee_.ball.reset();
  referee_.waits = false;
  note(referee_, {0, 0, 0, "kick_off", team, 0, 0}, time_s(), scene_.controlPeriod_s);
}

void Session::change(const KickOffAct& act) {
  needReferee(game_, "kick_off");
  kickOff(act.team.empty() ? referee_.kicks : act.team);
}

void Session::change(const ScoreAct& act) {
  needReferee(game_, "score");
  referee_.red = act.red;
  referee_.blue = act.blue;
  note(referee_, {0, 0, 0, "score", "", 0, 0}, time_s(), scene_.controlPeriod_s);
}

}  // namespace btr
