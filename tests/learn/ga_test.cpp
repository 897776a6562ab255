// The genetic algorithm as a plugin, through the interface that a run uses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/plugin/plugin_host.h"
#include "core/spec/error.h"
#include "tests/learn/genotype.h"

namespace btr {
namespace {

double nearness(const std::vector<double>& x) {
  double sum = 0;
  for (const double value : x) sum += (value - 0.3) * (value - 0.3);
  return 1 / (1 + sum);
}

double oneMax(const std::string& bits) { return static_cast<double>(std::count(bits.begin(), bits.end(), '1')); }

class Ga : public testing::Test {
 protected:
  PluginHost host{PLUGIN_DIR};
  std::unique_ptr<Learner> learner = host.learner("ga");

  std::vector<Candidate> startAndAsk(Random& random, const Values& settings, std::size_t parameters = 5) {
    learner->start(genotype(parameters), settings, random);
    return learner->ask(random);
  }

  /// Runs generations of a fitness of the candidate; returns the mean of each.
  template <class F>
  std::vector<double> evolve(int generations, Random& random, F fitness) {
    std::vector<double> means;
    for (int g = 0; g < generations; ++g) {
      std::vector<double> values;
      double sum = 0;
      for (const Candidate& candidate : learner->ask(random)) {
        values.push_back(fitness(candidate));
        sum += values.back();
      }
      means.push_back(sum / static_cast<double>(values.size()));
      learner->tell(values);
    }
    return means;
  }
};

TEST_F(Ga, HasTheSettingsOfTheKickPaperByDefault) {
  const auto settings = learner->settings();
  const auto byDefault = [&](const std::string& name) { return valueOf(settings, {}, name); };
  EXPECT_EQ(0.75, byDefault("crossover"));
  EXPECT_EQ(0.015, byDefault("mutation"));
  EXPECT_EQ(8, byDefault("bits"));
  EXPECT_EQ(30, byDefault("population"));
  EXPECT_EQ(0, byDefault("coding"));
}

TEST_F(Ga, RefusesSettingsOutOfBounds) {
  Random random(1);
  EXPECT_THROW(startAndAsk(random, {{"population", 1}}), InputError);
  EXPECT_THROW(startAndAsk(random, {{"bits", 17}}), InputError);
  EXPECT_THROW(startAndAsk(random, {{"elite", 1}}), InputError);
  EXPECT_THROW(startAndAsk(random, {}, 0), InputError);
}

TEST_F(Ga, BeginsWithARandomPopulationWithinTheBounds) {
  Random random(1);
  const auto candidates = startAndAsk(random, {{"population", 200}});
  ASSERT_EQ(200u, candidates.size());
  std::set<std::string> different;
  for (const Candidate& candidate : candidates) {
    different.insert(candidate.chromosome);
    ASSERT_EQ(5u, candidate.parameters.size());
    for (const double value : candidate.parameters) EXPECT_LE(std::abs(value), 1);
  }
  EXPECT_EQ(200u, different.size());
}

TEST_F(Ga, AskingTwiceGivesTheSame) {
  Random random(2);
  auto first = startAndAsk(random, {});
  for (int generation = 0; generation < 2; ++generation) {
    const std::string state = random.state();
    const auto again = learner->ask(random);
    EXPECT_EQ(state, random.state());
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].chromosome, again[i].chromosome);
    learner->tell(std::vector<double>(first.size(), 1.0));
    first = learner->ask(random);
  }
}

TEST_F(Ga, ClimbsOneMaxFarAboveChance) {
  Random random(3);
  learner->start(genotype(8), {{"population", 60}, {"mutation", 0.002}}, random);
  const auto means = evolve(100, random, [](const Candidate& c) { return oneMax(c.chromosome); });
  EXPECT_NEAR(32, means.front(), 2);  // 64 fair bits
  EXPECT_GT(means.back(), 54);
}

TEST_F(Ga, ClimbsTheSphereInBothCodings) {
  for (const double coding : {0.0, 1.0}) {
    Random random(4);
    learner->start(genotype(5), {{"population", 60}, {"coding", coding}, {"mutation", 0.005}}, random);
    const auto means = evolve(80, random, [](const Candidate& c) { return nearness(c.parameters); });
    EXPECT_LT(means.front(), 0.4);
    EXPECT_GT(means.back(), 0.7);
  }
}

TEST_F(Ga, WithoutVariationEachChildIsAParentInProportionToItsScaledFitness) {
  // 1000 individuals of which the first has twice the average: it must have 2 copies on average, the rest fewer than
  // that.
  Random random(5);
  const Values settings{{"population", 10}, {"crossover", 0}, {"mutation", 0}};
  const int repeats = 20000;
  int copies = 0;
  for (int i = 0; i < repeats; ++i) {
    const auto parents = startAndAsk(random, settings);
    std::vector<double> fitness(10, 5.0);
    fitness[0] = 6;  // linear scaling makes the best worth 2 averages
    learner->tell(fitness);
    for (const Candidate& child : learner->ask(random)) copies += child.chromosome == parents[0].chromosome;
  }
  // Each of 10 children is it with p = 2/10: binomial with mean 2 and variance 1.6 a generation.
  EXPECT_NEAR(2.0 * repeats, copies, 4 * std::sqrt(1.6 * repeats));
}

TEST_F(Ga, HasNoElitism) {
  // With every bit flipped with probability ½ nothing of the best can survive but by chance of 2⁻⁴⁰.
  Random random(6);
  const auto parents = startAndAsk(random, {{"mutation", 0.5}});
  std::vector<double> fitness(parents.size(), 1.0);
  fitness[7] = 1e6;
  learner->tell(fitness);
  for (const Candidate& child : learner->ask(random)) EXPECT_NE(parents[7].chromosome, child.chromosome);
}

TEST_F(Ga, ChildrenOfACrossoverAreTheirParentsWithOneStretchExchanged) {
  Random random(7);
  int mixed = 0;
  for (int repeat = 0; repeat < 200; ++repeat) {
    const auto parents = startAndAsk(random, {{"population", 2}, {"crossover", 1}, {"mutation", 0}});
    const std::string &a = parents[0].chromosome, &b = parents[1].chromosome;
    learner->tell(std::vector<double>{1, 1});
    for (const Candidate& child : learner->ask(random)) {
      // Where the parents differ, how often does the origin change from one parent to the other?
      int changes = 0;
      char origin = 0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] == b[i]) {
          EXPECT_EQ(a[i], child.chromosome[i]);
          continue;
        }
        const char now = child.chromosome[i] == a[i] ? 'a' : 'b';
        changes += origin && now != origin;
        origin = now;
      }
      EXPECT_LE(changes, 2);
      mixed += changes > 0;
    }
  }
  // Half of the pairs are two different parents, and most cuts lie across a difference.
  EXPECT_GT(mixed, 100);
}

TEST_F(Ga, KeepsAnOddPopulationOdd) {
  Random random(8);
  for (const double size : {3.0, 7.0, 31.0}) {
    learner->start(genotype(3), {{"population", size}}, random);
    evolve(3, random, [](const Candidate& c) { return nearness(c.parameters); });
    EXPECT_EQ(static_cast<std::size_t>(size), learner->ask(random).size());
  }
}

TEST_F(Ga, GoesOnFromWorthlessFitness) {
  const double nan = std::nan(""), infinity = HUGE_VAL;
  const std::vector<std::vector<double>> populations{
      {0, 0, 0, 0}, {-1, -2, -3, -4}, {nan, nan, nan, nan}, {nan, 1, infinity, -infinity}, {5, 5, 5, 5}};
  for (const auto& fitness : populations) {
    Random random(9);
    startAndAsk(random, {{"population", 4}});
    learner->tell(fitness);
    EXPECT_NO_THROW(learner->setState(learner->state()));
    EXPECT_EQ(4u, learner->ask(random).size());
  }
}

TEST_F(Ga, NeverPrefersAFitnessThatIsNotFinite) {
  Random random(10);
  const auto parents = startAndAsk(random, {{"crossover", 0}, {"mutation", 0}});
  // Most are good, so linear scaling gives the worst, 1, no share; infinity and not-a-number count as 1.
  std::vector<double> fitness(parents.size(), 10);
  fitness[0] = 1;
  fitness[1] = std::nan("");
  fitness[2] = HUGE_VAL;
  fitness[3] = -HUGE_VAL;
  learner->tell(fitness);
  for (const Candidate& child : learner->ask(random))
    for (std::size_t worthless = 0; worthless < 4; ++worthless)
      EXPECT_NE(parents[worthless].chromosome, child.chromosome);
}

TEST_F(Ga, AResumedSearchGivesTheSameBits) {
  const Values settings{{"population", 21}, {"coding", 1}};
  const auto fitness = [](const Candidate& c) { return nearness(c.parameters); };
  Random random(13);
  learner->start(genotype(6), settings, random);
  evolve(5, random, fitness);
  const std::string state = learner->state(), chance = random.state();
  evolve(5, random, fitness);
  const auto expected = learner->ask(random);

  learner = host.learner("ga");
  Random other(99);
  learner->start(genotype(6), settings, other);
  learner->setState(state);
  other.setState(chance);
  evolve(5, other, fitness);
  const auto resumed = learner->ask(other);
  ASSERT_EQ(expected.size(), resumed.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(expected[i].chromosome, resumed[i].chromosome);
    EXPECT_EQ(expected[i].parameters, resumed[i].parameters);
  }
  EXPECT_EQ(random.state(), other.state());
}

TEST_F(Ga, RefusesAForeignState) {
  Random random(14);
  startAndAsk(random, {{"population", 4}});
  const std::string good = learner->state();
  for (const char* wrong : {"", "[]", "{}", R"({"generation":1,"population":["01"],"fitness":[]})",
                            R"({"generation":1,"population":"01","fitness":[]})"})
    EXPECT_THROW(learner->setState(wrong), InputError) << wrong;
  EXPECT_EQ(good, learner->state());
  EXPECT_THROW(learner->tell(std::vector<double>{1, 2, 3}), InputError);
}

TEST_F(Ga, BeginsWithPermutationsOfAVector) {
  Random random(6);
  learner->start(genotype(5), {{"population", 200}}, random);
  const std::vector<double> at{0.3, -0.7, 1, 0, -1};
  const auto drawn = learner->ask(random);
  learner->beginAt(at, {0.8, 0.05}, random);
  const auto mixed = learner->ask(random);
  for (std::size_t n = 0; n < 5; ++n) EXPECT_NEAR(at[n], mixed[0].parameters[n], 0.5 * 2 / 255 + 1e-12);
  long flipped = 0;
  for (std::size_t i = 1; i < 160; ++i)
    for (std::size_t bit = 0; bit < 40; ++bit) flipped += mixed[i].chromosome[bit] != mixed[0].chromosome[bit];
  // 159 copies of 40 bits, 5 % of which flip: 318 ± 5 standard deviations of 17.4.
  EXPECT_NEAR(318, static_cast<double>(flipped), 87);
  for (std::size_t i = 160; i < 200; ++i) EXPECT_EQ(drawn[i].chromosome, mixed[i].chromosome);
}

TEST_F(Ga, NoShareOfPermutationsIsTheRandomPopulationAndDrawsNothing) {
  Random random(6);
  const auto drawn = startAndAsk(random, {});
  const std::string state = random.state();
  learner->beginAt(std::vector<double>(5, 0.5), {0, 0.05}, random);
  EXPECT_EQ(state, random.state());
  const auto same = learner->ask(random);
  for (std::size_t i = 0; i < drawn.size(); ++i) EXPECT_EQ(drawn[i].chromosome, same[i].chromosome);
}

}  // namespace
}  // namespace btr
