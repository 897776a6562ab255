// Mistakes of people who write games by hand: each is one sentence that says where and what is allowed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/live/act.h"
#include "tests/live/game_files.h"
#include "tests/refusal.h"

namespace btr::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string with(const std::string& from, const std::string& to) {
  std::string text = dogsText();
  text.replace(text.find(from), from.size(), to);
  return text;
}

/// What is said of the game with `blue1` as given.
std::string blue(const std::string& player) {
  return refusal(
      [&] { Session session(gameFromJson(with("{\"team\": \"blue\"}", player), "dogs.json", "."), host()); });
}

TEST(GameMistakes, AllKeysThatAreKnownAreTold) {
  const std::string said =
      refusal([&] { gameFromJson(with("\"robots\": {\"red1\"", "\"robot\": {\"red1\""), "dogs.json", "."); });
  EXPECT_EQ(
      "dogs.json: key \"robot\" is not known; known keys: field, format, referee, robots, scene, seed, simulator, "
      "state, view",
      said);
}

TEST(GameMistakes, APostureIsWithinTheJointsLimits) {
  EXPECT_THAT(blue("{\"posture\": {\"LF_J1\": 100}}"),
              StartsWith("robots blue1/posture/LF_J1: 100 is not allowed; -2.00713 to 2.26893"));
  EXPECT_EQ("accepted", blue("{\"posture\": {\"LF_J1\": 0.5}}"));
}

TEST(GameMistakes, WhoseControllerOrSimulatorItIsIsSaid) {
  EXPECT_THAT(blue("{\"controller\": {\"plugin\": \"wlak\"}}"),
              StartsWith("robots blue1/controller: \"wlak\" is not allowed; known: "));
  EXPECT_THAT(blue("{\"simulator\": {\"effects\": [{\"effect\": \"backlash\", \"at\": \"blue1.LF_J9\"}]}}"),
              StartsWith("robots blue1/simulator: effect backlash at: blue1.LF_J9 is not allowed"));
}

TEST(GameMistakes, WhatIsAddedIsOneThing) {
  EXPECT_EQ("act: \"add\" needs one of robot, ball and obstacle, and only one",
            refusal([] { actFromJson("{\"act\": \"add\"}", "act"); }));
}

TEST(GameMistakes, FarAwayIsSaidInWords) {
  EXPECT_THAT(
      refusal([] { Session session(gameFromJson(with("[0.6, 0.1, 0]", "[600, 0.1, 0]"), "dogs.json", "."), host()); }),
      StartsWith("game: at its start blue1.BODY is "));
}

}  // namespace
}  // namespace btr::test
