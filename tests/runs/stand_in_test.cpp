// What the stand-in reality conceals: a function of its settings, of sizes that effects declare as usual.
#include "core/run/reality/stand_in.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/genotypes.h"
#include "tests/plugin/built_plugins.h"

namespace {

using namespace btr;

using test::host;

PreparedExperiment kick(int seed, int effects) {
  ExperimentSpec spec = loadExperiment(SOURCE_DIR "/resources/experiments/kick-short.json");
  spec.standIn["seed"] = seed;
  spec.standIn["hidden_effects"] = effects;
  return prepareFromFiles(spec, host());
}

TEST(StandIn, ConcealsTheSameForTheSameSeedAndElseSomethingElse) {
  const auto drawn = [](int seed) { return drawConcealed(kick(seed, 2), host()); };
  const Concealed once = drawn(3), twice = drawn(3), other = drawn(4);
  EXPECT_EQ(once.simulator, twice.simulator);
  EXPECT_NE(once.simulator.values, other.simulator.values);
  EXPECT_EQ(once.simulator.effects.size(), 2u);
}

TEST(StandIn, ConcealsEffectsOfHalfToOneAndAHalfTimesTheirTypicalSize) {
  std::set<std::string> seen;
  bool below = false, above = false;
  for (int seed = 1; seed <= 60; ++seed) {
    const Concealed concealed = drawConcealed(kick(seed, 3), host());
    for (const PlacedEffect& effect : concealed.simulator.effects) {
      seen.insert(effect.effect);
      bool acts = false;
      for (const Parameter& p : host().effect(effect.effect)->parameters()) {
        const double value = effect.parameters.at(p.name);
        EXPECT_GE(value, p.minimum) << effect.effect << " " << p.name;
        EXPECT_LE(value, p.maximum) << effect.effect << " " << p.name;
        if (!p.neutral || p.byDefault == *p.neutral) {
          EXPECT_EQ(value, p.byDefault) << effect.effect << " " << p.name;
          continue;
        }
        acts = true;
        const double times = std::abs((value - *p.neutral) / (p.byDefault - *p.neutral));
        if (p.integer || value == p.minimum || value == p.maximum) continue;  // rounded or at a bound
        EXPECT_GE(times, 0.5) << effect.effect << " " << p.name;
        EXPECT_LE(times, 1.5) << effect.effect << " " << p.name;
        below = below || times < 0.7;
        above = above || times > 1.2;
      }
      EXPECT_TRUE(acts) << effect.effect << " was drawn without doing anything";
    }
  }
  EXPECT_TRUE(below && above) << "the whole range is drawn";
  EXPECT_GE(seen.size(), 5u);
}

TEST(StandIn, MeasuresTheSameIndividualTwiceWithDifferentNoiseAndRepeatably) {
  const PreparedExperiment prepared = kick(2, 1);
  const Concealed concealed = drawConcealed(prepared, host());
  const std::vector<double> middle = test::middleOf(prepared.genotype);
  const double first = measureStandIn(prepared, concealed, middle, 0).fitness;
  EXPECT_EQ(first, measureStandIn(prepared, concealed, middle, 0).fitness);
  const double second = measureStandIn(prepared, concealed, middle, 1).fitness;
  EXPECT_NE(first, second);
  EXPECT_NEAR(first, second, 10 * concealed.noise);
}

}  // namespace
