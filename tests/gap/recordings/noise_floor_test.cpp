#include "core/gap/recordings/noise_floor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/spec/random.h"

namespace btr {
namespace {

std::vector<double> swing(std::size_t samples, double noise, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> values;
  for (std::size_t i = 0; i < samples; ++i)
    values.push_back(0.8 * std::sin(2 * M_PI * 0.7 * static_cast<double>(i) * 0.004) + noise * random.normal());
  return values;
}

TEST(NoiseFloor, FindsTheNoiseUnderAMotionWithinAFewPercent) {
  // The median of 40 blocks of 46 or more degrees of freedom: standard error about 2 %; its bias is below 1 %.
  for (const double noise : {1e-4, 2e-3})
    for (std::uint64_t seed = 1; seed <= 10; ++seed)
      EXPECT_NEAR(noiseFloor(swing(2000, noise, seed)) / noise, 1, 0.08) << noise << " " << seed;
}

TEST(NoiseFloor, IsBelowAMicroradianForAMotionWithoutNoise) { EXPECT_LT(noiseFloor(swing(2000, 0, 1)), 1e-6); }

TEST(NoiseFloor, IgnoresAFewKnocksAndEmptyCells) {
  std::vector<double> values = swing(2000, 1e-3, 3);
  const double before = noiseFloor(values);
  values[700] += 5;
  values[1400] = std::nan("");
  EXPECT_NEAR(noiseFloor(values), before, 0.05 * before);
  EXPECT_EQ(noiseFloor(std::vector<double>{1, 2, 3, 4}), 0);
  EXPECT_NEAR(noiseFloor(std::vector<double>{0, 0, 1, 0, 0}), 6 / std::sqrt(70.0), 1e-12);
}

/// The height of a ball that bounces up as fast as it came down, every `each` samples.
std::vector<double> bouncing(std::size_t samples, std::size_t each, double noise, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> values;
  for (std::size_t i = 0; i < samples; ++i) {
    const double share = (static_cast<double>(i % each) + 0.3) / static_cast<double>(each);
    values.push_back(1.6 * share * (1 - share) + noise * random.normal());
  }
  return values;
}

TEST(NoiseFloor, OfABallIsNotThatOfItsBounces) {
  double sum = 0;
  constexpr int seeds = 40;
  for (int seed = 1; seed <= seeds; ++seed) {
    const double ratio = noiseFloor(bouncing(60, 12, 1e-3, static_cast<std::uint64_t>(seed)), Impacts::some) / 1e-3;
    EXPECT_GT(ratio, 0.5) << seed;
    EXPECT_LT(ratio, 2.2) << seed;
    sum += ratio;
  }
  // A third of the differences span a bounce; of the others some are counted to those.
  EXPECT_NEAR(1, sum / seeds, 0.25);
}

TEST(NoiseFloor, WithoutImpactsIsTheSame) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_EQ(noiseFloor(swing(60, 1e-3, seed)), noiseFloor(swing(60, 1e-3, seed), Impacts::some));
}

TEST(QuantisationStep, IsWhatOneCountIsWorth) {
  const double count = 2 * M_PI / 4096;
  std::vector<double> values = swing(1500, 0, 1);
  for (double& value : values)
    value = std::round(std::round(value / count) * count * 1e6) / 1e6;  // six digits in the file
  EXPECT_NEAR(quantisationStep(values), count, 1e-3 * count);
  EXPECT_NEAR(resolution(values), count / std::sqrt(12.0), 0.5 * count);
}

// A tossed ball that passes five to six counts from sample to sample: its fourth differences alone say two thirds.
TEST(QuantisationStep, IsFoundInAMotionThatPassesSeveralCountsPerSample) {
  const double count = 0.001069;
  Random random(7);
  for (int trial = 0; trial < 20; ++trial) {
    const double speed = count * random.uniform(5.1, 5.9), start = random.uniform(0, count);
    std::vector<double> values;
    for (int i = 0; i < 160; ++i) values.push_back(count * std::round((start + speed * i) / count));
    EXPECT_NEAR(quantisationStep(values), count, 1e-6 * count) << speed;
    EXPECT_GE(resolution(values), 0.999 * count / std::sqrt(12.0));
  }
}

TEST(QuantisationStep, IsNothingForContinuousOrConstantValues) {
  EXPECT_EQ(quantisationStep(swing(1500, 1e-3, 1)), 0);
  EXPECT_EQ(quantisationStep(std::vector<double>(100, 0.25)), 0);
  // Nor is what a motion without noise does from sample to sample: at an even speed, and falling from rest.
  std::vector<double> even, falling(30, 0.0);
  for (int i = 0; i < 200; ++i) {
    even.push_back(0.0064 * i);
    falling.push_back(-0.5 * 9.81 * std::pow(0.006 * i, 2));
  }
  EXPECT_EQ(quantisationStep(even), 0);
  EXPECT_EQ(quantisationStep(falling), 0);
}

}  // namespace
}  // namespace btr
