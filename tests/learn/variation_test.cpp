#include "core/learn/variation.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <map>

namespace btr {
namespace {

TEST(TwoPointCrossover, ExchangesTheBitsBetweenTheCuts) {
  std::string one = "00000000", other = "11111111";
  exchange(one, other, {2, 5});
  EXPECT_EQ("00111000", one);
  EXPECT_EQ("11000111", other);
}

TEST(TwoPointCrossover, EveryPairOfCutsIsEquallyLikelyInsideGenesToo) {
  const std::size_t length = 24;  // three genes of eight bits: 23 places, 253 pairs
  Random random(21);
  const int draws = 253000;
  std::map<std::pair<std::size_t, std::size_t>, int> counts;
  for (int i = 0; i < draws; ++i) {
    const Cuts cuts = drawCuts(length, random);
    ASSERT_LE(1u, cuts.first);
    ASSERT_LT(cuts.first, cuts.second);
    ASSERT_LE(cuts.second, length - 1);
    ++counts[{cuts.first, cuts.second}];
  }
  ASSERT_EQ(253u, counts.size());
  double chi = 0;
  for (const auto& [cuts, count] : counts) chi += (count - 1000.0) * (count - 1000.0) / 1000;
  EXPECT_GT(cdf(complement(boost::math::chi_squared(252), chi)), 1e-3);
}

TEST(TwoPointCrossover, WorksOnTheShortestString) {
  Random random(22);
  for (int i = 0; i < 100; ++i) EXPECT_EQ((Cuts{1, 2}), drawCuts(3, random));
}

TEST(Mutation, FlipsEachBitAtItsRateIndependently) {
  Random random(23);
  const int strings = 20000, length = 50;
  const double rate = 0.015;
  std::vector<int> flips(length);
  int together = 0;
  for (int i = 0; i < strings; ++i) {
    std::string bits(length, i % 2 ? '1' : '0');
    const std::string before = bits;
    mutate(bits, rate, random);
    for (std::size_t b = 0; b < length; ++b) flips[b] += bits[b] != before[b];
    for (std::size_t b = 1; b < length; ++b) together += bits[b] != before[b] && bits[b - 1] != before[b - 1];
  }
  double chi = 0;
  for (const int count : flips)
    chi += (count - strings * rate) * (count - strings * rate) / (strings * rate * (1 - rate));
  const double p = cdf(complement(boost::math::chi_squared(length), chi));
  EXPECT_GT(p, 1e-3);
  EXPECT_LT(p, 1 - 1e-3);
  const double pairs = strings * (length - 1.0) * rate * rate;
  EXPECT_NEAR(pairs, together, 4 * std::sqrt(pairs));
}

TEST(Mutation, RateZeroChangesNothingAndRateOneEverything) {
  Random random(24);
  std::string bits = "0101100";
  mutate(bits, 0, random);
  EXPECT_EQ("0101100", bits);
  mutate(bits, 1, random);
  EXPECT_EQ("1010011", bits);
}

}  // namespace
}  // namespace btr
