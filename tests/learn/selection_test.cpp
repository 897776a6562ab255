#include "core/learn/selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace btr {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(LinearScaling, KeepsTheAverageAndMakesTheBestCTimesIt) {
  // Average 5, best 6, worst 4: a = (C−1)·5/1, for C = 1.2 f' = f·1 + 0 … the worst stays positive.
  const std::vector<double> fitness{4, 5, 5, 6};
  for (const double copies : {1.2, 1.5, 2.0}) {
    const auto scaled = linearScaling(fitness, copies);
    EXPECT_NEAR(1, mean(scaled), 1e-15);
    EXPECT_NEAR(copies, scaled[3], 1e-15);
    EXPECT_NEAR(1, scaled[1], 1e-15);
    EXPECT_NEAR(2 - copies, scaled[0], 1e-15);
  }
}

TEST(LinearScaling, IsGoldbergsFormula) {
  Random random(4);
  for (int test = 0; test < 1000; ++test) {
    std::vector<double> fitness(10);
    for (double& value : fitness) value = random.uniform(0.1, 5);
    const double C = random.uniform(1.2, 2), average = mean(fitness);
    const double best = *std::max_element(fitness.begin(), fitness.end());
    const double worst = *std::min_element(fitness.begin(), fitness.end());
    double a = 0, b = 0;
    if (worst > (C * average - best) / (C - 1)) {
      a = (C - 1) * average / (best - average);
      b = average * (best - C * average) / (best - average);
    } else {
      a = average / (average - worst);
      b = -worst * average / (average - worst);
    }
    const auto scaled = linearScaling(fitness, C);
    for (std::size_t i = 0; i < fitness.size(); ++i) EXPECT_NEAR((a * fitness[i] + b) / average, scaled[i], 1e-12);
  }
}

TEST(LinearScaling, WhereTheWorstWouldBeNegativeItGetsNothing) {
  // Average 9, best 10, worst 0: twice the average for 10 would give 0 a negative share.
  std::vector<double> fitness(10, 10);
  fitness[0] = 0;
  const auto scaled = linearScaling(fitness, 2);
  EXPECT_EQ(0, scaled[0]);
  EXPECT_NEAR(10.0 / 9, scaled[1], 1e-15);
  EXPECT_NEAR(1, mean(scaled), 1e-15);
}

TEST(LinearScaling, DoesNotDependOnTheUnitOfFitness) {
  const std::vector<double> metres{0.1, 0.5, 0.7, 1.9}, millimetres{100, 500, 700, 1900};
  const auto one = linearScaling(metres, 2), other = linearScaling(millimetres, 2);
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(one[i], other[i], 1e-14);
}

TEST(LinearScaling, AConvergedOrWorthlessPopulationIsAllEqual) {
  const std::vector<double> ones(5, 1.0);
  EXPECT_EQ(ones, linearScaling(std::vector<double>(5, 3.7), 2));
  EXPECT_EQ(ones, linearScaling(std::vector<double>(5, 0.0), 2));
  EXPECT_EQ(ones, linearScaling(std::vector<double>(5, -2.0), 2));
  EXPECT_EQ(ones, linearScaling(std::vector<double>(5, nan), 2));
  EXPECT_EQ(std::vector<double>{1.0}, linearScaling(std::vector<double>{4.0}, 2));
}

TEST(LinearScaling, NegativeFitnessIsShiftedSoThatTheWorstIsZero) {
  const auto shifted = linearScaling(std::vector<double>{-3, -1, 0, 2}, 2);
  const auto plain = linearScaling(std::vector<double>{0, 2, 3, 5}, 2);
  for (std::size_t i = 0; i < plain.size(); ++i) EXPECT_NEAR(plain[i], shifted[i], 1e-15);
}

TEST(LinearScaling, WhatIsNotFiniteCountsAsTheWorst) {
  EXPECT_EQ((std::vector<double>{2, 1, 1, 1, 3}), finiteFitness(std::vector<double>{2, nan, 1, infinity, 3}));
  EXPECT_EQ(linearScaling(std::vector<double>{2, 1, 1, 1, 3}, 2),
            linearScaling(std::vector<double>{2, nan, 1, -infinity, 3}, 2));
}

TEST(LinearScaling, StaysFiniteAndNotNegativeForAnyFitness) {
  const double huge = std::numeric_limits<double>::max(), tiny = std::numeric_limits<double>::denorm_min();
  const std::vector<std::vector<double>> populations{{huge, -huge, 0},
                                                     {huge, huge, huge / 2},
                                                     {tiny, 0, 0},
                                                     {1, 1 + 1e-16, 1 - 1e-16},
                                                     {1, std::nextafter(1.0, 2), 1, 1},
                                                     {-huge, -huge, nan},
                                                     {1e300, 1e-300, -1e-300}};
  for (const auto& fitness : populations) {
    const auto scaled = linearScaling(fitness, 2);
    double sum = 0;
    for (const double weight : scaled) {
      EXPECT_TRUE(std::isfinite(weight) && weight >= 0) << weight;
      EXPECT_LE(weight, 2 + 1e-9);
      sum += weight;
    }
    EXPECT_GT(sum, 0);
  }
}

TEST(Roulette, DrawsInProportionToTheWeights) {
  const std::vector<double> fitness{0.2, 1.0, 0.4, 0.7, 2.2, 0.9};
  const auto weights = linearScaling(fitness, 2);
  const Roulette wheel(weights);
  Random random(11);
  const int draws = 600000;
  std::vector<int> counts(weights.size());
  for (int i = 0; i < draws; ++i) ++counts[wheel.spin(random)];
  double chi = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double expected = draws * weights[i] / static_cast<double>(weights.size());
    chi += (counts[i] - expected) * (counts[i] - expected) / expected;
  }
  EXPECT_GT(cdf(complement(boost::math::chi_squared(5), chi)), 1e-3);
}

TEST(Roulette, NeverDrawsWhatHasNoWeight) {
  const Roulette wheel(std::vector<double>{0, 1, 0, 2, 0});
  Random random(12);
  for (int i = 0; i < 100000; ++i) EXPECT_EQ(1u, wheel.spin(random) % 2);
}

}  // namespace
}  // namespace btr
