// OPEN-R programs in a living game: what they order is an act, and nothing else of them reaches the world.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/live/session_log.h"
#include "core/openr/ended_text.h"
#include "core/openr/joint_gains.h"
#include "tests/openr_live/played_program.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr::test {
namespace {

using openr::LivePrograms;
using openr::OrderFrame;
using openr::SensorFrame;
using testing::HasSubstr;

class OpenrLive : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* stick : {"red", "blue"}) std::filesystem::create_directories(folder_ + stick);
  }
  Game game(bool power = true) const { return gameFromJson(sticksText(power), "sticks.json", folder_); }

  static void run(Session& session, LivePrograms& programs, long periods) {
    session.onAct([&](long, const Act& act) { programs.acted(act); });
    for (long i = 0; i < periods; ++i) {
      programs.step();
      session.step();
    }
    ASSERT_EQ(session.fault(), "");
  }
  static double position(const Session& session, const std::string& joint, std::size_t robot = 0) {
    const auto j = static_cast<std::size_t>(session.scene().robots[robot].model.findJoint(joint));
    return session.world().jointPositions(robot)[j];
  }
  static const JointInput& input(const Session& session, const std::string& joint, std::size_t robot = 0) {
    return session.inputs()[robot][static_cast<std::size_t>(session.scene().robots[robot].model.findJoint(joint))];
  }

  const TemporaryFolder temporary_;
  const std::string folder_ = temporary_.file("sticks/");
};

OrderFrame nothing(const SensorFrame&) { return {}; }

/// Nods and looks around; a motion that no two seconds of are alike.
OrderFrame dancing(const SensorFrame& frame) {
  OrderFrame orders = frame.number == 1 ? enableAll() : OrderFrame{};
  orders.joints.resize(openr::robotDesign("ERS-7").joints.size());
  const double t = 0.008 * frame.number;
  orders.joints[placeOf("HEAD_PAN")].target_urad = static_cast<int>(std::lround(8e5 * std::sin(3 * t)));
  orders.joints[placeOf("LF_J1")].target_urad = static_cast<int>(std::lround(3e5 * std::sin(5 * t * t)));
  if (frame.number % 50 == 0)
    orders.joints[placeOf("LF_J1")].gain =
        openr::JointGain{static_cast<std::uint16_t>(0x10 + frame.number % 7), 8, 1, 0x0e, 2, 0x0f};
  if (frame.number % 40 == 0)
    orders.lamps.push_back({6, static_cast<std::uint8_t>(frame.number % 256), static_cast<std::uint16_t>(0)});
  return orders;
}

TEST_F(OpenrLive, AnActOfOrdersReadsBackAsItWasWritten) {
  OrdersAct act{"red1", {{"HEAD_PAN", 0.1234565}, {"LF_J1", -1e-6}}};
  act.orders.gains = {{"LF_J1", {0.5, 1, 16. / 28}}};
  act.orders.enabled = {{"LF_J1", true}, {"LF_J2", false}};
  act.orders.motorPower = true;
  act.orders.lamps = {{"face_1", {128 / 255., "A"}}, {"mode_red", {1, ""}}};
  const Act back = actFromJson(toJson(Act(act)).dump(), "act");
  const auto& read = std::get<OrdersAct>(back);
  EXPECT_EQ(read.robot, act.robot);
  EXPECT_EQ(read.targets, act.targets);
  EXPECT_EQ(read.orders, act.orders);
}

TEST_F(OpenrLive, OrdersThatCannotBeAreRefused) {
  Session session(game(), host());
  const auto why = [&](const std::string& text) { return refusal([&] { session.apply(actFromJson(text, "act")); }); };
  EXPECT_THAT(why(R"({"act": "orders", "robot": "green1"})"), HasSubstr("green1"));
  EXPECT_THAT(why(R"({"act": "orders", "robot": "red1", "targets": {"WING": 1}})"), HasSubstr("WING"));
  EXPECT_THAT(why(R"({"act": "orders", "robot": "red1", "gains": {"LF_J1": [1, -1, 1]}})"), HasSubstr("LF_J1"));
  EXPECT_THAT(why(R"({"act": "orders", "robot": "red1", "lamps": {"face_1": {"brightness": 2}}})"),
              HasSubstr("brightness"));
  session.apply(ControllerAct{"red1", GameController{"walk", {}, {}, true, {}}});
  EXPECT_THAT(why(R"({"act": "orders", "robot": "red1"})"), HasSubstr("no controller plugin moves"));
}

TEST_F(OpenrLive, AGameOfAnotherPeriodIsRefusedInOneSentence) {
  const std::string why =
      refusal([&] { Session(gameFromJson(sticksText(true, "0.01"), "sticks.json", folder_), host()); });
  EXPECT_THAT(why, HasSubstr("1/controller/openr"));
  EXPECT_THAT(why, HasSubstr("0.008"));
}

TEST_F(OpenrLive, AJointMovesOnlyWithPowerAndAfterItWasEnabled) {
  const int there = 700000;
  const auto answer = [&](bool enable, bool power) {
    return [=](const SensorFrame& frame) {
      OrderFrame orders = orderOf("HEAD_PAN", {there});
      if (frame.number == 1 && enable) orders.joints[placeOf("HEAD_PAN")].gainEnabled = true;
      if (frame.number == 1 && power) orders.motorPower = true;
      return orders;
    };
  };
  for (const bool enable : {false, true})
    for (const bool power : {false, true}) {
      Session session(game(false), host());
      LivePrograms programs(session, playing({{"red", answer(enable, power)}, {"blue", nothing}}));
      run(session, programs, 125);
      if (enable && power)
        EXPECT_NEAR(position(session, "HEAD_PAN"), 0.7, 0.01);
      else
        EXPECT_LT(position(session, "HEAD_PAN"), 0.3) << enable << power;
    }
}

TEST_F(OpenrLive, MotorsThatAreSwitchedOnAtTheStartNeedNoOrder) {
  Session session(game(true), host());
  LivePrograms programs(session, playing({{"red",
                                           [](const SensorFrame&) {
                                             OrderFrame orders = enableAll();
                                             orders.joints[placeOf("HEAD_PAN")].target_urad = -400000;
                                             return orders;
                                           }},
                                          {"blue", nothing}}));
  run(session, programs, 125);
  EXPECT_NEAR(position(session, "HEAD_PAN"), -0.4, 0.01);
  // Nobody enabled the other's: it lies on the floor.
  EXPECT_LT(session.world().robot(1).base.translation().z(), session.world().robot(0).base.translation().z() - 0.02);
}

TEST_F(OpenrLive, AProcessThatBeginsWithMotorsOffLeavesThoseOfTheGameOn) {
  const auto begins = [](const SensorFrame& frame) {
    OrderFrame orders = frame.number == 1 ? enableAll() : OrderFrame{};
    if (frame.number == 1) orders.motorPower = false;
    if (frame.number == 60) orders.motorPower = false;
    return orders;
  };
  Session session(game(true), host());
  LivePrograms programs(session, playing({{"red", begins}, {"blue", nothing}}));
  run(session, programs, 59);
  EXPECT_TRUE(input(session, "LF_J1").enabled);
  run(session, programs, 1);
  EXPECT_FALSE(input(session, "LF_J1").enabled);
}

TEST_F(OpenrLive, GainsAreTimesTheStandardOnesByNumberAndShift) {
  const openr::JointGain standard = openr::standardGain("ERS-7", "LF_J1");
  EXPECT_EQ(standard.p, 0x1c);
  using Three = std::array<double, 3>;
  EXPECT_EQ(timesStandard(standard, standard), (Three{1, 1, 1}));
  EXPECT_EQ(timesStandard({0x38, 4, 3, 0x0e, 2, 0x0f}, standard), (Three{2, 0.5, 3}));
  EXPECT_EQ(timesStandard({0x1c, 8, 1, 0x0d, 3, 0x0f}, standard), (Three{0.5, 2, 1}));
  EXPECT_EQ(timesStandard({0, 0, 0, 0x0e, 2, 0x0f}, standard), (Three{0, 0, 0}));
  // The mouth's standard I is 0: it says nothing of what another one would do.
  EXPECT_EQ(timesStandard({8, 4, 4, 0x0e, 2, 0x0f}, openr::standardGain("ERS-7", "MOUTH")), (Three{1, 1, 1}));
  EXPECT_EQ(openr::standardGain("ERS-210", "HEAD_ROLL").d, 0x0c);
}

TEST_F(OpenrLive, TwiceTheGainLetsTheNeckSagHalfAsFar) {
  const auto sag = [&](std::uint16_t p) {
    Session session(game(), host());
    LivePrograms programs(session, playing({{"red",
                                             [p](const SensorFrame& frame) {
                                               if (frame.number > 1) return OrderFrame{};
                                               OrderFrame orders = enableAll();
                                               orders.joints[placeOf("NECK_TILT")].target_urad = -900000;
                                               orders.joints[placeOf("NECK_TILT")].gain =
                                                   openr::JointGain{p, 4, 2, 0x0e, 2, 0x0f};
                                               return orders;
                                             }},
                                            {"blue", nothing}}));
    run(session, programs, 500);
    EXPECT_EQ(input(session, "NECK_TILT").pTimes, p / 10.);
    return position(session, "NECK_TILT") + 0.9;
  };
  const double one = sag(10), two = sag(20);
  EXPECT_GT(std::abs(one), 0.01);
  EXPECT_NEAR(one / two, 2, 0.1);
}

TEST_F(OpenrLive, TargetsBeyondTheRangeAreItsEnd) {
  Session session(game(), host());
  LivePrograms programs(session, playing({{"red",
                                           [](const SensorFrame&) {
                                             OrderFrame orders = orderOf("HEAD_PAN", {5000000});
                                             orders.joints[placeOf("LF_J2")].target_urad = -2147483647;
                                             return orders;
                                           }},
                                          {"blue", nothing}}));
  run(session, programs, 1);
  EXPECT_NEAR(input(session, "HEAD_PAN").command, 88 * M_PI / 180, 1e-6);
  EXPECT_NEAR(input(session, "LF_J2").command, -10 * M_PI / 180, 1e-6);
}

TEST_F(OpenrLive, TheLogPlaysAgainBitForBitWithoutThePrograms) {
  const std::string path = temporary_.file("openr.log");
  std::string sha;
  {
    Session session(game(), host());
    LivePrograms programs(session, playing({{"red", dancing}, {"blue", dancing}}));
    SessionLogWriter log(path, game());
    session.onAct([&](long period, const Act& act) {
      log.act(period, act);
      programs.acted(act);
    });
    for (int i = 0; i < 300; ++i) {
      if (i == 100) session.apply(NumberAct{"", "friction", 0.6});
      if (i == 150) session.apply(CheckpointAct{});
      programs.step();
      session.step();
    }
    sha = session.traceSha256();
    log.end(session.periods(), sha);
    EXPECT_GT(std::abs(position(session, "HEAD_PAN")), 0.05);
  }
  const SessionLog log = loadSessionLog(path);
  Session session(game(), host());
  for (std::size_t next = 0; session.periods() < log.periods;) {
    for (; next < log.acts.size() && log.acts[next].period == session.periods(); ++next)
      session.apply(log.acts[next].act);
    session.step();
  }
  EXPECT_EQ(session.traceSha256(), sha);
}

TEST_F(OpenrLive, NothingIsAnActWhereNothingChanges) {
  Session session(game(), host());
  LivePrograms programs(session, playing({{"red", nothing}, {"blue", nothing}}));
  long acts = 0;
  session.onAct([&](long, const Act&) { ++acts; });
  for (int i = 0; i < 10; ++i) {
    programs.step();
    session.step();
  }
  EXPECT_EQ(acts, 0);
}

TEST_F(OpenrLive, TwoRobotsObeyTheirOwnPrograms) {
  const auto to = [](int target) {
    return [=](const SensorFrame& frame) {
      OrderFrame orders = frame.number == 1 ? enableAll() : OrderFrame{};
      orders.joints.resize(openr::robotDesign("ERS-7").joints.size());
      orders.joints[placeOf("HEAD_PAN")].target_urad = target;
      orders.lines = {{"Object" + std::to_string(target), "frame " + std::to_string(frame.number)}};
      return orders;
    };
  };
  Session session(game(), host());
  LivePrograms programs(session, playing({{"red", to(500000)}, {"blue", to(-500000)}}));
  run(session, programs, 125);
  EXPECT_NEAR(position(session, "HEAD_PAN", 0), 0.5, 0.01);
  EXPECT_NEAR(position(session, "HEAD_PAN", 1), -0.5, 0.01);
  const auto lines = programs.takeLines();
  ASSERT_EQ(lines.size(), 250u);
  EXPECT_EQ(lines.back().robot, "red1");
  EXPECT_EQ(lines.back().object, "Object500000");
  EXPECT_EQ(lines.back().text, "frame 125");
  EXPECT_TRUE(programs.takeLines().empty());
}

TEST_F(OpenrLive, AProgramThatDiesLeavesJointsHeldAndTheSessionWhole) {
  const auto dies = [](const SensorFrame& frame) {
    OrderFrame orders = frame.number == 1 ? enableAll() : OrderFrame{};
    if (frame.number == 1) {
      orders.joints[placeOf("HEAD_PAN")].target_urad = 600000;
    } else if (frame.number == 50) {
      orders.ended = openr::Ended{openr::Ended::Why::crash, "Bad", "Notify0", "it read at address 0"};
    } else if (frame.number > 50) {
      ADD_FAILURE() << "asked after its end";
    }
    return orders;
  };
  Session session(game(), host());
  LivePrograms programs(session, playing({{"red", dies}, {"blue", dancing}}));
  run(session, programs, 250);
  ASSERT_TRUE(programs.ended().at("red1"));
  EXPECT_EQ(sentenceOf(*programs.ended().at("red1")), "Bad crashed in Notify0: it read at address 0");
  EXPECT_FALSE(programs.ended().at("blue1"));
  EXPECT_NEAR(position(session, "HEAD_PAN"), 0.6, 0.01);
  EXPECT_THAT(refusal([&] { programs.type("red1", "hello\n"); }), HasSubstr("red1"));
  // The same stick put in again begins anew.
  session.apply(ControllerAct{"red1", session.game().robots.at("red1").controller});
  EXPECT_FALSE(programs.ended().at("red1"));
  run(session, programs, 20);
}

TEST_F(OpenrLive, AProgramThatDiesWhileItStopsHasFailed) {
  const auto dies = [](const SensorFrame& frame) {
    OrderFrame orders;
    if (frame.shutdown) orders.ended = openr::Ended{openr::Ended::Why::crash, "Bad", "DoStop", "it wrote at address 0"};
    return orders;
  };
  const auto stops = [](const SensorFrame& frame) {
    OrderFrame orders;
    if (frame.shutdown) orders.ended = openr::Ended{openr::Ended::Why::shutdown, "", "", "all objects have stopped"};
    return orders;
  };
  Session session(game(), host());
  LivePrograms programs(session, playing({{"red", dies}, {"blue", stops}}));
  run(session, programs, 20);
  programs.end();
  ASSERT_TRUE(programs.ended().at("red1"));
  EXPECT_EQ(sentenceOf(*programs.ended().at("red1")), "Bad crashed in DoStop: it wrote at address 0");
  EXPECT_FALSE(programs.ended().at("blue1"));
}

TEST_F(OpenrLive, ARobotThatGoesTakesItsProgramAlongAndOneThatComesBringsOne) {
  long starts = 0;
  const auto turns = [&](int target) {
    return [&starts, target](const SensorFrame& frame) {
      if (frame.number == 1) ++starts;
      OrderFrame orders = frame.number == 1 ? enableAll() : OrderFrame{};
      orders.joints.resize(openr::robotDesign("ERS-7").joints.size());
      orders.joints[placeOf("HEAD_PAN")].target_urad = target;
      return orders;
    };
  };
  Session session(game(), host());
  LivePrograms programs(session, playing({{"red", turns(500000)}, {"blue", turns(-500000)}}));
  run(session, programs, 10);
  EXPECT_EQ(starts, 2);
  const AddAct back{session.game().scene.robots[0], session.game().robots.at("red1"), std::nullopt};
  session.apply(RemoveAct{"red1"});
  EXPECT_FALSE(programs.ended().contains("red1"));
  // What was the second robot is the first one now, and obeys its own program.
  run(session, programs, 100);
  EXPECT_NEAR(position(session, "HEAD_PAN", 0), -0.5, 0.01);
  session.apply(back);
  run(session, programs, 100);
  EXPECT_EQ(starts, 3);
  EXPECT_NEAR(position(session, "HEAD_PAN", 0), -0.5, 0.01);
  EXPECT_NEAR(position(session, "HEAD_PAN", 1), 0.5, 0.01);
}

TEST_F(OpenrLive, AHandThatHoldsAJointIsStrongerThanTheProgram) {
  Session session(game(false), host());
  LivePrograms programs(session, playing({{"red", nothing}, {"blue", nothing}}));
  run(session, programs, 10);
  session.apply(HoldAct{"red1", "HEAD_PAN", 0.4, std::nullopt});
  run(session, programs, 100);
  EXPECT_NEAR(position(session, "HEAD_PAN"), 0.4, 0.01);
  session.apply(HoldAct{"red1", "HEAD_PAN", std::nullopt, std::nullopt});
  run(session, programs, 1);
  EXPECT_FALSE(input(session, "HEAD_PAN").enabled);
}

TEST_F(OpenrLive, WhoShutsDownLetsGoOfEverything) {
  const auto shuts = [](const SensorFrame& frame) {
    OrderFrame orders = frame.number == 1 ? enableAll() : OrderFrame{};
    if (frame.number == 1) orders.lamps = {{0, 255, 0xffff}};
    if (frame.number == 100) orders.ended = openr::Ended{openr::Ended::Why::shutdown, "PowerMonitor", "", ""};
    return orders;
  };
  Session session(game(), host());
  LivePrograms programs(session, playing({{"red", shuts}, {"blue", nothing}}));
  run(session, programs, 99);
  const double stands = session.world().robot(0).base.translation().z();
  EXPECT_EQ(session.orders().at("red1").lamps.at("head_colour").brightness, 1);
  run(session, programs, 150);
  EXPECT_LT(session.world().robot(0).base.translation().z(), stands - 0.02);
  EXPECT_EQ(session.orders().at("red1").lamps.at("head_colour").brightness, 0);
}

TEST_F(OpenrLive, AStickThatIsNotThereIsSaidAndHurtsNobody) {
  std::filesystem::remove_all(folder_ + "blue");
  Session session(game(), host());
  LivePrograms programs(session, playing({{"red", dancing}}));
  ASSERT_TRUE(programs.ended().at("blue1"));
  EXPECT_THAT(sentenceOf(*programs.ended().at("blue1")), HasSubstr("blue"));
  run(session, programs, 20);
}

TEST_F(OpenrLive, FramesTellWhatTheRobotSensesInUnitsOfOpenR) {
  SensorFrame last;
  const auto stands = [&](const SensorFrame& frame) {
    last = frame;
    return frame.number == 1 ? enableAll() : OrderFrame{};
  };
  SensorFrame without;
  Session session(game(), host());
  LivePrograms programs(session, playing({{"red", stands}, {"blue", [&](const SensorFrame& frame) {
                                                              without = frame;
                                                              return OrderFrame{};
                                                            }}}));
  programs.type("red1", "typed\n");
  EXPECT_THAT(refusal([&] { programs.type("red1", std::string(1 << 20, 'x')); }),
              HasSubstr("text: 1048582 bytes between two periods is not allowed"));
  programs.step();
  EXPECT_EQ(last.number, 1u);
  EXPECT_EQ(last.time_us, 0);
  EXPECT_EQ(last.typed, "typed\n");
  session.step();
  run(session, programs, 249);
  EXPECT_EQ(last.number, 250u);
  EXPECT_EQ(last.time_us, 249 * 8000);
  EXPECT_EQ(last.typed, "");
  const auto& design = openr::robotDesign("ERS-7");
  const auto sensor = [&](const SensorFrame& frame, const std::string& name) {
    for (std::size_t i = 0; i < design.sensors.size(); ++i)
      if (design.sensors[i].name == name) return frame.sensors.at(i);
    ADD_FAILURE() << name;
    return 0;
  };
  // On its feet, gravity pulls the sensors' masses down; its own stance is tilted by a few degrees.
  EXPECT_NEAR(sensor(last, "acceleration_up"), -9.81e6, 0.6e6);
  EXPECT_NEAR(sensor(last, "acceleration_right"), 0, 0.6e6);
  EXPECT_EQ(sensor(last, "paw_LF") + sensor(last, "paw_RF") + sensor(last, "paw_LR") + sensor(last, "paw_RR"), 4);
  EXPECT_GE(sensor(last, "distance_near"), 50000);
  EXPECT_LE(sensor(last, "distance_near"), 500000);
  EXPECT_NEAR(last.joints.at(placeOf("LF_J3")).value_urad, 1e6 * position(session, "LF_J3"), 5000);
  EXPECT_NEAR(last.joints.at(placeOf("LF_J3")).reference_urad, 1e6 * input(session, "LF_J3").command, 1);
  EXPECT_NE(last.joints.at(placeOf("LF_J3")).duty, 0);
  // A robot to which the game gives no senses has those of its maker. This one lies.
  EXPECT_NEAR(sensor(without, "acceleration_up"), -9.81e6, 2e6);
  EXPECT_NE(sensor(without, "acceleration_up"), -9810000);
  EXPECT_GE(sensor(without, "distance_far"), 200000);
}

TEST_F(OpenrLive, ASensorThatNobodySimulatesHasItsNeutralValue) {
  Session session(game(), host());
  const auto& design = openr::robotDesign("ERS-7");
  const openr::RobotUnits units(design, session.scene().robots[0]);
  const std::vector<std::int32_t> values = units.sensors({{"touch_head", 1}, {"paw_RF", 1}, {"distance_chest", 0.25}});
  std::map<std::string, std::int32_t> by;
  for (std::size_t i = 0; i < design.sensors.size(); ++i) by[design.sensors[i].name] = values.at(i);
  EXPECT_EQ(by.at("distance_near"), 500000);
  EXPECT_EQ(by.at("distance_far"), 1500000);
  EXPECT_EQ(by.at("distance_chest"), 250000);
  EXPECT_EQ(by.at("acceleration_up"), -9810000);
  EXPECT_EQ(by.at("acceleration_front"), 0);
  EXPECT_EQ(by.at("touch_head"), 80);
  EXPECT_EQ(by.at("touch_back_rear"), 0);
  EXPECT_EQ(by.at("paw_RF"), 1);
  EXPECT_EQ(by.at("paw_LF"), 0);
  EXPECT_EQ(by.at("wireless_switch"), 1);
}

/// Cameras that write down what they are told.
class NotedCameras final : public openr::RobotCameras {
 public:
  void ask(const std::string& robot) override { notes += "ask " + robot + "; "; }
  std::optional<openr::CameraImage> look(const std::string& robot) override {
    notes += "look " + robot + "; ";
    return std::nullopt;
  }
  void set(const std::string&, const Values&) override {}
  std::string notes;
};

TEST_F(OpenrLive, AllCamerasDrawBeforeTheFirstIsWaitedFor) {
  Game both = game();
  for (auto& [name, player] : both.robots) player.controller->openr->camera = true;
  Session session(std::move(both), host());
  NotedCameras cameras;
  LivePrograms programs(session, playing({{"red", nothing}, {"blue", nothing}}), &cameras);
  programs.step();
  EXPECT_EQ(cameras.notes, "ask blue1; ask red1; look blue1; look red1; ");
}

TEST_F(OpenrLive, ACameraThatDoesNotLookIsNotAsked) {
  Game one = game();
  one.robots.at("red1").controller->openr->camera = true;
  Session session(std::move(one), host());
  NotedCameras cameras;
  LivePrograms programs(session, playing({{"red", nothing}, {"blue", nothing}}), &cameras);
  programs.step();
  EXPECT_EQ(cameras.notes, "ask red1; look red1; ");
}

TEST_F(OpenrLive, ConstantsOfTheCameraAreNumbersOfOurs) {
  const auto numbers = cameraNumbers(openr::robotDesign("ERS-7"), {1, 3, 3});
  EXPECT_EQ(numbers, (Values{{"balance_k", 2856}, {"exposure_s", 1. / 200}, {"gain_db", 6}}));
  EXPECT_EQ(cameraNumbers(openr::robotDesign("ERS-210"), {std::nullopt, std::nullopt, 1}), (Values{{"gain_db", 0}}));
  EXPECT_TRUE(cameraNumbers(openr::robotDesign("ERS-7"), {0, 9, std::nullopt}).empty());
}

TEST_F(OpenrLive, ASavedGameGoesOnWithWhatWasOrdered) {
  std::string text, sha;
  {
    Session session(game(), host());
    LivePrograms programs(session, playing({{"red", dancing}, {"blue", dancing}}));
    run(session, programs, 100);
    text = toJsonText(session.save());
    // Without its programs.
    for (int i = 0; i < 50; ++i) session.step();
    sha = toJsonText(session.save());
  }
  Session again(gameFromJson(text, "saved.json", folder_), host());
  for (int i = 0; i < 50; ++i) again.step();
  EXPECT_EQ(toJsonText(again.save()), sha);
}

TEST_F(OpenrLive, PluginsTakeOverARobotWithAllItsJoints) {
  Session session(game(false), host());
  LivePrograms programs(session, playing({{"red", nothing}, {"blue", nothing}}));
  run(session, programs, 50);
  EXPECT_FALSE(input(session, "LF_J1").enabled);
  session.apply(ControllerAct{"red1", GameController{"walk", {}, {}, true, {}}});
  session.step();
  EXPECT_TRUE(input(session, "LF_J1").enabled);
  EXPECT_FALSE(programs.ended().contains("red1"));
  EXPECT_TRUE(session.orders().contains("blue1"));
  EXPECT_FALSE(session.orders().contains("red1"));
}

}  // namespace
}  // namespace btr::test
