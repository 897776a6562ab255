#include "core/spec/random.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <vector>

#include "core/spec/error.h"

namespace btr {
namespace {

/// Probability of a larger chi-square when all cells are equally likely.
double uniformityP(const std::vector<int>& counts) {
  double total = 0, chi = 0;
  for (const int count : counts) total += count;
  const double expected = total / static_cast<double>(counts.size());
  for (const int count : counts) chi += (count - expected) * (count - expected) / expected;
  return cdf(complement(boost::math::chi_squared(static_cast<double>(counts.size() - 1)), chi));
}

TEST(Random, IsXoshiro256StarStarOfItsAuthors) {
  Random random(0);
  // State 1, 2, 3, 4: the outputs follow by hand from rotl(s1·5, 7)·9.
  random.setState("0000000000000001000000000000000200000000000000030000000000000004");
  EXPECT_EQ(11520u, random.next());
  EXPECT_EQ(0u, random.next());
  EXPECT_EQ(1509978240u, random.next());
  EXPECT_EQ(1215971899390074240u, random.next());
}

TEST(Random, SeedIsSpreadBySplitmix64) {
  // Published outputs of splitmix64 for seed 1234567: 6457827717110365317, 3203168211198807973, …
  EXPECT_EQ("599ed017fb08fc852c73f08458540fa5883ebce5a3f27c773fbef740e9177b3f", Random(1234567).state());
}

TEST(Random, StateReadsBack) {
  Random first(42), second(1);
  for (int i = 0; i < 10; ++i) first.next();
  second.setState(first.state());
  for (int i = 0; i < 10; ++i) EXPECT_EQ(first.next(), second.next());
}

TEST(Random, RefusesATextThatIsNoState) {
  Random random(1);
  EXPECT_THROW(random.setState(""), InputError);
  EXPECT_THROW(random.setState(std::string(64, '0')), InputError);
  EXPECT_THROW(random.setState(std::string(64, 'g')), InputError);
  EXPECT_THROW(random.setState(std::string(65, 'a')), InputError);
}

TEST(Random, UniformStaysInItsIntervalAndIsFlat) {
  Random random(7);
  std::vector<int> counts(20);
  for (int i = 0; i < 200000; ++i) {
    const double value = random.uniform();
    ASSERT_GE(value, 0);
    ASSERT_LT(value, 1);
    ++counts[static_cast<std::size_t>(value * 20)];
  }
  EXPECT_GT(uniformityP(counts), 1e-3);
}

TEST(Random, BelowHasNoBias) {
  Random random(8);
  std::vector<int> counts(7);
  for (int i = 0; i < 70000; ++i) ++counts[random.below(7)];
  EXPECT_GT(uniformityP(counts), 1e-3);
  // A count just above 2^63: without rejection the lower half would come up twice as often.
  const std::uint64_t large = 0xC000000000000000u;
  int lower = 0;
  for (int i = 0; i < 10000; ++i) lower += random.below(large) < large / 2;
  EXPECT_NEAR(5000, lower, 4 * 50);
}

TEST(Random, NormalHasTheNormalQuantiles) {
  Random random(9);
  const boost::math::normal normal;
  std::vector<int> counts(20);
  for (int i = 0; i < 200000; ++i) ++counts[static_cast<std::size_t>(cdf(normal, random.normal()) * 19.999999)];
  EXPECT_GT(uniformityP(counts), 1e-3);
}

TEST(Random, PurposesAndNumbersAreIndependentSequences) {
  Random a = Random::forPurpose(1, "trial", 0), again = Random::forPurpose(1, "trial", 0);
  Random b = Random::forPurpose(1, "trial", 1), c = Random::forPurpose(1, "noise", 0),
         d = Random::forPurpose(2, "trial", 0);
  const std::uint64_t first = a.next();
  EXPECT_EQ(first, again.next());
  EXPECT_NE(first, b.next());
  EXPECT_NE(first, c.next());
  EXPECT_NE(first, d.next());
}

}  // namespace
}  // namespace btr
