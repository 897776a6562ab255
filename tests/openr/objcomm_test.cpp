// Subject and observer: ready states and buffers. The subject does one line of a script with each tick: s sets the next
// number, n notifies, uN and bN set units and buffer, c clears, q tells its state. The observer asserts again after "1"
// and deasserts after "8".
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/openr/run_program.h"

namespace btr::openr {
namespace {

using testing::HasSubstr;

std::string talk(const std::string& script, const std::string& parameters = "0 1 1") {
  const std::string stick = stickOf("talk");
  writeText(stick + "/SCRIPT.TXT", script);
  writeText(stick + "/PARAMS.TXT", parameters);
  const StickRun run = runStick(stick, 100);
  EXPECT_EQ(run.ended.why, Ended::Why::shutdown) << run.ended.what;
  std::string told;
  for (const std::string& line : run.lines)
    if (line.find("got") != std::string::npos || line.find("q:") != std::string::npos ||
        line.find("Ready") != std::string::npos)
      told += line.substr(line.find(": ") + 2) + "|";
  return told;
}

TEST(ReadyState, IsUnknownAfterSendingAndOneAfterAnAssert) {
  EXPECT_EQ(talk("q\nsn\nq\n"),
            "Ready assert|q: state 1 any 1 all 1 room 14|got 1, 1 notices|Ready assert|q: state 1 any 1 all 1 room 14|"
            "Ready deassert|");
  EXPECT_EQ(
      talk("sn\nsn\nq\n"),
      "Ready assert|got 1, 1 notices|Ready assert|got 2, 1 notices|q: state 0 any 0 all 0 room 14|Ready deassert|");
}

TEST(ReadyState, NotReadyKeepsTheNewestUntilTheAssert) {
  // 1 and 2 go at once; the observer does not assert after "2": 3 and 4 wait, 4 is the newest.
  EXPECT_EQ(talk("ssn\nsn\nsn\nq\n"), "Ready assert|got 1 2, 2 notices|q: state 0 any 0 all 0 room 13|Ready deassert|");
}

TEST(ReadyState, AllDataSetBeforeOneNotifyGoTogether) {
  EXPECT_EQ(talk("s\ns\ns\nn\n"), "Ready assert|got 1 2 3, 3 notices|Ready deassert|");
}

TEST(ReadyState, DeassertedDeletes) {
  // After "8" the observer has deasserted.
  EXPECT_EQ(talk("ssssssssn\nq\nsn\nq\n"),
            "Ready assert|got 1 2 3 4 5 6 7 8, 8 notices|Ready deassert|q: state -1 any 0 all 0 room 14|"
            "q: state -1 any 0 all 0 room 14|Ready deassert|");
}

TEST(Buffer, NothingMovesBeforeNotifyAndClearDropsIt) {
  EXPECT_EQ(talk("sss\nq\nc\nq\nn\n"),
            "Ready assert|q: state 1 any 1 all 1 room 11|q: state 1 any 1 all 1 room 14|Ready deassert|");
}

TEST(Buffer, OverflowDropsTheOldest) {
  EXPECT_EQ(talk("b2\nssss\nn\n"), "Ready assert|got 3 4, 2 notices|Ready deassert|");
}

TEST(Buffer, UnitsAreWhole) { EXPECT_EQ(talk("u2\nsssn\n"), "Ready assert|got 1 2, 1 notices|Ready deassert|"); }

TEST(Buffer, SkipLeavesOutUnits) {
  EXPECT_EQ(talk("ssssn\n", "1 1 1"), "Ready assert|got 1 3, 2 notices|Ready deassert|");
}

TEST(Buffer, MinimumWaitsForMore) {
  EXPECT_EQ(talk("sn\nq\nsn\n", "0 2 2"),
            "Ready assert|q: state 1 any 1 all 1 room 13|got 1 2, 2 notices|Ready deassert|");
}

TEST(Objects, DoTheSameEachTime) {
  const std::string stick = stickOf("talk");
  writeText(stick + "/SCRIPT.TXT", "sn\nssn\nq\nsn\n");
  EXPECT_EQ(runStick(stick, 60).all(), runStick(stick, 60).all());
}

TEST(Objects, ThatAnswerEachOtherWithoutEndLetTimePass) {
  const StickRun run = runStick(stickOf("pair"), 200);
  EXPECT_EQ(run.ended.why, Ended::Why::shutdown);
  EXPECT_EQ(std::count(run.lines.begin(), run.lines.end(), "Left: tick"), 200 / 4);
  EXPECT_THAT(run.all(), testing::HasSubstr("ten thousand throws"));
}

TEST(Objects, ControlAndConnectBeforeAnyReady) {
  const StickRun run = runStick(stickOf("talk"), 10);
  ASSERT_GE(run.lines.size(), 3u);
  EXPECT_EQ(run.lines[0], "Source: Control Sink.Words.Text.O 1");
  EXPECT_EQ(run.lines[1], "Sink: Connect Source.Words.Text.S 1");
  EXPECT_EQ(run.lines[2], "Source: Ready assert");
}

TEST(Objects, ManyObserversOfOneSubject) {
  const std::string all = runStick(stickOf("many"), 60).all();
  // Who is refused by the subject hears nothing of it.
  EXPECT_THAT(all, HasSubstr("a subject refuses Third.In.Msg.O (status 2): not connected\n"));
  EXPECT_THAT(all, testing::Not(HasSubstr("Third: con")));
  EXPECT_THAT(all, HasSubstr("Pub: reason 0 observers 2 2\n"));
  // One takes each datum, the other two at once.
  EXPECT_THAT(all, HasSubstr("Fast: got 1: m1(2)\n"));
  EXPECT_THAT(all, HasSubstr("Slow: got 2: m3(1) m4(2)\n"));
  EXPECT_THAT(all, HasSubstr("Fast: got 1: only first(1)\n"));
  EXPECT_THAT(all, testing::Not(HasSubstr("Slow: got 1")));
  // A shared region is held by both until they are ready again.
  EXPECT_THAT(all, HasSubstr("Pub: reg refs 3\n"));
  EXPECT_THAT(all, HasSubstr("Pub: reg ready refs 2\nPub: reg ready refs 1\n"));
  // Its memory has a number, by which others hold it, too.
  EXPECT_THAT(all, HasSubstr("Pub: by number 1 1 kept 8\n"));
}

}  // namespace
}  // namespace btr::openr
