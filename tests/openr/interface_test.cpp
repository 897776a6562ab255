// Containers, times, timers and the network card, by programs of our own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/openr/run_program.h"

namespace btr::openr {
namespace {

using testing::HasSubstr;

class Containers : public testing::Test {
 protected:
  const std::string said = runStick(stickOf("boxes"), 5).all();
};

TEST_F(Containers, AListHasRoomForSoManyAndGoesBothWays) {
  EXPECT_THAT(said, HasSubstr("push 1 full 1 size 3 of 3\n"));
  EXPECT_THAT(said, HasSubstr("[bob][root][eve] last eve\n"));
  EXPECT_THAT(said, HasSubstr("front root back eve\n"));
  EXPECT_THAT(said, HasSubstr("empty 0 underflow 1 1\n"));
}

TEST_F(Containers, AQueueGivesWhatCameFirstAndADequeHasTwoEnds) {
  EXPECT_THAT(said, HasSubstr("queue full at 4\n"));
  EXPECT_THAT(said, HasSubstr("1 2 3 9 deque 0.5 2.5 3\n"));
}

TEST_F(Containers, ADateIsWrittenAsInALetter) {
  EXPECT_THAT(said, HasSubstr("9 Thu, 01 Jan 2004 09:00:00 +0900\n"));
  EXPECT_THAT(said, HasSubstr("Mon, 02 Jan 2006 02:04:05 -0300 year 2006 dow 1\n"));
}

TEST_F(Containers, ADateThatNoCalendarHasIsKnownAndItsDayOfTheWeekIsMended) {
  EXPECT_THAT(said, HasSubstr("proper 0 leap 1\n"));
  EXPECT_THAT(said, HasSubstr("dow 2 dif -3 later 1\n"));  // 2006-02-28 was a Tuesday
  EXPECT_THAT(said, HasSubstr("none 1\nBoxes: 2000-01-01 00:00:00\n"));
}

TEST_F(Containers, AnObserverOfASharedPointerGoesOnToSeeWhatWasSent) {
  EXPECT_THAT(said, HasSubstr("shape 1 cube x 0.500000 elements 1 refs 1\n"));
  EXPECT_THAT(said, HasSubstr("shape 2 cube x 0.500000 elements 1 refs 1\n"));
}

TEST(Timers, ComeWithTheFrameInWhichTheyAreDue) {
  const std::string said = runStick(stickOf("timer"), 60).all();
  EXPECT_THAT(said, HasSubstr("set 0 0 cancelled 0 and once more 1\nTimer: no period 1\n"));
  // Frames are 8 ms: 100 ms is over in the one that begins at 104.
  EXPECT_THAT(said, HasSubstr("again 1 at 40\nTimer: again 2 at 80\nTimer: once 42 at 104\nTimer: again 3 at 120\n"
                              "Timer: again 4 at 160\nTimer: over 0\n"));
  EXPECT_THAT(said, testing::Not(HasSubstr("again 5")));
}

class Card : public testing::Test {
 protected:
  const StickRun run = runStick(stickOf("lookup"), 20);
  const std::string said = run.all();
};

TEST_F(Card, NamesAreThisComputerTheRobotAndNumbers) {
  EXPECT_THAT(said, HasSubstr("servers 1 error 0 first a000101\n"));
  EXPECT_THAT(said, HasSubstr("domain [example.net] 0\n"));
  EXPECT_THAT(said, HasSubstr("now 2 10.0.1.6 in lab.example\n"));
  EXPECT_THAT(said, HasSubstr("127.0.0.1 is localhost\n"));
  EXPECT_THAT(said, HasSubstr("name localhost address 127.0.0.1 aliases 0 again 1\n"));
  EXPECT_THAT(said, HasSubstr("name AIBO.lab.example. address 127.0.0.1 aliases 0 again 1\n"));
  EXPECT_THAT(said, HasSubstr("www.example.com. unknown (2)\n"));
  EXPECT_THAT(said, HasSubstr("name 192.168.0.7 address 192.168.0.7 aliases 0 again 1\n"));
}

TEST_F(Card, IsSetAsTheStickSaysAndFoundOnLoopback) {
  EXPECT_THAT(said, HasSubstr("AIBONET channel 3 ap 1 wep 1 AIBO\n"));
  EXPECT_THAT(said, HasSubstr("as text 02:00:00:00:00:01 ETHER_OK\n"));
  EXPECT_THAT(said, HasSubstr("[ETHER_IP] 127.0.0.1\nCardInfo: none 1\n"));
}

TEST_F(Card, TheRobotSaysWithWhatItStartsAndWhatDrivesIt) {
  EXPECT_THAT(said, HasSubstr("boot reason 0 stick 2 of 4\n"));
  EXPECT_THAT(said, HasSubstr("cpu 0 size 256 576 MHz\n"));
}

TEST_F(Card, PowerIsToldAtBothEdgesAndThePauseKeysFatalEndsTheProgramInOrder) {
  EXPECT_THAT(said, HasSubstr("observe 0 again 4101\n"));
  EXPECT_THAT(said, HasSubstr("power notice 1: motor 1 pause 0\n"));
  EXPECT_THAT(said, HasSubstr("power notice 2: motor 0 pause 0\nCardInfo: unobserve 0\nCardInfo: stop 1\n"));
  EXPECT_EQ(run.ended.why, Ended::Why::shutdown);
}

}  // namespace
}  // namespace btr::openr
