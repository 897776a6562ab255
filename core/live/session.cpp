#include "core/live/session.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/live/session_objects.h"
#include "core/live/session_players.h"
#include "core/spec/error.h"

namespace btr {
namespace {

constexpr long goodEvery = 12;  ///< control periods, a tenth of a second of the standard ones

/// True of what comes many times a period from other programs and needs no look: robot and joint must be there anyway.
bool canBeLogged(const Act& act) {
  constexpr double largest = 1e12;
  const auto* hold = std::get_if<HoldAct>(&act);
  return hold && hold->position && std::abs(*hold->position) <= largest && !hold->command;
}

}  // namespace

Session::Session(Game game, const PluginHost& host, Watchdog* dog, CameraMaker cameras)
    : host_(host), makeCamera_(std::move(cameras)), dog_(dog) {
  checkPlayers(game, host);
  if (game.referee) field_ = fieldOf(game);
  models_ = loadModels(game.scene);
  Scene scene = sceneOf(game, models_, host);
  sensing_ = sensingOf(game, scene);
  world_ = worldOf(game, scene, nullptr);
  scene_ = std::move(scene);
  game_ = std::move(game);
  if (!world_->fault().empty()) throw InputError("game: at its start " + world_->fault());
  std::map<std::string, double> clocks;
  std::map<std::string, std::vector<double>> memories;
  Commands commands;
  orders_ = ordersOf(game_, game_.state ? game_.state->orders : std::map<std::string, Orders>{});
  if (game_.state) {
    for (const RobotMemory& robot : game_.state->world.robots)
      if (const auto i = objects::indexOf(game_.scene.robots, robot.name); i == game_.scene.robots.size())
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
  const auto i = objects::indexOf(game_.scene.robots, name);
  if (i < game_.scene.robots.size()) return i;
  std::string known;
  for (const RobotSpec& robot : game_.scene.robots) known += (known.empty() ? ": " : ", ") + robot.name;
  throw InputError("robot", "\"" + name + "\"", "a robot of this game" + known);
}

std::size_t Session::jointOf(std::size_t robot, const std::string& joint) const {
  const RobotModel& model = scene_.robots[robot].model;
  const int index = model.findJoint(joint);
  if (index < 0 || model.joints[static_cast<std::size_t>(index)].type == Joint::Type::fixed)
    throw InputError("joint", "\"" + joint + "\"", "a joint of " + game_.scene.robots[robot].name + " that moves");
  return static_cast<std::size_t>(index);
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

void Session::measureContacts(bool on) {
  contacts_ = on;
  world_->measureForces(on);
}

void Session::step() {
  if (!fault_.empty()) return;
  const double period = scene_.controlPeriod_s;
  askEyes();
  for (std::size_t i = 0; i < scene_.robots.size(); ++i) {
    const std::string& name = scene_.robots[i].name;
    if (const auto found = players_.find(name); found != players_.end()) {
      Player& player = found->second;
      const bool repeats = game_.robots.at(name).controller->repeats, asked = player.isAsked(period, repeats);
      if (repeats && player.isOver(period)) player = playerOf(game_, scene_, name, 0);
      if (asked) askController(i, player);
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

void Session::apply(const Act& act) {
  if (!fault_.empty()) throw InputError("session", fault_, "a session that goes on; open the game again");
  // Nothing that a log could not say.
  if (!canBeLogged(act)) actFromJson(toJson(act).dump(), "act");
  std::visit([this](const auto& each) { change(each); }, act);
  if (logged_) logged_(periods_, act);
}

void Session::rebuild(Game game, const WorldMemory& memory) {
  checkPlayers(game, host_);
  // A robot's file is read once a session, however often something else comes or goes.
  ModelSet models = loadModels(game.scene, game.scene.directory == game_.scene.directory ? models_ : ModelSet{});
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
    if (!world_->fault().empty()) throw InputError("game: at its start " + world_->fault());
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

}  // namespace btr
