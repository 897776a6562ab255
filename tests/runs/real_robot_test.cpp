// Where real fitness comes from is settled before a run begins.
#include "core/run/loop/robot.h"

#include <gtest/gtest.h>

#include "core/spec/error.h"
#include "tests/runs/small_kick_run.h"

namespace btr::test {
namespace {

SmallKickRun measuredBy(const nlohmann::json& reality) {
  return SmallKickRun(2, 2, [&](nlohmann::json& text) { text["reality"] = reality; });
}

TEST(RealRobots, WhatIsNotThereIsRefusedBeforeTheRun) {
  EXPECT_THROW(measuredBy("dream"), InputError);
  EXPECT_THROW(measuredBy({{"name", "program"}}), InputError);
  EXPECT_THROW(measuredBy({{"name", "program"}, {"settings", {{"program", "/nowhere/robot"}}}}), InputError);
  EXPECT_THROW(measuredBy({{"name", "csv_folder"}, {"settings", {{"folder", "/nowhere"}}}}), InputError);
  EXPECT_THROW(measuredBy({{"name", "person"}, {"settings", {{"patience", 1}}}}), InputError);
}

}  // namespace
}  // namespace btr::test
