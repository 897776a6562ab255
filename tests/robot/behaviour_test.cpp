// Behaviours in trials and in games: what they sense, and what they may count on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/live/session.h"
#include "core/model/load_model.h"
#include "core/model/model_json.h"
#include "core/robot/robot.h"
#include "core/sim/gait.h"
#include "core/sim/trial.h"
#include "core/spec/json_reader.h"
#include "tests/refusal.h"

namespace btr {
namespace {

const std::string resources = SOURCE_DIR "/resources/";

Scene dogBeforeWall(double wall_m) {
  const std::string text = R"({"format": "uchilsim-scene-1", "step_s": 0.002, "control_period_s": 0.008,
    "floor": {"friction": 1}, "robots_collide": true, "robots": [{"name": "red1", "model": ")" +
                           resources + R"(robots/ers7.wrl"}], "obstacles": [{"name": "wall", "size_m": [0.05, 2, 0.4],
    "position_m": [)" + toText(wall_m + 0.025) +
                           R"(, 0, 0.2]}]})";
  const SceneSpec spec = sceneFromJson(text, "test", ".");
  return makeScene(spec, loadModels(spec), {}, {});
}

/// Holds still and keeps what it was told.
class Watcher final : public uchilsim::Behaviour {
 public:
  struct Seen {
    std::vector<double> near_m;
    bool others = false;
    std::vector<std::uint64_t> drawn;
  };
  Watcher(Seen& seen, bool senses, bool looks = false) : seen_(seen), senses_(senses), looks_(looks) {}
  std::vector<SenseSpec> senses() const override {
    return senses_ ? std::vector<SenseSpec>{{"infrared_near", {{"noise_m", 0}}}} : std::vector<SenseSpec>{};
  }
  bool looks() const override { return looks_; }
  void start(const uchilsim::Robot&, const Values&, std::span<const double>) override {}
  void act(const uchilsim::Senses& senses, uchilsim::Orders&) override {
    if (senses.infrared.near_m) seen_.near_m.push_back(*senses.infrared.near_m);
    seen_.others = seen_.others || senses.infrared.far_m || senses.paws || senses.touch || senses.acceleration_m_s2;
    seen_.drawn.push_back(senses.random().next());
  }
  double duration_s() const override { return 0.4; }

 private:
  Seen& seen_;
  bool senses_, looks_;
};

uchilsim::BehaviourController watcher(Watcher::Seen& seen, bool senses, bool looks = false) {
  return {"watcher", [&seen, senses, looks] { return std::make_unique<Watcher>(seen, senses, looks); }};
}

TrialResult trialOf(const uchilsim::BehaviourController& controller, std::uint64_t seed = 1) {
  Scene scene = dogBeforeWall(0.4);
  controller.arrange(scene, {});
  TrialOptions options;
  options.recordTrace = true;
  return runTrial(scene, controller, {}, {}, seed, options);
}

TEST(Behaviour, SensesInATrialWhatItAsksFor) {
  Watcher::Seen seen;
  trialOf(watcher(seen, true));
  ASSERT_EQ(50u, seen.near_m.size());
  // The eye is in the head, some centimetres before the body's middle; the wall 0.4 m ahead of that.
  for (const double distance : seen.near_m) {
    EXPECT_GT(distance, 0.2);
    EXPECT_LT(distance, 0.4);
  }
  EXPECT_FALSE(seen.others);
}

TEST(Behaviour, SensesNothingThatItDoesNotAskForAndMovesTheSame) {
  Watcher::Seen with, without;
  const TrialResult a = trialOf(watcher(with, true)), b = trialOf(watcher(without, false));
  EXPECT_TRUE(without.near_m.empty());
  EXPECT_FALSE(without.others);
  EXPECT_EQ(a.trace.values, b.trace.values);
}

TEST(Behaviour, ItsRandomNumbersAreAFunctionOfSeedAndPeriod) {
  Watcher::Seen a, b, other;
  trialOf(watcher(a, true), 7);
  trialOf(watcher(b, true), 7);
  trialOf(watcher(other, true), 8);
  EXPECT_EQ(a.drawn, b.drawn);
  ASSERT_EQ(a.drawn.size(), other.drawn.size());
  for (std::size_t i = 0; i < a.drawn.size(); ++i) EXPECT_NE(a.drawn[i], other.drawn[i]);
  EXPECT_NE(a.drawn[0], a.drawn[1]);
}

TEST(Behaviour, OneThatLooksIsRefusedByATrialWithWhatToDo) {
  Watcher::Seen seen;
  const auto controller = watcher(seen, false, true);
  const std::string said = test::refusal([&] { trialOf(controller); });
  EXPECT_NE(std::string::npos, said.find("camera")) << said;
  EXPECT_NE(std::string::npos, said.find("games")) << said;
}

TEST(Behaviour, WhatTheRobotCannotHaveIsRefused) {
  class Headless final : public uchilsim::Behaviour {
    std::vector<SenseSpec> senses() const override { return {{"smell"}}; }
    void start(const uchilsim::Robot&, const Values&, std::span<const double>) override {}
    void act(const uchilsim::Senses&, uchilsim::Orders&) override {}
  };
  const uchilsim::BehaviourController controller("headless", [] { return std::make_unique<Headless>(); });
  EXPECT_NE(std::string::npos, test::refusal([&] { trialOf(controller); }).find("smell"));
}

// A program gets the model over the network: what it computes from it must be the same bits.
TEST(ModelJson, KeepsEveryBitThatAGaitNeeds) {
  for (const char* file : {"robots/ers7.wrl", "robots/ers210.wrl"}) {
    const RobotModel model = loadModel(resources + file);
    const RobotModel read = modelFromJson(toJson(model).dump(), "test");
    ASSERT_EQ(model.joints.size(), read.joints.size());
    const std::vector<double> stance = stanceOf(model, "test");
    EXPECT_EQ(stance, stanceOf(read, "test")) << file;
    EXPECT_TRUE(standing(model, stance, "test").matrix() == standing(read, stance, "test").matrix()) << file;
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      EXPECT_EQ(model.joints[j].name, read.joints[j].name);
      EXPECT_EQ(model.joints[j].lower, read.joints[j].lower);
      EXPECT_EQ(model.joints[j].upper, read.joints[j].upper);
    }
  }
}

TEST(ModelJson, NonsenseIsRefused) {
  for (const char* text : {"", "{}", "[1]", R"({"name": 3})"})
    EXPECT_TRUE(test::refusal([&] { modelFromJson(text, "the model"); }).starts_with("the model")) << text;
}

// ---- in games: the examples, as plugins ----

const PluginHost& examples() {
  static const PluginHost host(std::vector<std::string>{PLUGIN_DIR, EXAMPLES_DIR});
  return host;
}

Game gameOf(const std::string& name) { return loadGame(resources + "robot-examples/" + name + ".json"); }

double baseX(const Session& session) { return session.world().robot(0).base.translation().x(); }

TEST(BehaviourInAGame, StopsBeforeTheWall) {
  Session session(gameOf("wall"), examples());
  const double began = baseX(session);
  for (int i = 0; i < 125 * 25 && session.fault().empty(); ++i) session.step();
  ASSERT_EQ("", session.fault());
  const double stands = baseX(session);
  EXPECT_GT(stands, began + 0.1);
  EXPECT_LT(stands, 0.875 - 0.25);
  for (int i = 0; i < 125; ++i) session.step();
  EXPECT_NEAR(stands, baseX(session), 0.01);
  EXPECT_EQ(1.0, session.lamps().at("red1").at("face_1"));
}

TEST(BehaviourInAGame, ItsSensesAreChannelsOfTheTrace) {
  Session session(gameOf("wall"), examples());
  const std::vector<std::string> channels = session.channels();
  EXPECT_NE(channels.end(), std::find(channels.begin(), channels.end(), "red1.infrared.near_m"));
}

TEST(BehaviourInAGame, WagsWhileAHandIsAtItsHead) {
  Session session(gameOf("hand"), examples());
  const auto wags = [&] {
    const RobotModel& model = session.scene().robots[0].model;
    const auto tail = static_cast<std::size_t>(model.findJoint("TAIL_PAN"));
    double most = 0;
    for (int i = 0; i < 125; ++i) {
      session.step();
      most = std::max(most, std::abs(session.inputs()[0][tail].command));
    }
    return most;
  };
  EXPECT_EQ(0.0, wags());
  EXPECT_TRUE(session.lamps().at("red1").empty());
  PullAct hand;
  hand.object = "red1";
  hand.link = "HEAD";
  hand.point_m = {0, 0, 0.03};
  hand.target_m = {0.2, 0, 0.25};
  hand.most_n = 0.5;
  session.apply(hand);
  EXPECT_GT(wags(), 0.3);
  EXPECT_EQ(2u, session.lamps().at("red1").size());
}

/// What the first robot's joints are told after so many periods. There is one world a process, so each has its own.
std::vector<double> toldAfter(long periods, const std::function<void(Session&, long)>& before) {
  Session session(gameOf("wall"), examples());
  for (long i = 0; i < periods; ++i) {
    before(session, i);
    session.step();
  }
  std::vector<double> commands;
  for (const JointInput& input : session.inputs()[0]) commands.push_back(input.command);
  return commands;
}

TEST(BehaviourInAGame, RemembersWhenSomethingReachesIn) {
  // The legs go on where they were: nothing jumps back to the first step.
  const auto nothing = [](Session&, long) {};
  const auto aBallComes = [](Session& session, long period) {
    if (period != 130) return;
    BallSpec ball;
    ball.name = "far";
    ball.position_m = {-1, 1, 0.0425};
    AddAct add;
    add.what = ball;
    session.apply(add);
  };
  EXPECT_EQ(toldAfter(131, nothing), toldAfter(131, aBallComes));
  EXPECT_NE(toldAfter(130, nothing), toldAfter(131, nothing));
}

TEST(BehaviourInAGame, GoesOnAfterASaveWithTheSameBits) {
  const auto on = [](Session& each) {
    for (int i = 0; i < 100; ++i) each.step();
    std::vector<double> row;
    each.sample(row);
    return row;
  };
  std::string saved;
  std::vector<double> same;
  {
    Session session(gameOf("wall"), examples());
    for (int i = 0; i < 100; ++i) session.step();
    saved = toJsonText(session.save());
    same = on(session);
  }
  Session again(gameFromJson(saved, "saved", resources + "robot-examples"), examples());
  EXPECT_EQ(same, on(again));
}

TEST(BehaviourInAGame, OneThatLooksNeedsSomebodyWhoDraws) {
  const std::string said = test::refusal([] { Session session(gameOf("ball"), examples()); });
  EXPECT_NE(std::string::npos, said.find("ball_watcher")) << said;
  EXPECT_NE(std::string::npos, said.find("drawn")) << said;
}

/// A picture with an orange spot to the left.
class PaintedEye final : public CameraEye {
  std::optional<CameraPicture> look(const Session& session) override {
    if (session.periods() % 4 != 0) return std::nullopt;
    CameraPicture picture{20, 10, std::vector<std::uint8_t>(600, 60)};
    for (int row = 4; row < 7; ++row)
      for (int column = 2; column < 5; ++column) {
        std::uint8_t* rgb = &picture.rgb[3 * static_cast<std::size_t>(20 * row + column)];
        rgb[0] = 250, rgb[1] = 90, rgb[2] = 20;
      }
    return picture;
  }
};

TEST(BehaviourInAGame, TurnsItsHeadToWhatItsCameraSees) {
  Session session(gameOf("ball"), examples(), nullptr, [](const std::string& robot) {
    EXPECT_EQ("red1", robot);
    return std::make_unique<PaintedEye>();
  });
  for (int i = 0; i < 40; ++i) session.step();
  ASSERT_EQ("", session.fault());
  const RobotModel& model = session.scene().robots[0].model;
  EXPECT_GT(session.inputs()[0][static_cast<std::size_t>(model.findJoint("HEAD_PAN"))].command, 0.3);
}

class BrokenEye final : public CameraEye {
  std::optional<CameraPicture> look(const Session&) override { throw InputError("no picture comes out"); }
};

TEST(BehaviourInAGame, ACameraThatFailsStopsTheWorldWithItsReason) {
  Session session(gameOf("ball"), examples(), nullptr,
                  [](const std::string&) { return std::make_unique<BrokenEye>(); });
  session.step();
  EXPECT_NE(std::string::npos, session.fault().find("no picture comes out")) << session.fault();
  EXPECT_NE(std::string::npos, session.fault().find("red1")) << session.fault();
}

// ---- what programs order ----

TEST(OrdersOfAProgram, MoveARobotWithoutController) {
  Game game = gameOf("hand");
  game.robots["red1"].controller.reset();
  Session session(game, examples());
  const RobotModel& model = session.scene().robots[0].model;
  const auto at = [&](const char* joint) { return static_cast<std::size_t>(model.findJoint(joint)); };
  session.apply(OrdersAct{"red1", {{"HEAD_PAN", 0.5}}, {}});
  session.step();
  EXPECT_EQ(0.5, session.inputs()[0][at("HEAD_PAN")].command);
  EXPECT_TRUE(session.inputs()[0][at("HEAD_PAN")].enabled);
  OrdersAct soft{"red1", {}, {}};
  soft.orders.gains["NECK_TILT"] = {0.5, 1, 1};
  soft.orders.enabled["TAIL_PAN"] = false;
  session.apply(soft);
  session.step();
  EXPECT_EQ(0.5, session.inputs()[0][at("NECK_TILT")].pTimes);
  EXPECT_FALSE(session.inputs()[0][at("TAIL_PAN")].enabled);
  EXPECT_TRUE(session.inputs()[0][at("LF_J1")].enabled);
  EXPECT_EQ(0.5, session.inputs()[0][at("HEAD_PAN")].command);
}

TEST(OrdersOfAProgram, AreRefusedWhereAPluginMovesTheRobot) {
  Session session(gameOf("hand"), examples());
  const std::string said = test::refusal([&] { session.apply(OrdersAct{"red1", {{"HEAD_PAN", 0.5}}, {}}); });
  EXPECT_NE(std::string::npos, said.find("plugin")) << said;
}

}  // namespace
}  // namespace btr
