// Who moves the robots of a session: motions of controllers, asked once a period; their parameters.
#include <algorithm>
#include <utility>

#include "core/live/session.h"
#include "core/live/session_objects.h"
#include "core/live/session_players.h"
#include "core/spec/error.h"

namespace btr {

std::vector<double> parametersOf(const Controller& controller, const GameController& spec, const std::string& place) {
  return resolve(controller.genotype(), spec.parameters, place + "/parameters");
}

namespace {

std::unique_ptr<Controller> controllerOf(const std::string& robot, const GameController& of, const PluginHost& host) {
  try {
    return host.controller(of.plugin);
  } catch (const InputError& error) {
    throw InputError("robots " + robot + "/" + error.what());
  }
}

}  // namespace

void checkPlayers(const Game& game, const PluginHost& host) {
  for (const auto& [name, player] : game.robots)
    if (player.hasStick()) {
      constexpr double frame_s = 0.008;
      if (game.scene.controlPeriod_s != frame_s)
        throw InputError("robots " + name + "/controller/openr",
                         "a control period of " + toText(game.scene.controlPeriod_s) + " s",
                         "a scene whose control_period_s is 0.008, a frame of OPEN-R");
    } else if (player.controller) {
      const auto controller = controllerOf(name, *player.controller, host);
      resolve(controller->settings(), player.controller->settings, "robots " + name + "/controller/settings");
      parametersOf(*controller, *player.controller, "robots " + name + "/controller");
    }
}

Session::Player Session::playerOf(const Game& game, const Scene& scene, const std::string& robot, double clock) const {
  const GameController& spec = *game.robots.at(robot).controller;
  const Asked asked(dog_, robot + "'s controller \"" + spec.plugin + "\"");
  Player player;
  player.controller = host_.controller(spec.plugin);
  if (player.controller->looks() && !makeCamera_)
    throw InputError("robots " + robot + "/controller", "\"" + spec.plugin + "\", which looks through a camera",
                     "a controller that does not look: nothing can be drawn here");
  // A controller drives the first robot of a scene.
  Scene mine = scene;
  std::swap(mine.robots.front(), mine.robots.at(objects::indexOf(game.scene.robots, robot)));
  player.motion =
      player.controller->begin(mine, spec.settings, parametersOf(*player.controller, spec, "robots " + robot));
  player.clock = clock;
  if (const auto was = players_.find(robot); clock > 0 && was != players_.end()) {
    const auto& before = game_.robots.at(robot).controller;
    if (before && before->plugin == spec.plugin) player.motion->remember(was->second.motion->memory());
  }
  return player;
}

void Session::askEyes() {
  const double period = scene_.controlPeriod_s;
  for (auto& [name, eye] : eyes_) {
    const auto found = players_.find(name);
    if (!eye || found == players_.end() || !found->second.controller->looks()) continue;
    if (found->second.isAsked(period, game_.robots.at(name).controller->repeats)) eye->ask(*this);
  }
}

void Session::askController(std::size_t robot, Player& player) {
  const std::string& name = scene_.robots[robot].name;
  const std::string who = name + "'s controller \"" + game_.robots.at(name).controller->plugin + "\"";
  MotionSenses now;
  now.seed = game_.seed;
  now.period = periods_;
  std::vector<double> values;
  if (const auto found = std::ranges::find(sensing_, robot, &Sensing::robot); found != sensing_.end()) {
    found->senses.sample(values);
    now.channels = found->senses.channels();
    now.values = values;
  }
  std::optional<CameraPicture> picture;
  try {
    if (player.controller->looks()) {
      if (!eyes_[name]) eyes_[name] = makeCamera_(name);
      picture = eyes_[name]->look(*this);
    }
    if (picture) now.picture = &*picture;
    world_->read(robot, readings_);
    const Asked asked(dog_, who);
    player.motion->sense(now);
    player.motion->command(player.clock, readings_, inputs_[robot]);
    lamps_[name] = player.motion->lamps();
  } catch (const InputError& error) {
    fault_ = who + ": " + error.what() + ", at " + toText(time_s()) + " s";
  }
}

void Session::change(const ParameterAct& act) {
  robotOf(act.robot);
  const auto player = players_.find(act.robot);
  if (player == players_.end()) throw InputError("robot", act.robot, "a robot that has a controller");
  const std::vector<Parameter> genotype = player->second.controller->genotype();
  const auto declared = std::ranges::find_if(genotype, [&](const Parameter& p) { return p.name == act.name; });
  if (declared == genotype.end())
    throw InputError("name", "\"" + act.name + "\"",
                     "a parameter of the controller " + game_.robots[act.robot].controller->plugin);
  Values& parameters = game_.robots[act.robot].controller->parameters;
  if (act.value) {
    check(*declared, *act.value, act.robot + " " + act.name);
    parameters[act.name] = *act.value;
  } else {
    parameters.erase(act.name);
  }
  player->second = playerOf(game_, scene_, act.robot, player->second.clock);
}

void Session::change(const ControllerAct& act) {
  const std::size_t robot = robotOf(act.robot);
  Game game = game_;
  game.robots[act.robot].controller = act.controller;
  checkPlayers(game, host_);
  std::vector<Sensing> sensing = sensingOf(game, scene_);
  const auto senseAs = [&] {
    const std::vector<std::string> before = channels();
    if (!sensesOf(game_, act.robot).empty()) world_->measureAcceleration(robot);
    takeSenses(std::move(sensing));
    sense(true);
    if (channels() != before) hashChannels();
  };
  if (game.robots[act.robot].hasPlugin()) {
    Player player = playerOf(game, scene_, act.robot, 0);
    game_ = std::move(game);
    players_[act.robot] = std::move(player);
    orders_.erase(act.robot);
    for (JointInput& input : inputs_[robot]) input = JointInput{input.command};
    senseAs();
    return;
  }
  std::map<std::size_t, double> told;
  for (const auto& [joint, command] : act.commands) told[jointOf(robot, joint)] = command;
  game_ = std::move(game);
  players_.erase(act.robot);
  lamps_.erase(act.robot);
  eyes_.erase(act.robot);
  senseAs();
  orders_.erase(act.robot);
  orders_ = ordersOf(game_, orders_);
  if (game_.robots[act.robot].hasStick()) {
    // What joints are told stays until the program orders something else; they are limp.
    world_->measureAcceleration(robot);
    for (const auto& [joint, command] : told) inputs_[robot][joint].command = command;
    return;
  }
  const RobotReadings now = world_->robot(robot);
  for (std::size_t j = 0; j < inputs_[robot].size(); ++j)
    inputs_[robot][j] = JointInput{scene_.robots[robot].drives[j].kind == Drive::Kind::torque ? 0 : now.position[j]};
  for (const auto& [joint, command] : told) inputs_[robot][joint].command = command;
}

}  // namespace btr
