#include "core/cluster/schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace {

using btr::Pace;
using btr::Schedule;

std::vector<std::size_t> handOutAll(Schedule& schedule, const Pace& pace) {
  std::vector<std::size_t> all;
  while (true) {
    const std::vector<std::size_t> piece = schedule.next(pace, 0);
    if (piece.empty()) return all;
    all.insert(all.end(), piece.begin(), piece.end());
  }
}

TEST(Schedule, HandsOutEveryJobOnceWhateverWasMeasured) {
  for (const Pace& pace : {Pace{}, Pace{0.04, 0}, Pace{1e-6, 0.005}, Pace{30, 1e-4}})
    for (const std::size_t places : {1u, 3u, 1000u}) {
      Schedule schedule(237, places);
      const std::vector<std::size_t> all = handOutAll(schedule, pace);
      ASSERT_EQ(237u, all.size());
      for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(i, all[i]);
      EXPECT_EQ(0u, schedule.left());
    }
}

TEST(Schedule, APieceIsOneJobUntilSomethingIsMeasured) { EXPECT_EQ(1u, Schedule(100, 2).next(Pace{}, 0).size()); }

TEST(Schedule, APieceTakesHalfASecondAtMost) {
  Schedule schedule(100000, 2);
  const Pace pace{0.04, 0.001};
  EXPECT_LE(static_cast<double>(schedule.next(pace, 0).size()) * pace.job_s, 0.5);
}

TEST(Schedule, PiecesBecomeShorterTowardsTheEnd) {
  Schedule schedule(64, 2);
  const Pace pace{0.001, 0};
  std::size_t before = 64;
  for (std::vector<std::size_t> piece = schedule.next(pace, 0); !piece.empty(); piece = schedule.next(pace, 0)) {
    EXPECT_LE(piece.size(), before);
    before = piece.size();
  }
  EXPECT_EQ(1u, before);
}

TEST(Schedule, AShortJobTravelsWithOthersSoThatItsJourneyPays) {
  Schedule schedule(100000, 1000);
  const Pace pace{0.0002, 0.005};
  const std::vector<std::size_t> piece = schedule.next(pace, 0);
  EXPECT_GE(static_cast<double>(piece.size()) * pace.job_s, pace.journey_s);
}

TEST(Schedule, ASecondPieceIsForThoseWhoLeaveEnoughForTheOthers) {
  Schedule schedule(5, 4);
  EXPECT_FALSE(schedule.next(Pace{}, 0).empty());
  EXPECT_TRUE(schedule.next(Pace{}, 1).empty());  // four are left for four places
  Schedule longer(50, 4);
  EXPECT_FALSE(longer.next(Pace{}, 1).empty());
  EXPECT_TRUE(longer.next(Pace{}, 2).empty());
}

TEST(Schedule, WhatIsGivenBackComesFirstAndAlone) {
  Schedule schedule(10, 2);
  const Pace pace{0.01, 0};
  const std::vector<std::size_t> lost = schedule.next(pace, 0);
  schedule.giveBack(lost);
  EXPECT_EQ(10u, schedule.left());
  for (const std::size_t job : lost) EXPECT_EQ(std::vector{job}, schedule.next(pace, 0));
}

TEST(Pace, TheJourneyIsTheShortestThatWasSeen) {
  Pace pace;
  pace.add(4, 0.4, 0.41);
  EXPECT_NEAR(0.1, pace.job_s, 1e-12);
  EXPECT_NEAR(0.01, pace.journey_s, 1e-12);
  pace.add(4, 0.4, 0.9);  // it waited behind another piece
  EXPECT_NEAR(0.01, pace.journey_s, 1e-12);
}

}  // namespace
