#include "core/spec/parameter.h"

#include <gtest/gtest.h>

#include <bit>
#include <limits>

#include "core/spec/random.h"
#include "tests/refusal.h"

namespace btr {
namespace {

const std::vector<Parameter> declared{
    {"mass_kg", "kg", "mass", 0.1, 2, 1},
    {"count", "", "how many", 2, 10, 4, {}, true},
    {"coding", "", "bits", 0, 1, 0, {}, false, {"binary", "gray"}},
};

std::string refusal(const Values& values) {
  return test::refusal([&] { resolve(declared, values, "a.json /settings"); });
}

TEST(Parameters, AbsentNamesHaveTheirDefaults) {
  EXPECT_EQ((std::vector<double>{1, 7, 0}), resolve(declared, {{"count", 7}}, ""));
}

TEST(Parameters, BoundsThemselvesAreAllowed) {
  EXPECT_EQ("accepted", refusal({{"mass_kg", 0.1}, {"count", 10}, {"coding", 1}}));
}

TEST(Parameters, ARefusalNamesPlaceValueAndWhatIsAllowed) {
  EXPECT_EQ("a.json /settings/mass_kg: 2.5 is not allowed; 0.1 to 2 kg", refusal({{"mass_kg", 2.5}}));
  EXPECT_EQ("a.json /settings/count: 2.5 is not allowed; whole numbers 2 to 10", refusal({{"count", 2.5}}));
  EXPECT_EQ("a.json /settings/coding: 2 is not allowed; one of binary, gray", refusal({{"coding", 2}}));
  EXPECT_EQ("a.json /settings: \"mass\" is not allowed; known names: mass_kg, count, coding", refusal({{"mass", 1}}));
}

TEST(Parameters, NotFiniteValuesAreRefused) {
  EXPECT_NE("accepted", refusal({{"mass_kg", std::numeric_limits<double>::quiet_NaN()}}));
  EXPECT_NE("accepted", refusal({{"mass_kg", std::numeric_limits<double>::infinity()}}));
}

TEST(NumberText, ReadsBackTheSameBits) {
  Random random(3);
  for (int i = 0; i < 100000; ++i) {
    const double value = std::bit_cast<double>(random.next());
    if (!(value - value == 0)) continue;
    const auto back = toNumber(toText(value));
    ASSERT_TRUE(back);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(*back)) << toText(value);
  }
}

TEST(NumberText, IsTheShortest) {
  EXPECT_EQ("0.1", toText(0.1));
  EXPECT_EQ("-9.81", toText(-9.81));
  EXPECT_EQ("100000", toText(100000));
  EXPECT_EQ("-0", toText(-0.0));
  EXPECT_EQ("1e+20", toText(1e20));
}

TEST(NumberText, RefusesWhatIsNotOneFiniteNumber) {
  for (const char* text : {"", " ", "1 ", " 1", "1,5", "1.5kg", "nan", "inf", "1e999", "0x10", "--1", "+-1", "+"})
    EXPECT_FALSE(toNumber(text)) << text;
  EXPECT_EQ(1.5, toNumber("+1.5"));
  EXPECT_EQ(-2e-3, toNumber("-2e-3"));
}

}  // namespace
}  // namespace btr
