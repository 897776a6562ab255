// Sensors that hang in the midst of a motion, and joints that merely stand still.
#include "core/gap/recordings/doctor/frozen.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/recordings/recording.h"
#include "core/spec/random.h"

namespace btr {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

double waving(double t) { return 0.6 * std::sin(3 * t) + 0.2 * std::sin(7 * t + 1); }

/// Read every 5 ms for 6 s, in counts and with noise.
template <class Position>
Recording recorded(Position position, double count, double noise = 0) {
  Random random(3);
  Recording trial;
  trial.channels = {"time_s", "leg.knee.command_rad", "leg.knee.position_rad", "leg.hip.position_rad"};
  trial.columns.resize(4);
  for (int i = 0; i < 1200; ++i) {
    const double t = 0.005 * i, value = position(t) + noise * random.normal();
    trial.columns[0].push_back(t);
    trial.columns[1].push_back(waving(t + 0.05));
    trial.columns[2].push_back(count > 0 ? count * std::round(value / count) : value);
    trial.columns[3].push_back(waving(t) / 2);
  }
  return trial;
}

/// The sensor tells at `from_s` for the last time, until `until_s`.
void hang(Recording& trial, double from_s, double until_s) {
  double last = 0;
  for (std::size_t row = 0; row < trial.rows(); ++row) {
    const double t = trial.columns[0][row];
    if (t <= from_s) last = trial.columns[2][row];
    if (t > from_s && t < until_s) trial.columns[2][row] = last;
  }
}

TEST(Frozen, ASensorThatHangsIsNotComparedMeanwhile) {
  for (const double count : {0.0, 2 * M_PI / 4096})
    for (const double noise : {0.0, 0.001}) {
      Recording trial = recorded(waving, count, noise);
      const Recording whole = trial;
      hang(trial, 2.1, 3.0);
      emptyFrozen(trial);
      ASSERT_EQ(trial.notes.size(), 1u) << count << " " << noise;
      EXPECT_THAT(trial.notes, ElementsAre(HasSubstr("leg.knee.position_rad: stays at exactly ")));
      for (std::size_t row = 0; row < trial.rows(); ++row) {
        const double t = trial.columns[0][row];
        EXPECT_EQ(std::isfinite(trial.columns[2][row]), t < 2.1025 || t > 2.9975) << t;
      }
      EXPECT_EQ(trial.columns[1], whole.columns[1]);
      EXPECT_EQ(trial.columns[3], whole.columns[3]);
    }
}

TEST(Frozen, ASensorThatHangsToTheEndIsNotComparedFromThereOn) {
  Recording trial = recorded(waving, 0.001);
  hang(trial, 4.2, 7);
  emptyFrozen(trial);
  EXPECT_THAT(trial.notes, ElementsAre(HasSubstr(" from 4.2 s to 5.995 s, stopped in full motion")));
  for (std::size_t row = 0; row < trial.rows(); ++row)
    EXPECT_EQ(std::isfinite(trial.columns[2][row]), trial.columns[0][row] < 4.2025);
}

TEST(Frozen, OneThatHangsToTheEndWhereItTurnedIsFoundByItsCommand) {
  Recording trial = recorded([](double t) { return 0.8 * std::sin(3 * t); }, 0.001);
  hang(trial, M_PI / 6 + 2 * M_PI / 3, 7);  // at its farthest
  emptyFrozen(trial);
  EXPECT_THAT(trial.notes, ElementsAre(AllOf(HasSubstr(" to 5.995 s"), HasSubstr("its sensor hung there"))));
}

TEST(Frozen, WhatRestsBrakesOrLeansOnSomethingIsKept) {
  const auto isKept = [](Recording trial) {
    const Recording before = trial;
    emptyFrozen(trial);
    EXPECT_THAT(trial.notes, IsEmpty());
    EXPECT_EQ(trial.columns, before.columns);
  };
  isKept(recorded(waving, 0.001));
  // Against a hard stop, which it leaves as it moves.
  isKept(recorded([](double t) { return std::min(waving(t), 0.3); }, 0.0015));
  // Dry friction holds it wherever it turns.
  isKept(recorded(
      [held = 0.0](double t) mutable {
        held = std::clamp(held, waving(t) - 0.15, waving(t) + 0.15);
        return held;
      },
      0.0015));
  // A soft approach to a target, and a rest there.
  Recording soft = recorded([](double t) { return 0.5 * (1 - std::exp(-3 * t)); }, 0.0015);
  soft.columns[1].assign(soft.rows(), 0.5);
  isKept(soft);
  // Goes quickly to where its command stays.
  Recording still = recorded([](double t) { return t < 2 ? 0.2 * t : 0.4; }, 0.0015);
  for (std::size_t row = 0; row < still.rows(); ++row)
    still.columns[1][row] = std::min(0.4, 0.2 * still.columns[0][row]);
  isKept(still);
}

}  // namespace
}  // namespace btr
