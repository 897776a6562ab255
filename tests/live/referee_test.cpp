// The referee sees what geometry says, and a game with him plays again with the same bits.
#include "core/live/referee.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/live/session_log.h"
#include "tests/live/game_files.h"
#include "tests/refusal.h"

namespace btr::test {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double ball_m = 0.0425;

FieldSpec field2004() { return {4.2, 2.7, {0.6, 0.3, 0.3}}; }

BallIs judged(Vector3d before, Vector3d now) { return judge(field2004(), ball_m, before, now); }

TEST(Judge, AllOfTheBallMustHavePassedTheLine) {
  const double line = 2.1 + ball_m;
  EXPECT_EQ(judged({2, 0, ball_m}, {line - 0.001, 0, ball_m}), BallIs::onField);
  EXPECT_EQ(judged({2, 0, ball_m}, {line + 0.001, 0, ball_m}), BallIs::inGoalAtPlusX);
  EXPECT_EQ(judged({-2, 0, ball_m}, {-line + 0.001, 0, ball_m}), BallIs::onField);
  EXPECT_EQ(judged({-2, 0, ball_m}, {-line - 0.001, 0, ball_m}), BallIs::inGoalAtMinusX);
  const double side = 1.35 + ball_m;
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(judged({1, sign, ball_m}, {1, sign * (side - 0.001), ball_m}), BallIs::onField);
    EXPECT_EQ(judged({1, sign, ball_m}, {1, sign * (side + 0.001), ball_m}), BallIs::out);
    EXPECT_EQ(judged({sign * 2, 0.8, ball_m}, {sign * (line + 0.001), 0.8, ball_m}), BallIs::out);
  }
}

TEST(Judge, BetweenThePostsAndUnderTheBarWhereItCrossed) {
  const Vector3d now(2.3, 0.32, ball_m);  // beside the goal
  // From the middle it crossed the line at less than 0.3: 2.1425/2.3 of 0.32.
  EXPECT_EQ(judged({0, 0, ball_m}, now), BallIs::inGoalAtPlusX);
  EXPECT_EQ(judged({2.1, 0.31, ball_m}, now), BallIs::out);
  EXPECT_EQ(judged({2.0, 0, 0.4}, {2.3, 0, 0.4}), BallIs::out);
  EXPECT_EQ(judged({2.0, 0, 0.25}, {2.3, 0, 0.25}), BallIs::inGoalAtPlusX);
  // Behind its back wall, where a hand put it.
  EXPECT_EQ(judged({2.5, 0, ball_m}, {2.5, 0, ball_m}), BallIs::out);
  EXPECT_EQ(judged({2.3, 0, ball_m}, {2.3, 0, ball_m}), BallIs::inGoalAtPlusX);
}

RefereeView viewOf(double x, double y) { return {1, 0.008, Vector3d(x, y, ball_m), ball_m, {}}; }

TEST(Referee, CountsAGoalOnceAndForWhoScored) {
  RefereeSpec spec;
  RefereeState state;
  const auto see = [&](double x, double y) { return officiate(spec, field2004(), state, viewOf(x, y)); };
  see(1.9, 0);
  EXPECT_EQ(see(2.2, 0).kickOff, "blue");  // red's goal: blue kicks off
  EXPECT_EQ(see(2.3, 0).kickOff, "");      // still there
  EXPECT_THAT((std::array{state.red, state.blue}), ElementsAre(1, 0));
  see(0, 0);
  see(-2, 0);
  EXPECT_EQ(see(-2.2, 0).kickOff, "red");
  EXPECT_THAT((std::array{state.red, state.blue}), ElementsAre(1, 1));
  ASSERT_EQ(state.events.size(), 2u);
  EXPECT_EQ(state.events[0].what, "goal");
  EXPECT_EQ(state.events[0].team, "red");
  EXPECT_NEAR(state.events[0].x_m, 2.1 + ball_m, 1e-12);
  // In the second half red defends +x, unless sides are kept.
  state.half = 2;
  see(0, 0);
  see(2.2, 0);
  EXPECT_THAT((std::array{state.red, state.blue}), ElementsAre(1, 2));
  spec.changeSides = false;
  see(0, 0);
  see(2.2, 0);
  EXPECT_THAT((std::array{state.red, state.blue}), ElementsAre(2, 2));
}

TEST(Referee, PutsTheBallBackWhereItWentOut) {
  RefereeSpec spec;
  const auto from = [&](Vector3d before, Vector3d now, std::vector<Vector3d> robots = {}) {
    RefereeState state;
    officiate(spec, field2004(), state, {1, 0.008, before, ball_m, robots});
    const auto order = officiate(spec, field2004(), state, {1, 0.008, now, ball_m, robots});
    EXPECT_EQ(state.events.size(), 1u);
    return order.ball;
  };
  // Half of the way over the line: x = 0.5 · 0.4.
  const double side = 1.35 + ball_m;
  Vector3d place = *from({0, side - 0.1, ball_m}, {0.4, side + 0.1, ball_m});
  EXPECT_LT((place - Vector3d(0.2, 1.35, ball_m)).norm(), 1e-12);
  place = *from({0, -side + 0.1, ball_m}, {0.4, -side - 0.1, ball_m});
  EXPECT_LT((place - Vector3d(0.2, -1.35, ball_m)).norm(), 1e-12);
  place = *from({2, 1, ball_m}, {2.2, 1, ball_m});
  EXPECT_LT((place - Vector3d(2.1, 1, ball_m)).norm(), 1e-12);
  // A dog stands there: further towards the middle.
  place = *from({1, side - 0.1, ball_m}, {1, side + 0.1, ball_m}, {{1, 1.3, 0.1}});
  EXPECT_GE((place - Vector3d(1, 1.3, 0)).head<2>().norm(), 0.2);
  EXPECT_LT(place.x(), 1);
  EXPECT_EQ(place.y(), 1.35);
  // Over the bar: not before the goal.
  place = *from({2, 0.1, 0.5}, {2.2, 0.1, 0.5});
  EXPECT_NEAR(place.y(), 0.3 + 2 * ball_m, 1e-12);
  spec.out = RefereeSpec::Out::inside;
  spec.inside_m = 0.4;
  place = *from({1, side - 0.1, ball_m}, {1, side + 0.1, ball_m});
  EXPECT_LT((place - Vector3d(1, 0.95, ball_m)).norm(), 1e-12);
  spec.out = RefereeSpec::Out::nothing;
  EXPECT_EQ(from({1, side - 0.1, ball_m}, {1, side + 0.1, ball_m}), std::nullopt);
}

TEST(Referee, ClockHalvesAndEnd) {
  RefereeSpec spec;
  spec.half_s = 4;  // 500 periods of 8 ms
  RefereeState state;
  int kickOffs = 0;
  for (int i = 1; i <= 1000; ++i) {
    const RefereeOrder order = officiate(spec, field2004(), state, viewOf(0, 0));
    if (i == 499) {
      EXPECT_EQ(state.half, 1);
    }
    if (i == 499) {
      EXPECT_EQ(state.periods, 499);
    }
    if (!order.kickOff.empty()) {
      ++kickOffs;
      EXPECT_EQ(i, 500);
      EXPECT_EQ(order.kickOff, "blue");
    }
  }
  EXPECT_EQ(kickOffs, 1);
  EXPECT_TRUE(state.over);
  EXPECT_EQ(state.periods, 500);
  ASSERT_EQ(state.events.size(), 2u);
  EXPECT_EQ(state.events[0].what, "half_time");
  EXPECT_EQ(state.events[0].clock_s, 4);
  EXPECT_EQ(state.events[1].what, "end");
  EXPECT_EQ(state.events[1].half, 2);
  // Nothing counts any more.
  officiate(spec, field2004(), state, viewOf(2.3, 0));
  EXPECT_EQ(state.red + state.blue, 0);
  EXPECT_EQ(state.periods, 500);
}

TEST(Referee, PlacesTeamsInTheirHalves) {
  RefereeSpec spec;
  spec.kickOff["red2"] = {-1, 0.3, 0.5};
  RefereeState state;
  const std::vector<std::pair<std::string, std::string>> teams{{"red1", "red"},   {"red2", "red"},   {"blue1", "blue"},
                                                               {"blue2", "blue"}, {"blue3", "blue"}, {"blue4", "blue"},
                                                               {"camera", ""}};
  for (const int half : {1, 2}) {
    state.half = half;
    const auto places = kickOffPlaces(spec, field2004(), state, "red", teams);
    EXPECT_EQ(places.size(), 6u);
    for (const auto& [name, place] : places) {
      const bool left = name.starts_with("red") == (half == 1);
      EXPECT_LT(left ? place[0] : -place[0], 0) << name;
      EXPECT_LT(std::abs(place[0]), 2.1);
      EXPECT_LT(std::abs(place[1]), 1.35);
      if (name != "red2") {
        EXPECT_NEAR(std::cos(place[2]), left ? 1 : -1, 1e-12) << name;
      }
      // Who does not kick off stands outside of the circle, nose and all.
      if (name.starts_with("blue")) {
        EXPECT_GT(std::hypot(place[0], place[1]), 0.15 + 0.2) << name;
      }
    }
    const auto given = places.at("red2");
    EXPECT_NEAR(given[0], half == 1 ? -1 : 1, 1e-12);
    EXPECT_NEAR(given[1], half == 1 ? 0.3 : -0.3, 1e-12);
  }
}

/// A dog that stands aside, and the field of 2004 with its goals.
Game matchGame() {
  Game game = loadGame(SOURCE_DIR "/resources/games/match-2004.json");
  game.robots["red1"].controller.reset();
  game.robots["blue1"].controller.reset();
  game.scene.robots[0].position_m = {-1, 1, 0};
  game.scene.robots[1].position_m = {1, 1, 0};
  return game;
}

long countOf(const Session& session, const std::string& what) {
  return std::ranges::count_if(session.referee()->events, [&](const RefereeEvent& e) { return e.what == what; });
}

TEST(RefereeInASession, ABallThatRollsIntoTheGoalCountsOnce) {
  Session session(matchGame(), host());
  session.apply(PlaceAct{"ball", {1.6, 0, ball_m}});
  session.apply(ThrowAct{"ball", {2, 0, 0}, {0, 2 / ball_m, 0}});
  run(session, 400);
  EXPECT_EQ(session.fault(), "");
  EXPECT_EQ(session.referee()->red, 1);
  EXPECT_EQ(session.referee()->blue, 0);
  EXPECT_EQ(countOf(session, "goal"), 1);
  EXPECT_EQ(countOf(session, "kick_off"), 1);
  // The ball lies in the middle, dogs stand at their places.
  EXPECT_LT(session.world().ball(0).position_m.head<2>().norm(), 0.01);
  EXPECT_NEAR(session.world().robot(0).base.translation().x(), -0.5, 0.02);
  EXPECT_NEAR(session.world().robot(1).base.translation().x(), 0.3, 0.02);
  EXPECT_LT(session.world().robot(1).base.linear()(0, 0), -0.99);
}

TEST(RefereeInASession, ABallAgainstThePostDoesNot) {
  Session session(matchGame(), host());
  session.apply(PlaceAct{"ball", {1.6, 0.31, ball_m}});  // the middle of the post, 2 cm thick
  session.apply(ThrowAct{"ball", {2, 0, 0}, {0, 2 / ball_m, 0}});
  run(session, 250);
  EXPECT_EQ(session.referee()->red + session.referee()->blue, 0);
  EXPECT_EQ(countOf(session, "goal"), 0);
  EXPECT_LT(session.world().ball(0).position_m.x(), 2.1);
}

TEST(RefereeInASession, ABallThatIsOutComesBackToTheLine) {
  for (const auto& [from, velocity, back] :
       {std::tuple{Vector3d(0.5, 1.2, ball_m), Vector3d(0, 1.5, 0), Vector3d(0.5, 1.35, ball_m)},
        {Vector3d(0.5, -1.2, ball_m), Vector3d(0, -1.5, 0), Vector3d(0.5, -1.35, ball_m)},
        {Vector3d(1.9, 0.8, ball_m), Vector3d(1.5, 0, 0), Vector3d(2.1, 0.8, ball_m)},
        {Vector3d(-1.9, -0.8, ball_m), Vector3d(-1.5, 0, 0), Vector3d(-2.1, -0.8, ball_m)}}) {
    Session session(matchGame(), host());
    session.apply(PlaceAct{"ball", {from.x(), from.y(), from.z()}});
    session.apply(
        ThrowAct{"ball", {velocity.x(), velocity.y(), 0}, {-velocity.y() / ball_m, velocity.x() / ball_m, 0}});
    run(session, 120);
    EXPECT_EQ(countOf(session, "out"), 1);
    EXPECT_LT((session.world().ball(0).position_m - back).norm(), 0.003) << back.transpose();
  }
}

// Two halves of two seconds with a goal by hand, a log, and a game that was saved in between.
TEST(RefereeInASession, PlaysAgainBitForBitAndGoesOnFromASavedGame) {
  Game game = loadGame(SOURCE_DIR "/resources/games/match-2004.json");
  game.referee->half_s = 2;
  std::vector<std::pair<long, Act>> log;
  std::string sha, saved;
  std::vector<double> onwards;
  RefereeState end;
  {
    Session session(game, host());
    session.onAct([&](long period, const Act& act) { log.emplace_back(period, act); });
    run(session, 30);
    session.apply(PlaceAct{"ball", {1.9, 0.1, ball_m}});
    session.apply(ThrowAct{"ball", {2, 0, 0}, {0, 0, 0}});
    run(session, 100);
    session.apply(KickOffAct{"blue"});
    run(session, 70);
    saved = toJsonText(session.save());
    for (int i = 0; i < 350; ++i) {
      session.step();
      session.sample(onwards);
    }
    end = *session.referee();
    sha = session.traceSha256();
  }
  EXPECT_EQ(end.red, 1);
  EXPECT_TRUE(end.over);
  {
    Session session(game, host());
    std::size_t next = 0;
    while (session.periods() < 550) {
      for (; next < log.size() && log[next].first == session.periods(); ++next) session.apply(log[next].second);
      session.step();
    }
    EXPECT_EQ(*session.referee(), end);
    EXPECT_EQ(session.traceSha256(), sha);
  }
  Session session(gameFromJson(saved, "saved.json", game.scene.directory), host());
  EXPECT_EQ(session.referee()->red, 1);
  std::vector<double> again;
  for (int i = 0; i < 350; ++i) {
    session.step();
    session.sample(again);
  }
  EXPECT_EQ(onwards, again);
  EXPECT_EQ(*session.referee(), end);
}

TEST(RefereeInASession, WhatIsNotAllowedIsRefused) {
  Session without(dogs(), host());
  EXPECT_THAT(refusal([&] { without.apply(KickOffAct{}); }), HasSubstr("a game with a referee"));
  Game game = dogs();
  game.referee = RefereeSpec{};
  EXPECT_THAT(refusal([&] { Session(game, host()); }), HasSubstr("the field's sizes"));
  game.pitch.field = field2004();
  game.referee->ball = "egg";
  EXPECT_THAT(refusal([&] { Session(game, host()); }), HasSubstr("egg"));
  EXPECT_THAT(refusal([] { actFromJson(R"({"act": "score", "red": -1, "blue": 0})", "act"); }), HasSubstr("red"));
}

TEST(RefereeSpecs, SurviveBeingWrittenAndRead) {
  Game game = matchGame();
  game.referee->field = field2004();
  game.referee->kickOff["red1"] = {-1, 0, 0.1};
  game.referee->out = RefereeSpec::Out::inside;
  const Game again = gameFromJson(toJsonText(game), "game.json", game.scene.directory);
  EXPECT_EQ(again.referee, game.referee);
  EXPECT_EQ(again.pitch.field, game.pitch.field);
}

}  // namespace
}  // namespace btr::test
