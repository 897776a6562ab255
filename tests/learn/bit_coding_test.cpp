#include "core/learn/bit_coding.h"

#include <gtest/gtest.h>

#include <cmath>

namespace btr {
namespace {

using Kind = BitCoding::Kind;

/// `number` as eight binary digits.
std::string digits(unsigned number) {
  std::string text;
  for (int bit = 7; bit >= 0; --bit) text += (number >> bit & 1u) ? '1' : '0';
  return text;
}

TEST(BitCoding, EightBinaryDigitsRunThrough0To255) {
  for (unsigned number = 0; number < 256; ++number) EXPECT_EQ(number, geneNumber(digits(number), Kind::binary));
}

TEST(BitCoding, GrayCodeIsThePublishedTableOfThreeBits) {
  const char* table[] = {"000", "001", "011", "010", "110", "111", "101", "100"};
  for (std::uint32_t number = 0; number < 8; ++number) EXPECT_EQ(number, geneNumber(table[number], Kind::gray));
}

TEST(BitCoding, NeighboursInGrayCodeDifferInOneBit) {
  // The Gray code of n is n xor n/2.
  for (unsigned number = 0; number < 256; ++number)
    EXPECT_EQ(number, geneNumber(digits(number ^ number >> 1), Kind::gray));
}

TEST(BitCoding, ParametersAreTheMinimumPlusAShareOf255) {
  const BitCoding coding({{"a", "", "", -1, 3, 0}, {"b", "", "", 10, 20, 10}}, 8, Kind::binary);
  EXPECT_EQ(16u, coding.length());
  for (unsigned number = 0; number < 256; ++number) {
    const auto decoded = coding.decode(digits(number) + digits(255 - number));
    EXPECT_NEAR(-1 + 4 * number / 255.0, decoded[0], 1e-15 * 4);
    EXPECT_NEAR(10 + 10 * (255 - number) / 255.0, decoded[1], 1e-15 * 20);
  }
}

TEST(BitCoding, BoundsAreReachedExactlyAndNeverPassed) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double low = random.uniform(-10, 10), high = low + random.uniform();
    for (const int bits : {4, 8, 16}) {
      const BitCoding coding({{"a", "", "", low, high, low}}, bits, Kind::binary);
      EXPECT_EQ(low, coding.decode(std::string(static_cast<std::size_t>(bits), '0'))[0]);
      EXPECT_EQ(high, coding.decode(std::string(static_cast<std::size_t>(bits), '1'))[0]);
      const double between = coding.decode(coding.draw(random))[0];
      EXPECT_LE(low, between);
      EXPECT_GE(high, between);
    }
  }
}

TEST(BitCoding, WholeParametersAreRounded) {
  const BitCoding coding({{"n", "", "", 2, 16, 4, {}, true}}, 8, Kind::binary);
  std::vector<int> counts(17);
  for (unsigned number = 0; number < 256; ++number) {
    const double value = coding.decode(digits(number))[0];
    EXPECT_EQ(std::round(2 + 14 * number / 255.0), value);
    ++counts[static_cast<std::size_t>(value)];
  }
  for (int n = 2; n <= 16; ++n) EXPECT_GT(counts[static_cast<std::size_t>(n)], 0) << n;
}

TEST(BitCoding, KnowsAChromosomeFromAnotherText) {
  const BitCoding coding({{"a", "", "", 0, 1, 0}}, 4, Kind::binary);
  EXPECT_TRUE(coding.fits("0110"));
  EXPECT_FALSE(coding.fits("011"));
  EXPECT_FALSE(coding.fits("01101"));
  EXPECT_FALSE(coding.fits("01x0"));
}

TEST(BitCoding, DrawnBitsAreFairAndIndependent) {
  const BitCoding coding({{"a", "", "", 0, 1, 0}}, 16, Kind::binary);
  Random random(2);
  const int draws = 20000;
  std::vector<int> ones(16), pairs(16);
  for (int i = 0; i < draws; ++i) {
    const std::string bits = coding.draw(random);
    for (std::size_t b = 0; b < 16; ++b) {
      ones[b] += bits[b] == '1';
      pairs[b] += bits[b] == bits[(b + 1) % 16];
    }
  }
  // Binomial with p = ½: standard deviation √n/2; four of them hold for all 32 counts but once in 500 seeds.
  const double allowed = 4 * std::sqrt(draws) / 2;
  for (std::size_t b = 0; b < 16; ++b) {
    EXPECT_NEAR(draws / 2, ones[b], allowed);
    EXPECT_NEAR(draws / 2, pairs[b], allowed);
  }
}

TEST(BitCoding, EncodesToTheNearestChromosomeInBothCodings) {
  for (const auto kind : {BitCoding::Kind::binary, BitCoding::Kind::gray}) {
    const BitCoding coding({{"a", "", "", -2, 2, 0}, {"b", "", "", 0, 255, 0}, {"c", "", "", 1, 9, 1, {}, true}}, 8,
                           kind);
    Random random(5);
    for (int i = 0; i < 100; ++i) {
      const std::vector<double> at{random.uniform(-2, 2), random.uniform(0, 255), std::floor(random.uniform(1, 10))};
      const std::string chromosome = coding.encode(at);
      const std::vector<double> decoded = coding.decode(chromosome);
      EXPECT_LE(std::abs(decoded[0] - at[0]), 0.5 * 4 / 255 + 1e-12);
      EXPECT_LE(std::abs(decoded[1] - at[1]), 0.5 + 1e-12);
      EXPECT_EQ(at[2], decoded[2]);
      EXPECT_EQ(decoded, coding.decode(coding.encode(decoded)));
    }
    EXPECT_EQ((std::vector<double>{2, 0, 9}), coding.decode(coding.encode(std::vector<double>{7, -7, 90})));
  }
}

}  // namespace
}  // namespace btr
