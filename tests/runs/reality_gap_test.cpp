#include "core/run/reality/reality_gap.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace btr;

const std::vector<double> real{1.0, 2.0, 4.0}, simulated{1.5, 1.0, 4.0};

TEST(RealityGap, IsTheMeanAbsoluteDifference) { EXPECT_DOUBLE_EQ(0.5, gapOf(real, simulated, GapNorm::meanAbsolute)); }
TEST(RealityGap, HasARootMeanSquare) {
  EXPECT_DOUBLE_EQ(std::sqrt(1.25 / 3), gapOf(real, simulated, GapNorm::rootMeanSquare));
}
TEST(RealityGap, HasAMaximum) { EXPECT_DOUBLE_EQ(1.0, gapOf(real, simulated, GapNorm::maximum)); }
TEST(RealityGap, OfNobodyIsZero) { EXPECT_EQ(0, gapOf({}, {}, GapNorm::meanAbsolute)); }

MeasurementRecord value(Id individual, double v, bool isVoid = false) {
  MeasurementRecord m;
  m.individual = individual;
  m.value = v;
  m.isVoid = isVoid;
  return m;
}

MeasurementTask task(int stage, Id individual, int repeats = 1) {
  MeasurementTask t;
  t.run = 1;
  t.stage = stage;
  t.individual = individual;
  t.wantedRepeats = repeats;
  return t;
}

TEST(RealFitness, IsTheMeanOfTheValuesThatAreNotVoid) {
  const auto all =
      realFitness({task(1, 7), task(1, 8)}, {value(7, 1.0), value(7, 3.0), value(7, 99, true), value(8, 5, true)}, 1);
  ASSERT_EQ(1u, all.size());
  EXPECT_EQ(7, all[0].individual);
  EXPECT_DOUBLE_EQ(2.0, all[0].mean);
  EXPECT_EQ(2, all[0].count);
  EXPECT_DOUBLE_EQ(std::sqrt(2.0), all[0].standardDeviation);
}

TEST(RealFitness, LeavesLaterStagesOut) {
  const std::vector<MeasurementTask> tasks{task(1, 7), task(2, 8)};
  EXPECT_EQ(1u, realFitness(tasks, {value(7, 1), value(8, 1)}, 1).size());
  EXPECT_EQ(2u, realFitness(tasks, {value(7, 1), value(8, 1)}, 2).size());
}

TEST(RealFitness, StandardErrorOfTheGapComesFromRepeats) {
  RealFitness once, twice;
  once.count = 1;
  twice.count = 2;
  twice.standardDeviation = 0.2;
  EXPECT_EQ(0, gapStandardError({once, once}));
  EXPECT_DOUBLE_EQ(std::sqrt(0.02) / 2, gapStandardError({once, twice}));
}

TEST(MeasurementTask, IsSettledByAsManyValuesAsWereWanted) {
  EXPECT_FALSE(isSettled(task(1, 7, 2), {value(7, 1), value(8, 1)}));
  EXPECT_TRUE(isSettled(task(1, 7, 2), {value(7, 1), value(7, 0, true)}));
}

}  // namespace
