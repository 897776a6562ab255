// Across a bounce an error of a velocity is multiplied: a fit of an initial state may stop in a side minimum.
#include <algorithm>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/fit/segments.h"
#include "core/gap/fit/starts_anew.h"

namespace btr {
namespace {

constexpr double farFromNoise = 1.5, asOthers = 2;  // mean squared error; times that of the (lower) middle segment
constexpr double kick = 3;                          // standard errors
constexpr double spinKick = 0.3;                    // of a spin: standard deviations of its prior
constexpr int iterations = 20;
constexpr std::size_t mostBeginnings = 7;  // as many as a ball without spin has
constexpr double better = 0.98;

bool isRate(const Nuisance& nuisance) {
  using enum Nuisance::What;
  return nuisance.what == jointRate || nuisance.what == baseVelocity || nuisance.what == baseSpin ||
         nuisance.what == ballVelocity || nuisance.what == ballSpin;
}

double sumOfSquares(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return sum;
}

/// Where else a fit of the segment's initial state begins: as estimated, and with each velocity on either side.
std::vector<std::vector<double>> beginnings(const Segment& segment, const std::vector<double>& shift) {
  std::vector<std::vector<double>> all{std::vector<double>(shift.size(), 0.0)};
  for (std::size_t k = 0; k < segment.nuisances.size(); ++k)
    if (const Nuisance& nuisance = segment.nuisances[k]; isRate(nuisance))
      for (const double way : {-1.0, 1.0}) {
        all.push_back(shift);
        all.back()[k] += way * (nuisance.what == Nuisance::What::ballSpin ? spinKick / nuisance.hold : kick);
      }
  return all;
}

}  // namespace

Fit withStartsAnew(const FitProblem& problem, const Fit& fit) {
  SceneCache scenes(problem, fit.model);
  const auto costOf = [&](std::size_t s, const std::vector<double>& shift) {
    const Segment& segment = problem.segments[s];
    return sumOfSquares(residualsOf(problem, segment, scenes.scene(fit.model.values, segment.trial), shift)) +
           priorCost(segment.nuisances, shift);
  };
  const auto costs =
      bySegment(problem, 1, [&](std::size_t s) { return std::vector<double>{costOf(s, fit.shifts[s])}; });
  std::vector<double> errors;
  for (std::size_t s = 0; s < costs.size(); ++s)
    errors.push_back(costs[s][0] / std::max<double>(1, static_cast<double>(problem.segments[s].row.size())));
  std::vector<double> sorted = errors;
  std::ranges::sort(sorted);
  // One that bounces and has no other beside it cannot be told from one that got stuck.
  const bool isAlone = sorted.size() == 1 && problem.segments[0].bounces;
  const double limit = isAlone ? farFromNoise : std::max(farFromNoise, asOthers * sorted[(sorted.size() - 1) / 2]);

  /// The beginnings from which a fit has least to go.
  const auto promising = [&](std::size_t s) {
    std::vector<std::vector<double>> all = beginnings(problem.segments[s], fit.shifts[s]);
    if (all.size() <= mostBeginnings) return all;
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t i = 0; i < all.size(); ++i) order.emplace_back(costOf(s, all[i]), i);
    std::ranges::sort(order);
    std::vector<std::vector<double>> few;
    for (std::size_t k = 0; k < mostBeginnings; ++k) few.push_back(all[order[k].second]);
    return few;
  };

  // Of each segment the least cost, then the shifts that have it.
  const auto anew = bySegment(problem, iterations, [&](std::size_t s) {
    std::vector<double> best = fit.shifts[s];
    double least = costs[s][0];
    const auto packed = [&] {
      std::vector<double> numbers{least};
      numbers.insert(numbers.end(), best.begin(), best.end());
      return numbers;
    };
    if (errors[s] <= limit) return packed();
    FitProblem one = problem;
    one.segments = {problem.segments[s]};
    one.jobs = 1;
    for (const std::vector<double>& begin : promising(s)) {
      const std::vector<double> found =
          fitModel(one, fit.model, {begin}, {.iterations = iterations, .startsOnly = true}).shifts[0];
      const double cost = costOf(s, found);
      if (cost >= better * least) continue;
      least = cost;
      best = found;
    }
    return packed();
  });
  Fit result = fit;
  for (std::size_t s = 0; s < anew.size(); ++s) {
    result.shifts[s].assign(anew[s].begin() + 1, anew[s].end());
    result.cost += (anew[s][0] - costs[s][0]) / 2;
  }
  return result;
}

}  // namespace btr
