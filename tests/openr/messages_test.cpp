// What the console says to who wonders why a program does nothing; and what programs wait for at their start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "tests/openr/run_program.h"

namespace btr::openr {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Console, PrimitivesOfAnotherRobotAreSaidOnce) {
  const std::string all = runStick(stickOf("omitted"), 3).all();
  EXPECT_THAT(all,
              HasSubstr("Omitted: the ERS-7 has no \"PRM:/r1/c1-Joint2:j1\"; it is the ERS-210's and the ERS-220's\n"));
  EXPECT_THAT(all, HasSubstr("Omitted: 6 6 6\n"));
  EXPECT_THAT(all, Not(HasSubstr("the ERS-7 has no \"PRM:/r1/c1/c2-Joint2:j2")));
}

TEST(Console, ConnectionsThatAreMissingAreSaidIfSomebodyNeedsThem) {
  const char* const connections = "/OPEN-R/MW/CONF/CONNECT.CFG";
  const std::string needs = stickOf("senser"), needsNone = stickOf("omitted");
  for (const std::string& stick : {needs, needsNone}) std::filesystem::remove(stick + connections);
  EXPECT_THAT(runStick(needs, 3).all(), HasSubstr("OPEN-R/MW/CONF/CONNECT.CFG is missing: no subject has an observer"));
  EXPECT_THAT(runStick(needsNone, 3).all(), Not(HasSubstr("CONNECT.CFG")));
}

TEST(Console, FilesThatAreNotOnTheRobotAreSaidOnceEach) {
  const std::string all = runStick(stickOf("filer"), 20).all();
  const std::string said =
      "Filer: \"/etc/passwd\" is not on the robot: its files are those below /MS, without \"..\"\n";
  EXPECT_THAT(all, HasSubstr(said));
  EXPECT_EQ(all.find(said, all.find(said) + 1), std::string::npos);
}

// The Effector is ready again after each.
TEST(Console, EachKindOfWrongVectorIsSaidOnceAndTheNextOneIsPlayed) {
  const StickRun run = runStick(stickOf("clumsy"), 40);
  const std::string all = run.all();
  for (const char* said :
       {"Clumsy: a command was left out, which has the primitiveID 4711: the ERS-7 has none of that number\n",
        "Clumsy: a command was left out, which has the primitiveID of acceleration_front, which is neither a joint nor "
        "a "
        "lamp\n",
        "Clumsy: a command was left out, which has odataJOINT_COMMAND2 for the lamp face_1: odataLED_COMMAND2 or 3 is "
        "allowed\n",
        "Clumsy: a command was left out, which has numFrames 0 for HEAD_PAN: 1 to 16 are allowed\n",
        "Clumsy: a command was left out, which has data of HEAD_PAN that lie outside of its region\n",
        "Clumsy: a command vector has numData 5, but room for 1: the others are left out\n",
        "Clumsy: a region of 10 bytes was sent to the robot: a vector begins with ",
        "Clumsy: what was sent to the Effector is no command vector (type 1431655765): OPENR::NewCommandVectorData "
        "makes "
        "one\n"}) {
    const auto at = all.find(said);
    EXPECT_NE(at, std::string::npos) << said << all;
    EXPECT_EQ(all.find(said, at + 1), std::string::npos) << said;
  }
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 8) << all;
  EXPECT_THAT(run.targets(robotDesign("ERS-7"), "HEAD_PAN"), testing::ElementsAre(100000, 100000));
}

TEST(Objects, ShareAnObjectInARegionAndTheFirstNoticeOfThePower) {
  const std::string all = runStick(stickOf("mates"), 12).all();
  EXPECT_THAT(all, HasSubstr("Doer: sum 3\nDoer: sum 41\n"));
  EXPECT_THAT(all, HasSubstr("Thinker: legs are 40, references 2\n"));
  // Who watches before the motors are switched on is told, though both happen before the first frame is over.
  EXPECT_THAT(all, HasSubstr("Thinker: power: motors 1\n"));
}

}  // namespace
}  // namespace btr::openr
