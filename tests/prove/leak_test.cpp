// What an analyst gets says nothing of the answer: neither a number of it, nor of what kind the case is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "tests/prove/prove_fixture.h"

namespace btr::prove {
namespace {

constexpr std::uint64_t leakSeed = 41;

BlindCase leakCase(const Plugins& plugins, const std::string& scene, const std::string& kind, std::uint64_t number) {
  return drawCase({.seed = leakSeed, .number = number, .engine = "ode", .scene = scene, .kind = kind}, plugins.library);
}

/// All that is in the open folder but the measured columns.
std::string openText(const BlindCase& blind) {
  const BlindWorld& world = blind.world;
  std::string text = toJsonText(world.scene);
  for (const auto& [name, content] : world.files) text += name + content;
  for (const TrialPlan& plan : world.trials) {
    text += "\n" + std::to_string(plan.rows) + " " + toText(plan.sample_s);
    for (const auto& row : plan.commands)
      for (const double command : row) text += " " + toText(command);
    for (const char on : plan.enabled) text += on ? "1" : "0";
  }
  for (const MeasuredColumn& column : world.columns)
    text += "\n" + column.name + " " + toText(column.noise) + " " + toText(column.quantum);
  return text;
}

/// All numbers of the scene's file, by their place in it.
Values numbersOf(const BlindCase& blind) {
  Values numbers;
  const auto scene = nlohmann::json::parse(toJsonText(blind.world.scene)).flatten();
  for (const auto& [place, value] : scene.items())
    if (value.is_number() && value.get<double>() != 0) numbers[place] = value.get<double>();
  return numbers;
}

std::set<double> numbersOfModels(const BlindCase& blind) {
  static const std::regex number(R"([-+]?\d+\.?\d*([eE][-+]?\d+)?)");
  std::set<double> numbers;
  for (const auto& [name, text] : blind.world.files)
    for (std::sregex_iterator found(text.begin(), text.end(), number), end; found != end; ++found)
      numbers.insert(std::stod(found->str()));
  return numbers;
}

class Leak : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, Leak, testing::ValuesIn(sceneKinds()), [](const auto& test) { return test.param; });

TEST_P(Leak, ACaseWithRightNumbersAndOneWithWrongOnesLookTheSame) {
  const Plugins plugins;
  for (std::uint64_t number = 1; number <= 20; ++number) {
    const BlindCase right = leakCase(plugins, GetParam(), "nothing", number),
                    wrong = leakCase(plugins, GetParam(), "parameters", number);
    EXPECT_EQ(openText(right), openText(wrong)) << number;
    EXPECT_NE(right.answer.truth, wrong.answer.truth);
    EXPECT_EQ(right.answer.truth, right.world.given);
  }
}

TEST(Leak, ACaseWithHiddenPhysicsLooksLikeOneWithout) {
  const Plugins plugins;
  for (const char* kind : {"one", "two", "outside"})
    for (std::uint64_t number = 1; number <= 2; ++number)
      EXPECT_EQ(openText(leakCase(plugins, "carpet", "nothing", number)),
                openText(leakCase(plugins, "carpet", kind, number)))
          << kind << number;
}

TEST_P(Leak, NoNumberOfTheAnswerIsAnOpenOneOrAFixedShareOfOne) {
  const Plugins plugins;
  std::map<std::string, std::vector<double>> shares;  // by number of the answer and open number
  const auto note = [&](const std::string& kind, const std::string& path, double truth, const std::string& place,
                        double open) { shares[kind + " " + path + " / " + place].push_back(truth / open); };
  for (std::uint64_t number = 1; number <= 30; ++number) {
    const BlindCase wrong = leakCase(plugins, GetParam(), "parameters", number);
    const Values open = numbersOf(wrong);
    const std::set<double> models = numbersOfModels(wrong);
    for (const auto& [path, truth] : wrong.answer.truth) {
      EXPECT_EQ(0u, models.count(truth)) << path;
      for (const auto& [place, value] : open) note("parameters", path, truth, place, value);
    }
    // Where nothing is wrong the given number is the true one; the bounds of a fit must not say so.
    const BlindCase right = leakCase(plugins, GetParam(), "nothing", number);
    for (const auto& [place, value] : numbersOf(right))
      if (place.rfind("/calibrate/", 0) == 0)
        for (const auto& [path, truth] : right.answer.truth) note("nothing", path, truth, place, value);
  }
  EXPECT_FALSE(shares.empty());
  for (auto& [which, values] : shares) {
    std::sort(values.begin(), values.end());
    EXPECT_EQ(0, std::count(values.begin(), values.end(), 1.0)) << which;
    for (std::size_t i = 1; i < values.size(); ++i)
      EXPECT_GT(values[i] - values[i - 1], 1e-12 * std::abs(values[i])) << which;
  }
}

TEST(Leak, NoSizeOfAHiddenEffectIsAnOpenNumber) {
  const Plugins plugins;
  for (std::uint64_t number = 1; number <= 4; ++number) {
    const BlindCase blind = leakCase(plugins, "carpet", "one", number);
    const auto& hidden = blind.answer.hidden.at(0);
    for (const std::string& size : hidden.sizes)
      for (const auto& [place, value] : numbersOf(blind)) EXPECT_NE(hidden.placed.parameters.at(size), value) << place;
  }
}

TEST_P(Leak, TheRangeOfAFitHoldsWhateverTruthAGivenNumberMayHave) {
  for (std::uint64_t number = 1; number <= 100; ++number) {
    Random random = Random::forPurpose(leakSeed, "bounds", number);
    const BlindWorld world = drawWorld(GetParam(), random);
    EXPECT_EQ(world.given.size(), world.scene.calibrate.size());
    for (const auto& entry : world.scene.calibrate) {
      const double given = world.given.at(entry.path), most = mostError(entry.path) * std::abs(given);
      EXPECT_LT(entry.minimum, given - most) << entry.path;
      EXPECT_GT(entry.maximum, given + most) << entry.path;
    }
  }
}

/// Mann and Whitney's statistic in its standard errors; equal values count half.
double rankDifference(const std::vector<double>& a, const std::vector<double>& b) {
  double wins = 0;
  for (const double x : a)
    for (const double y : b) wins += x > y ? 1 : x == y ? 0.5 : 0;
  const auto n = static_cast<double>(a.size()), m = static_cast<double>(b.size());
  return (wins - n * m / 2) / std::sqrt(n * m * (n + m + 1) / 12);
}

TEST(Leak, WhatIsOpenHasTheSameDistributionInCasesOfEitherKind) {
  const Plugins plugins;
  std::map<std::string, std::map<std::string, std::vector<double>>> samples;  // by feature, by kind
  for (std::uint64_t number = 1; number <= 400; ++number) {
    const std::string kind = number % 2 ? "nothing" : "parameters";
    const BlindCase blind = leakCase(plugins, "pendulum", kind, number);
    const auto add = [&](const std::string& feature, double value) { samples[feature][kind].push_back(value); };
    const BlindWorld& world = blind.world;
    add("noise", world.columns[0].floor());
    add("rounding", world.columns[0].quantum);
    add("columns", static_cast<double>(world.columns.size()));
    add("sample", world.scene.controlPeriod_s);
    add("enabled", world.showsEnabled);
    add("calibrated", static_cast<double>(world.given.size()));
    double most = 0;
    for (const auto& row : world.trials[0].commands) most = std::max(most, std::abs(row[0]));
    add("effort", most);
    for (const auto& entry : world.scene.calibrate) {
      const double given = world.given.at(entry.path);
      add(entry.path, given);
      add(entry.path + " low", entry.minimum / given);
      add(entry.path + " high", entry.maximum / given);
    }
  }
  // Sixteen features: the largest of so many normal deviates passes 4 once in a thousand seeds.
  EXPECT_EQ(16u, samples.size());
  for (auto& [feature, kinds] : samples)
    EXPECT_LT(std::abs(rankDifference(kinds["nothing"], kinds["parameters"])), 4) << feature;
}

}  // namespace
}  // namespace btr::prove
