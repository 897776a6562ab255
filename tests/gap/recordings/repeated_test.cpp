// Sensors that are read more often than they measure, and those that only look like it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/recordings/doctor/repeated.h"
#include "core/gap/recordings/noise_floor.h"
#include "core/gap/recordings/recording.h"
#include "core/spec/random.h"

namespace btr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

double turning(double t) { return t < 1 ? 0 : 0.7 * std::sin(2 * (t - 1) + 0.2 * t * t); }

/// A joint that is read every 4 ms, measured anew every `measures_s`, in counts and with noise.
Recording readEvery4ms(double measures_s, double count, double noise, std::uint64_t seed) {
  Random random(seed);
  Recording trial;
  trial.channels = {"time_s", "leg.knee.command_rad", "leg.knee.position_rad"};
  trial.columns.resize(3);
  double measured = -1, value = 0;
  for (int i = 0; i < 1500; ++i) {
    const double t = 0.004 * i;
    if (const double now = measures_s * std::floor(t / measures_s + 1e-9); now != measured) {
      measured = now;
      value = turning(measured) + noise * random.normal();
      if (count > 0) value = count * std::round(value / count);
    }
    trial.columns[0].push_back(t);
    trial.columns[1].push_back(t < 3 ? 0.2 : 0.5);
    trial.columns[2].push_back(value);
  }
  return trial;
}

std::size_t kept(const Recording& trial) {
  return static_cast<std::size_t>(
      std::count_if(trial.columns[2].begin(), trial.columns[2].end(), [](double v) { return std::isfinite(v); }));
}

TEST(Repeated, OnlyNewValuesAreLeft) {
  for (const int every : {2, 3, 5, 10})
    for (const double noise : {0.0, 0.001}) {
      Recording trial = readEvery4ms(0.004 * every, 2 * M_PI / 4096, noise, 1);
      const Recording before = trial;
      emptyRepeated(trial);
      EXPECT_EQ(kept(trial), 1500u / static_cast<unsigned>(every)) << every << " " << noise;
      for (std::size_t row = 0; row < trial.rows(); ++row)
        EXPECT_EQ(std::isfinite(trial.columns[2][row]), row % static_cast<std::size_t>(every) == 0);
      EXPECT_EQ(trial.columns[1], before.columns[1]);
      EXPECT_THAT(trial.thinned, ElementsAre("leg.knee.position_rad"));
      EXPECT_THAT(trial.notes, ElementsAre(HasSubstr("only repeat the one before, as its sensor measures every " +
                                                     std::to_string(every) + " rows")));
    }
}

TEST(Repeated, AShortTrialShowsItToo) {
  for (const int every : {2, 3, 4}) {
    Recording trial = readEvery4ms(0.004 * every, 0, 0.001, 3);
    for (auto& column : trial.columns) column = {column.begin() + 300, column.begin() + 360};  // 0.24 s of motion
    emptyRepeated(trial);
    EXPECT_EQ(kept(trial), 60u / static_cast<unsigned>(every)) << every;
  }
}

TEST(Repeated, SlowMotionInCoarseCountsShowsItToo) {
  for (const int every : {2, 3, 4}) {
    // Counts so coarse that one lasts for many rows.
    Recording trial = readEvery4ms(0.004 * every, 0.02, 0.001, 5);
    emptyRepeated(trial);
    EXPECT_EQ(kept(trial), 1500u / static_cast<unsigned>(every)) << every;
  }
}

TEST(Repeated, CoarseCountsOfASensorThatMeasuresInEveryRowAreKept) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Recording trial = readEvery4ms(0.004, 0.02, 0.001, seed);
    emptyRepeated(trial);
    EXPECT_EQ(kept(trial), 1500u) << seed;
  }
}

TEST(Repeated, AFewEqualReadingsOfAShortTrialAreChance) {
  Recording trial = readEvery4ms(0.004, 0, 0.001, 4);
  for (auto& column : trial.columns) column = {column.begin() + 300, column.begin() + 360};
  for (const std::size_t row : {10u, 25u, 26u, 40u}) trial.columns[2][row] = trial.columns[2][row - 1];
  emptyRepeated(trial);
  EXPECT_EQ(kept(trial), 60u);
}

TEST(Repeated, ARhythmThatIsNoWholeNumberOfRowsIsOne) {
  Recording trial = readEvery4ms(0.0063, 2 * M_PI / 4096, 0.001, 4);
  const Recording before = trial;
  emptyRepeated(trial);
  ASSERT_THAT(trial.thinned, ElementsAre("leg.knee.position_rad"));
  for (std::size_t row = 1; row < trial.rows(); ++row)
    if (before.columns[2][row] != before.columns[2][row - 1]) {
      EXPECT_TRUE(std::isfinite(trial.columns[2][row]));
    }
}

TEST(Repeated, ASensorThatMeasuresInEveryRowKeepsAll) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const double count : {0.0, 2 * M_PI / 4096, 2 * M_PI / 1024, 0.02})
      for (const double counts : {0.0, 0.3, 1.0, 3.0}) {
        Recording trial = readEvery4ms(0.004, count, counts * 0.0015, seed);
        const Recording before = trial;
        emptyRepeated(trial);
        EXPECT_THAT(trial.notes, IsEmpty()) << count << " " << counts;
      }
}

// A bus on which a read fails now and then: the value before stands once more, the next one catches up.
TEST(Repeated, ReadsThatFailAreTakenOut) {
  for (const double chance : {0.1, 0.3})
    for (const double count : {0.0, 2 * M_PI / 4096}) {
      Recording trial = readEvery4ms(0.004, count, 1e-4, 11);
      Random random(5);
      std::vector<bool> failed(trial.rows(), false);
      for (std::size_t row = 1; row < trial.rows(); ++row)
        if ((failed[row] = random.chance(chance))) trial.columns[2][row] = trial.columns[2][row - 1];
      emptyRepeated(trial);
      EXPECT_THAT(trial.notes, ElementsAre(HasSubstr("now and then no new value came in time"))) << chance << count;
      std::size_t late = 0;
      for (std::size_t row = 0; row < trial.rows(); ++row)
        if (failed[row] && std::isfinite(trial.columns[2][row]) &&
            std::abs(trial.columns[2][row] - turning(0.004 * static_cast<double>(row))) > count + 5e-4)
          ++late;
      EXPECT_EQ(late, 0u) << chance << " " << count;
      EXPECT_NEAR(noiseFloor(trial.columns[0], trial.columns[2]), count > 0 ? 0.00046 : 1e-4, 1e-4);
    }
}

// What sticks and slips stands between steps, too, but leaves slowly.
TEST(Repeated, StickingAndSlippingIsNoFailure) {
  Recording trial;
  trial.channels = {"time_s", "leg.knee.command_rad", "leg.knee.position_rad"};
  trial.columns.resize(3);
  for (int i = 0; i < 1500; ++i) {
    const double phase = std::fmod(i, 12), slip = std::max(0.0, phase - 3) / 9;  // stands for three rows
    trial.columns[0].push_back(0.004 * i);
    trial.columns[1].push_back(0);
    const double value = 0.1 * (std::floor(i / 12.0) + (1 - std::cos(M_PI * slip)) / 2);
    trial.columns[2].push_back(0.0015 * std::round(value / 0.0015));
  }
  emptyRepeated(trial);
  EXPECT_THAT(trial.notes, IsEmpty());
}

TEST(Repeated, TheNoiseFloorIsThatOfTheValuesThatAreNew) {
  Recording trial = readEvery4ms(0.012, 0, 0.001, 9);
  EXPECT_GT(noiseFloor(trial.columns[2]), 0.003);  // stairs look like noise
  emptyRepeated(trial);
  EXPECT_NEAR(noiseFloor(trial.columns[0], trial.columns[2]), 0.001, 0.0001);
}

// A cell that is lost may be the one in which a value was new: its repeats say it too late.
TEST(Repeated, WhatWasFirstToldInALostCellHasNoDate) {
  for (const double count : {0.0, 0.02})
    for (const int every : {2, 3, 4}) {
      Recording trial = readEvery4ms(0.004 * every, count, 0.001, 6);
      Random random(8);
      for (std::size_t row = 1; row < trial.rows(); ++row)
        if (random.chance(0.08)) trial.columns[2][row] = NAN;
      emptyRepeated(trial);
      ASSERT_THAT(trial.thinned, ElementsAre("leg.knee.position_rad")) << count << " " << every;
      EXPECT_GT(kept(trial), 1100u / static_cast<unsigned>(every));
      const std::vector<double>& left = trial.columns[2];
      for (std::size_t row = 0; row < trial.rows(); ++row)
        if (std::isfinite(left[row]) && (row == 0 || left[row] != left[row - 1])) {
          EXPECT_NEAR(left[row], turning(0.004 * static_cast<double>(row)), count / 2 + 0.005) << row;
        }
    }
}

TEST(Repeated, ABodyIsOneSensor) {
  Recording trial;
  trial.channels = {"time_s", "cube.base.x_m", "cube.base.z_m", "cube.base.qw"};
  trial.columns.resize(4);
  Random random(3);
  double x = 0, z = 0, w = 1;
  for (int i = 0; i < 300; ++i) {
    if (i % 3 == 0) x = 0.01 * i + 1e-4 * random.normal(), z = i < 150 ? 0.2 : 0.3, w = std::cos(0.01 * i);
    trial.columns[0].push_back(0.01 * i);
    trial.columns[1].push_back(x);
    trial.columns[2].push_back(z);
    trial.columns[3].push_back(w);
  }
  emptyRepeated(trial);
  for (std::size_t row = 0; row < 300; ++row)
    for (std::size_t column = 1; column < 4; ++column)
      EXPECT_EQ(std::isfinite(trial.columns[column][row]), row % 3 == 0) << row << " " << column;
}

}  // namespace
}  // namespace btr
