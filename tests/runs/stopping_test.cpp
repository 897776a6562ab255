// Which stops count that somebody asked for in the database.
#include <gtest/gtest.h>

#include "core/run/setup/run_lock.h"
#include "tests/runs/small_kick_run.h"

namespace {

using namespace btr;

TEST(Stopping, OneOfAnEarlierTimeIsForgottenByWhoeverGoesOn) {
  test::SmallKickRun r(4, 1);
  r.database_.requestStop(r.run_, true);
  EXPECT_EQ(RunEnd::waiting, r.goOn());
  EXPECT_FALSE(r.database_.run(r.run_).stopRequested);
}

TEST(Stopping, OneThatCameBeforeTheProcessCountsWhereEarlierOnesWereForgotten) {
  test::SmallKickRun r(4, 1);
  RunOptions options;
  options.jobs = 1;
  options.earlierStopCounts = true;
  r.database_.requestStop(r.run_, true);
  EXPECT_EQ(RunEnd::stopped, continueRun(r.database_, r.host_, r.run_, StopFlag{false}, options));
  EXPECT_TRUE(r.database_.generations(r.run_).empty());
  forgetStop(r.database_, r.run_);
  EXPECT_EQ(RunEnd::waiting, continueRun(r.database_, r.host_, r.run_, StopFlag{false}, options));
}

TEST(Stopping, OneOfARunAtWorkIsNotForgotten) {
  test::SmallKickRun r(4, 1);
  const RunLock working(r.database_.path(), r.run_);
  r.database_.requestStop(r.run_, true);
  forgetStop(r.database_, r.run_);
  EXPECT_TRUE(r.database_.run(r.run_).stopRequested);
}

TEST(Stopping, WhatIsForgottenIsForgottenBeforeOthersSeeTheRunAtWork) {
  test::SmallKickRun r(4, 1);
  bool wasSeen = true;
  const auto look = [&] {
    wasSeen = isRunActive(r.database_.path(), r.run_);
    EXPECT_THROW(RunLock(r.database_.path(), r.run_), InputError) << "two may begin at once";
  };
  const RunLock lock(r.database_.path(), r.run_, "run", look);
  EXPECT_FALSE(wasSeen);
  EXPECT_TRUE(isRunActive(r.database_.path(), r.run_));
}

}  // namespace
