#include "core/remote/world_desk.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/remote/act_messages.h"
#include "core/remote/clock.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "uchilsim.pb.h"

namespace btr::remote {
namespace {

namespace v1 = uchilsim::v1;
namespace fs = std::filesystem;

constexpr double workAtMost_s = 0.03;   ///< then calls are looked at again
constexpr double behindAtMost_s = 0.2;  ///< what cannot be caught up is given up

void requireFewObjects(const Game& game) {
  const std::size_t count = game.scene.robots.size() + game.scene.balls.size() + game.scene.obstacles.size();
  if (count > WorldDesk::mostObjects)
    throw InputError("game", std::to_string(count) + " objects", "at most " + std::to_string(WorldDesk::mostObjects));
}

/// The host says which programs run on his machine.
[[noreturn]] void refuseStick(const std::string& place) {
  throw InputError(place, "openr", "a controller plugin in what a client sends");
}

Game withoutSticks(Game game) {
  for (const auto& [name, robot] : game.robots)
    if (robot.hasStick()) refuseStick("game_json /robots/" + name + "/controller");
  return game;
}

const char* nameOf(Drive::Kind kind) {
  switch (kind) {
    case Drive::Kind::servo:
      return "servo";
    case Drive::Kind::dcMotor:
      return "dc_motor";
    case Drive::Kind::torque:
      return "torque";
    case Drive::Kind::motion:
      return "motion";
    case Drive::Kind::none:
      break;
  }
  return "none";
}

std::vector<std::size_t> movingJoints(const SceneRobot& robot) {
  std::vector<std::size_t> moving;
  for (std::size_t j = 0; j < robot.model.joints.size(); ++j)
    if (robot.model.joints[j].type != Joint::Type::fixed) moving.push_back(j);
  return moving;
}

void describeRobot(const Session& session, const SceneRobot& robot, const PluginHost& host, v1::RobotParts& out) {
  out.set_name(robot.name);
  for (const std::size_t j : movingJoints(robot)) {
    const Joint& joint = robot.model.joints[j];
    v1::JointParts& parts = *out.add_joints();
    parts.set_name(joint.name);
    parts.set_minimum(joint.lower);
    parts.set_maximum(joint.upper);
    parts.set_drive(nameOf(robot.drives[j].kind));
  }
  for (const Link& link : robot.model.links) out.add_links(link.name);
  const auto player = session.game().robots.find(robot.name);
  if (player == session.game().robots.end() || !player->second.hasPlugin()) return;
  const GameController& controller = *player->second.controller;
  out.set_controller(controller.plugin);
  const std::vector<Parameter> genotype = host.controller(controller.plugin)->genotype();
  for (const Parameter& parameter : genotype) {
    v1::NumberParts& parts = *out.add_parameters();
    remote::describe(parameter, parts);
    parts.set_value(valueOf(genotype, controller.parameters, parameter.name));
  }
}

}  // namespace

WorldDesk::~WorldDesk() {
  // A log says where its session ended.
  try {
    end();
  } catch (const std::exception&) {
    // The disk is full: the log is whole up to its last act, as of a session that was killed.
  }
}

Session& WorldDesk::session() {
  if (!session_) throw Refusal(Code::notNow, "this world is not open");
  return *session_;
}

Game WorldDesk::gameOf(const v1::OpenRequest& request) const {
  if (request.game().empty() == request.game_json().empty())
    throw InputError("open", "both or none of game and game_json", "one of them");
  if (request.game_json().empty())
    return loadGame(folder_.file(request.game(), {".json", ".wrl", ".urdf", ".xacro"}, "game"));
  const std::string directory = folder_.folder(request.directory(), "directory");
  requireShallow(request.game_json(), "game_json");
  JsonReader reader = JsonReader::parse(request.game_json(), "game_json");
  folder_.judgeGame(reader.node(), directory, "game_json");
  if (reader.word("format", {"uchilsim-game-1", "uchilsim-scene-1"}) == "uchilsim-game-1")
    return withoutSticks(gameFromJson(request.game_json(), "game_json", directory));
  Game game;
  game.scene = sceneFromJson(request.game_json(), "game_json", directory);
  game.pitch = pitchFromJson(request.game_json(), "game_json");
  return game;
}

std::string WorldDesk::open(const v1::OpenRequest& request) {
  Game game = gameOf(request);
  requireFewObjects(game);
  if (request.has_seed()) game.seed = request.seed();
  logged_ = folder_.writable() && !request.unlogged();
  // The file that the log is bound to lies beside it.
  if (logged_) game = movedTo(std::move(game), (fs::path(folder_.path()) / GamesFolder::sessions).string());
  game_ = std::move(game);
  try {
    begin();
  } catch (...) {
    game_.reset();
    throw;
  }
  v1::World world;
  describe(world);
  return world.SerializeAsString();
}

// Files are written only for a game that can be played.
void WorldDesk::begin() {
  end();
  session_ = std::make_unique<Session>(*game_, host_);
  ++episode_;
  speed_ = 0;
  channels_ = session_->channels();
  chosen_.clear();
  chosenAt_.clear();
  if (!logged_) return;
  const std::string name = GamesFolder::sessions + ("/" + name_) + "-" + std::to_string(episode_);
  gameFile_ = folder_.toWrite(name + ".json", "log");
  logFile_ = fs::path(gameFile_).replace_extension(".log").string();
  writeFile(gameFile_, toJsonText(*game_));
  log_ = std::make_unique<SessionLogWriter>(logFile_, *game_);
  session_->onAct([this](long period, const Act& act) { log_->act(period, act); });
}

std::string WorldDesk::end() {
  if (!session_) return "";
  const std::string sha = session_->traceSha256();
  const long periods = session_->periods();
  session_.reset();
  const auto log = std::move(log_);
  if (log) log->end(periods, sha);
  return sha;
}

void WorldDesk::refreshChannels() {
  std::vector<std::string> now = session().channels();
  if (now == channels_) return;
  channels_ = std::move(now);
  channelsChanged_ = true;
  chosen_.clear();
  chosenAt_.clear();
}

void WorldDesk::apply(const Act& act) {
  const Session& now = session();
  if (const auto* add = std::get_if<AddAct>(&act)) {
    if (const auto* robot = std::get_if<RobotSpec>(&add->what))
      folder_.requireInside(robot->model, now.game().scene.directory, "act /robot/model");
    if (add->player.hasStick()) refuseStick("act /player/controller");
    Game game = now.game();
    game.scene.balls.emplace_back();
    requireFewObjects(game);
  }
  if (const auto* given = std::get_if<ControllerAct>(&act); given && given->controller && given->controller->openr)
    refuseStick("act /controller");
  session().apply(act);
  const bool samePlaces = std::holds_alternative<HoldAct>(act) || std::holds_alternative<PlaceAct>(act) ||
                          std::holds_alternative<ThrowAct>(act) || std::holds_alternative<PullAct>(act);
  if (!samePlaces) refreshChannels();
}

void WorldDesk::apply(const v1::Targets& targets, int row, int rows) {
  Session& world = session();
  const auto& robots = world.scene().robots;
  const auto robot = std::ranges::find_if(robots, [&](const SceneRobot& r) { return r.name == targets.robot(); });
  if (robot == robots.end()) throw InputError("targets", "\"" + targets.robot() + "\"", "a robot of this game");
  const std::vector<std::size_t> moving = movingJoints(*robot);
  const int n = static_cast<int>(moving.size()), given = targets.positions_size();
  if (given != n && given != n * rows)
    throw InputError("targets of " + robot->name, std::to_string(given) + " numbers",
                     std::to_string(n) + ", or as many for each period");
  if (row > 0 && given == n) return;
  const auto held = world.held().find(robot->name);
  for (int k = 0; k < n; ++k) {
    const std::string& joint = robot->model.joints[moving[static_cast<std::size_t>(k)]].name;
    const double position = targets.positions(row * n + k);
    if (held != world.held().end())
      if (const auto was = held->second.find(joint); was != held->second.end() && was->second == position) continue;
    world.apply(HoldAct{robot->name, joint, position});
  }
}

void WorldDesk::step(const v1::StepRequest& request) {
  if (request.periods() < 0 || request.periods() > mostPeriods)
    throw InputError("periods", std::to_string(request.periods()), "0 to " + std::to_string(mostPeriods));
  for (const v1::Targets& targets : request.targets())
    for (const double position : targets.positions())
      if (!std::isfinite(position)) throw InputError("targets of " + targets.robot(), "no number", "finite numbers");
  Session& world = session();
  for (const v1::Act& act : request.acts()) apply(actOf(act));
  const int rows = std::max(1, request.periods());
  for (int i = 0; i < rows && world.fault().empty(); ++i) {
    for (const v1::Targets& targets : request.targets()) apply(targets, i, rows);
    if (request.periods() > 0) onePeriod();
  }
}

void WorldDesk::onePeriod() {
  session().step();
  for (auto& each : cameras_) look(each.first);
}

// A camera that fails ends alone: the world goes on, and who asks for a picture is told why.
void WorldDesk::look(const std::string& robot) {
  Camera& camera = cameras_.at(robot);
  if (!camera.eye) return;
  try {
    if (auto picture = camera.eye->look(session())) {
      camera.picture = std::move(*picture);
      camera.period = session().periods();
      ++camera.number;
    }
  } catch (const InputError& error) {
    camera.eye.reset();
    camera.why = error.what();
  }
}

std::string WorldDesk::picture(const v1::PictureRequest& request) {
  if (!makeCamera_) throw Refusal(Code::notThere, "this server has no cameras; btr live --camera renders them");
  const auto& robots = session().scene().robots;
  if (std::ranges::none_of(robots, [&](const SceneRobot& r) { return r.name == request.robot(); }))
    throw InputError("robot", "\"" + request.robot() + "\"", "a robot of this game");
  if (!cameras_.contains(request.robot())) {
    if (cameras_.size() >= mostCameras)
      throw Refusal(Code::tooMuch, "more than " + std::to_string(mostCameras) + " cameras of a world");
    cameras_[request.robot()].eye = makeCamera_(request.robot());
    look(request.robot());
  }
  const Camera& camera = cameras_.at(request.robot());
  if (!camera.eye) {
    const std::string why = camera.why;
    cameras_.erase(request.robot());  // the next call tries again
    throw Refusal(Code::notNow, why);
  }
  v1::PictureReply reply;
  if (camera.number > request.after()) {
    reply.set_number(camera.number);
    reply.set_period(camera.period);
    reply.set_width(camera.picture.width);
    reply.set_height(camera.picture.height);
    reply.set_rgb(camera.picture.rgb.data(), camera.picture.rgb.size());
  }
  return reply.SerializeAsString();
}

void WorldDesk::describe(v1::World& out) {
  const Session& world = session();
  out.set_world(name_);
  out.set_control_period_s(world.scene().controlPeriod_s);
  out.set_episode(episode_);
  for (const std::string& channel : channels_) out.add_channels(channel);
  for (const SceneRobot& robot : world.scene().robots) describeRobot(world, robot, host_, *out.add_robots());
  for (const BallSpec& ball : world.game().scene.balls) out.add_balls(ball.name);
  for (const ObstacleSpec& obstacle : world.game().scene.obstacles) out.add_obstacles(obstacle.name);
  if (log_) out.set_log(folder_.shown(logFile_));
}

void WorldDesk::fillRow(const v1::Wanted& wanted, v1::State& out) {
  row_.clear();
  session().sample(row_);
  if (wanted.channels().empty()) {
    out.mutable_row()->Add(row_.begin(), row_.end());
    return;
  }
  if (!std::ranges::equal(wanted.channels(), chosen_)) {
    std::vector<std::size_t> at;
    for (const std::string& channel : wanted.channels()) {
      const auto found = std::ranges::find(channels_, channel);
      if (found == channels_.end())
        throw InputError("wanted channels", "\"" + channel + "\"", "a channel of this world");
      at.push_back(static_cast<std::size_t>(found - channels_.begin()));
    }
    chosenAt_ = std::move(at);
    chosen_.assign(wanted.channels().begin(), wanted.channels().end());
  }
  for (const std::size_t i : chosenAt_) out.add_row(row_[i]);
}

std::string WorldDesk::state(const v1::Wanted& wanted) {
  Session& world = session();
  v1::State out;
  out.set_world(name_);
  out.set_episode(episode_);
  out.set_period(world.periods());
  out.set_time_s(world.time_s());
  out.set_fault(world.fault());
  out.set_playing(speed_ > 0);
  fillRow(wanted, out);
  if (channelsChanged_)
    for (const std::string& channel : channels_) out.add_channels(channel);
  channelsChanged_ = false;
  if (wanted.links())
    for (std::size_t i = 0; i < world.scene().robots.size(); ++i) {
      v1::LinkPoses& poses = *out.add_links();
      for (const Eigen::Isometry3d& pose : world.world().linkPoses(i)) {
        const Eigen::Vector3d p = pose.translation();
        const Eigen::Quaterniond q(pose.linear());
        for (const double number : {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()}) poses.add_pose(number);
      }
    }
  if (wanted.contacts()) {
    if (!world.measuresContacts()) world.measureContacts(true);
    for (const ContactForce& contact : world.world().contactForces()) {
      const auto& [p, f] = contact;
      v1::Contact& each = *out.add_contacts();
      each.set_x_m(p.x());
      each.set_y_m(p.y());
      each.set_z_m(p.z());
      each.set_fx_n(f.x());
      each.set_fy_n(f.y());
      each.set_fz_n(f.z());
    }
  }
  if (const RefereeState* referee = world.referee()) {
    out.mutable_score()->set_red(referee->red);
    out.mutable_score()->set_blue(referee->blue);
    out.mutable_score()->set_half(referee->half);
    out.mutable_score()->set_over(referee->over);
  }
  return out.SerializeAsString();
}

std::string WorldDesk::answer(Method method, std::string_view message) {
  switch (method) {
    case Method::open: {
      // The server puts the world's name in front: 16 letters.
      constexpr std::size_t nameLength = 16;
      if (message.size() < nameLength) throw Refusal(Code::invalid, "a world without a name");
      const auto request = messageOf<v1::OpenRequest>(message.substr(nameLength));
      if (game_) throw Refusal(Code::notNow, "this world is open already");
      name_ = message.substr(0, nameLength);
      return open(request);
    }
    case Method::describe: {
      v1::World world;
      describe(world);
      world.set_game_json(toJsonText(movedTo(session().game(), folder_.path())));
      return world.SerializeAsString();
    }
    case Method::get:
      return state(messageOf<v1::GetRequest>(message).wanted());
    case Method::reset: {
      const auto request = messageOf<v1::ResetRequest>(message);
      session();
      if (request.has_seed()) game_->seed = request.seed();
      begin();
      cameras_.clear();
      for (const v1::Act& act : request.acts()) apply(actOf(act));
      return state(request.wanted());
    }
    case Method::step: {
      const auto request = messageOf<v1::StepRequest>(message);
      step(request);
      return state(request.wanted());
    }
    case Method::pose: {
      const auto request = messageOf<v1::PoseRequest>(message);
      for (const Act& act : actsOf(request)) apply(act);
      v1::PosesReply reply;
      reply.set_taken(1);
      reply.set_last_period(session().periods());
      return reply.SerializeAsString();
    }
    case Method::play: {
      const auto request = messageOf<v1::PlayRequest>(message);
      if (!(request.speed() >= 0 && request.speed() <= fastestPlay))
        throw InputError("speed", toText(request.speed()), "0 to " + toText(fastestPlay));
      anchorPeriods_ = session().periods();
      anchor_s_ = now_s();
      speed_ = request.speed();
      return state({});
    }
    case Method::save: {
      const auto request = messageOf<v1::SaveRequest>(message);
      v1::SaveReply reply;
      if (!request.file().empty()) {
        const std::string path = folder_.toWrite(request.file(), "file"), directory = fs::path(path).parent_path();
        reply.set_game_json(toJsonText(movedTo(session().save(), directory)));
        fs::create_directories(directory);
        writeFile(path, reply.game_json());
      } else {
        reply.set_game_json(toJsonText(movedTo(session().save(), folder_.path())));
      }
      return reply.SerializeAsString();
    }
    case Method::close: {
      session();
      v1::CloseReply reply;
      reply.set_trace_sha256(end());
      return reply.SerializeAsString();
    }
    case Method::picture:
      return picture(messageOf<v1::PictureRequest>(message));
    case Method::logFiles:
      if (!log_) throw Refusal(Code::notNow, "this world is not logged");
      return gameFile_ + '\n' + logFile_;
    default:
      throw Refusal(Code::notThere, "a world does not answer this");
  }
}

double WorldDesk::patience_s() const {
  if (speed_ <= 0 || !session_) return -1;
  const double period = session_->scene().controlPeriod_s / speed_;
  const double due = anchor_s_ + static_cast<double>(session_->periods() - anchorPeriods_ + 1) * period;
  return std::max(0.0, due - now_s());
}

void WorldDesk::goOn() {
  if (speed_ <= 0 || !session_) return;
  const double begun = now_s(), period = session_->scene().controlPeriod_s;
  const auto due = [&] { return anchorPeriods_ + std::lround(std::floor((now_s() - anchor_s_) * speed_ / period)); };
  while (session_->periods() < due() && session_->fault().empty() && now_s() - begun < workAtMost_s) onePeriod();
  if (!session_->fault().empty()) speed_ = 0;
  if (static_cast<double>(due() - session_->periods()) * period / std::max(speed_, 1e-9) > behindAtMost_s) {
    anchor_s_ = now_s();
    anchorPeriods_ = session_->periods();
  }
}

}  // namespace btr::remote
