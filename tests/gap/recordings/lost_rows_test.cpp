// Rows that a logger lost, and pauses that only look like them.
#include "core/gap/recordings/doctor/lost_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/spec/error.h"
#include "core/spec/random.h"

namespace btr {
namespace lost_rows {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

double sine(double t) { return 0.6 * std::sin(3 * t); }
double steps(double t) { return std::fmod(t, 2) < 1 ? 0.4 : -0.4; }

/// Every 10 ms for 5 s, without `lost` rows; stamps jitter by `jitter_s`.
Recording logged(double (*command)(double), const std::set<int>& lost, double jitter_s = 0) {
  Random random(4);
  Recording trial;
  trial.source = "trial.csv";
  trial.channels = {"time_s", "leg.knee.command_rad", "leg.knee.position_rad"};
  trial.columns.resize(3);
  for (int i = 0; i < 500; ++i) {
    if (lost.contains(i)) continue;
    const double t = 0.01 * i;
    trial.columns[0].push_back(t + jitter_s * random.uniform(-1, 1));
    trial.columns[1].push_back(command(t));
    trial.columns[2].push_back(0.9 * sine(t - 0.05));
  }
  return trial;
}

TEST(LostRows, OfASmoothCommandComeBackFromItsNeighbours) {
  for (const double jitter_s : {0.0, 0.0015}) {
    Recording trial = logged(sine, {50, 51, 120, 300, 444}, jitter_s);
    fillLostRows(trial);
    ASSERT_EQ(trial.rows(), 500u);
    for (const int row : {50, 51, 120, 300, 444}) {
      const auto i = static_cast<std::size_t>(row);
      EXPECT_NEAR(trial.columns[0][i], 0.01 * row, jitter_s + 1e-9);
      EXPECT_NEAR(trial.columns[1][i], sine(0.01 * row), 1e-3);
      EXPECT_TRUE(std::isnan(trial.columns[2][i])) << "nobody measured it";
      EXPECT_FALSE(std::isnan(trial.columns[2][i + 20]));
    }
    EXPECT_THAT(trial.notes, ElementsAre(HasSubstr("5 rows are lost")));
  }
}

// Whether the step came in the lost row or behind it nobody knows.
TEST(LostRows, WhatFollowsALostStepIsNotCompared) {
  Recording trial = logged(steps, {50, 200, 330, 471});
  fillLostRows(trial);
  ASSERT_EQ(trial.rows(), 500u);
  for (std::size_t row = 0; row < trial.rows(); ++row) {
    const bool lost = row == 50 || row == 200 || row == 330 || row == 471;
    EXPECT_EQ(std::isnan(trial.columns[2][row]), lost || (row >= 200 && row < 350)) << row;
    if (row != 200) {
      EXPECT_EQ(trial.columns[1][row], steps(0.01 * static_cast<double>(row))) << row;
    }
  }
  EXPECT_THAT(trial.notes, ElementsAre(HasSubstr("one steps meanwhile (1 times)")));
}

TEST(LostRows, PausesOfAnyLengthAreNone) {
  Recording trial = logged(sine, {});
  for (const std::size_t row : {100u, 200u, 300u, 400u})
    for (std::size_t k = row; k < trial.rows(); ++k) trial.columns[0][k] += 0.0153;
  const Recording before = trial;
  fillLostRows(trial);
  EXPECT_EQ(trial.columns, before.columns);
  EXPECT_THAT(trial.notes, IsEmpty());
}

TEST(LostRows, StampsThatJitterLoseNothing) {
  for (const double jitter_s : {0.001, 0.003, 0.006, 0.02}) {
    Recording trial = logged(sine, {}, jitter_s);
    std::ranges::sort(trial.columns[0]);
    fillLostRows(trial);
    EXPECT_EQ(trial.rows(), 500u) << jitter_s;
  }
}

// Which torque drives its joint and which is measured is in the scene, not in its name.
TEST(LostRows, OfATorqueComeBackWhereItDrives) {
  Recording trial = logged(sine, {50, 51, 120, 300, 444});
  trial.channels[1] = "leg.knee.torque_nm";
  Recording measured = trial;
  fillLostRows(measured);
  EXPECT_EQ(measured.rows(), 495u);
  fillLostRows(trial, {1});
  ASSERT_EQ(trial.rows(), 500u);
  for (const std::size_t row : {50u, 51u, 120u, 300u, 444u})
    EXPECT_NEAR(trial.columns[1][row], sine(0.01 * static_cast<double>(row)), 1e-3);
}

TEST(LostRows, WithoutCommandsNothingIsMissed) {
  Recording trial = logged(sine, {50, 120, 300, 444});
  trial.channels[1] = "leg.hip.position_rad";
  fillLostRows(trial);
  EXPECT_EQ(trial.rows(), 496u);
}

TEST(LostRows, AMappingMaySayThatCommandsHeld) {
  EXPECT_TRUE(mappingFromJson(R"({"lost_rows": "hold"})", "m.json").lostRowsHold);
  EXPECT_FALSE(mappingFromJson(R"({"lost_rows": "fill"})", "m.json").lostRowsHold);
  EXPECT_THROW(mappingFromJson(R"({"lost_rows": 3})", "m.json"), InputError);
}

}  // namespace lost_rows
}  // namespace btr
