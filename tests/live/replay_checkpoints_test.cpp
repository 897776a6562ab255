// Going back in a session that plays a log again: to moments that were kept, with the same bits.
#include "core/live/replay_checkpoints.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "core/live/session.h"
#include "tests/live/game_files.h"

namespace btr::test {
namespace replay_checkpoints {

/// What hands did, of every kind that changes how a world goes on.
std::vector<SessionLog::Entry> busyActs() {
  const std::vector<std::pair<long, const char*>> acts{
      {10, R"({"act": "throw", "object": "ball", "velocity_m_s": [0.5, -1, 1.2], "spin_rad_s": [3, 1, 2]})"},
      {30, R"({"act": "pull", "object": "blue1", "point_m": [0.02, 0.01, 0], "target_m": [0.6, 0.1, 0.5],
               "stiffness_n_m": 100, "most_n": 30})"},
      {55, R"({"act": "add", "ball": {"name": "second", "position_m": [0.1, -0.3, 0.3]}})"},
      {70, R"({"act": "let_go", "object": "blue1"})"},
      {90, R"({"act": "hold", "robot": "blue1", "joint": "LF_J1", "position": 0.4})"},
      {110, R"({"act": "number", "name": "floor.friction", "value": 0.7})"},
      {130, R"({"act": "parameter", "robot": "red1", "name": "length_m", "value": 0.05})"},
      {150, R"({"act": "effect", "effect": "coulomb_friction", "at": "red1.LF_J1"})"},
      {160,
       R"({"act": "effect", "effect": "viscous_friction", "at": "red1.RF_J2", "parameters": {"coefficient_nm_s_rad": 0.05}})"},
      {170, R"({"act": "remove", "object": "crate"})"}};
  std::vector<SessionLog::Entry> entries;
  for (const auto& [period, text] : acts) entries.push_back({period, actFromJson(text, "act")});
  return entries;
}

constexpr long end = 300;

SessionLog busyLog() {
  SessionLog log;
  log.acts = busyActs();
  log.periods = end;
  return log;
}

/// A session that plays the log again, with checkpoints.
struct Played {
  Session session{dogs(), host()};
  LogReplay replay{busyLog(), 0};
  ReplayCheckpoints checkpoints;
  std::map<long, std::string> traces;  ///< by period, as it was passed first
  long stepped = 0;

  explicit Played(long first, std::size_t most = 64) : checkpoints(first, most) {}

  /// False where a checkpoint was not met as it was.
  bool playTo(long period, bool compare = true) {
    while (session.periods() < period) {
      if (!checkpoints.pass(session, replay, 0, 0)) return false;
      replay.act(session, [](long, const std::string&) {});
      session.step();
      ++stepped;
      const auto [at, isNew] = traces.try_emplace(session.periods(), session.traceSha256SoFar());
      if (compare && at->second != session.traceSha256SoFar()) {
        ADD_FAILURE() << "other bits before period " << session.periods();
        return false;
      }
    }
    return true;
  }
  /// The period from which it goes on.
  long backBefore(long period) {
    const ReplayCheckpoints::Kept* kept = checkpoints.goBack(period);
    EXPECT_TRUE(kept);
    if (!kept) return -1;
    session.returnTo(kept->session);
    replay.returnTo(kept->replay);
    return session.periods();
  }
};

TEST(ReplayCheckpoints, GoOnWithTheBitsOfPlayingFromTheStart) {
  Played played(20);
  ASSERT_TRUE(played.playTo(end));
  for (const long period : {299, 181, 140, 60, 59, 12, 0, 155}) {
    EXPECT_LE(played.backBefore(period), period);
    // playTo() compares the traces' hashes after each period.
    ASSERT_TRUE(played.playTo(end));
  }
}

TEST(ReplayCheckpoints, MakeAJumpBackShort) {
  Played played(20);
  ASSERT_TRUE(played.playTo(end));
  // The first jump passes one, to see that bits are the same.
  EXPECT_EQ(played.backBefore(295), 260);
  ASSERT_TRUE(played.playTo(295));
  played.stepped = 0;
  EXPECT_EQ(played.backBefore(294), 280);
  ASSERT_TRUE(played.playTo(294));
  EXPECT_EQ(played.stepped, 14);
}

TEST(ReplayCheckpoints, AreNeverMany) {
  Played played(5, 6);
  for (long period = 1; period <= end; ++period) {
    ASSERT_TRUE(played.playTo(period));
    ASSERT_LE(played.checkpoints.count(), 7u);
  }
  EXPECT_GE(played.checkpoints.count(), 3u);
  EXPECT_GT(played.backBefore(end), end / 4);
}

// As a motion would do that remembers what it does not tell: something is other than when it passed first.
TEST(ReplayCheckpoints, AreGivenUpWhereASessionGoesOnOtherwise) {
  Played played(20);
  ASSERT_TRUE(played.playTo(end));
  played.backBefore(200);
  played.session.apply(actFromJson(R"({"act": "throw", "object": "ball", "velocity_m_s": [0.1, 0, 2]})", "act"));
  EXPECT_FALSE(played.playTo(end, false));
  EXPECT_EQ(played.session.periods(), 200);
  EXPECT_EQ(played.backBefore(200), 0);
  ASSERT_TRUE(played.playTo(end));
  EXPECT_EQ(played.checkpoints.count(), 1u);  // the start
}

TEST(ReplayCheckpoints, KeepWhatTheLogWasComparedTo) {
  Played played(20);
  ASSERT_TRUE(played.playTo(100));
  const LogReplay::Place was = played.replay.place();
  played.backBefore(30);
  EXPECT_LT(played.replay.place().nextAct, was.nextAct);
  ASSERT_TRUE(played.playTo(100));
  EXPECT_EQ(played.replay.place().nextAct, was.nextAct);
}

}  // namespace replay_checkpoints
}  // namespace btr::test
