// The policy gradient as L1 of a kick: its defaults do not touch the ball, nor does anything one ε around them.
#include <gtest/gtest.h>

#include "tests/runs/small_kick_run.h"

namespace btr {
namespace {

TEST(PgrlKick, LeavesTheMetreOfNothingThatAKickFromScratchBeginsAt) {
  test::SmallKickRun run(
      0, 2,
      [](nlohmann::json& spec) {
        spec["learner"] = {{"name", "pgrl"}, {"settings", nlohmann::json::object()}};
        spec["stages"]["first_generations"] = 12;
        spec["stages"]["total_generations"] = 13;
      },
      2);
  ASSERT_EQ(RunEnd::waiting, run.goOn());
  const std::vector<GenerationRecord> generations = run.database_.generations(run.run_);
  ASSERT_EQ(12u, generations.size());
  EXPECT_EQ(0, generations.front().best);
  EXPECT_GT(generations.back().mean, 0.02);  // m
  EXPECT_GT(generations.back().best, 0.1);
}

}  // namespace
}  // namespace btr
