// A running world: what hands do takes effect, is stored, and plays again with the same bits.
#include "core/live/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/live/session_log.h"
#include "core/spec/json_reader.h"
#include "tests/live/game_files.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr::test {
namespace {

using testing::HasSubstr;

/// The acts of a lively minute, each before a period.
std::vector<std::pair<long, std::string>> livelyActs() {
  return {{20, R"({"act": "throw", "object": "ball", "velocity_m_s": [0.5, -1, 1.2], "spin_rad_s": [0, 5, 0]})"},
          {60, R"({"act": "add", "obstacle": {"name": "box", "mass_kg": 0.3, "position_m": [0.05, 0, 0.3]}})"},
          {90, R"({"act": "pull", "object": "blue1", "link": "HEAD", "target_m": [0.5, 0.1, 0.4], "most_n": 15})"},
          {120, R"({"act": "parameter", "robot": "red1", "name": "length_m", "value": 0.05})"},
          {150, R"({"act": "let_go", "object": "blue1"})"},
          {160, R"({"act": "hold", "robot": "blue1", "joint": "LF_J1", "position": 0.4})"},
          {170, R"({"act": "number", "name": "friction", "value": 0.6})"},
          {180, R"({"act": "place", "object": "ball", "position_m": [-0.2, 0.2, 0.2]})"},
          {200, R"({"act": "remove", "object": "crate"})"},
          {210, R"({"act": "effect", "robot": "red1", "effect": "command_delay", "at": "red1.LF_J1",
                    "parameters": {"delay_s": 0.02}})"},
          {230, R"({"act": "hold", "robot": "blue1", "joint": "LF_J1"})"},
          {240, R"({"act": "controller", "robot": "blue1", "controller": {"plugin": "walk"}})"},
          {260, R"({"act": "checkpoint"})"}};
}

TEST(Session, TheSameGameAndActsGiveTheSameBits) {
  std::string first;
  for (int again = 0; again < 2; ++again) {
    Session session(dogs(), host());
    const auto acts = livelyActs();
    for (std::size_t next = 0; session.periods() < 300;) {
      for (; next < acts.size() && acts[next].first == session.periods(); ++next)
        session.apply(actFromJson(acts[next].second, "act"));
      session.step();
      ASSERT_EQ(session.fault(), "");
    }
    const std::string sha = session.traceSha256();
    if (again == 0) first = sha;
    EXPECT_EQ(sha, first);
  }
}

TEST(Session, ItsLogPlaysItAgainBitForBit) {
  const TemporaryFolder temporary;
  const std::string path = temporary.file("lively.log");
  std::string sha;
  {
    Session session(dogs(), host());
    SessionLogWriter log(path, dogs());
    session.onAct([&](long period, const Act& act) { log.act(period, act); });
    const auto acts = livelyActs();
    for (std::size_t next = 0; session.periods() < 280; session.step())
      for (; next < acts.size() && acts[next].first == session.periods(); ++next)
        session.apply(actFromJson(acts[next].second, "act"));
    sha = session.traceSha256();
    log.end(session.periods(), sha);
  }
  const SessionLog log = loadSessionLog(path);
  EXPECT_EQ(log.gameSha256, gameSha256(dogs()));
  EXPECT_EQ(log.periods, 280);
  EXPECT_EQ(log.acts.size(), livelyActs().size());
  Session session(dogs(), host());
  for (std::size_t next = 0; session.periods() < log.periods; session.step())
    for (; next < log.acts.size() && log.acts[next].period == session.periods(); ++next)
      session.apply(log.acts[next].act);
  EXPECT_EQ(session.traceSha256(), sha);
}

// What was saved while it ran goes on exactly as the one that went on running.
TEST(Session, ASavedGameGoesOnBitForBit) {
  std::string text;
  std::vector<double> onwards;
  {
    Session session(dogs(), host());
    run(session, 100);
    session.apply(actFromJson(livelyActs()[2].second, "act"));
    session.apply(HoldAct{"blue1", "LF_J1", 0.3});
    run(session, 37);
    text = toJsonText(session.save());
    for (int i = 0; i < 120; ++i) {
      session.step();
      session.world().sample(onwards);
    }
  }
  Session loaded(gameFromJson(text, "saved.json", "."), host());
  EXPECT_EQ(loaded.periods(), 137);
  std::vector<double> again;
  for (int i = 0; i < 120; ++i) {
    loaded.step();
    loaded.world().sample(again);
  }
  EXPECT_EQ(onwards, again);
}

TEST(Session, AWalkingDogGetsAheadAndAStandingOneStands) {
  Session session(dogs(), host());
  const double from = session.world().robot(0).base.translation().x();
  const Eigen::Vector3d stood = session.world().robot(1).base.translation();
  EXPECT_NEAR(from, -0.5, 1e-9);
  EXPECT_LT(session.world().robot(1).base.linear()(0, 0), -0.9);  // turned round, as the scene says
  run(session, 375);                                              // three seconds
  EXPECT_GT(session.world().robot(0).base.translation().x(), from + 0.1);
  EXPECT_LT((session.world().robot(1).base.translation() - stood).norm(), 0.01);
}

TEST(Session, DogsStopEachOther) {
  Game game = dogs();
  game.scene.robots[1].position_m = {-0.15, 0, 0};
  game.scene.robots[1].orientation_wxyz = {1, 0, 0, 0};
  Session session(game, host());
  run(session, 500);
  // The one behind cannot be where the other one is: their trunks alone are 0.23 m long.
  EXPECT_GT(
      (session.world().robot(1).base.translation() - session.world().robot(0).base.translation()).head<2>().norm(),
      0.12);
  EXPECT_EQ(session.fault(), "");
}

TEST(Session, ANumberOfOneRobotIsItsOwn) {
  Session session(dogs(), host());
  session.apply(NumberAct{"red1", "leg_mass_kg", 0.3});
  const auto massOf = [&](std::size_t robot) {
    double sum = 0;
    for (const Link& link : session.scene().robots[robot].model.links) sum += link.inertial.mass_kg;
    return sum;
  };
  const double changed = massOf(0), other = massOf(1);
  EXPECT_GT(changed, other + 0.1);
  session.apply(NumberAct{"red1", "leg_mass_kg", std::nullopt});
  EXPECT_DOUBLE_EQ(massOf(0), other);
}

TEST(Session, WhatIsNotAllowedChangesNothing) {
  Session session(dogs(), host());
  run(session, 10);
  const std::vector<std::pair<std::string, std::string>> refused{
      {R"({"act": "place", "object": "cat", "position_m": [0, 0, 0]})", "a robot, ball or obstacle of this game"},
      {R"({"act": "throw", "object": "wall", "velocity_m_s": [1, 0, 0]})", "a robot, ball or obstacle of this game"},
      {R"({"act": "add", "ball": {"name": "ball"}})", "a name that no other object of this game has"},
      {R"({"act": "add", "robot": {"name": "red2", "model": "nothing.wrl"}})", "nothing.wrl"},
      {R"({"act": "parameter", "robot": "red1", "name": "length_m", "value": 5})", "length_m"},
      {R"({"act": "parameter", "robot": "red1", "name": "speed", "value": 5})", "a parameter of the controller walk"},
      {R"({"act": "parameter", "robot": "blue1", "name": "length_m", "value": 0.05})", "a robot that has a controller"},
      {R"({"act": "controller", "robot": "blue1", "controller": {"plugin": "fly"}})", "fly"},
      {R"({"act": "hold", "robot": "blue1", "joint": "NOSE", "position": 0})", "NOSE"},
      {R"({"act": "hold", "robot": "cat", "joint": "LF_J1"})", "a robot of this game: red1, blue1"},
      {R"({"act": "let_go", "object": "ball"})", "an object that is pulled"},
      {R"({"act": "number", "name": "frictoin", "value": 1})", "frictoin"},
      {R"({"act": "effect", "effect": "backlash", "at": "red1.NOSE"})", "ROBOT.JOINT of the scene"},
      {R"({"act": "pull", "object": "ball", "link": "HEAD"})", "a link of the robot that is pulled"}};
  long logged = 0;
  session.onAct([&](long, const Act&) { ++logged; });
  const std::string before = toJsonText(session.game());
  std::vector<double> row, after;
  session.world().sample(row);
  for (const auto& [act, why] : refused)
    EXPECT_THAT(refusal([&, &act = act] { session.apply(actFromJson(act, "act")); }), HasSubstr(why)) << act;
  session.world().sample(after);
  EXPECT_EQ(row, after);
  EXPECT_EQ(toJsonText(session.game()), before);
  EXPECT_EQ(logged, 0);
  run(session, 10);
  EXPECT_EQ(session.fault(), "");
}

TEST(Session, AnExplosionStopsItAndKeepsTheLastGoodState) {
  Session session(dogs(), host());
  run(session, 30);
  session.apply(ThrowAct{"ball", {49, 0, 0}, {0, 0, 0}});
  session.apply(NumberAct{"", "gravity_m_s2", 10.5});
  run(session, 400);
  EXPECT_THAT(session.fault(), HasSubstr("ball"));  // further away than a world is large
  EXPECT_LT(session.world().ball(0).position_m.norm(), 100);
  EXPECT_THAT(refusal([&] { session.apply(RemoveAct{"ball"}); }), HasSubstr("open the game again"));
  EXPECT_NO_THROW(gameFromJson(toJsonText(session.save()), "saved.json", "."));
}

TEST(Acts, SurviveBeingWrittenAndRead) {
  for (const auto& [period, text] : livelyActs()) {
    const std::string once = toJson(actFromJson(text, "act")).dump();
    EXPECT_EQ(toJson(actFromJson(once, "act")).dump(), once);
  }
  const std::string robot =
      R"({"act": "add", "robot": {"name": "red2", "model": "a.wrl", "position_m": [1, 2, 0]},
          "player": {"team": "red", "controller": {"plugin": "walk", "parameters": {"length_m": 0.05}}}})";
  const std::string once = toJson(actFromJson(robot, "act")).dump();
  EXPECT_EQ(toJson(actFromJson(once, "act")).dump(), once);
}

TEST(Acts, AreRefusedWithWhatIsAllowed) {
  const std::vector<std::pair<std::string, std::string>> refused{
      {R"({"act": "jump"})", "place"},
      {R"({"act": "place", "object": "ball", "position_m": [0, 0]})", "position_m"},
      {R"({"act": "place", "object": "ball", "position_m": [0, 0, 1e9]})", "numbers from -100 to 100"},
      {R"({"act": "place", "object": "ball", "orientation_wxyz": [0, 0, 0, 0]})", "a unit quaternion"},
      {R"({"act": "throw", "object": "ball", "velocity_m_s": [1000, 0, 0]})", "numbers from -50 to 50"},
      {R"({"act": "add"})", "one of robot, ball and obstacle"},
      {R"({"act": "remove", "object": "ball", "quickly": true})", "quickly"},
      {R"({"act": "pull", "object": "ball", "most_n": -1})", "most_n"}};
  for (const auto& [text, why] : refused)
    EXPECT_THAT(refusal([&, &text = text] { actFromJson(text, "act"); }), HasSubstr(why)) << text;
}

TEST(SessionLogs, OfAKilledSessionAreReadUpToTheirLastWholeLine) {
  const TemporaryFolder temporary;
  const std::string path = temporary.file("killed.log");
  {
    SessionLogWriter log(path, dogs());
    log.act(5, RemoveAct{"ball"});
    log.act(9, CheckpointAct{});
  }
  std::string text = readFile(path);
  std::ofstream(path) << text << R"({"act": "rem)";
  const SessionLog log = loadSessionLog(path);
  EXPECT_EQ(log.acts.size(), 2u);
  EXPECT_EQ(log.periods, 9);
  EXPECT_EQ(log.traceSha256, "");
  std::ofstream(path) << text << "{\"act\": \"rem\n"
                      << "{}\n";
  EXPECT_THAT(refusal([&] { loadSessionLog(path); }), HasSubstr("killed.log:4"));
  std::ofstream(path) << "";
  EXPECT_THAT(refusal([&] { loadSessionLog(path); }), HasSubstr("an empty file"));
  std::ofstream(path) << text.substr(0, text.find('\n') / 2);
  EXPECT_THAT(refusal([&] { loadSessionLog(path); }), HasSubstr("a file that ends within its first line"));
}

TEST(Session, ReadsARobotsFileOnceHoweverMuchComesAndGoes) {
  const TemporaryFolder folder;
  const std::string urdf = R"(<robot name="block"><link name="body"><inertial><mass value="1"/>
      <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
      <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link></robot>)";
  folder.write("block.urdf", urdf);
  Session session(gameFromJson(R"({"format": "uchilsim-game-1", "scene": {"format": "uchilsim-scene-1", "floor": {},
      "robots": [{"name": "one", "model": "block.urdf", "position_m": [0, 0, 0.05]}]}})",
                               "game", folder.file(".")),
                  host());
  std::filesystem::remove(folder.file("block.urdf"));
  const auto apply = [&](const std::string& act) { session.apply(actFromJson(act, "act")); };
  apply(R"({"act": "add", "ball": {"name": "ball", "position_m": [0.5, 0, 0.5]}})");
  apply(R"({"act": "add", "robot": {"name": "two", "model": "block.urdf", "position_m": [0, 0.5, 0.05]}})");
  run(session, 10);
  EXPECT_EQ(session.fault(), "");
  apply(R"({"act": "remove", "object": "one"})");
  apply(R"({"act": "remove", "object": "two"})");
  EXPECT_THAT(
      refusal([&] {
        apply(R"({"act": "add", "robot": {"name": "three", "model": "block.urdf", "position_m": [0, 0, 0.05]}})");
      }),
      HasSubstr("block.urdf"));
}

TEST(Games, AreRefusedWithFileAndPlace) {
  const auto refused = [](const std::string& from, const std::string& to) {
    std::string text = dogsText();
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    return refusal([&] { Session(gameFromJson(text, "dogs.json", "."), host()); });
  };
  EXPECT_THAT(refused("\"blue1\": {\"team\"", "\"blue2\": {\"team\""), HasSubstr("blue2"));
  EXPECT_THAT(refused("\"walk\"", "\"swim\""), HasSubstr("swim"));
  EXPECT_THAT(refused("\"red\"", "\"green\""), HasSubstr("team"));
  EXPECT_THAT(refused("\"name\": \"crate\"", "\"name\": \"ball\""),
              HasSubstr("a name that no other robot, ball or obstacle has"));
  EXPECT_THAT(refused("\"size_m\": [0.1, 0.1, 0.1]", "\"size_m\": [0.1, 0, 0.1]"), HasSubstr("size_m"));
  EXPECT_THAT(refused("\"mass_kg\": 0.2", "\"colour\": \"red\""), HasSubstr("colour"));
}

// Its models are found from where the scene is, also where the game's own folder is named from the working one.
TEST(Games, MayNameASceneInAnotherFolder) {
  namespace fs = std::filesystem;
  const TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  const std::string scene = fs::relative(SOURCE_DIR "/resources/scenes/kick.json", folder).string();
  std::ofstream(folder / "kick.json") << R"({"format": "uchilsim-game-1", "scene": ")" << scene << "\"}";
  Session session(loadGame((fs::relative(folder) / "kick.json").string()), host());
  EXPECT_EQ(session.scene().robots.at(0).name, "ers7");
}

TEST(Games, OfARobotFileStandOnTheFloor) {
  Session session(loadGame(SOURCE_DIR "/resources/robots/contactnets_cube.urdf"), host());
  run(session, 250);
  EXPECT_EQ(session.fault(), "");
  // The cube of 10 cm lies where it was put.
  EXPECT_NEAR(session.world().robot(0).base.translation().z(), 0.05, 0.005);
}

TEST(Games, OfARobotFileWhoseKneeCannotBeStraightHoldItBent) {
  const TemporaryFolder folder;
  const std::string body = "<inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01'/></inertial>";
  const std::string path = folder.write(
      "frog.urdf",
      "<robot name='frog'><link name='trunk'>" + body +
          "<collision><geometry><box size='0.2 0.2 0.1'/></geometry></collision></link><link name='shank'>" + body +
          "</link><joint name='knee' type='revolute'><parent link='trunk'/><child link='shank'/>" +
          "<axis xyz='0 1 0'/><limit lower='-2.7' upper='-0.9' effort='30' velocity='20'/></joint></robot>");
  Session session(loadGame(path), host());
  EXPECT_EQ(-0.9, session.inputs()[0][0].command);
  for (int i = 0; i < 125; ++i) {
    run(session, 1);
    ASSERT_NEAR(-0.9, session.world().robot(0).position[0], 0.02) << i;
  }
  EXPECT_EQ(session.fault(), "");
}

TEST(Games, OfASceneHaveItsRobotsHoldStill) {
  Session session(loadGame(SOURCE_DIR "/resources/scenes/kick.json"), host());
  run(session, 125);
  EXPECT_EQ(session.fault(), "");
  EXPECT_NEAR(session.world().ball(0).position_m.x(), 0.23, 0.01);
}

}  // namespace
}  // namespace btr::test
