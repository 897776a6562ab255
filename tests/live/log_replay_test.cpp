// A log that is played again: it carries its game, and says up to where the bits are the same.
#include "core/live/log_replay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/spec/json_reader.h"
#include "tests/live/game_files.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr::test {
namespace {

using testing::HasSubstr;

const char* const thrown = R"({"act": "throw", "object": "ball", "velocity_m_s": [0.5, -1, 1.2]})";

/// A session of 170 periods with an act in it and one at its end.
std::string logged(const TemporaryFolder& folder) {
  const std::string path = folder.file("session.log");
  Session session(dogs(), host());
  SessionLogWriter log(path, session.game());
  session.onAct([&](long period, const Act& act) { log.act(period, act); });
  while (session.periods() < 170) {
    if (session.periods() == 60) session.apply(actFromJson(thrown, "act"));
    session.step();
    if (session.periods() % SessionLog::markEvery == 0) log.mark(session.periods(), session.mark());
  }
  session.apply(RemoveAct{"crate"});
  log.mark(session.periods(), session.mark());
  log.end(session.periods(), session.traceSha256());
  return path;
}

/// Plays a log to its end.
LogReplay replayed(SessionLog log) {
  Session session(*log.game, host());
  LogReplay replay(std::move(log), session.periods());
  const auto nobody = [](long, const std::string&) {};
  for (replay.act(session, nobody); !replay.isOver(session); replay.act(session, nobody)) session.step();
  return replay;
}

TEST(LogReplays, AreTheSameToTheirEnd) {
  const TemporaryFolder folder;
  const SessionLog log = loadSessionLog(logged(folder));
  ASSERT_TRUE(log.game);
  EXPECT_EQ(gameSha256(*log.game), log.gameSha256);
  EXPECT_EQ(log.marks.size(), 4u);
  const LogReplay replay = replayed(log);
  EXPECT_EQ(replay.sameUntil(), 170);
  EXPECT_FALSE(replay.differsBy());
}

// Another throw at period 60: the mark at 50 is the same, that at 100 is not.
TEST(LogReplays, SayWhereTheFirstDifferenceIs) {
  const TemporaryFolder folder;
  SessionLog log = loadSessionLog(logged(folder));
  std::get<ThrowAct>(log.acts.at(0).act).velocity_m_s[0] = 0.51;
  const LogReplay replay = replayed(log);
  EXPECT_EQ(replay.sameUntil(), 50);
  EXPECT_EQ(replay.differsBy(), 100);
}

TEST(LogReplays, OfAChangedGameAreRefused) {
  const TemporaryFolder folder;
  std::string text = readFile(logged(folder));
  const auto at = text.find("\"seed\":3");
  ASSERT_NE(at, std::string::npos);
  text[at + 7] = '4';
  const std::string changed = folder.file("changed.log");
  writeFile(changed, text);
  EXPECT_THAT(refusal([&] { loadSessionLog(changed); }), HasSubstr("changed.log:1"));
  EXPECT_TRUE(isSessionLog(changed));
  EXPECT_TRUE(headOfSessionLog(changed).hasGame);
  EXPECT_FALSE(isSessionLog(SOURCE_DIR "/resources/games/two-dogs-and-a-ball.json"));
}

TEST(LogReplays, NameWhatFollowsEachOtherOnce) {
  SessionLog log;
  for (const long period : {10, 12, 14}) log.acts.push_back({period, PullAct{"ball", "", {}, {}}});
  log.acts.push_back({15, RemoveAct{"crate"}});
  log.acts.push_back({200, RemoveAct{"ball"}});
  const auto acts = actsOf(log, 0.008);
  ASSERT_EQ(acts.size(), 3u);
  EXPECT_EQ(acts[0].from, 10);
  EXPECT_EQ(acts[0].to, 14);
  EXPECT_EQ(acts[2].from, 200);
}

// A game saved from a log that plays goes on from there, and the log plays on as it was.
TEST(LogReplays, MayBeSavedWithoutOtherBits) {
  std::string alone;
  {
    Session session(dogs(), host());
    run(session, 60);
    alone = session.traceSha256();
  }
  std::vector<double> row, again;
  std::optional<Game> saved;
  {
    Session session(dogs(), host());
    run(session, 30);
    saved = session.saved();
    session.sample(row);
    run(session, 30);
    EXPECT_EQ(session.traceSha256(), alone);
  }
  Session later(gameFromJson(toJsonText(*saved), "saved", "."), host());
  EXPECT_EQ(later.periods(), 30);
  later.sample(again);
  ASSERT_EQ(row.size(), again.size());
  for (std::size_t i = 0; i < row.size(); ++i) EXPECT_NEAR(row[i], again[i], 1e-6) << later.channels()[i];
}

}  // namespace
}  // namespace btr::test
