#include "core/gap/search/screening/search_discoveries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace btr {
namespace {

// Benjamini and Hochberg 1995, section 4: fifteen comparisons of two treatments of myocardial infarction. At a rate of
// 0.05 the procedure rejects four; Bonferroni's rejects three.
const std::vector<double> infarction{0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                                     0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.0000};

TEST(FalseDiscovery, RejectsAsInThePublishedExample) {
  const std::vector<double> rates = falseDiscoveryRates(infarction);
  EXPECT_EQ(std::count_if(rates.begin(), rates.end(), [](double rate) { return rate <= 0.05; }), 4);
  EXPECT_NEAR(rates[3], 0.0095 * 15 / 4, 1e-12);
  // 0.0344 at rank 8 adjusts to 0.0645, less than its neighbours' own 0.0695 and 0.0639 at ranks 6 and 7.
  EXPECT_NEAR(rates[7], 0.0344 * 15 / 8, 1e-12);
  EXPECT_NEAR(rates[5], 0.0298 * 15 / 7, 1e-12);
  EXPECT_EQ(rates[14], 1);
}

TEST(FalseDiscovery, KeepsTheOrderOfTheTests) {
  std::vector<double> turned(infarction.rbegin(), infarction.rend());
  std::vector<double> rates = falseDiscoveryRates(turned);
  std::reverse(rates.begin(), rates.end());
  EXPECT_EQ(rates, falseDiscoveryRates(infarction));
  EXPECT_TRUE(std::is_sorted(rates.begin(), rates.end()));
}

TEST(FalseDiscovery, OfOneTestIsItsPValue) {
  EXPECT_THAT(falseDiscoveryRates({0.03}), testing::ElementsAre(0.03));
  EXPECT_THAT(falseDiscoveryRates({}), testing::IsEmpty());
  EXPECT_THAT(falseDiscoveryRates({0.02, 1, 1, 1}), testing::ElementsAre(0.08, 1, 1, 1));
}

}  // namespace
}  // namespace btr
