// One world and what clients do to it, without a network.
#include "core/remote/world_desk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "tests/remote/remote_folder.h"
#include "uchilsim.pb.h"

namespace {

using namespace btr;
using namespace btr::remote;
using namespace btr::test;
using testing::HasSubstr;
namespace v1 = uchilsim::v1;
namespace fs = std::filesystem;

class WorldDeskTest : public testing::Test {
 protected:
  v1::World open(const std::string& game, bool unlogged = false) {
    v1::OpenRequest request;
    request.set_game(game);
    request.set_unlogged(unlogged);
    return answered<v1::World>(desk, Method::open, request, worldName);
  }
  v1::State step(int periods, const std::function<void(v1::StepRequest&)>& settle = {}) {
    v1::StepRequest request;
    request.set_periods(periods);
    if (settle) settle(request);
    return answered<v1::State>(desk, Method::step, request);
  }
  double value(const v1::State& state, const std::string& channel) const {
    const auto at = std::ranges::find(world.channels(), channel);
    return state.row(static_cast<int>(at - world.channels().begin()));
  }
  std::string stepRefused(const std::function<void(v1::StepRequest&)>& settle) {
    v1::StepRequest request;
    request.set_periods(1);
    settle(request);
    return refused(desk, Method::step, request);
  }

  RemoteFolder files;
  GamesFolder folder{files.server().string(), true};
  WorldDesk desk{plugins(), folder};
  v1::World world;
};

/// Plays a log again, without any client; the hash of its trace.
std::string replayed(const fs::path& gameFile, const fs::path& logFile) {
  const SessionLog log = loadSessionLog(logFile.string());
  const Game game = loadGame(gameFile.string());
  EXPECT_EQ(log.gameSha256, gameSha256(game));
  Session session(game, plugins());
  std::size_t next = 0;
  while (true) {
    while (next < log.acts.size() && log.acts[next].period <= session.periods()) session.apply(log.acts[next++].act);
    if (session.periods() >= log.periods) break;
    session.step();
  }
  const std::string sha = session.traceSha256();
  EXPECT_EQ(log.traceSha256, sha);
  return sha;
}

TEST_F(WorldDeskTest, FallsAsABallDoes) {
  world = open("ball.json");
  EXPECT_EQ(0.008, world.control_period_s());
  const v1::State state = step(10);
  EXPECT_EQ(10, state.period());
  EXPECT_NEAR(0.2 - 9.81 * 0.08 * 0.08 / 2, value(state, "ball.z_m"), 1e-9);
}

TEST_F(WorldDeskTest, AControllerThatIsLeftOutNeedNotBeThere) {
  nlohmann::json game = nlohmann::json::parse(RemoteFolder::dogGame());
  game["robots"]["red1"] = {{"controller", {{"plugin", "somebody_elses"}}}};
  files.write("theirs.json", game.dump());
  v1::OpenRequest request;
  request.set_game("theirs.json");
  EXPECT_THAT(refused(desk, Method::open, request, worldName), HasSubstr("somebody_elses"));
  request.add_without_controller("cat");
  EXPECT_THAT(refused(desk, Method::open, request, worldName), HasSubstr("without_controller"));
  request.set_without_controller(0, "red1");
  world = answered<v1::World>(desk, Method::open, request, worldName);
  ASSERT_EQ(1, world.robots_size());
  EXPECT_EQ("", world.robots(0).controller());
  EXPECT_EQ(3, step(3).period());
}

TEST_F(WorldDeskTest, ItsLogPlaysAgainWithTheSameBitsWithoutTheClient) {
  world = open("dog.json");
  EXPECT_EQ("sessions/" + std::string(worldName) + "-1.log", world.log());
  const int joints = world.robots(0).joints_size();
  for (int i = 0; i < 20; ++i)
    step(3, [&](v1::StepRequest& request) {
      v1::Targets& targets = *request.add_targets();
      targets.set_robot("red1");
      for (int k = 0; k < joints; ++k) targets.add_positions(0.1 * std::sin(0.3 * i + k));
      if (i == 5) {
        v1::Throw& thrown = *request.add_acts()->mutable_throw_();
        thrown.set_object("ball");
        for (const double v : {-1.0, 0.1, 0.5}) thrown.add_velocity_m_s(v);
      }
      if (i == 7)
        request.add_acts()->set_json(R"({"act": "add", "ball": {"name": "b2", "position_m": [0.2, 0.2, 0.3]}})");
      if (i == 9) {
        v1::Number& number = *request.add_acts()->mutable_number();
        number.set_name("friction");
        number.set_value(0.4);
      }
      if (i == 11) request.add_acts()->set_remove("b2");
    });
  v1::PoseRequest pose;
  pose.set_object("ball");
  for (const double x : {0.2, 0.1, 0.3}) pose.add_position_m(x);
  for (const double v : {0.0, 0.5, 0.0}) pose.add_velocity_m_s(v);
  answered<v1::PosesReply>(desk, Method::pose, pose);
  step(5);
  const auto closed = answered<v1::CloseReply>(desk, Method::close, v1::CloseRequest());
  const fs::path log = files.server() / world.log();
  EXPECT_EQ(closed.trace_sha256(), replayed(fs::path(log).replace_extension(".json"), log));
}

TEST_F(WorldDeskTest, TheSameSeedGivesTheSameBitsAndEachEpisodeALogOfItsOwn) {
  open("dog.json");
  std::vector<std::string> rows;
  for (const std::uint64_t seed : {5, 6, 5}) {
    v1::ResetRequest reset;
    reset.set_seed(seed);
    EXPECT_EQ(0, answered<v1::State>(desk, Method::reset, reset).period());
    rows.push_back(step(40).SerializeAsString());
  }
  answered<v1::CloseReply>(desk, Method::close, v1::CloseRequest());
  const auto withoutEpisode = [](const std::string& bytes) {
    v1::State state;
    state.ParseFromString(bytes);
    state.set_episode(0);
    return state.SerializeAsString();
  };
  EXPECT_EQ(withoutEpisode(rows[0]), withoutEpisode(rows[2]));
  for (const char* episode : {"-1", "-2", "-3", "-4"}) {
    const fs::path log = files.server() / "sessions" / (std::string(worldName) + episode + ".log");
    replayed(fs::path(log).replace_extension(".json"), log);
  }
}

TEST_F(WorldDeskTest, TargetsOfEachPeriodAreToldInTurn) {
  world = open("dog.json", true);
  const int n = world.robots(0).joints_size();
  const v1::State once = step(4, [&](v1::StepRequest& request) {
    v1::Targets& targets = *request.add_targets();
    targets.set_robot("red1");
    for (int i = 0; i < 4 * n; ++i) targets.add_positions(0.01 * (i / n));
  });
  v1::ResetRequest reset;
  answered<v1::State>(desk, Method::reset, reset);
  v1::State each;
  for (int period = 0; period < 4; ++period)
    each = step(1, [&](v1::StepRequest& request) {
      v1::Targets& targets = *request.add_targets();
      targets.set_robot("red1");
      for (int k = 0; k < n; ++k) targets.add_positions(0.01 * period);
    });
  EXPECT_TRUE(std::ranges::equal(once.row(), each.row()));
}

TEST_F(WorldDeskTest, ASavedGameGoesOnWithTheSameBits) {
  open("dog.json");
  step(7);
  v1::SaveRequest save;
  save.set_file("mine/now.json");
  answered<v1::SaveReply>(desk, Method::save, save);
  const v1::State here = step(30);
  answered<v1::CloseReply>(desk, Method::close, v1::CloseRequest());
  WorldDesk other(plugins(), folder);
  v1::OpenRequest request;
  request.set_game("mine/now.json");
  answered<v1::World>(other, Method::open, request, "fedcba9876543210");
  v1::StepRequest on;
  on.set_periods(30);
  const v1::State there = answered<v1::State>(other, Method::step, on);
  EXPECT_TRUE(std::ranges::equal(here.row(), there.row()));
}

TEST_F(WorldDeskTest, WhatIsNotAllowedIsSaidInOneSentenceAndChangesNothing) {
  world = open("dog.json");
  const v1::State before = step(3);
  const std::string listing = files.listing();
  const auto act = [](const std::string& json) {
    return [json](v1::StepRequest& request) { request.add_acts()->set_json(json); };
  };
  EXPECT_THAT(stepRefused([](auto& r) { r.set_periods(-1); }), HasSubstr("periods: -1 is not allowed; 0 to 10000"));
  EXPECT_THAT(stepRefused([](auto& r) { r.set_periods(10001); }), HasSubstr("0 to 10000"));
  EXPECT_THAT(stepRefused([](auto& r) { r.add_acts(); }), HasSubstr("says nothing"));
  EXPECT_THAT(stepRefused([](auto& r) { r.add_targets()->set_robot("red2"); }), HasSubstr("a robot of this game"));
  EXPECT_THAT(stepRefused([](auto& r) {
                r.add_targets()->set_robot("red1");
                r.mutable_targets(0)->add_positions(0);
              }),
              HasSubstr("1 numbers"));
  EXPECT_THAT(stepRefused([](auto& r) {
                r.add_targets()->set_robot("red1");
                r.mutable_targets(0)->add_positions(std::numeric_limits<double>::quiet_NaN());
              }),
              HasSubstr("finite"));
  EXPECT_THAT(stepRefused(act("{")), HasSubstr("act"));
  EXPECT_THAT(stepRefused(act(std::string(100000, '['))), HasSubstr("levels"));
  EXPECT_THAT(stepRefused(act(R"({"act": "add", "robot": {"name": "r", "model": "../secret.wrl"}})")),
              HasSubstr("a file below the server's folder"));
  EXPECT_THAT(stepRefused(act(R"({"act": "add", "robot": {"name": "r", "model": "/etc/passwd"}})")),
              HasSubstr("a file below the server's folder"));
  EXPECT_THAT(stepRefused([](auto& r) {
                auto& place = *r.add_acts()->mutable_place();
                place.set_object("ball");
                for (const double x : {0.0, 0.0, 1e9}) place.add_position_m(x);
              }),
              HasSubstr("position_m"));
  v1::SaveRequest save;
  save.set_file("../out.json");
  EXPECT_THAT(refused(desk, Method::save, save), HasSubstr("below the server's folder"));
  v1::PlayRequest play;
  play.set_speed(std::numeric_limits<double>::infinity());
  EXPECT_THAT(refused(desk, Method::play, play), HasSubstr("speed"));
  EXPECT_EQ(listing, files.listing());
  const v1::State after = answered<v1::State>(desk, Method::get, v1::GetRequest());
  EXPECT_TRUE(std::ranges::equal(before.row(), after.row()));
  EXPECT_EQ(before.period(), after.period());
}

TEST_F(WorldDeskTest, AGameThatCannotBePlayedIsRefusedAndNothingIsWritten) {
  const std::string listing = files.listing();
  const auto said = [&](const std::function<void(v1::OpenRequest&)>& settle) {
    v1::OpenRequest request;
    settle(request);
    return refused(desk, Method::open, request, worldName);
  };
  EXPECT_THAT(said([](auto&) {}), HasSubstr("one of them"));
  EXPECT_THAT(said([](auto& r) { r.set_game("../dog.json"); }), HasSubstr("below the server's folder"));
  EXPECT_THAT(said([](auto& r) { r.set_game_json("{\"format\": 1}"); }), HasSubstr("format"));
  EXPECT_THAT(said([](auto& r) { r.set_game_json(R"({"format": "uchilsim-game-1", "scene": "/etc/passwd"})"); }),
              HasSubstr("below the server's folder"));
  EXPECT_THAT(said([](auto& r) {
                r.set_game_json(R"({"format": "uchilsim-game-1", "scene": {"format": "uchilsim-scene-1",
                  "robots": [{"name": "r", "model": "robots/ers7.wrl"}]},
                  "robots": {"r": {"controller": {"openr": {"stick": "/tmp"}}}}})");
              }),
              HasSubstr("openr"));
  EXPECT_THAT(said([](auto& r) {
                nlohmann::json scene{{"format", "uchilsim-scene-1"}, {"balls", nlohmann::json::array()}};
                for (int i = 0; i < 1001; ++i)
                  scene["balls"].push_back({{"name", "b" + std::to_string(i)}, {"position_m", {i, 0, 1}}});
                r.set_game_json(scene.dump());
              }),
              HasSubstr("at most 1000"));
  EXPECT_EQ(listing, files.listing());
  v1::StepRequest step;
  EXPECT_EQ("this world is not open", refused(desk, Method::step, step));
}

TEST_F(WorldDeskTest, ChannelsComeAndGoWithObjects) {
  world = open("dog.json");
  const v1::State more = step(0, [](auto& r) { r.add_acts()->set_json(R"({"act": "add", "ball": {"name": "b2"}})"); });
  EXPECT_GT(more.channels_size(), world.channels_size());
  EXPECT_EQ(more.channels_size(), more.row_size());
  EXPECT_EQ(0, step(1).channels_size());
  EXPECT_EQ(world.channels_size(), step(0, [](auto& r) { r.add_acts()->set_remove("b2"); }).channels_size());
  v1::GetRequest get;
  get.mutable_wanted()->add_channels("ball.z_m");
  get.mutable_wanted()->set_links(true);
  get.mutable_wanted()->set_contacts(true);
  const auto state = answered<v1::State>(desk, Method::get, get);
  EXPECT_EQ(1, state.row_size());
  EXPECT_EQ(7 * world.robots(0).links_size(), state.links(0).pose_size());
  v1::GetRequest many;
  for (int i = 0; i <= world.channels_size(); ++i) many.mutable_wanted()->add_channels("ball.z_m");
  EXPECT_THAT(refused(desk, Method::get, many), HasSubstr("at most " + std::to_string(world.channels_size())));
  get.mutable_wanted()->add_channels("ball.temperature");
  EXPECT_THAT(refused(desk, Method::get, get), HasSubstr("a channel of this world"));
}

TEST_F(WorldDeskTest, EverybodyIsToldWhichChannelsThereAre) {
  world = open("dog.json");
  v1::GetRequest first, second;
  first.mutable_wanted()->set_channels_known(world.channels_version());
  second = first;
  const auto got = [&](v1::GetRequest& request) {
    const auto state = answered<v1::State>(desk, Method::get, request);
    EXPECT_TRUE(state.channels_size() == 0 || state.channels_size() == state.row_size());
    request.mutable_wanted()->set_channels_known(state.channels_version());
    return state.channels_size();
  };
  EXPECT_EQ(0, got(first));
  // A third one, who does not say what he knows, adds an object and is told.
  const v1::State more = step(0, [](auto& r) { r.add_acts()->set_json(R"({"act": "add", "ball": {"name": "b2"}})"); });
  EXPECT_GT(more.channels_size(), world.channels_size());
  EXPECT_EQ(more.channels_size(), got(first));
  EXPECT_EQ(more.channels_size(), got(second));
  EXPECT_EQ(0, got(first));
  // A new beginning takes it away again.
  answered<v1::State>(desk, Method::reset, v1::ResetRequest());
  EXPECT_EQ(world.channels_size(), got(first));
  EXPECT_EQ(world.channels_size(), got(second));
  EXPECT_EQ(0, got(second));
}

TEST_F(WorldDeskTest, AProgramOrdersGainsTargetsAndLampsAndItsLogPlaysWithoutIt) {
  world = open("dog.json");
  const v1::JointParts& joint = world.robots(0).joints(0);
  const auto order = [](const std::function<void(v1::Orders&)>& settle) {
    return [settle](v1::StepRequest& request) {
      v1::Orders& orders = *request.add_acts()->mutable_orders();
      orders.set_robot("red1");
      settle(orders);
    };
  };
  for (int i = 0; i < 10; ++i)
    step(1, order([&](v1::Orders& orders) {
           (*orders.mutable_targets())[joint.name()] = 0.05 * i;
           if (i == 3) (*orders.mutable_gains())[joint.name()].set_p(0.5);
           if (i == 4) (*orders.mutable_lamps())["face_1"] = 1;
           if (i == 5) (*orders.mutable_enabled())[joint.name()] = false;
         }));
  EXPECT_NEAR(0.45, value(step(1), "red1." + joint.name() + ".command_rad"), 1e-12);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE("", stepRefused(order([&](v1::Orders& orders) { (*orders.mutable_targets())[joint.name()] = nan; })));
  EXPECT_THAT(stepRefused(order([](v1::Orders& orders) { (*orders.mutable_targets())["WING"] = 0; })),
              HasSubstr("WING"));
  EXPECT_THAT(stepRefused(order([](v1::Orders& orders) {
                for (int i = 0; i < 101; ++i) (*orders.mutable_lamps())["lamp" + std::to_string(i)] = 1;
              })),
              HasSubstr("100"));
  EXPECT_THAT(stepRefused(order([](v1::Orders& orders) { orders.set_robot("nobody"); })), HasSubstr("nobody"));
  const auto closed = answered<v1::CloseReply>(desk, Method::close, v1::CloseRequest());
  const fs::path log = files.server() / world.log();
  EXPECT_EQ(closed.trace_sha256(), replayed(fs::path(log).replace_extension(".json"), log));
}

TEST_F(WorldDeskTest, ARobotsModelIsToldToItsProgram) {
  world = open("dog.json");
  v1::RobotRequest request;
  request.set_robot("red1");
  const auto robot = answered<v1::RobotReply>(desk, Method::robot, request);
  const auto model = nlohmann::json::parse(robot.model_json());
  EXPECT_EQ(model.at("joints").size(), static_cast<std::size_t>(robot.start_size()));
  EXPECT_EQ(robot.start_size(), robot.commands_size());
  request.set_robot("nobody");
  EXPECT_THAT(refused(desk, Method::robot, request), HasSubstr("nobody"));
}

TEST_F(WorldDeskTest, ALongStepThatIsToBeLeftEndsWithAWholePeriod) {
  world = open("ball.json");
  int pieces = 0;
  desk.betweenPieces = [&] {
    if (++pieces == 5) throw Refusal(Code::cancelled, "the server ends");
  };
  EXPECT_EQ("the server ends", stepRefused([](auto& r) { r.set_periods(10000); }));
  EXPECT_EQ(5, pieces);
  EXPECT_EQ(5, answered<v1::State>(desk, Method::get, v1::GetRequest()).period());
  // Many acts are a long answer too.
  step(0, [](auto& r) {
    for (int i = 0; i < 3; ++i)
      r.add_acts()->set_json(R"({"act": "throw", "object": "ball", "velocity_m_s": [0, 0, 0]})");
  });
  EXPECT_EQ(8, pieces);
  answered<v1::CloseReply>(desk, Method::close, v1::CloseRequest());
  const fs::path log = files.server() / world.log();
  replayed(fs::path(log).replace_extension(".json"), log);
}

/// Every call answers, whatever its bytes, and no file appears where none may.
TEST_F(WorldDeskTest, AMillionDamagedCallsAreAnsweredAndNothingIsWrittenOutside) {
  google::protobuf::SetLogHandler(nullptr);
  open("ball.json");
  const std::string methods = "odgrspyvclDERGISOXWMwB";
  std::vector<std::string> whole;
  const auto keep = [&](Method method, const google::protobuf::Message& message) {
    whole.push_back(callOf(method, message.SerializeAsString()));
  };
  v1::StepRequest step;
  step.set_periods(2);
  auto& place = *step.add_acts()->mutable_place();
  place.set_object("ball");
  for (const double x : {0.1, 0.0, 0.3}) place.add_position_m(x);
  step.add_acts()->set_json(R"({"act": "throw", "object": "ball", "velocity_m_s": [1, 0, 0]})");
  keep(Method::step, step);
  v1::StepRequest ordered;
  v1::Orders& orders = *ordered.add_acts()->mutable_orders();
  orders.set_robot("red1");
  (*orders.mutable_targets())["LF_J1"] = 0.1;
  (*orders.mutable_gains())["LF_J1"].set_p(0.5);
  (*orders.mutable_lamps())["face_1"] = 1;
  keep(Method::step, ordered);
  v1::PoseRequest pose;
  pose.set_object("ball");
  for (const double x : {0.1, 0.0, 0.3}) pose.add_position_m(x);
  keep(Method::pose, pose);
  v1::GetRequest get;
  get.mutable_wanted()->add_channels("ball.x_m");
  get.mutable_wanted()->set_contacts(true);
  keep(Method::get, get);
  v1::SaveRequest save;
  save.set_file("../../outside/../save.json");
  keep(Method::save, save);
  std::mt19937 random(1);
  const std::string outside = [&] {
    std::string names;
    for (const auto& entry : fs::directory_iterator(files.outside())) names += entry.path().string() + "\n";
    return names;
  }();
  std::map<Code, int> codes;
  for (int i = 0; i < 1'000'000; ++i) {
    std::string call;
    if (i % 20 < 17) {
      call = methods[random() % methods.size()];
      if (call[0] == 'r' || call[0] == 'c') call[0] = 's';  // a new beginning takes long, and is tried elsewhere
      for (std::size_t left = random() % 24; left > 0; --left) call += static_cast<char>(random());
      if (call[0] == 's' && call.size() > 1) call[1] = static_cast<char>(random() % 8 * 8 + 2);  // no long steps
    } else {
      call = whole[random() % whole.size()];
      if (random() % 2) call.resize(random() % call.size());
      for (int flips = static_cast<int>(random() % 4); flips > 0 && call.size() > 3; --flips)
        call[3 + random() % (call.size() - 3)] ^= static_cast<char>(1 << random() % 8);
    }
    ++codes[answerCall(desk, call).code];
  }
  EXPECT_GT(codes[Code::invalid], 100'000);
  EXPECT_GT(codes[Code::ok], 1'000);
  EXPECT_EQ(0, codes[Code::internal]);
  std::string after;
  for (const auto& entry : fs::directory_iterator(files.outside())) after += entry.path().string() + "\n";
  EXPECT_EQ(outside, after);
  // And the world is still there.
  v1::ResetRequest reset;
  EXPECT_EQ(0, answered<v1::State>(desk, Method::reset, reset).period());
}

/// A picture every fourth period.
class FourthEye final : public CameraEye {
 public:
  std::optional<CameraPicture> look(const Session& session) override {
    if (session.periods() % 4 != 0 || session.periods() == 0) return std::nullopt;
    return CameraPicture{1, 1, {0, 0, 0}};
  }
};

// However far the world is behind its clock.
TEST_F(WorldDeskTest, NoPictureTakesThePlaceOfOneThatNobodyCouldAskFor) {
  WorldDesk seeing(plugins(), folder, [](const std::string&) { return std::make_unique<FourthEye>(); });
  v1::OpenRequest open;
  open.set_game("dog.json");
  open.set_unlogged(true);
  answered<v1::World>(seeing, Method::open, open, worldName);
  v1::PictureRequest request;
  request.set_robot("red1");
  const auto number = [&] { return answered<v1::PictureReply>(seeing, Method::picture, request).number(); };
  EXPECT_EQ(0, number());
  v1::PlayRequest play;
  play.set_speed(WorldDesk::fastestPlay);
  answered<v1::State>(seeing, Method::play, play);
  for (long last = 0; last < 20;) {
    seeing.goOn();
    const long now = number();
    ASSERT_LE(now, last + 1);
    last = now;
  }
}

/// Writes down when it is asked and when its picture is taken.
class NotedEye final : public CameraEye {
 public:
  NotedEye(std::string robot, std::string& notes) : robot_(std::move(robot)), notes_(notes) {}
  void ask(const Session&) override { notes_ += "ask " + robot_ + "; "; }
  std::optional<CameraPicture> look(const Session&) override {
    notes_ += "look " + robot_ + "; ";
    return CameraPicture{1, 1, {0, 0, 0}};
  }

 private:
  const std::string robot_;
  std::string& notes_;
};

TEST_F(WorldDeskTest, AllCamerasOfAWorldDrawBeforeTheFirstIsWaitedFor) {
  std::string notes;
  WorldDesk seeing(plugins(), folder,
                   [&](const std::string& robot) { return std::make_unique<NotedEye>(robot, notes); });
  v1::OpenRequest open;
  open.set_game("dog.json");
  open.set_unlogged(true);
  answered<v1::World>(seeing, Method::open, open, worldName);
  v1::StepRequest step;
  step.set_periods(1);
  step.add_acts()->set_json(
      R"({"act": "add", "robot": {"name": "blue1", "model": "robots/ers7.wrl", "position_m": [1, 0, 0]}})");
  answered<v1::State>(seeing, Method::step, step);
  step.clear_acts();
  v1::PictureRequest request;
  for (const char* robot : {"red1", "blue1"}) {
    request.set_robot(robot);
    answered<v1::PictureReply>(seeing, Method::picture, request);
  }
  notes.clear();
  answered<v1::State>(seeing, Method::step, step);
  EXPECT_EQ(notes, "ask blue1; ask red1; look blue1; look red1; ");
}

/// A program that says what it is called for; it ends with its third period.
class NotedPrograms final : public StickPrograms {
 public:
  explicit NotedPrograms(Session& session) : session_(session) { note("begins"); }
  void step() override {
    note("step");
    session_.apply(OrdersAct{"red1", {{"HEAD_PAN", 0.2}}, {}});
    if (session_.periods() == 2) why_ = "PanPath crashed";
  }
  void acted(const Act& act) override { note(std::holds_alternative<OrdersAct>(act) ? "orders" : "act"); }
  void type(const std::string& robot, const std::string& text) override {
    if (robot != "red1") throw InputError("robot", "\"" + robot + "\"", "a robot whose OPEN-R program runs");
    note("typed " + text);
  }
  void end() override { note("end"); }
  std::vector<Line> takeLines() override { return std::exchange(lines_, {}); }
  std::map<std::string, std::string> whyEnded() const override { return {{"red1", why_}}; }

 private:
  void note(const std::string& what) { lines_.push_back({"red1", "PanPath", what}); }
  Session& session_;
  std::vector<Line> lines_;
  std::string why_;
};

class SticksTest : public WorldDeskTest {
 protected:
  void SetUp() override {
    nlohmann::json game = nlohmann::json::parse(RemoteFolder::dogGame());
    game["robots"]["red1"] = {{"controller", {{"openr", {{"stick", "MS"}, {"motor_power", true}}}}}};
    files.write("stick.json", game.dump());
    request.set_game("stick.json");
  }
  /// The lines with a larger number, with their periods.
  static std::string lines(WorldDesk& of, long after) {
    v1::GetRequest get;
    get.mutable_wanted()->set_lines_after(after);
    std::string all;
    const v1::State state = answered<v1::State>(of, Method::get, get);
    for (const v1::Line& line : state.lines())
      all += std::to_string(line.number()) + "@" + std::to_string(line.period()) + " " + line.text() + "; ";
    return all;
  }
  v1::OpenRequest request;
};

TEST_F(SticksTest, AServerWithoutProgramsRefusesAStick) {
  const std::string listing = files.listing();
  EXPECT_THAT(refused(desk, Method::open, request, worldName), HasSubstr("robots red1/controller"));
  request.add_without_controller("red1");
  EXPECT_EQ("accepted", refused(desk, Method::open, request, worldName));
  EXPECT_NE(listing, files.listing());
}

TEST_F(SticksTest, AProgramThatCannotBeStartedIsRefusedAndNothingIsWritten) {
  const std::string listing = files.listing();
  WorldDesk other(plugins(), folder, {}, [](Session&) -> std::unique_ptr<StickPrograms> {
    throw InputError("robots red1/controller/openr: MS: no folder");
  });
  EXPECT_THAT(refused(other, Method::open, request, worldName), HasSubstr("MS: no folder"));
  EXPECT_EQ("this world is not open", refused(other, Method::step, v1::StepRequest()));
  EXPECT_EQ(listing, files.listing());
}

TEST_F(SticksTest, AClientTypesOnAProgramsConsole) {
  WorldDesk running(plugins(), folder, {}, [](Session& session) { return std::make_unique<NotedPrograms>(session); });
  v1::TypeRequest type;
  type.set_robot("red1");
  type.set_text("go");
  EXPECT_EQ("this world is not open", refused(running, Method::type, type));
  answered<v1::World>(running, Method::open, request, worldName);
  answered<v1::TypeReply>(running, Method::type, type);
  v1::StepRequest step;
  step.set_periods(1);
  answered<v1::State>(running, Method::step, step);
  EXPECT_EQ("1@0 begins; 2@0 typed go; 3@0 step; 4@0 orders; ", lines(running, 0));
  type.set_robot("blue1");
  EXPECT_THAT(refused(running, Method::type, type), HasSubstr("robot: \"blue1\" is not allowed"));
  type.set_robot("red1");
  type.set_text(std::string(WorldDesk::mostTypedBytes + 1, 'x'));
  EXPECT_THAT(refused(running, Method::type, type), HasSubstr("text: 65537 bytes is not allowed"));
}

TEST_F(SticksTest, WhereNoProgramRunsNobodyTypes) {
  request.add_without_controller("red1");
  answered<v1::World>(desk, Method::open, request, worldName);
  v1::TypeRequest type;
  type.set_robot("red1");
  EXPECT_THAT(refused(desk, Method::type, type), HasSubstr("a robot whose OPEN-R program runs"));
}

TEST_F(SticksTest, AProgramMovesItsRobotAndIsHeard) {
  WorldDesk running(plugins(), folder, {}, [](Session& session) { return std::make_unique<NotedPrograms>(session); });
  world = answered<v1::World>(running, Method::open, request, worldName);
  EXPECT_EQ("openr", world.robots(0).controller());
  v1::StepRequest step;
  step.set_periods(2);
  step.add_acts()->set_json(R"({"act": "add", "ball": {"name": "b2"}})");
  v1::State state = answered<v1::State>(running, Method::step, step);
  ASSERT_EQ(1, state.programs_size());
  EXPECT_TRUE(state.programs(0).running());
  EXPECT_EQ(0, state.lines_size());
  EXPECT_EQ("1@0 begins; 2@0 act; 3@0 step; 4@0 orders; 5@1 step; 6@1 orders; ", lines(running, 0));
  EXPECT_EQ("6@1 orders; ", lines(running, 5));
  step.clear_acts();
  state = answered<v1::State>(running, Method::step, step);
  EXPECT_EQ("red1", state.programs(0).robot());
  EXPECT_FALSE(state.programs(0).running());
  EXPECT_EQ("PanPath crashed", state.programs(0).why());
  EXPECT_EQ("", state.fault());

  const std::string log = (files.server() / world.log()).string();
  answered<v1::State>(running, Method::reset, v1::ResetRequest());
  EXPECT_EQ("11@4 end; ", lines(running, 10));
  answered<v1::State>(running, Method::step, step);
  EXPECT_EQ("11@4 end; 12@0 begins; 13@0 step; 14@0 orders; 15@1 step; 16@1 orders; ", lines(running, 10));
  // What it ordered is in the log, which plays again without it.
  answered<v1::CloseReply>(running, Method::close, v1::CloseRequest());
  replayed(fs::path(log).replace_extension(".json"), log);
}

TEST_F(SticksTest, OfManyLinesTheLastAreKept) {
  WorldDesk running(plugins(), folder, {}, [](Session& session) { return std::make_unique<NotedPrograms>(session); });
  answered<v1::World>(running, Method::open, request, worldName);
  v1::StepRequest step;
  step.set_periods(600);
  answered<v1::State>(running, Method::step, step);
  v1::GetRequest get;
  get.mutable_wanted()->set_lines_after(0);
  const v1::State state = answered<v1::State>(running, Method::get, get);
  ASSERT_EQ(static_cast<int>(WorldDesk::mostLines), state.lines_size());
  EXPECT_EQ(1201, state.lines(state.lines_size() - 1).number());
  EXPECT_EQ("1201@599 orders; ", lines(running, 1200));
}

}  // namespace
