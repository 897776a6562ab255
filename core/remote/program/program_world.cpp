#include "core/remote/program/program_world.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/model/model_json.h"

namespace btr::remote {
namespace {

namespace v1 = ::uchilsim::v1;
using nlohmann::json;
using Stub = v1::Worlds::Stub;

/// A world that is closed again, whatever happens.
class OwnWorld {
 public:
  OwnWorld(ServerLink& server, const v1::OpenRequest& request)
      : server_(server), world(server.ask(&Stub::Open, request)) {}
  ~OwnWorld() {
    if (closed_) return;
    try {
      close();
    } catch (const InputError&) {
      // What ended the program stands first; the server closes a world that nobody calls.
    }
  }
  OwnWorld(const OwnWorld&) = delete;
  OwnWorld& operator=(const OwnWorld&) = delete;

  std::string close() {
    closed_ = true;
    v1::CloseRequest request;
    request.set_world(world.world());
    return server_.ask(&Stub::Close, request).trace_sha256();
  }

 private:
  ServerLink& server_;
  bool closed_ = false;

 public:
  const v1::World world;
};

v1::RobotReply robotOf(ServerLink& server, const std::string& world, const std::string& robot) {
  v1::RobotRequest request;
  request.set_world(world);
  request.set_robot(robot);
  return server.ask(&Stub::Robot, request);
}

v1::World describe(ServerLink& server, const std::string& world) {
  v1::DescribeRequest request;
  request.set_world(world);
  return server.ask(&Stub::Describe, request);
}

/// The game as it would be with the behaviour as the robot's plugin: its posture, its senses, but nobody who moves it.
v1::OpenRequest gameFor(ServerLink& server, const ::uchilsim::BehaviourController& controller,
                        const ProgramPlan& plan) {
  v1::OpenRequest request;
  request.set_game(plan.game);
  request.set_unlogged(true);
  request.add_without_controller(plan.robot);
  OwnWorld asItIs(server, request);
  const std::string& world = asItIs.world.world();
  const v1::RobotReply robot = robotOf(server, world, plan.robot);
  v1::GetRequest get;
  get.set_world(world);
  if (server.ask(&Stub::Get, get).period() != 0)
    throw InputError("--game", plan.game,
                     "a game that was not saved in its middle; open it elsewhere and name its --world");
  json game = json::parse(describe(server, world).game_json());
  asItIs.close();

  json& player = game["robots"][plan.robot];
  player.erase("controller");
  const RobotModel model = modelFromJson(robot.model_json(), "the server's model of " + plan.robot);
  if (const std::vector<double> posture = controller.posture(model);
      !posture.empty() && player.value("posture", json(true)) != json(false)) {
    player["posture"] = json::object();
    for (std::size_t j = 0; j < posture.size(); ++j)
      if (model.joints[j].type != Joint::Type::fixed) player["posture"][model.joints[j].name] = posture[j];
  }
  for (const SenseSpec& sense : controller.senses())
    if (std::ranges::find(robot.senses(), sense.sense) == robot.senses().end())
      player["senses"].push_back({{"sense", sense.sense}, {"parameters", sense.parameters}});
  request.clear_game();
  request.clear_without_controller();
  request.set_game_json(game.dump());
  request.set_unlogged(!plan.logged);
  if (plan.seed) request.set_seed(*plan.seed);
  return request;
}

/// The pictures of a robot's camera, as they come.
class Camera {
 public:
  Camera(ServerLink& server, const std::string& world, const std::string& robot) : server_(server) {
    request_.set_world(world);
    request_.set_robot(robot);
  }
  const CameraPicture* look() {
    const v1::PictureReply reply = server_.ask(&Stub::Picture, request_);
    if (reply.number() == 0) return nullptr;
    request_.set_after(reply.number());
    picture_ = {reply.width(),
                reply.height(),
                {reply.rgb().begin(), reply.rgb().end()},
                {reply.classes().begin(), reply.classes().end()}};
    return &picture_;
  }

 private:
  ServerLink& server_;
  v1::PictureRequest request_;
  CameraPicture picture_;
};

bool saysSomething(const v1::Orders& orders) {
  return !orders.targets().empty() || !orders.gains().empty() || !orders.enabled().empty() || !orders.lamps().empty();
}

class Play {
 public:
  Play(ServerLink& server, const ::uchilsim::BehaviourController& controller, const PlayedMotion& played,
       const ProgramPlan& plan, const v1::World& world)
      : server_(server),
        plan_(plan),
        world_(world.world()),
        player_(controller, played, world, robotOf(server, world_, plan.robot), plan.robot) {
    if (controller.looks()) camera_.emplace(server, world_, plan.robot);
    outcome_.period_s = world.control_period_s();
    most_ = plan.seconds > 0 ? std::lround(plan.seconds / outcome_.period_s) : -1;
    wanted_.mutable_channels()->Add(player_.channels().begin(), player_.channels().end());
  }

  ProgramOutcome run() {
    v1::GetRequest get;
    get.set_world(world_);
    *get.mutable_wanted() = wanted_;
    const v1::State state = server_.ask(&Stub::Get, get);
    episode_ = state.episode();
    if (state.playing())
      follow();
    else
      drive(state);
    return outcome_;
  }

 private:
  bool ends(const v1::State& state) {
    outcome_.fault = state.fault();
    if (state.episode() != episode_) throw InputError("world", world_, "a world that nobody resets meanwhile");
    return !state.fault().empty() || (most_ >= 0 && outcome_.periods >= most_) || player_.isOver() ||
           (plan_.stopped && plan_.stopped());
  }

  v1::StepRequest answerTo(const v1::State& state, long periods) {
    v1::Orders orders = player_.play(state, camera_ ? camera_->look() : nullptr, periods);
    v1::StepRequest request;
    request.set_world(world_);
    *request.mutable_wanted() = wanted_;
    if (saysSomething(orders)) *request.add_acts()->mutable_orders() = std::move(orders);
    return request;
  }

  /// The world waits for each step.
  void drive(v1::State state) {
    grpc::ClientContext context;
    server_.identify(context);
    const auto steps = server_.stub().Steps(&context);
    while (!ends(state)) {
      v1::StepRequest request = answerTo(state, 1);
      request.set_periods(1);
      if (!steps->Write(request) || !steps->Read(&state)) {
        server_.expect(steps->Finish());
        throw InputError("world", world_, "one that goes on; the server ended it");
      }
      ++outcome_.periods;
    }
    steps->WritesDone();
    server_.expect(steps->Finish());
  }

  /// The world goes on by itself.
  void follow() {
    grpc::ClientContext context;
    server_.identify(context);
    v1::WatchRequest request;
    request.set_world(world_);
    *request.mutable_wanted() = wanted_;
    constexpr double often_hz = 1000;
    request.set_rate_hz(often_hz);
    const auto watch = server_.stub().Watch(&context, request);
    v1::State state;
    std::optional<std::int64_t> last;
    while (watch->Read(&state)) {
      if (ends(state)) {
        context.TryCancel();
        watch->Finish();
        return;
      }
      if (last && state.period() == *last) continue;
      const long gone = last ? static_cast<long>(state.period() - *last) : 1;
      last = state.period();
      outcome_.late += gone - 1;
      ++outcome_.periods;
      const v1::StepRequest answer = answerTo(state, gone);
      if (!answer.acts().empty()) server_.ask(&Stub::Step, answer);
    }
    server_.expect(watch->Finish());
  }

  ServerLink& server_;
  const ProgramPlan& plan_;
  std::string world_;
  RobotPlayer player_;
  std::optional<Camera> camera_;
  v1::Wanted wanted_;
  ProgramOutcome outcome_;
  long most_ = -1;
  std::int64_t episode_ = 0;
};

}  // namespace

ProgramOutcome playOnServer(ServerLink& server, const ::uchilsim::BehaviourController& controller,
                            const PlayedMotion& played, const ProgramPlan& plan) {
  if (!plan.world.empty()) return Play(server, controller, played, plan, describe(server, plan.world)).run();
  OwnWorld own(server, gameFor(server, controller, plan));
  ProgramOutcome outcome = Play(server, controller, played, plan, own.world).run();
  outcome.log = own.world.log();
  outcome.traceSha256 = own.close();
  return outcome;
}

}  // namespace btr::remote
