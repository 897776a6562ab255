#include "core/live/session.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/spec/error.h"

namespace btr {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr long goodEvery = 12;  ///< control periods, a tenth of a second of the standard ones

Vector3d vectorOf(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

Isometry3d poseOf(const std::array<double, 3>& p, const std::array<double, 4>& q) {
  return Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
}

template <class Specs>
std::size_t indexOf(const Specs& specs, const std::string& name) {
  const auto found = std::ranges::find_if(specs, [&](const auto& spec) { return spec.name == name; });
  return static_cast<std::size_t>(found - specs.begin());
}

/// True of what comes many times a period from other programs and needs no look: robot and joint must be there anyway.
bool canBeLogged(const Act& act) {
  constexpr double largest = 1e12;
  const auto* hold = std::get_if<HoldAct>(&act);
  return hold && hold->position && std::abs(*hold->position) <= largest && !hold->command;
}

/// Where a name belongs.
struct ObjectPlace {
  enum class Kind { robot, ball, obstacle } kind;
  std::size_t index;
};

ObjectPlace placeOf(const SceneSpec& scene, const std::string& name, const std::string& place) {
  if (const auto i = indexOf(scene.robots, name); i < scene.robots.size()) return {ObjectPlace::Kind::robot, i};
  if (const auto i = indexOf(scene.balls, name); i < scene.balls.size()) return {ObjectPlace::Kind::ball, i};
  if (const auto i = indexOf(scene.obstacles, name); i < scene.obstacles.size())
    return {ObjectPlace::Kind::obstacle, i};
  throw InputError(place, "\"" + name + "\"", "a robot, ball or obstacle of this game");
}

/// The controller's parameters as a vector; throws InputError.
std::vector<double> vectorOf(const Controller& controller, const GameController& spec, const std::string& place) {
  return resolve(controller.genotype(), spec.parameters, place + "/parameters");
}

/// What makeScene() would say of it later: a controller that is not there, settings or parameters out of bounds.
void check(const Game& game, const PluginHost& host) {
  for (const auto& [name, player] : game.robots)
    if (player.hasStick()) {
      constexpr double frame_s = 0.008;
      if (game.scene.controlPeriod_s != frame_s)
        throw InputError("robots " + name + "/controller/openr",
                         "a control period of " + toText(game.scene.controlPeriod_s) + " s",
                         "a scene whose control_period_s is 0.008, a frame of OPEN-R");
    } else if (player.controller) {
      const auto controller = host.controller(player.controller->plugin);
      resolve(controller->settings(), player.controller->settings, "robots " + name + "/controller/settings");
      vectorOf(*controller, *player.controller, "robots " + name + "/controller");
    }
}

}  // namespace

Session::Session(Game game, const PluginHost& host, Watchdog* dog, CameraMaker cameras)
    : host_(host), makeCamera_(std::move(cameras)), dog_(dog) {
  check(game, host);
  if (game.referee) field_ = fieldOf(game);
  models_ = loadModels(game.scene);
  Scene scene = sceneOf(game, models_, host);
  sensing_ = sensingOf(game, scene);
  world_ = worldOf(game, scene, nullptr);
  scene_ = std::move(scene);
  game_ = std::move(game);
  if (!world_->fault().empty()) throw InputError("game", world_->fault(), "a world in which everything is finite");
  std::map<std::string, double> clocks;
  std::map<std::string, std::vector<double>> memories;
  Commands commands;
  orders_ = ordersOf(game_, game_.state ? game_.state->orders : std::map<std::string, Orders>{});
  if (game_.state) {
    for (const RobotMemory& robot : game_.state->world.robots)
      if (const auto i = indexOf(game_.scene.robots, robot.name); i == game_.scene.robots.size())
        throw InputError("state/world/robots", robot.name, "a robot of the game's scene");
    try {
      world_->remember(game_.state->world);
    } catch (const std::logic_error& error) {
      throw InputError("state/world/robots", error.what(), "what was saved with the same robot files");
    }
    periods_ = game_.state->periods;
    clocks = game_.state->clocks;
    memories = game_.state->memories;
    held_ = game_.state->held;
    commands = game_.state->commands;
    lastGood_ = std::move(game_.state->world);
    for (Sensing& sensing : sensing_)
      if (const auto was = game_.state->senses.find(scene_.robots[sensing.robot].name);
          was != game_.state->senses.end())
        sensing.senses.remember(was->second, "state/senses/" + was->first);
    if (game_.state->referee) referee_ = *game_.state->referee;
    for (const PullAct& pull : game_.state->pulls) change(pull);
    for (const auto& [robot, joints] : held_)
      for (const auto& joint : joints) jointOf(robotOf(robot), joint.first);
    game_.state.reset();
  } else {
    lastGood_ = world_->memory();
  }
  holdCommands(lastGood_, commands);
  for (const auto& [name, player] : game_.robots)
    if (player.hasPlugin()) {
      players_[name] = playerOf(game_, scene_, name, clocks.contains(name) ? clocks[name] : 0);
      if (memories.contains(name)) players_[name].motion->remember(memories[name]);
    }
  sense(true);
  hashChannels();
}

std::unique_ptr<World> Session::worldOf(const Game& game, const Scene& scene, const WorldMemory* memory) const {
  auto world = std::make_unique<World>(scene, game.seed);
  world->measureForces(contacts_);
  for (std::size_t i = 0; i < scene.robots.size(); ++i)
    if (const auto player = game.robots.find(scene.robots[i].name);
        player != game.robots.end() && (player->second.hasStick() || !sensesOf(game, player->first).empty()))
      world->measureAcceleration(i);
  if (memory) world->remember(*memory);
  return world;
}

Session::~Session() = default;

std::size_t Session::robotOf(const std::string& name) const {
  const auto i = indexOf(game_.scene.robots, name);
  if (i == game_.scene.robots.size()) throw InputError("robot", "\"" + name + "\"", "a robot of this game");
  return i;
}

std::size_t Session::jointOf(std::size_t robot, const std::string& joint) const {
  const RobotModel& model = scene_.robots[robot].model;
  const int index = model.findJoint(joint);
  if (index < 0 || model.joints[static_cast<std::size_t>(index)].type == Joint::Type::fixed)
    throw InputError("joint", "\"" + joint + "\"", "a joint of " + game_.scene.robots[robot].name + " that moves");
  return static_cast<std::size_t>(index);
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
  std::swap(mine.robots.front(), mine.robots.at(indexOf(game.scene.robots, robot)));
  player.motion = player.controller->begin(mine, spec.settings, vectorOf(*player.controller, spec, "robots " + robot));
  player.clock = clock;
  if (const auto was = players_.find(robot); clock > 0 && was != players_.end()) {
    const auto& before = game_.robots.at(robot).controller;
    if (before && before->plugin == spec.plugin) player.motion->remember(was->second.motion->memory());
  }
  return player;
}

Session::Commands Session::commands() const {
  Commands commands;
  for (std::size_t i = 0; i < inputs_.size(); ++i)
    for (std::size_t j = 0; j < inputs_[i].size(); ++j)
      if (const Joint& joint = scene_.robots[i].model.joints[j]; joint.type != Joint::Type::fixed)
        commands[scene_.robots[i].name][joint.name] = inputs_[i][j].command;
  return commands;
}

// Inputs go on as they were; a joint that was never driven holds where it starts.
void Session::holdCommands(const WorldMemory& memory, const Commands& commands) {
  inputs_.clear();
  for (std::size_t i = 0; i < scene_.robots.size(); ++i) {
    const SceneRobot& robot = scene_.robots[i];
    std::vector<JointInput> inputs(robot.model.joints.size());
    for (std::size_t j = 0; j < inputs.size(); ++j)
      if (robot.drives[j].kind != Drive::Kind::torque && j < robot.jointStart.size())
        inputs[j].command = robot.jointStart[j];
    const auto was = std::ranges::find_if(memory.robots, [&](const auto& r) { return r.name == robot.name; });
    if (was != memory.robots.end()) {
      std::size_t moving = 0;
      for (std::size_t j = 0; j < inputs.size(); ++j) {
        if (robot.model.joints[j].type == Joint::Type::fixed) continue;
        if (moving < was->joints.size() && !was->joints[moving].fresh) inputs[j].command = was->joints[moving].command;
        ++moving;
      }
    }
    if (const auto told = commands.find(robot.name); told != commands.end())
      for (const auto& [joint, command] : told->second)
        if (const int j = robot.model.findJoint(joint); j >= 0) inputs[static_cast<std::size_t>(j)].command = command;
    inputs_.push_back(std::move(inputs));
  }
}

void Session::hash(std::string_view bytes) {
  hash_.add(bytes);
  sinceMark_.add(bytes);
}

void Session::hashChannels() {
  for (const std::string& channel : channels()) hash(channel + "\n");
}

std::string Session::mark() {
  const std::string mark = sinceMark_.finish();
  sinceMark_ = Sha256();
  sinceMark_.add(mark);
  return mark;
}

void Session::setPulls() {
  std::vector<Pull> pulls;
  for (const auto& [name, act] : pulls_) {
    const ObjectPlace found = placeOf(game_.scene, name, "object");
    Pull pull;
    pull.what = found.kind == ObjectPlace::Kind::robot  ? Pull::What::link
                : found.kind == ObjectPlace::Kind::ball ? Pull::What::ball
                                                        : Pull::What::obstacle;
    pull.object = found.index;
    if (found.kind == ObjectPlace::Kind::robot && !act.link.empty())
      pull.link = static_cast<std::size_t>(scene_.robots[found.index].model.findLink(act.link));
    pull.point_m = vectorOf(act.point_m);
    pull.target_m = vectorOf(act.target_m);
    pull.stiffness_n_m = act.stiffness_n_m;
    pull.most_n = act.most_n;
    pulls.push_back(pull);
  }
  world_->setPulls(std::move(pulls));
}

void Session::measureContacts(bool on) {
  contacts_ = on;
  world_->measureForces(on);
}

Vector3d Session::handForce_n(const std::string& object) const {
  std::size_t i = 0;
  for (const auto& [name, act] : pulls_) {
    if (name == object) return world_->pullForce_n(i);
    ++i;
  }
  return Vector3d::Zero();
}

void Session::step() {
  if (!fault_.empty()) return;
  const double period = scene_.controlPeriod_s;
  for (std::size_t i = 0; i < scene_.robots.size(); ++i) {
    const std::string& name = scene_.robots[i].name;
    if (const auto found = players_.find(name); found != players_.end()) {
      Player& player = found->second;
      const bool over = player.isOver(period);
      if (over && game_.robots.at(name).controller->repeats) player = playerOf(game_, scene_, name, 0);
      if (!over || player.clock < period / 2) askController(i, player);
      player.clock += period;
    }
    if (const auto found = held_.find(name); found != held_.end())
      for (const auto& [joint, position] : found->second) inputs_[i][jointOf(i, joint)].command = position;
    obey(i);
    for (std::size_t j = 0; j < inputs_[i].size(); ++j)
      if (!std::isfinite(inputs_[i][j].command)) {
        fault_ = name + ": its controller gave a command for " + scene_.robots[i].model.joints[j].name +
                 " that is no number, at " + toText(time_s()) + " s";
        inputs_[i][j].command = 0;
      }
  }
  if (fault_.empty()) {
    const Asked asked(dog_, "the world");
    world_->advance(inputs_, period);
    if (!world_->fault().empty()) fault_ = world_->fault() + " at " + toText(time_s()) + " s";
  }
  if (!fault_.empty()) {
    // The last good state is kept, to be looked at and saved.
    world_.reset();
    world_ = worldOf(game_, scene_, &lastGood_);
    return;
  }
  ++periods_;
  sense(false);
  row_.clear();
  sample(row_);
  hash({reinterpret_cast<const char*>(row_.data()), row_.size() * sizeof(double)});
  officiate();
  if (periods_ % goodEvery == 0) lastGood_ = world_->memory();
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

void Session::apply(const Act& act) {
  if (!fault_.empty()) throw InputError("session", fault_, "a session that goes on; open the game again");
  // Nothing that a log could not say.
  if (!canBeLogged(act)) actFromJson(toJson(act).dump(), "act");
  std::visit([this](const auto& each) { change(each); }, act);
  if (logged_) logged_(periods_, act);
}

void Session::rebuild(Game game, const WorldMemory& memory) {
  check(game, host_);
  ModelSet models = loadModels(game.scene);
  Scene scene = sceneOf(game, models, host_);
  std::vector<Sensing> sensing = sensingOf(game, scene);
  std::map<std::string, Player> players;
  for (const auto& [name, player] : game.robots)
    if (player.hasPlugin())
      players[name] = playerOf(game, scene, name, players_.contains(name) ? players_.at(name).clock : 0);
  // One world a process: the old one goes first, and comes back if the new one cannot be.
  world_.reset();
  try {
    world_ = worldOf(game, scene, &memory);
    if (!world_->fault().empty()) throw InputError("game", world_->fault(), "a world in which everything is finite");
  } catch (...) {
    world_.reset();
    world_ = worldOf(game_, scene_, &memory);
    setPulls();
    throw;
  }
  const Commands told = commands();
  game_ = std::move(game);
  models_ = std::move(models);
  scene_ = std::move(scene);
  keptScene_.reset();
  players_ = std::move(players);
  std::erase_if(lamps_, [&](const auto& each) { return !players_.contains(each.first); });
  std::erase_if(eyes_, [&](const auto& each) { return !players_.contains(each.first); });
  takeSenses(std::move(sensing));
  orders_ = ordersOf(game_, orders_);
  holdCommands(memory, told);
  setPulls();
  sense(true);
  lastGood_ = memory;
  hashChannels();
}

void Session::change(const CheckpointAct&) { rebuild(game_, world_->memory()); }

Game Session::save() {
  if (fault_.empty()) apply(CheckpointAct{});
  // What the world was begun anew from: what it remembers of it may differ in a last bit.
  return savedWith(lastGood_);
}

Game Session::saved() const { return savedWith(fault_.empty() ? world_->memory() : lastGood_); }

Game Session::savedWith(WorldMemory world) const {
  Game saved = game_;
  GameState state;
  state.world = std::move(world);
  state.periods = periods_;
  for (const auto& [name, player] : players_) {
    state.clocks[name] = player.clock;
    if (std::vector<double> memory = player.motion->memory(); !memory.empty()) state.memories[name] = std::move(memory);
  }
  state.held = held_;
  state.commands = commands();
  for (const auto& [name, pull] : pulls_) state.pulls.push_back(pull);
  for (const Sensing& sensing : sensing_) state.senses[scene_.robots[sensing.robot].name] = sensing.senses.memory();
  if (game_.referee) state.referee = referee_;
  state.orders = orders_;
  saved.state = std::move(state);
  return saved;
}

void Session::change(const PlaceAct& act) {
  const ObjectPlace found = placeOf(game_.scene, act.object, "object");
  const Isometry3d pose = poseOf(act.position_m, act.orientation_wxyz);
  if (!(act.joints.empty() && act.commands.empty()) && found.kind != ObjectPlace::Kind::robot)
    throw InputError("joints", act.object, "joints of a robot only");
  if (found.kind == ObjectPlace::Kind::ball) {
    BallState state;
    state.position_m = pose.translation();
    state.time = world_->time();
    world_->setBall(found.index, state);
    if (refereeBall() == found.index) referee_.ball.reset();  // it did not go there
  } else if (found.kind == ObjectPlace::Kind::obstacle) {
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
    world_->setRobot(found.index, pose, Vector3d::Zero(), Vector3d::Zero(), positions,
                     std::vector<double>(positions.size(), 0));
  }
}

void Session::change(const ThrowAct& act) {
  const ObjectPlace found = placeOf(game_.scene, act.object, "object");
  const Vector3d velocity = vectorOf(act.velocity_m_s), spin = vectorOf(act.spin_rad_s);
  if (found.kind == ObjectPlace::Kind::ball) {
    BallState state = world_->ball(found.index);
    state.velocity_m_s = velocity;
    state.spin_rad_s = spin;
    world_->setBall(found.index, state);
  } else if (found.kind == ObjectPlace::Kind::obstacle) {
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
  const auto taken = [&](const auto& specs) { return indexOf(specs, name) < specs.size(); };
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
  const ObjectPlace found = placeOf(game_.scene, act.object, "object");
  Game game = game_;
  const auto at = static_cast<std::ptrdiff_t>(found.index);
  if (found.kind == ObjectPlace::Kind::robot) game.scene.robots.erase(game.scene.robots.begin() + at);
  if (found.kind == ObjectPlace::Kind::ball) game.scene.balls.erase(game.scene.balls.begin() + at);
  if (found.kind == ObjectPlace::Kind::obstacle) game.scene.obstacles.erase(game.scene.obstacles.begin() + at);
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

void Session::change(const PullAct& act) {
  const ObjectPlace found = placeOf(game_.scene, act.object, "object");
  if (!act.link.empty() &&
      (found.kind != ObjectPlace::Kind::robot || scene_.robots[found.index].model.findLink(act.link) < 0))
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
    btr::check(*declared, *act.value, act.robot + " " + act.name);
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
  check(game, host_);
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

/// A robot's own simulator, which it gets if it has none yet; with "" that of all others.
SimulatorSpec& Session::simulatorOf(Game& game, const std::string& robot) const {
  if (robot.empty()) return game.simulator;
  robotOf(robot);
  GameRobot& player = game.robots[robot];
  if (!player.simulator) player.simulator = game.simulator;
  return *player.simulator;
}

void Session::change(const NumberAct& act) {
  Game game = game_;
  SimulatorSpec& simulator = simulatorOf(game, act.robot);
  if (act.value)
    simulator.values[act.name] = *act.value;
  else if (simulator.values.erase(act.name) == 0)
    throw InputError("name", "\"" + act.name + "\"", "a number that was changed");
  rebuild(std::move(game), world_->memory());
}

void Session::change(const EffectAct& act) {
  Game game = game_;
  SimulatorSpec& simulator = simulatorOf(game, act.robot);
  const auto same = [&](const PlacedEffect& each) {
    return each.effect == act.effect.effect && each.at == act.effect.at;
  };
  const auto found = std::ranges::find_if(simulator.effects, same);
  if (act.there) {
    if (found != simulator.effects.end())
      found->parameters = act.effect.parameters;
    else
      simulator.effects.push_back(act.effect);
  } else if (found == simulator.effects.end()) {
    throw InputError("effect", act.effect.text(), "an effect that is there");
  } else {
    simulator.effects.erase(found);
  }
  rebuild(std::move(game), world_->memory());
}

void Session::change(const SimulatorAct& act) {
  Game game = game_;
  if (act.robot.empty()) {
    game.simulator = act.simulator.value_or(SimulatorSpec{});
  } else {
    robotOf(act.robot);
    game.robots[act.robot].simulator = act.simulator;
  }
  rebuild(std::move(game), world_->memory());
}

}  // namespace btr
