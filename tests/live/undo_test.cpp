// What hands did is taken back and done again.
#include "core/live/undo.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/live/session.h"
#include "core/spec/random.h"
#include "tests/live/game_files.h"
#include "tests/refusal.h"

namespace btr::test {
namespace {

using testing::HasSubstr;

/// All that undo promises to give back.
struct Everything {
  std::string game;
  std::vector<double> joints, balls;              ///< positions
  std::vector<Eigen::Isometry3d> poses;           ///< of robots and obstacles
  std::vector<double> commands;                   ///< of robots without controller
  std::vector<std::array<double, 3>> velocities;  ///< of what has no joints
};

std::array<double, 3> arrayFrom(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Everything everythingOf(const Session& session) {
  Everything all;
  Game game = session.game();
  // A robot that is not in the list is one that has nothing of its own.
  std::erase_if(game.robots, [](const auto& player) { return player.second == GameRobot{}; });
  all.game = toJsonText(game);
  const World& world = session.world();
  const auto add = [&](const Eigen::Vector3d& v) { all.balls.insert(all.balls.end(), {v.x(), v.y(), v.z()}); };
  for (std::size_t i = 0; i < game.scene.robots.size(); ++i) {
    const std::vector<double> joints = world.jointPositions(i);
    all.joints.insert(all.joints.end(), joints.begin(), joints.end());
    all.poses.push_back(world.robot(i).base);
    const auto player = game.robots.find(game.scene.robots[i].name);
    if (player != game.robots.end() && player->second.controller) continue;
    for (const JointInput& input : session.inputs()[i]) all.commands.push_back(input.command);
  }
  for (std::size_t i = 0; i < game.scene.balls.size(); ++i) {
    add(world.ball(i).position_m);
    all.velocities.push_back(arrayFrom(world.ball(i).velocity_m_s));
    all.velocities.push_back(arrayFrom(world.ball(i).spin_rad_s));
  }
  for (std::size_t i = 0; i < game.scene.obstacles.size(); ++i) {
    all.poses.push_back(world.obstacle(i).pose);
    all.velocities.push_back(arrayFrom(world.obstacle(i).spin_rad_s));
  }
  for (const auto& [object, pull] : session.pulls()) all.game += toJson(pull).dump() + "\n";
  for (const auto& [robot, joints] : session.held())
    for (const auto& [joint, position] : joints) all.game += robot + joint + toText(position) + "\n";
  return all;
}

void expectSame(const Everything& a, const Everything& b, const std::string& what) {
  EXPECT_EQ(a.game, b.game) << what;
  EXPECT_EQ(a.balls, b.balls) << what;
  ASSERT_EQ(a.joints.size(), b.joints.size()) << what;
  for (std::size_t i = 0; i < a.joints.size(); ++i) EXPECT_NEAR(a.joints[i], b.joints[i], 1e-12) << what << " " << i;
  EXPECT_EQ(a.commands, b.commands) << what;
  EXPECT_EQ(a.velocities, b.velocities) << what;
  ASSERT_EQ(a.poses.size(), b.poses.size()) << what;
  for (std::size_t i = 0; i < a.poses.size(); ++i)
    EXPECT_LT((a.poses[i].matrix() - b.poses[i].matrix()).cwiseAbs().maxCoeff(), 1e-12) << what << " " << i;
}

std::array<double, 3> somewhere(Random& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0.2, 0.6)};
}

/// An act of a hand that the game of dogsText() allows.
Act anyAct(const Session& session, Random& random, int number) {
  const SceneSpec& scene = session.game().scene;
  std::vector<std::string> objects;
  for (const auto& each : scene.robots) objects.push_back(each.name);
  for (const auto& each : scene.balls) objects.push_back(each.name);
  for (const auto& each : scene.obstacles) objects.push_back(each.name);
  const std::string object = objects[random.below(objects.size())];
  const std::string robot = scene.robots[random.below(scene.robots.size())].name;
  const double heading = random.uniform(-3, 3);
  const std::string number_text = std::to_string(number);
  switch (random.below(13)) {
    case 0:
      return PlaceAct{object, somewhere(random), {std::cos(heading / 2), 0, 0, std::sin(heading / 2)}};
    case 1:
      return ThrowAct{object, somewhere(random), somewhere(random)};
    case 2:
      return AddAct{BallSpec{"ball" + number_text, 0.03, 0.05, 2.0 / 3, 0, 0, somewhere(random)}};
    case 3: {
      ObstacleSpec box;
      box.name = "box" + number_text;
      box.mass_kg = random.chance(0.5) ? 0 : 0.3;
      box.position_m = somewhere(random);
      return AddAct{box};
    }
    case 4: {
      RobotSpec dog = scene.robots.front();
      dog.name = "dog" + number_text;
      dog.position_m = {random.uniform(-2, 2), 1.5, 0};
      return AddAct{dog, {"blue", std::nullopt, std::nullopt, true}};
    }
    case 5:
      return RemoveAct{object};
    case 6:
      return PullAct{object, "", {0.01, 0, 0}, somewhere(random), 50, 10};
    case 7:
      return session.pulls().empty() ? Act(CheckpointAct{}) : Act(LetGoAct{session.pulls().begin()->first});
    case 8:
      return HoldAct{robot, "RF_J1", random.uniform(-0.5, 0.5)};
    case 9:
      return HoldAct{robot, "RF_J1"};
    case 10:
      return ParameterAct{robot, "length_m", random.uniform(0.03, 0.06)};
    case 11:
      return ControllerAct{robot, GameController{"walk", {}, {{"length_m", 0.04}}, true}};
    default:
      return random.chance(0.5) ? Act(NumberAct{robot, "leg_mass_kg", random.uniform(0.15, 0.25)})
                                : Act(EffectAct{"", {"command_delay", robot + ".LF_J1", {{"delay_s", 0.02}}}});
  }
}

// In a world that waits, so that what was is what shall be again.
TEST(Undo, TakesBackRandomActsOneByOneAndDoesThemAgain) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    Random random(seed);
    Session session(dogs(), host());
    run(session, 20);
    UndoStack stack;
    std::vector<Everything> states{everythingOf(session)};
    std::vector<std::string> names;
    for (int number = 0; names.size() < 25; ++number) {
      const Act act = anyAct(session, random, number);
      if (session.game().scene.robots.size() < 2 && std::holds_alternative<RemoveAct>(act)) continue;
      try {
        stack.apply(session, act);
      } catch (const InputError&) {
        continue;  // a joint that nobody holds, an effect at what should go
      }
      if (std::holds_alternative<CheckpointAct>(act)) continue;
      names.push_back(nameOf(act));
      states.push_back(everythingOf(session));
      ASSERT_EQ(stack.undoName(), names.back());
    }
    for (std::size_t i = names.size(); i-- > 0;) {
      stack.undo(session);
      EXPECT_EQ(stack.redoName(), names[i]);
      expectSame(everythingOf(session), states[i], "seed " + std::to_string(seed) + ", before " + names[i]);
    }
    EXPECT_EQ(stack.undoName(), "");
    for (std::size_t i = 0; i < names.size(); ++i) {
      stack.redo(session);
      expectSame(everythingOf(session), states[i + 1], "seed " + std::to_string(seed) + ", again " + names[i]);
    }
    EXPECT_EQ(stack.redoName(), "");
  }
}

TEST(Undo, OfADragIsOneStep) {
  Session session(dogs(), host());
  run(session, 20);
  UndoStack stack;
  stack.apply(session, PlaceAct{"crate", {0.3, 0.3, 0.05}});
  const Everything before = everythingOf(session);
  for (int i = 0; i < 30; ++i) {
    stack.apply(session, PullAct{"ball", "", {}, {0.1 * i, 0, 0.3}, 100, 20}, 7);
    run(session, 2);
  }
  stack.apply(session, LetGoAct{"ball"}, 7);
  stack.apply(session, PlaceAct{"ball", {0.5, 0.5, 0.0425}}, 8);
  stack.undo(session);
  EXPECT_EQ(stack.undoName(), "pull ball");
  stack.undo(session);
  const Everything after = everythingOf(session);
  EXPECT_EQ(after.velocities[0], before.velocities[0]);
  EXPECT_EQ(after.balls, before.balls);
  EXPECT_TRUE(session.pulls().empty());
  EXPECT_EQ(stack.undoName(), "move crate");
  EXPECT_EQ(stack.redoName(), "pull ball");
  // Something new: what was taken back is gone.
  stack.apply(session, RemoveAct{"crate"});
  EXPECT_EQ(stack.redoName(), "");
  EXPECT_THAT(refusal([&] { stack.redo(session); }), HasSubstr("an act that was taken back"));
}

// What undo does are acts, which the log has: it plays again.
TEST(Undo, IsInTheLogAndPlaysAgain) {
  std::vector<std::pair<long, std::string>> logged;
  std::string sha;
  {
    Session session(dogs(), host());
    session.onAct([&](long period, const Act& act) { logged.emplace_back(period, toJson(act).dump()); });
    UndoStack stack;
    run(session, 30);
    stack.apply(session, RemoveAct{"red1"});
    stack.apply(session, ThrowAct{"ball", {1, 0, 1}, {0, 3, 0}});
    run(session, 30);
    stack.undo(session);
    stack.undo(session);
    run(session, 30);
    stack.redo(session);
    run(session, 30);
    sha = session.traceSha256();
  }
  Session session(dogs(), host());
  std::size_t next = 0;
  while (session.periods() < 120) {
    for (; next < logged.size() && logged[next].first == session.periods(); ++next)
      session.apply(actFromJson(logged[next].second, "act"));
    session.step();
  }
  EXPECT_EQ(session.traceSha256(), sha);
}

TEST(Undo, RemembersTwoHundredSteps) {
  Session session(dogs(), host());
  UndoStack stack;
  for (int i = 0; i < 250; ++i) stack.apply(session, PlaceAct{"ball", {0.001 * i, 1, 0.1}});
  for (int i = 0; i < 200; ++i) stack.undo(session);
  EXPECT_THAT(refusal([&] { stack.undo(session); }), HasSubstr("an act that can be taken back"));
  EXPECT_EQ(session.world().ball(0).position_m.x(), 0.001 * 49);
}

// What was put somewhere is told to stay there also when it was saved at once.
TEST(Session, WhatJointsAreToldIsSaved) {
  std::string text;
  std::vector<double> onwards, again;
  {
    Session session(dogs(), host());
    session.apply(PlaceAct{"blue1", {0.6, 0.1, 0.3}, {1, 0, 0, 0}, {{"LF_J1", 0.2}}, {{"RF_J1", -0.3}}});
    text = toJsonText(session.save());
    run(session, 60);
    session.world().sample(onwards);
    EXPECT_EQ(session.inputs()[1][static_cast<std::size_t>(session.scene().robots[1].model.findJoint("LF_J1"))].command,
              0.2);
  }
  Session session(gameFromJson(text, "saved.json", "."), host());
  run(session, 60);
  session.world().sample(again);
  EXPECT_EQ(onwards, again);
}

}  // namespace
}  // namespace btr::test
