// How much a run still has to simulate.
#include "core/run/loop/time_left.h"

#include <gtest/gtest.h>

namespace btr {
namespace {

// 5 generations, then every 10, until 30: stages after 5, 15, 25 and 30.
constexpr PlannedWork kick{20, 12, 5, 10, 30, 4, 3};

TEST(TimeLeft, CountsLearningAndEveryAdaptationToCome) {
  EXPECT_EQ(kick.stages(), 4);
  EXPECT_EQ(kick.trialsOfAdaptersGeneration(1), 12 * 3);
  EXPECT_EQ(kick.trialsOfAdaptersGeneration(3), 12 * 9);  // all that three stages measured
  // L3 of four stages: 4 generations each of 36, 72, 108 and 144 trials.
  EXPECT_EQ(kick.trialsLeft(0, 1, 0), 30 * 20 + 4 * (36 + 72 + 108 + 144));
  EXPECT_EQ(kick.trialsLeft(5, 1, 3), 25 * 20 + 1 * 36 + 4 * (72 + 108 + 144));
  EXPECT_EQ(kick.trialsLeft(30, 4, 4), 0);
}

TEST(TimeLeft, OfARunThatMeasuresOnceOnlyIsItsLearningAndOneAdaptation) {
  constexpr PlannedWork once{10, 8, 50, 100, 20, 2, 5};  // the first stage is after the last generation
  EXPECT_EQ(once.stages(), 1);
  EXPECT_EQ(once.trialsLeft(19, 1, 0), 10 + 2 * 8 * 5);
}

}  // namespace
}  // namespace btr
