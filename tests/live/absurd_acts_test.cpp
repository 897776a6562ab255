// Hands that do anything at all: a session answers each act, refuses it, or stops with a reason; never more.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "core/live/undo.h"
#include "core/spec/random.h"
#include "tests/live/game_files.h"
#include "tests/refusal.h"

namespace btr::test {
namespace {

using testing::HasSubstr;

/// Mostly near, now and then absurd.
double anyNumber(Random& random) {
  switch (random.below(12)) {
    case 0:
      return random.uniform(-100, 100);
    case 1:
      return 0;
    case 2:
      return random.uniform(-1e-9, 1e-9);
    case 3:
      return random.chance(0.2) ? 1e12 : random.uniform(-5, 5);
    default:
      return random.uniform(-0.5, 0.5);
  }
}

std::array<double, 3> anyPoint(Random& random) { return {anyNumber(random), anyNumber(random), anyNumber(random)}; }

std::array<double, 4> anyTurn(Random& random) {
  Eigen::Vector4d q(random.normal(), random.normal(), random.normal(), random.normal());
  q.normalize();
  return {q[0], q[1], q[2], q[3]};
}

std::string anyObject(const Session& session, Random& random) {
  std::vector<std::string> names{"nobody"};
  for (const auto& each : session.game().scene.robots) names.push_back(each.name);
  for (const auto& each : session.game().scene.balls) names.push_back(each.name);
  for (const auto& each : session.game().scene.obstacles) names.push_back(each.name);
  return names[random.below(names.size())];
}

Act absurdAct(const Session& session, Random& random, int number) {
  const std::string object = anyObject(session, random), name = "thing" + std::to_string(number);
  const std::vector<std::string> joints{"LF_J1", "RR_J3", "HEAD_PAN", "NOSE"}, links{"", "HEAD", "LF_LOWER", "NOSE"};
  const std::string joint = joints[random.below(joints.size())];
  switch (random.below(12)) {
    case 0:
      return PlaceAct{object, anyPoint(random), anyTurn(random)};
    case 1:
      return PlaceAct{object, anyPoint(random), anyTurn(random), {{joint, anyNumber(random)}}};
    case 2:
      return ThrowAct{object, anyPoint(random), anyPoint(random)};
    case 3:
      return PullAct{object,
                     links[random.below(links.size())],
                     anyPoint(random),
                     anyPoint(random),
                     random.uniform(0, 1e6),
                     random.uniform(0, 1e4)};
    case 4:
      return LetGoAct{object};
    case 5: {
      BallSpec ball;
      ball.name = random.chance(0.1) ? object : name;
      ball.position_m = anyPoint(random);
      return AddAct{ball};
    }
    case 6: {
      const std::vector<std::string> shapes{"box", "cylinder", "sphere", "ramp"};
      ObstacleSpec obstacle;
      obstacle.name = name;
      obstacle.shape = shapes[random.below(shapes.size())];
      obstacle.mass_kg = random.chance(0.5) ? 0 : 0.2;
      obstacle.position_m = anyPoint(random);  // into others, too
      obstacle.orientation_wxyz = anyTurn(random);
      return AddAct{obstacle};
    }
    case 7:
      return RemoveAct{object};
    case 8:
      return HoldAct{object, joint, random.chance(0.3) ? std::nullopt : std::optional(anyNumber(random))};
    case 9:
      return ControllerAct{object,
                           random.chance(0.5) ? std::nullopt : std::optional(GameController{"walk", {}, {}, true})};
    case 10:
      return NumberAct{"", "friction", random.uniform(0.3, 2)};
    default:
      return random.chance(0.5) ? Act(CheckpointAct{}) : Act(KickOffAct{});
  }
}

// Some hundreds of acts; where the world stops, the last good state is saved and opened again, and on it goes.
TEST(AbsurdActs, AreDoneRefusedOrStopTheWorldWithAReason) {
  Random random(20261127);
  Game game = dogs();
  game.pitch.field = FieldSpec{};
  game.referee = RefereeSpec{};
  int acts = 0, refused = 0, stopped = 0;
  while (acts < 400) {
    Session session(game, host());
    UndoStack stack;
    for (int i = 0; i < 60 && session.fault().empty(); ++i, ++acts) {
      try {
        if (random.chance(0.1) && !stack.undoName().empty())
          stack.undo(session);
        else
          stack.apply(session, absurdAct(session, random, acts));
      } catch (const InputError&) {
        ++refused;
      }
      run(session, static_cast<long>(random.below(6)));
      std::vector<double> row;
      session.sample(row);
      for (const double number : row) ASSERT_TRUE(std::isfinite(number)) << acts << " " << session.fault();
    }
    if (session.fault().empty()) continue;
    ++stopped;
    EXPECT_NO_THROW(gameFromJson(toJsonText(session.save()), "saved.json", ".")) << session.fault();
  }
  EXPECT_GT(refused, 10);
  EXPECT_GT(stopped, 0);
}

// What a log could not say is refused, wherever it comes from.
TEST(AbsurdActs, NumbersThatAreNoneAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  const std::vector<Act> acts{PlaceAct{"ball", {nan, 0, 0}},
                              PlaceAct{"ball", {0, 0, 1e9}},
                              PlaceAct{"red1", {0, 0, 0.3}, {1, 0, 0, 0}, {{"LF_J1", nan}}},
                              PlaceAct{"crate", {0, 0, 0.3}, {nan, 0, 0, 0}},
                              PlaceAct{"crate", {0, 0, 0.3}, {0, 0, 0, 0}},
                              ThrowAct{"red1", {0, infinite, 0}, {}},
                              HoldAct{"blue1", "LF_J1", nan},
                              ParameterAct{"red1", "length_m", infinite},
                              PullAct{"ball", "", {}, {nan, 0, 0}, 100, 20}};
  Session session(dogs(), host());
  for (const Act& act : acts)
    EXPECT_THAT(refusal([&] { session.apply(act); }), HasSubstr("not allowed")) << toJson(act).dump();
  run(session, 5);
  EXPECT_EQ(session.fault(), "");
}

TEST(AbsurdActs, DamagedGamesAreRefused) {
  Random random(5);
  const std::string whole = toJsonText(dogs());
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::string text = whole;
    for (std::uint64_t change = 0; change <= random.below(3); ++change) {
      const std::size_t at = random.below(text.size());
      if (random.chance(0.5))
        text[at] = static_cast<char>(random.below(256));
      else
        text.erase(at, random.below(40));
    }
    try {
      gameFromJson(text, "damaged.json", ".");
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("damaged.json"));
      ++refused;
    }
  }
  EXPECT_GT(refused, 200);
}

}  // namespace
}  // namespace btr::test
