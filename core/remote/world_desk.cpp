#include "core/remote/world_desk.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
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

}  // namespace

WorldDesk::~WorldDesk() {
  // A log says where its session ended.
  try {
    end();
  } catch (const std::exception& error) {
    // The disk may be full: the log is whole up to its last act, as of a session that was killed.
    std::fprintf(stderr, "the log of a world has no end: %s\n", error.what());
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
  for (const std::string& robot : request.without_controller()) {
    if (std::none_of(game.scene.robots.begin(), game.scene.robots.end(),
                     [&robot](const RobotSpec& one) { return one.name == robot; }))
      throw InputError("without_controller", "\"" + robot + "\"", "a robot of this game");
    if (const auto player = game.robots.find(robot); player != game.robots.end()) player->second.controller.reset();
  }
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

std::unique_ptr<StickPrograms> WorldDesk::programsOf(Session& session) const {
  for (const auto& [name, player] : session.game().robots)
    if (player.hasStick()) {
      if (makePrograms_) return makePrograms_(session);
      throw InputError("robots " + name + "/controller", "openr",
                       "a controller plugin: this server runs no OPEN-R programs");
    }
  return nullptr;
}

void WorldDesk::type(const v1::TypeRequest& request) {
  session();
  if (request.text().size() > mostTypedBytes)
    throw InputError("text", std::to_string(request.text().size()) + " bytes",
                     "at most " + std::to_string(mostTypedBytes));
  if (!programs_) throw InputError("robot", "\"" + request.robot() + "\"", "a robot whose OPEN-R program runs");
  programs_->type(request.robot(), request.text());
}

void WorldDesk::keepLines() {
  if (!programs_) return;
  const auto bytesOf = [](const StickPrograms::Line& line) {
    return line.robot.size() + line.object.size() + line.text.size();
  };
  for (StickPrograms::Line& line : programs_->takeLines()) {
    saidBytes_ += bytesOf(line);
    ++lastLine_;
    said_.push_back({session().periods(), std::move(line)});
    while (said_.size() > mostLines || (said_.size() > 1 && saidBytes_ > mostLineBytes)) {
      saidBytes_ -= bytesOf(said_.front().line);
      said_.pop_front();
    }
  }
}

// Files are written only for a game that can be played.
void WorldDesk::begin() {
  end();
  auto session = std::make_unique<Session>(*game_, host_, nullptr, makeCamera_);
  programs_ = programsOf(*session);
  session_ = std::move(session);
  session_->onAct([this](long period, const Act& act) {
    if (log_) log_->act(period, act);
    if (programs_) programs_->acted(act);
  });
  ++episode_;
  speed_ = 0;
  for (auto& [robot, camera] : cameras_) camera = {nullptr, {}, camera.number, 0, {}, nullptr};
  if (channels_.empty()) {
    channels_ = session_->channels();
    channelsTold_ = ++channelsVersion_;  // by what opens the world
  } else {
    refreshChannels();
  }
  if (!logged_) return;
  const std::string name = GamesFolder::sessions + ("/" + name_) + "-" + std::to_string(episode_);
  gameFile_ = folder_.toWrite(name + ".json", "log");
  logFile_ = fs::path(gameFile_).replace_extension(".log").string();
  writeFile(gameFile_, toJsonText(*game_));
  log_ = std::make_unique<SessionLogWriter>(logFile_, *game_);
}

std::string WorldDesk::end() {
  if (!session_) return "";
  if (programs_) programs_->end();
  keepLines();
  programs_.reset();
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
  ++channelsVersion_;
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
                          std::holds_alternative<ThrowAct>(act) || std::holds_alternative<PullAct>(act) ||
                          std::holds_alternative<OrdersAct>(act);
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
  for (const v1::Act& act : request.acts()) {
    betweenPieces();
    apply(actOf(act));
  }
  const int rows = std::max(1, request.periods());
  for (int i = 0; i < rows && world.fault().empty(); ++i) {
    if (i > 0) betweenPieces();
    for (const v1::Targets& targets : request.targets()) apply(targets, i, rows);
    if (request.periods() > 0) onePeriod();
  }
}

bool WorldDesk::onePeriod() {
  if (programs_) programs_->step();
  keepLines();
  session().step();
  if (log_ && session().periods() % SessionLog::markEvery == 0) log_->mark(session().periods(), session().mark());
  bool pictures = false;
  for (auto& each : cameras_)
    if (each.second.eye) each.second.eye->ask(session());
  for (auto& each : cameras_) pictures = look(each.first) || pictures;
  return pictures;
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
    case Method::type:
      type(messageOf<v1::TypeRequest>(message));
      return v1::TypeReply().SerializeAsString();
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
    case Method::pictureMemory:
      return pictureMemory(messageOf<v1::PictureMemoryRequest>(message));
    case Method::robot:
      return robot(messageOf<v1::RobotRequest>(message).robot());
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
  // A picture goes to whoever waits for it before the next one takes its place.
  bool pictures = false;
  while (session_->periods() < due() && session_->fault().empty() && now_s() - begun < workAtMost_s && !pictures)
    pictures = onePeriod();
  if (!session_->fault().empty()) speed_ = 0;
  if (static_cast<double>(due() - session_->periods()) * period / std::max(speed_, 1e-9) > behindAtMost_s) {
    anchor_s_ = now_s();
    anchorPeriods_ = session_->periods();
  }
}

}  // namespace btr::remote
