// What the console says to who wonders why a program does nothing; and what programs wait for at their start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

TEST(Objects, ShareAnObjectInARegionAndTheFirstNoticeOfThePower) {
  const std::string all = runStick(stickOf("mates"), 12).all();
  EXPECT_THAT(all, HasSubstr("Doer: sum 3\nDoer: sum 41\n"));
  EXPECT_THAT(all, HasSubstr("Thinker: legs are 40, references 2\n"));
  // Who watches before the motors are switched on is told, though both happen before the first frame is over.
  EXPECT_THAT(all, HasSubstr("Thinker: power: motors 1\n"));
}

}  // namespace
}  // namespace btr::openr
