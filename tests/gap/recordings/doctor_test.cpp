#include "core/gap/recordings/doctor/doctor.h"
#include "core/gap/recordings/doctor/objection.h"
#include "core/gap/recordings/doctor/recording_health.h"
#include "core/gap/recordings/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace btr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A chirp-like motion: never the same twice, so that a shift is unique.
double motion(double t) { return 0.5 * std::sin(3 * t + 0.4 * t * t) + 0.2 * std::sin(5.3 * t); }

std::vector<double> timesOf(std::size_t count, double period, double wobble) {
  std::vector<double> times;
  for (std::size_t i = 0; i < count; ++i)
    times.push_back(period * static_cast<double>(i) + wobble * std::sin(2.3 * static_cast<double>(i)));
  return times;
}

Recording swingAt(const std::vector<double>& times) {
  Recording recording;
  recording.channels = {"time_s", "leg.knee.position_rad", "remark"};
  recording.columns.resize(3);
  for (const double t : times) {
    recording.columns[0].push_back(t);
    recording.columns[1].push_back(motion(t));
    recording.columns[2].push_back(std::nan(""));
  }
  return recording;
}

TEST(Doctor, FindsNothingOddInAnEvenOrSlightlyUnevenRecording) {
  for (const double wobble : {0.0, 0.0004}) {
    const RecordingHealth health = examine(swingAt(timesOf(1000, 0.005, wobble)));
    EXPECT_NEAR(health.period_s, 0.005, 3 * wobble + 1e-12);
    EXPECT_THAT(health.gaps, IsEmpty());
    EXPECT_THAT(health.findings, IsEmpty());
    ASSERT_EQ(health.channels.size(), 1u);
    EXPECT_EQ(health.channels[0].channel, "leg.knee.position_rad");
  }
}

TEST(Doctor, CountsDroppedSamples) {
  std::vector<double> times = timesOf(1000, 0.005, 0.0003);
  times.erase(times.begin() + 700, times.begin() + 707);
  times.erase(times.begin() + 300);
  const RecordingHealth health = examine(swingAt(times));
  ASSERT_EQ(health.gaps.size(), 2u);
  EXPECT_EQ(health.gaps[0].row, 300u);
  EXPECT_EQ(health.gaps[0].missing, 1);
  EXPECT_EQ(health.gaps[1].row, 699u);
  EXPECT_EQ(health.gaps[1].missing, 7);
  EXPECT_NEAR(health.gaps[1].to_s - health.gaps[1].from_s, 0.04, 0.001);
  EXPECT_THAT(health.findings, ElementsAre(HasSubstr("2 pauses, about 8 samples missing; the longest lasts 0.0")));
}

TEST(Doctor, TakesAnotherRhythmForNoPause) {
  // 5.3 ms with torque, 3.5 ms without, as a servo bus gives.
  std::vector<double> times;
  for (double t = 0; t < 2; t += 0.0053) times.push_back(t);
  for (double t = times.back() + 0.0035; t < 6; t += 0.0035) times.push_back(t);
  EXPECT_THAT(examine(swingAt(times)).gaps, IsEmpty());
}

TEST(Doctor, NamesCountsEmptyCellsAndHolds) {
  Recording recording = swingAt(timesOf(1000, 0.005, 0));
  auto& position = recording.columns[1];
  for (double& value : position) value = std::round(value / 0.0015) * 0.0015;
  for (std::size_t i = 400; i < 500; ++i) position[i] = position[400];
  position[10] = std::nan("");
  const RecordingHealth health = examine(recording);
  EXPECT_NEAR(health.channels[0].quantisation, 0.0015, 1e-9);
  EXPECT_EQ(health.channels[0].empty, 1u);
  EXPECT_NEAR(health.channels[0].longestHold_s, 0.005 * 99, 0.0101);
  EXPECT_THAT(health.findings, ElementsAre("leg.knee.position_rad: 1 of 1000 cells are empty",
                                           HasSubstr("leg.knee.position_rad: counts of 0.0015")));
}

TEST(Doctor, FindsTheOffsetOfTwoClocks) {
  const std::vector<double> times = timesOf(1200, 0.005, 0.0004);
  for (const double offset : {-0.12, -0.0031, 0.0, 0.0074, 0.08}) {
    std::vector<double> command, measured;
    for (const double t : times) {
      command.push_back(motion(t));
      measured.push_back(motion(t - offset) + 0.3);
    }
    const auto found = clockOffset(times, command, measured);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->offset_s, offset, 0.0005) << offset;
    EXPECT_LT(found->uncertainty_s, 0.1);
    EXPECT_GT(found->correlation, 0.99);
  }
}

TEST(Doctor, SaysNothingOfClocksWhereNothingMovesTogether) {
  const std::vector<double> times = timesOf(1200, 0.005, 0);
  std::vector<double> command, other;
  for (const double t : times) {
    command.push_back(motion(t));
    other.push_back(std::sin(37 * t));
  }
  EXPECT_FALSE(clockOffset(times, command, std::vector<double>(times.size(), 0.2)));
  EXPECT_FALSE(clockOffset(times, command, other));
  EXPECT_FALSE(clockOffset(std::vector<double>{0, 1}, std::vector<double>{0, 1}, std::vector<double>{0, 1}));
}

/// Who mends one column at a time is refused as often as there are columns.
TEST(Objection, NamesEachChannelOnceAndNoneThatFollowsElsewhere) {
  Objection objection;
  EXPECT_FALSE(objection.text());
  const Finding knee{"leg.knee.position_rad", "the knee is in degrees", true};
  const Finding hip{"leg.hip.position_rad", "the hip is reversed", true, true};
  const Finding ankle{"leg.ankle.position_rad", "the ankle leaps", true};
  const Finding doubt{"leg.toe.position_rad", "the toe may be late"};
  objection.hear("a.csv", "m.json", {{knee, hip, doubt}, {}});
  objection.hear("b.csv", "m.json", {{knee, ankle}, {"leg.hip.position_rad"}});
  EXPECT_EQ(objection.text(), "a.csv: the knee is in degrees; and b.csv: the ankle leaps");
}

}  // namespace
}  // namespace btr
