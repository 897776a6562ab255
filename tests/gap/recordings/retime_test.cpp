// Stamps that jitter: found where the values do not, made even where the mapping agrees.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/recordings/channel_floor.h"
#include "core/gap/recordings/doctor/retime.h"
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/noise_floor.h"
#include "core/gap/recordings/recording.h"
#include "core/spec/parameter.h"
#include "core/spec/random.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using testing::Contains;
using testing::HasSubstr;

double waving(double t) { return 0.8 * std::sin(4 * t) + 0.3 * std::sin(9 * t + 1); }

/// A joint sampled evenly, every 5 ms from 3 s on, and stamped late by up to `latest_s`; some samples are dropped.
struct Stamped {
  Recording trial;
  std::vector<double> taken;

  Stamped(double latest_s, double noise, const std::vector<int>& dropped = {}, std::uint64_t seed = 1) {
    Random random(seed);
    trial.source = "log.csv";
    trial.channels = {"time_s", "leg.knee.position_rad"};
    trial.columns.resize(2);
    for (int i = 0; i < 2000; ++i) {
      const double t = 3 + 0.005 * i, stamp = t + random.uniform(0, latest_s),
                   value = waving(t) + noise * random.normal();
      if (std::ranges::find(dropped, i) != dropped.end()) continue;
      taken.push_back(t);
      trial.columns[0].push_back(stamp);
      trial.columns[1].push_back(value);
    }
  }
  double worst(double later) const {
    double most = 0;
    for (std::size_t i = 0; i < taken.size(); ++i)
      most = std::max(most, std::abs(trial.columns[0][i] - taken[i] - later));
    return most;
  }
};

TEST(Retime, PutsSamplesWhereTheyWereTakenUpToTheMeanDelay) {
  for (const double latest : {0.001, 0.003, 0.0048}) {
    Stamped late(latest, 0.001);
    retime(late.trial, 0);
    // The line's start is known to σ·2/√2000, its end as well.
    EXPECT_LT(late.worst(latest / 2), 4 * latest / std::sqrt(12.0) * 2 / std::sqrt(2000.0)) << latest;
    EXPECT_THAT(late.trial.notes,
                Contains(HasSubstr("time_s: stamps made even as the mapping says, a sample every 0.005")));
  }
}

TEST(Retime, LeavesDroppedSamplesOut) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    std::vector<int> dropped{1990};
    for (int i = 0; i < 37; ++i) dropped.push_back(700 + i);
    for (int i = 100; i < 600; i += 41) dropped.push_back(i);
    Stamped late(0.003, 0.001, dropped, seed);
    retime(late.trial, 0.005);
    EXPECT_LT(late.worst(0.0015), 1e-4) << seed;
  }
}

// Two losses within the window by which a clock is known: the rows between them were moved by a whole period.
TEST(Retime, LeavesSamplesOutThatWereDroppedNearEachOther) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    for (const double lost : {0.005, 0.015, 0.03, 0.1}) {
      Random random(100 + seed);
      std::vector<int> dropped;
      for (int i = 1; i < 2000; ++i)
        if (random.uniform(0, 1) < lost) dropped.push_back(i);
      Stamped late(0.001, 0.001, dropped, seed);
      retime(late.trial, 0);
      EXPECT_LT(late.worst(0.0005), 3e-4) << seed << ", lost " << lost;
    }
}

TEST(Retime, RefusesRowsThatAreNoEvenSamples) {
  Stamped other(0.001, 0);
  EXPECT_THAT(test::refusal([&] { retime(other.trial, 0.01); }),
              HasSubstr("retime period_s: 0.01 is not allowed; about 0.00"));
  Stamped bent(0, 0);
  for (double& t : bent.trial.columns[0]) t = 3 + (t - 3) * (t - 3) / 10;
  EXPECT_THAT(test::refusal([&] { retime(bent.trial, 0); }), HasSubstr("the rows are no even samples"));
  Stamped still(0, 0);
  for (double& t : still.trial.columns[0]) t = 3;
  EXPECT_THAT(test::refusal([&] { retime(still.trial, 0); }), HasSubstr("time that stands still"));
}

TEST(Retime, IsWhatTheMappingSays) {
  const auto refused = [](const std::string& json) {
    return test::refusal([&] { mappingFromJson(R"({"time_s": {"column": "t"}, "retime": )" + json + "}", "m.json"); });
  };
  EXPECT_EQ(refused("\"even\""), "accepted");
  EXPECT_EQ(refused("{\"period_s\": 0.01}"), "accepted");
  for (const char* wrong : {"\"odd\"", "true", "0.01", "{}", "{\"period_s\": 0}", "{\"period\": 1}", "[0.01]"})
    EXPECT_THAT(refused(wrong), HasSubstr("m.json")) << wrong;
  // Stamps of whole centiseconds repeat: without consent two values at one time.
  std::string rows = "t,q\n";
  for (int i = 0; i < 400; ++i) rows += toText(std::floor(0.4 * i) / 100) + "," + toText(waving(0.004 * i)) + "\n";
  const TemporaryFolder folder;
  const std::string file = folder.write("log.csv", rows);
  Mapping mapping = mappingFromJson(
      R"({"time_s": {"column": "t"}, "leg.knee.position_rad": {"column": "q"}, "retime": "even"})", "m.json");
  const Recording read = loadRecording(file, &mapping);
  ASSERT_EQ(read.rows(), 400u);
  EXPECT_NEAR(read.samplePeriod(), 0.004, 1e-6);
  mapping.retime_s.reset();
  EXPECT_THAT(test::refusal([&] { loadRecording(file, &mapping); }), HasSubstr("\"retime\": \"even\""));
}

TEST(ChannelFloor, SeesWhichClockTheValuesFollow) {
  const Stamped late(0.003, 0.0002);
  const ChannelFloor floor = channelFloor(late.trial, 1);
  EXPECT_TRUE(followsRowsNotStamps(floor));
  EXPECT_NEAR(floor.byRows, 0.0002, 0.00004);
  // Speed times jitter: the motion's mean square speed, and the spread of an even delay.
  const double speed = std::sqrt(0.5 * (std::pow(0.8 * 4, 2) + std::pow(0.3 * 9, 2))), jitter = 0.003 / std::sqrt(12.0);
  EXPECT_NEAR(floor.ofTime, speed * jitter, 0.1 * speed * jitter);
  EXPECT_NEAR(floor.level, speed * jitter, 0.15 * speed * jitter);
  // Samples that were taken at their uneven stamps: nothing to mend.
  Stamped uneven(0.003, 0);
  Random random(4);
  for (std::size_t i = 0; i < uneven.taken.size(); ++i)
    uneven.trial.columns[1][i] = waving(uneven.trial.columns[0][i]) + 0.0002 * random.normal();
  const ChannelFloor honest = channelFloor(uneven.trial, 1);
  EXPECT_FALSE(followsRowsNotStamps(honest));
  EXPECT_NEAR(honest.level, 0.0002, 0.00002);
  EXPECT_EQ(honest.ofTime, 0);
}

TEST(ChannelFloor, IsThatOfTheSamplesThatAreThere) {
  Stamped full(0, 0.001);
  for (const std::size_t every : {2u, 5u}) {
    Recording sparse = full.trial;
    for (std::size_t row = 0; row < sparse.rows(); ++row)
      if (row % every != 0) sparse.columns[1][row] = std::nan("");
    // At 25 ms the wave itself is seen a little: its fourth difference is (9·0.025)⁴·0.3/√70/√2 = 7e-5.
    EXPECT_NEAR(channelFloor(sparse, 1).level, 0.001, 0.00015) << every;
  }
}

TEST(ChannelFloor, IsNeverZeroForANumber) {
  Recording few;
  few.channels = {"time_s", "ball.x_m"};
  few.columns = {{0, 1, 2, 3}, {0.25, std::nan(""), 0.5, 0.75}};
  few.places.lastDigit = {0, 0.01};
  EXPECT_NEAR(channelFloor(few, 1).level, 0.01 / std::sqrt(12.0), 1e-15);
  EXPECT_TRUE(channelFloor(few, 1).few);
  few.columns[1] = {0.25, 0.25, 0.25, 0.25};
  EXPECT_GT(channelFloor(few, 1).level, 0);
  few.columns[1] = std::vector<double>(4, std::nan(""));
  EXPECT_EQ(channelFloor(few, 1).level, 0);
}

TEST(NoiseFloor, OverStampsIsThatOfWhiteNoiseHoweverTheyLie) {
  Random random(6);
  std::vector<double> time{0}, values;
  while (time.size() < 4000)
    time.push_back(time.back() + random.uniform(0.001, 0.009) + (random.chance(0.01) ? 0.2 : 0));
  for (const double t : time) values.push_back(0.5 * std::sin(t) + 0.002 * random.normal());
  EXPECT_NEAR(noiseFloor(time, values), 0.002, 0.0002);
  // Nothing of a cubic is noise.
  for (std::size_t i = 0; i < time.size(); ++i) values[i] = 1 + time[i] - 0.3 * std::pow(time[i], 3);
  EXPECT_LT(noiseFloor(time, values), 1e-6);
}

}  // namespace
}  // namespace btr
