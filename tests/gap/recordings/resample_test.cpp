#include "core/gap/recordings/resample.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/recordings/channel_floor.h"
#include "core/gap/recordings/lowpass.h"
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/spec/error.h"
#include "core/spec/random.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

std::vector<double> sine(double hertz, double rate, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(std::sin(2 * M_PI * hertz * i / rate));
  return values;
}

/// Of a sine, from its mean square over the middle half: whole periods.
double amplitudeInTheMiddle(const std::vector<double>& values) {
  double squares = 0;
  for (std::size_t i = values.size() / 4; i < 3 * values.size() / 4; ++i) squares += values[i] * values[i];
  return std::sqrt(4 * squares / static_cast<double>(values.size()));
}

TEST(LowPass, HalvesTheAmplitudeAtItsCutoffAndFollowsButterworthElsewhere) {
  const double rate = 1000, cutoff = 50;
  for (const int order : {2, 4, 8})
    for (const double hertz : {10.0, 50.0, 100.0}) {
      // Prewarped bilinear transform: |H|² of forward and backward, at tan(πf/fs).
      const double ratio = std::tan(M_PI * hertz / rate) / std::tan(M_PI * cutoff / rate);
      const double gain = 1 / (1 + std::pow(ratio, 2 * order));
      const auto filtered = LowPass(order, cutoff, rate).zeroPhase(sine(hertz, rate, 4000));
      EXPECT_NEAR(amplitudeInTheMiddle(filtered), gain, 2e-3) << order << " " << hertz;
    }
}

TEST(LowPass, LeavesAStraightLineAloneToItsEnds) {
  std::vector<double> line;
  for (int i = 0; i < 300; ++i) line.push_back(2 - 0.5 * i);
  const auto filtered = LowPass(4, 20, 500).zeroPhase(line);
  for (std::size_t i = 0; i < line.size(); ++i) EXPECT_NEAR(filtered[i], line[i], 2e-3) << i;
}

TEST(LowPass, DoesNotDelay) {
  const auto given = sine(2, 500, 2000), filtered = LowPass(4, 30, 500).zeroPhase(given);
  for (std::size_t i = 200; i < 1800; ++i) EXPECT_NEAR(filtered[i], given[i], 1e-4);
}

Recording unevenSine() {
  Recording recording;
  recording.source = "made";
  recording.channels = {"time_s", "leg.knee.position_rad", "leg.knee.enabled"};
  recording.columns.resize(3);
  for (int i = 0; i < 1000; ++i) {
    const double time = 0.002 * i + (i % 7 == 3 ? 0.0007 : 0);
    recording.columns[0].push_back(time);
    recording.columns[1].push_back(std::sin(2 * M_PI * time));
    recording.columns[2].push_back(i < 500 ? 1 : 0);
  }
  return recording;
}

TEST(Resample, MakesTimesEvenAndKeepsTheMotion) {
  const Recording even = resampled(unevenSine(), {0.01, 0});
  ASSERT_GT(even.rows(), 190u);
  for (std::size_t i = 0; i < even.rows(); ++i) {
    EXPECT_NEAR(even.columns[0][i], 0.01 * static_cast<double>(i), 1e-12);
    if (i > 10 && i + 10 < even.rows()) {
      EXPECT_NEAR(even.columns[1][i], std::sin(2 * M_PI * even.columns[0][i]), 1e-3);
    }
    EXPECT_TRUE(even.columns[2][i] == 0 || even.columns[2][i] == 1);
  }
}

TEST(Resample, KnowsTheNoiseThatAFilterLeaves) {
  Random random(11);
  Recording noisy;
  noisy.channels = {"time_s", "leg.knee.torque_nm"};
  noisy.columns.resize(2);
  for (int i = 0; i < 20000; ++i) {
    noisy.columns[0].push_back(0.002 * i);
    noisy.columns[1].push_back(0.1 * random.normal());
  }
  for (const double cutoff : {5.0, 20.0, 60.0}) {
    const Recording smooth = resampled(noisy, {0.004, cutoff});
    double squares = 0;
    for (const double value : smooth.columns[1]) squares += value * value;
    // Its differences would say a tenth of that or less.
    const double there = std::sqrt(squares / static_cast<double>(smooth.rows()));
    EXPECT_NEAR(channelFloor(smooth, 1).level, there, 0.12 * there) << cutoff;
  }
}

TEST(Resample, RefusesAFilterThatTheRecordingCannotCarry) {
  EXPECT_THROW(resampled(unevenSine(), {0, 250}), InputError);
  EXPECT_THROW(resampled(unevenSine(), {100, 0}), InputError);
}

Mapping mappingWith(const std::string& more, const std::string& place = "m.json") {
  return mappingFromJson(R"({"time_s": {"column": "t"}, )" + more + "}", place);
}

TEST(Trials, ASegmentColumnDividesTheFile) {
  const TemporaryFolder folder;
  const std::string path = folder.write("swing.csv", "t,q,piece\n0,1,0\n1,2,0\n2,3,4\n3,4,4\n4,5,4\n");
  const Mapping mapping = mappingWith(R"("leg.knee.position_rad": {"column": "q"}, "segments": {"column": "piece"})");
  const auto trials = loadTrials(path, &mapping);
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_EQ(trials[0].rows(), 2u);
  EXPECT_EQ(trials[1].columns[0], (std::vector<double>{2, 3, 4}));
  EXPECT_EQ(trials[1].source, folder.file("swing-2.csv"));
  EXPECT_EQ(trials[0].sha256, trials[1].sha256);
  EXPECT_THROW(loadRecording(path, &mapping), InputError);
}

TEST(Trials, AMissingSegmentColumnIsNamed) {
  const TemporaryFolder folder;
  const std::string path = folder.write("swing.csv", "t,q\n0,1\n1,2\n");
  const Mapping mapping = mappingWith(R"("leg.knee.position_rad": {"column": "q"}, "segments": {"column": "piece"})");
  try {
    loadTrials(path, &mapping);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"piece\""), std::string::npos);
  }
}

TEST(Trials, ColumnsAreAddedWithTheirScales) {
  const TemporaryFolder folder;
  const std::string path = folder.write("arm.csv", "t,a,b\n0,1,5\n1,2,7\n");
  const Mapping mapping = mappingWith(
      R"("arm.elbow.position_rad": {"column": "b", "scale": 2, "offset": 1, "add": [{"column": "a", "scale": -1},
         {"column": "absent", "optional": true}]}, "arm.shoulder.position_rad": {"column": "a", "compare": false})");
  const Recording recording = loadRecording(path, &mapping);
  EXPECT_EQ(recording.columns[static_cast<std::size_t>(recording.column("arm.elbow.position_rad"))],
            (std::vector<double>{2 * 5 + 1 - 1, 2 * 7 + 1 - 2}));
  EXPECT_EQ(recording.notCompared, std::vector<std::string>{"arm.shoulder.position_rad"});
  const Mapping needed = mappingWith(R"("arm.elbow.position_rad": {"column": "b", "add": [{"column": "absent"}]})");
  EXPECT_THROW(loadRecording(path, &needed), InputError);
}

TEST(Trials, AMappingMayResample) {
  const TemporaryFolder folder;
  std::string text = "t,q\n";
  for (int i = 0; i < 400; ++i) text += std::to_string(i) + "e-3," + std::to_string(i) + "\n";
  const std::string path = folder.write("arm.csv", text);
  const Mapping mapping =
      mappingWith(R"("arm.elbow.position_rad": {"column": "q"}, "resample": {"period_s": 0.01, "lowpass_hz": 20})");
  const Recording recording = loadRecording(path, &mapping);
  ASSERT_EQ(recording.rows(), 40u);
  EXPECT_NEAR(recording.columns[1][20], 200, 1e-2);
}

}  // namespace
}  // namespace btr
