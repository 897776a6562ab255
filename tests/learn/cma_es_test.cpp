// CMA-ES as a plugin: published numbers of evaluations, what it must be blind to, resuming.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/plugin/plugin_host.h"
#include "core/spec/error.h"

namespace btr {
namespace {

using Point = std::vector<double>;
using Cost = std::function<double(const Point&)>;

/// A box of ±`half`, in which a search starts everywhere at `start`.
std::vector<Parameter> box(std::size_t count, double half, double start) {
  std::vector<Parameter> parameters;
  for (std::size_t i = 0; i < count; ++i) parameters.push_back({"p" + std::to_string(i), "", "", -half, half, start});
  return parameters;
}

double sphere(const Point& x) {
  double sum = 0;
  for (const double value : x) sum += value * value;
  return sum;
}
/// Axis ratio 1000.
double ellipsoid(const Point& x) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    sum += std::pow(10.0, 6 * static_cast<double>(i) / static_cast<double>(x.size() - 1)) * x[i] * x[i];
  return sum;
}
double rosenbrock(const Point& x) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    sum += 100 * std::pow(x[i] * x[i] - x[i + 1], 2) + std::pow(x[i] - 1, 2);
  return sum;
}

class CmaEs : public testing::Test {
 protected:
  PluginHost host{PLUGIN_DIR};

  /// Evaluations until a candidate costs at most `target`; `most` if none did.
  long evaluations(const std::vector<Parameter>& genotype, double sigma, const Cost& cost, double target,
                   std::uint64_t seed, const Point& at = {}, long most = 40000) {
    const auto learner = host.learner("cma_es");
    Random random(seed);
    learner->start(genotype, {{"sigma", sigma / (genotype[0].maximum - genotype[0].minimum)}}, random);
    if (!at.empty()) learner->beginAt(at, {}, random);
    long count = 0;
    while (count < most) {
      std::vector<double> fitness;
      double best = target + 1;
      for (const Candidate& c : learner->ask(random)) {
        const double value = cost(c.parameters);
        best = std::min(best, value);
        fitness.push_back(-value);
        ++count;
      }
      if (best <= target) return count;
      learner->tell(fitness);
    }
    return most;
  }

  long median(std::vector<long> counts) {
    std::sort(counts.begin(), counts.end());
    return counts[counts.size() / 2];
  }

  /// Median over 15 searches that begin at `start` everywhere.
  long fromStart(std::size_t count, double start, double sigma, const Cost& cost, double target) {
    std::vector<long> counts;
    for (std::uint64_t seed = 1; seed <= 15; ++seed)
      counts.push_back(evaluations(box(count, 10, start), sigma, cost, target, seed));
    return median(counts);
  }
};

// Published: Hansen's purecma.py (github.com/CMA-ES/pycma, documentation of fmin) and its predecessor barecmaes2.py
// print whole searches. Where these cost 4.83e-13, 5.27e-10 and 1.15e-11 they had made 1400, 6000 and 1600 evaluations.
// One search scatters by some 8 %; the median of 15 of ours must lie within 15 %.
TEST_F(CmaEs, NeedsAsManyEvaluationsAsHansensOwn) {
  EXPECT_NEAR(1400, fromStart(3, 0.5, 0.3, ellipsoid, 4.83e-13), 0.15 * 1400);
  EXPECT_NEAR(6000, fromStart(10, 0.5, 0.3, ellipsoid, 5.27e-10), 0.15 * 6000);
  EXPECT_NEAR(1600, fromStart(4, 0.5, 0.5, rosenbrock, 1.15e-11), 0.15 * 1600);
}

// Published: pycma's own tests ask for 1e-12 on Rosenbrock's function of ten parameters, from 0.1 with σ = 0.3, within
// 8000.
TEST_F(CmaEs, FindsTheEndOfRosenbrocksValleyWithinThePublishedBudget) {
  EXPECT_LT(fromStart(10, 0.1, 0.3, rosenbrock, 1e-12), 8000);
}

// The sphere needs no adaptation of the shape: from the known progress rates of the other two it must be the fastest by
// far, and its logarithm falls linearly: as many evaluations for each of two runs of six decades.
TEST_F(CmaEs, FallsLinearlyInTheLogarithmOnTheSphere) {
  const auto six = static_cast<double>(fromStart(10, 0.5, 0.3, sphere, 1e-6));
  const auto twelve = static_cast<double>(fromStart(10, 0.5, 0.3, sphere, 1e-12));
  const auto eighteen = static_cast<double>(fromStart(10, 0.5, 0.3, sphere, 1e-18));
  EXPECT_NEAR(1, (eighteen - twelve) / (twelve - six), 0.15);
  EXPECT_LT(twelve, 6000 / 3);
}

TEST_F(CmaEs, SeesOnlyTheOrderOfTheFitness) {
  const auto one = host.learner("cma_es"), other = host.learner("cma_es");
  Random a(4), b(4);
  one->start(box(6, 5, 2), {}, a);
  other->start(box(6, 5, 2), {}, b);
  for (int generation = 0; generation < 60; ++generation) {
    std::vector<double> plain, bent;
    const auto asked = one->ask(a), askedOther = other->ask(b);
    for (std::size_t i = 0; i < asked.size(); ++i) {
      ASSERT_EQ(asked[i].parameters, askedOther[i].parameters) << "generation " << generation;
      const double cost = ellipsoid(asked[i].parameters);
      plain.push_back(-cost);
      bent.push_back(7 - 1e-3 * std::cbrt(std::log1p(cost)));
    }
    one->tell(plain);
    other->tell(bent);
  }
}

TEST_F(CmaEs, FindsAnEllipsoidThatLiesAskewAsFast) {
  // Any rotation of the coordinates, made of plane rotations by one radian.
  const Cost askew = [](const Point& x) {
    Point y = x;
    for (std::size_t i = 0; i < y.size(); ++i)
      for (std::size_t k = i + 1; k < y.size(); ++k) {
        const double c = std::cos(1.0), s = std::sin(1.0), u = y[i], v = y[k];
        y[i] = c * u - s * v;
        y[k] = s * u + c * v;
      }
    return ellipsoid(y);
  };
  std::vector<long> straight, turned;
  for (std::uint64_t seed = 1; seed <= 15; ++seed) {
    straight.push_back(evaluations(box(6, 10, 0.5), 0.3, ellipsoid, 1e-9, seed));
    turned.push_back(evaluations(box(6, 10, 0.5), 0.3, askew, 1e-9, seed));
  }
  EXPECT_NEAR(1, static_cast<double>(median(turned)) / static_cast<double>(median(straight)), 0.15);
}

TEST_F(CmaEs, DoesNotSeeTheUnitsOfTheParameters) {
  const auto one = host.learner("cma_es"), other = host.learner("cma_es");
  Random a(4), b(4);
  one->start(box(3, 1, 0.5), {}, a);
  other->start(box(3, 1024, 512), {}, b);
  for (int generation = 0; generation < 30; ++generation) {
    std::vector<double> fitness;
    const auto small = one->ask(a), large = other->ask(b);
    for (std::size_t i = 0; i < small.size(); ++i) {
      for (std::size_t n = 0; n < 3; ++n) ASSERT_EQ(1024 * small[i].parameters[n], large[i].parameters[n]);
      fitness.push_back(-rosenbrock(small[i].parameters));
    }
    one->tell(fitness);
    other->tell(fitness);
  }
}

TEST_F(CmaEs, StaysInTheBoxAndFindsAnOptimumInItsCorner) {
  const auto learner = host.learner("cma_es");
  Random random(6);
  learner->start(box(5, 1, 0), {}, random);
  for (int generation = 0; generation < 150; ++generation) {
    std::vector<double> fitness;
    for (const Candidate& c : learner->ask(random)) {
      double sum = 0;
      for (const double value : c.parameters) {
        ASSERT_LE(std::abs(value), 1);
        sum += value;
      }
      fitness.push_back(sum);
    }
    learner->tell(fitness);
  }
  for (const double value : learner->centre()) EXPECT_GT(value, 0.99);
}

TEST_F(CmaEs, HasThePopulationOfTheTutorialUnlessToldOtherwise) {
  for (const auto& [count, population] :
       std::vector<std::pair<std::size_t, std::size_t>>{{1, 4}, {10, 10}, {20, 12}, {25, 13}}) {
    const auto learner = host.learner("cma_es");
    Random random(1);
    learner->start(box(count, 1, 0), {}, random);
    EXPECT_EQ(population, learner->ask(random).size());
  }
  const auto learner = host.learner("cma_es");
  Random random(1);
  learner->start(box(4, 1, 0), {{"population", 30}}, random);
  EXPECT_EQ(30u, learner->ask(random).size());
  EXPECT_THROW(learner->start(box(4, 1, 0), {{"population", 3}}, random), InputError);
  EXPECT_THROW(learner->start({}, {}, random), InputError);
}

TEST_F(CmaEs, OutlivesAFlatFitnessAndValuesThatAreNone) {
  const auto learner = host.learner("cma_es");
  Random random(3);
  learner->start(box(4, 1, 0), {}, random);
  for (int generation = 0; generation < 2000; ++generation) {
    const auto asked = learner->ask(random);
    std::vector<double> fitness(asked.size(), generation % 3 == 0 ? std::nan("") : 1.0);
    learner->tell(fitness);
    for (const Candidate& c : asked)
      for (const double value : c.parameters) ASSERT_TRUE(std::abs(value) <= 1);
  }
}

TEST_F(CmaEs, ASearchGoesOnWithTheSameBitsFromItsState) {
  const auto learner = host.learner("cma_es");
  Random random(9);
  learner->start(box(5, 3, 1), {}, random);
  std::string state, randomState;
  std::vector<Point> expected, got;
  for (int generation = 0; generation < 40; ++generation) {
    if (generation == 17) {
      state = learner->state();
      randomState = random.state();
    }
    std::vector<double> fitness;
    for (const Candidate& c : learner->ask(random)) {
      fitness.push_back(-rosenbrock(c.parameters));
      if (generation >= 17) expected.push_back(c.parameters);
    }
    learner->tell(fitness);
  }
  const auto resumed = host.learner("cma_es");
  Random other(5);
  resumed->start(box(5, 3, 1), {}, other);
  resumed->setState(state);
  other.setState(randomState);
  for (int generation = 17; generation < 40; ++generation) {
    std::vector<double> fitness;
    for (const Candidate& c : resumed->ask(other)) {
      fitness.push_back(-rosenbrock(c.parameters));
      got.push_back(c.parameters);
    }
    resumed->tell(fitness);
  }
  EXPECT_EQ(expected, got);
  EXPECT_EQ(learner->state(), resumed->state());
}

TEST_F(CmaEs, RefusesAStateOfAnotherSearch) {
  const auto learner = host.learner("cma_es"), larger = host.learner("cma_es");
  Random random(1);
  learner->start(box(2, 1, 0), {}, random);
  larger->start(box(3, 1, 0), {}, random);
  EXPECT_THROW(larger->setState(learner->state()), InputError);
  EXPECT_THROW(learner->setState("{}"), InputError);
  EXPECT_THROW(learner->setState("nonsense"), InputError);
}

}  // namespace
}  // namespace btr
