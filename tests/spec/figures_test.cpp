// Numbers as people read them, thinned curves, and the steps of an axis.
#include "core/spec/figures.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "core/spec/nice_steps.h"
#include "core/spec/thinning.h"

namespace btr {
namespace {

TEST(Figures, AMeanHasAsManyDecimalsAsTheTwoDigitsOfItsDeviation) {
  EXPECT_EQ(withDeviation(0.5, 0.1414), "0.50 ± 0.14");
  EXPECT_EQ(withDeviation(0.5, 0.0996), "0.50 ± 0.10");
  EXPECT_EQ(withDeviation(12.3456, 3.21), "12.3 ± 3.2");
  EXPECT_EQ(withDeviation(-1234.5, 42.3), "-1234 ± 42");
  EXPECT_EQ(withDeviation(0.5, 0), "0.5 ± 0");
  EXPECT_EQ(withDeviation(12345, 870.2), "1.234e+04 ± 870");
  EXPECT_EQ(withDeviation(0.5, 1.23e-9), "0.5 ± 1.2e-09");
}

TEST(Figures, Shares) {
  EXPECT_EQ(percent(0.007), "0.7 %");
  EXPECT_EQ(percent(0.833), "83 %");
  EXPECT_EQ(tenthPercent(0.833), "83.3 %");
  EXPECT_EQ(signedPercent(0.12), "+12 %");
  EXPECT_EQ(signedPercent(-0.034), "-3 %");
}

TEST(Figures, WhatIsNotFiniteIsADash) { EXPECT_EQ(brief(std::numeric_limits<double>::infinity()), "–"); }

TEST(Thinning, KeepsFirstLowestHighestAndLastOfEachBucketInTheirOrder) {
  const std::vector<double> values{1, 5, 3, 0, 2, 7, 7, 7};
  std::vector<std::size_t> taken;
  thin(
      0, values.size(), [](std::size_t i) { return i < 5 ? 0 : 1; }, [&](std::size_t i) { return values[i]; },
      [&](std::size_t i) { taken.push_back(i); });
  EXPECT_EQ(taken, (std::vector<std::size_t>{0, 1, 3, 4, 5, 7}));
}

TEST(NiceSteps, AtMostOrAboutSoMany) {
  EXPECT_DOUBLE_EQ(niceStep(10, 4), 2.5);
  EXPECT_DOUBLE_EQ(niceStep(10, 4, true), 5);
  EXPECT_DOUBLE_EQ(nearestNiceStep(10, 4), 2);
  EXPECT_DOUBLE_EQ(nearestNiceStep(0.08, 4), 0.02);
  EXPECT_EQ(ticksWithin(0, 1, 0.25), 5);
}

}  // namespace
}  // namespace btr
