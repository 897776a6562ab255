#include "core/gap/replay/initial_state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/spec/random.h"

namespace btr {
namespace {

struct Samples {
  std::vector<double> time, values;
};

/// x = position + rate·t + acceleration·t²/2 with noise and rounding to counts.
Samples line(double position, double rate, double acceleration, double noise, double count, std::uint64_t seed) {
  Random random(seed);
  Samples samples;
  for (int i = 0; i < 300; ++i) {
    const double t = 0.005 * i;
    double value = position + rate * t + acceleration * t * t / 2 + noise * random.normal();
    if (count > 0) value = std::round(value / count) * count;
    samples.time.push_back(2 + t);
    samples.values.push_back(value);
  }
  return samples;
}

TEST(InitialState, IsTheMeanOfTheFirstSamplesAtRest) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Samples rest = line(0.3, 0, 0, 1e-3, 0, seed);
    const Start start = estimateStart(rest.time, rest.values);
    EXPECT_FALSE(start.moving) << seed;
    EXPECT_EQ(start.rate, 0);
    EXPECT_NEAR(start.position, 0.3, 4 * 1e-3 / std::sqrt(7.0)) << seed;
  }
}

TEST(InitialState, DoesNotTakeOneCountForAMotion) {
  Samples rest = line(0, 0, 0, 0, 0, 1);
  for (std::size_t i = 3; i < rest.values.size(); ++i) rest.values[i] = 0.0015;
  for (std::size_t i = 30; i < rest.values.size(); ++i) rest.values[i] = 0.0015 * static_cast<double>(i % 5);
  EXPECT_FALSE(estimateStart(rest.time, rest.values).moving);
}

TEST(InitialState, FollowsALineWhenItClearlyMoves) {
  for (const double count : {0.0, 1.5e-3}) {
    const Samples swing = line(-0.2, 3, 0, 5e-4, count, 7);
    const Start start = estimateStart(swing.time, swing.values);
    EXPECT_TRUE(start.moving);
    EXPECT_NEAR(start.position, -0.2, 2e-3);
    EXPECT_NEAR(start.rate, 3, 0.1);
  }
}

TEST(InitialState, KnowsGravity) {
  const Samples flight = line(1, 2, -9.81, 0, 0, 1);
  const Start start = estimateStart(flight.time, flight.values, 0.05, -9.81);
  EXPECT_NEAR(start.position, 1, 1e-12);
  EXPECT_NEAR(start.rate, 2, 1e-10);
  EXPECT_LT(startMisfit(flight.time, flight.values, 0.05, -9.81), startMisfit(flight.time, flight.values, 0.05, 0));
}

TEST(InitialState, OfABallIsNotLostInItsBounces) {
  // A sample every 40 ms, a bounce every six of them, loses half its speed.
  std::vector<double> time, height;
  Random random(3);
  double z = 0.6, rate = 1.1;
  for (int i = 0; i < 24; ++i) {
    time.push_back(0.04 * i);
    height.push_back(z + 4e-4 * random.normal());
    z += 0.04 * rate - 9.81 * 0.04 * 0.04 / 2;
    rate -= 9.81 * 0.04;
    if (z < 0) z = -z / 4, rate = -rate / 2;
  }
  EXPECT_FALSE(estimateStart(time, height, 0.05, -9.81).moving) << "else this tests nothing";
  const Start start = estimateStart(time, height, 0.05, -9.81, Impacts::some);
  EXPECT_TRUE(start.moving);
  EXPECT_NEAR(start.rate, 1.1, 0.03);
}

TEST(InitialState, PassesOverEmptyCells) {
  Samples rest = line(0.3, 0, 0, 0, 0, 1);
  rest.values[0] = rest.values[2] = std::nan("");
  EXPECT_NEAR(estimateStart(rest.time, rest.values).position, 0.3, 1e-15);
}

TEST(InitialState, TurnsQuaternionsIntoAttitudeAndSpin) {
  const Eigen::Quaterniond tilted(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()));
  const Eigen::Vector3d spin(4, -3, 5);
  std::vector<double> time;
  std::array<std::vector<double>, 4> columns;
  for (int i = 0; i < 20; ++i) {
    const double t = 0.004 * i;
    Eigen::Quaterniond now = Eigen::AngleAxisd(spin.norm() * t, spin.normalized()) * tilted;
    if (i % 2 == 1) now.coeffs() = -now.coeffs();  // the same attitude
    time.push_back(t);
    for (std::size_t k = 0; k < 4; ++k) columns[k].push_back(k == 0 ? now.w() : now.vec()[static_cast<int>(k) - 1]);
  }
  const StartAttitude start = estimateAttitude(time, {columns[0], columns[1], columns[2], columns[3]});
  EXPECT_NEAR(start.orientation.angularDistance(tilted), 0, 1e-6);
  EXPECT_NEAR((start.spin_rad_s - spin).norm(), 0, 1e-6);
}

}  // namespace
}  // namespace btr
