// The arithmetic of Kohl and Stone's policy gradient, on groups made by hand.
#include "core/learn/policy_gradient.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace btr {
namespace {

using Policies = std::vector<std::vector<double>>;

std::vector<Parameter> boxes(std::size_t count) {
  std::vector<Parameter> genotype;
  for (std::size_t i = 0; i < count; ++i) genotype.push_back({"p" + std::to_string(i), "", "", -10, 10, 0});
  return genotype;
}

TEST(PolicyGradient, StepsAlongTheDifferenceOfTheOuterGroupsInUnitsOfEpsilon) {
  // First parameter: Avg+ = 7, Avg0 = 4, Avg− = 4. Second: Avg+ = 5, Avg0 = 4, Avg− = 9: A = (3, −4), |A| = 5.
  const Policies policies{{0.5, 2}, {0.5, 0}, {0, -2}, {-0.5, 0}, {0, 2}, {-0.5, -2}, {0.5, -2}, {0, 0}, {-0.5, 2}};
  //                       a         b         c        d          e       f           g          h       i
  // + : a b g, 0 : c e h, − : d f i;   second  + : a e i, 0 : b d h, − : c f g
  const std::vector<double> fitness{8, 4, 9, 3, 1, 8.5, 9, 2, 0.5};
  const auto step = policyGradient(boxes(2), std::vector{0.0, 0.0}, std::vector{0.5, 2.0}, 2, policies, fitness);
  const ParameterGradient &x = step.parameters[0], &y = step.parameters[1];
  EXPECT_DOUBLE_EQ(7, x.above.mean);
  EXPECT_DOUBLE_EQ(4, x.same.mean);
  EXPECT_DOUBLE_EQ(4, x.below.mean);
  EXPECT_DOUBLE_EQ(3, x.gradient);
  EXPECT_DOUBLE_EQ((8 + 1 + 0.5) / 3, y.above.mean);
  EXPECT_DOUBLE_EQ(3, y.same.mean);
  EXPECT_DOUBLE_EQ((9 + 8.5 + 9) / 3, y.below.mean);
  const double a = 3, b = (9.5 - 26.5) / 3, length = std::sqrt(a * a + b * b);
  EXPECT_DOUBLE_EQ(b, y.gradient);
  EXPECT_NEAR(2 * 0.5 * a / length, step.centre[0], 1e-15);
  EXPECT_NEAR(2 * 2.0 * b / length, step.centre[1], 1e-15);
}

TEST(PolicyGradient, StaysWhereUnchangedIsBetterThanBoth) {
  const Policies policies{{1, 1}, {0, 1}, {-1, 1}, {1, 0}, {0, 0}, {-1, 0}, {1, -1}, {0, -1}, {-1, -1}};
  const std::vector<double> fitness{1, 9, 3, 2, 9, 3, 0, 9, 3};  // the first parameter alone matters, and 0 is its best
  const auto step = policyGradient(boxes(2), std::vector{0.0, 0.0}, std::vector{1.0, 1.0}, 1, policies, fitness);
  EXPECT_EQ(0, step.parameters[0].gradient);
  EXPECT_EQ(0, step.parameters[0].step);
}

TEST(PolicyGradient, AnUnchangedGroupThatOnlyTiesWithABetterOneDoesNotHoldTheCentre) {
  const Policies policies{{1}, {0}, {-1}};
  const auto step =
      policyGradient(boxes(1), std::vector{0.0}, std::vector{1.0}, 1, policies, std::vector{5.0, 5.0, 2.0});
  EXPECT_EQ(3, step.parameters[0].gradient);
  EXPECT_EQ(1, step.centre[0]);
}

TEST(PolicyGradient, EqualFitnessEverywhereKeepsTheCentre) {
  const Policies policies{{1}, {0}, {-1}, {1}};
  const auto step = policyGradient(boxes(1), std::vector{0.25}, std::vector{1.0}, 2, policies, std::vector(4, 3.0));
  EXPECT_EQ(0.25, step.centre[0]);
  EXPECT_EQ(0, step.parameters[0].step);
}

TEST(PolicyGradient, AnEmptyGroupSaysNothing) {
  const Policies noneBelow{{1}, {0}, {1}}, noneSame{{1}, {-1}, {1}};
  for (const Policies& policies : {noneBelow, noneSame}) {
    const auto step =
        policyGradient(boxes(1), std::vector{0.0}, std::vector{1.0}, 1, policies, std::vector{9.0, 1.0, 9.0});
    EXPECT_EQ(0, step.parameters[0].gradient);
    EXPECT_EQ(0, step.centre[0]);
  }
}

TEST(PolicyGradient, APolicyThatTheBoundsPushedBackCountsAsUnchanged) {
  const std::vector<Parameter> genotype{{"p", "", "", -1, 1, 0}};
  // Drawn at the upper bound: what went up lies at the bound again.
  const Policies policies{{1}, {1}, {-0.5}, {1}};
  const auto step =
      policyGradient(genotype, std::vector{1.0}, std::vector{1.5}, 1, policies, std::vector{4.0, 5.0, 1.0, 6.0});
  EXPECT_EQ(0, step.parameters[0].above.count);
  EXPECT_EQ(3, step.parameters[0].same.count);
  EXPECT_EQ(5, step.parameters[0].same.mean);
  EXPECT_EQ(1, step.centre[0]) << "the bound is better than what lies within";
}

TEST(PolicyGradient, LeavesABoundWhenInwardIsBetter) {
  const std::vector<Parameter> genotype{{"p", "", "", -1, 1, 0}};
  for (const double side : {1.0, -1.0}) {
    const Policies policies{{side}, {side}, {0.5 * side}, {side}};
    const auto step =
        policyGradient(genotype, std::vector{side}, std::vector{0.5}, 1, policies, std::vector{1.0, 2.0, 4.0, 3.0});
    EXPECT_EQ(-2 * side, step.parameters[0].gradient);
    EXPECT_EQ(0.5 * side, step.centre[0]);
  }
}

TEST(PolicyGradient, DoesNotLeaveTheBox) {
  const std::vector<Parameter> genotype{{"p", "", "", -1, 1, 0}};
  const Policies policies{{1}, {0.8}, {0.3}};
  const auto step =
      policyGradient(genotype, std::vector{0.8}, std::vector{0.5}, 3, policies, std::vector{3.0, 2.0, 1.0});
  EXPECT_EQ(1, step.centre[0]);
}

TEST(PolicyGradient, PoliciesOfUnknownFitnessAreLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Policies policies{{1}, {0}, {-1}, {1}, {-1}}, known{{1}, {0}, {-1}};
  const auto with =
      policyGradient(boxes(1), std::vector{0.0}, std::vector{1.0}, 1, policies, std::vector{3.0, 2.0, 1.0, nan, nan});
  const auto without =
      policyGradient(boxes(1), std::vector{0.0}, std::vector{1.0}, 1, known, std::vector{3.0, 2.0, 1.0});
  EXPECT_EQ(without.centre, with.centre);
  EXPECT_EQ(1, with.parameters[0].above.count);
  const auto none = policyGradient(boxes(1), std::vector{0.5}, std::vector{1.0}, 1, known, std::vector{nan, nan, nan});
  EXPECT_EQ(0.5, none.centre[0]);
}

TEST(PolicyGradient, HasTheStandardErrorsAndTheProbabilityOfWelchsTest) {
  // {1, 3, 5, 7} and {2, 4, 12}: means 4 and 6, variances 20/3 and 28; t = 2/√(5/3 + 28/3) = 0.603, freedom 2.716.
  const Policies policies{{-1}, {-1}, {-1}, {-1}, {1}, {1}, {1}, {0}};
  const auto step = policyGradient(boxes(1), std::vector{0.0}, std::vector{1.0}, 1, policies,
                                   std::vector{1.0, 3.0, 5.0, 7.0, 2.0, 4.0, 12.0, 0.0});
  const ParameterGradient& p = step.parameters[0];
  EXPECT_NEAR(std::sqrt(5.0 / 3), p.below.standardError, 1e-12);
  EXPECT_NEAR(std::sqrt(28.0 / 3), p.above.standardError, 1e-12);
  EXPECT_TRUE(std::isnan(p.same.standardError));
  // Of Student's t with 2.716 degrees of freedom: between p(2) = 0.608 and p(3) = 0.589.
  ASSERT_TRUE(p.pValue);
  EXPECT_GT(*p.pValue, 0.589);
  EXPECT_LT(*p.pValue, 0.608);
}

TEST(PolicyGradient, ASinglePolicyInAGroupHasNoProbability) {
  const auto step = policyGradient(boxes(1), std::vector{0.0}, std::vector{1.0}, 1, Policies{{-1}, {0}, {1}},
                                   std::vector{1.0, 2.0, 3.0});
  EXPECT_FALSE(step.parameters[0].pValue);
  EXPECT_EQ(2, step.parameters[0].gradient);
}

TEST(PolicyGradient, DrawsEachOfTheThreeChangesEquallyOften) {
  Random random(7);
  const auto policies = drawPolicies(boxes(4), std::vector(4, 0.0), std::vector{1.0, 2.0, 3.0, 4.0}, 30000, random);
  for (std::size_t n = 0; n < 4; ++n) {
    int up = 0, down = 0;
    for (const auto& policy : policies) {
      up += policy[n] == static_cast<double>(n + 1);
      down += policy[n] == -static_cast<double>(n + 1);
    }
    // Five standard deviations of a binomial with p = 1/3: 5·√(30000·2/9) = 408.
    EXPECT_NEAR(10000, up, 408);
    EXPECT_NEAR(10000, down, 408);
  }
}

TEST(PolicyGradient, DrawsWholeNumbersWhereParametersAreWhole) {
  const std::vector<Parameter> genotype{{"n", "", "", 1, 3, 2, {}, true}};
  Random random(8);
  for (const auto& policy : drawPolicies(genotype, std::vector{2.4}, std::vector{1.0}, 50, random)) {
    EXPECT_EQ(policy[0], std::round(policy[0]));
    EXPECT_GE(policy[0], 1);
    EXPECT_LE(policy[0], 3);
  }
}

}  // namespace
}  // namespace btr
