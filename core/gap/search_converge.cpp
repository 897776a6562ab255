// Out of side minima and along curved valleys: what least squares with local derivatives leaves undone.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/gap/search_run.h"

namespace btr {
namespace {

constexpr int moreIterations = 30, rounds = 12;
constexpr double better = 0.995;  // of the squared error

double squaredError(const FitProblem& problem, const FitModel& model, const Fit& fit) {
  return residualsOf(problem, model, fit.shifts).squaredNorm();
}

}  // namespace

/// Dry friction and play leave side minima along an effect's size: where another size fits better at once, the fit is
/// taken up again from there.
void SearchRun::shake(std::vector<Fit>& fits, const std::string& stage, double at) const {
  constexpr std::array<double, 4> sizes{1, 0.5, 0.8, 1.25};
  const auto resized = [&](const Fit& fit, double size) {
    FitModel model = fit.model;
    for (std::size_t i = 0; i < model.parameters.size(); ++i) {
      const FitParameter& p = model.parameters[i];
      if (p.effect + 1 == static_cast<int>(model.effects.size()) && p.hasNeutral)
        model.values[i] = std::clamp(p.given + size * (model.values[i] - p.given), p.minimum, p.maximum);
    }
    return model;
  };
  const auto errors = parallel(options_.jobs, fits.size(), [&](std::size_t i) {
    std::vector<double> list;
    for (const double size : sizes) list.push_back(squaredError(problem_, resized(fits[i], size), fits[i]));
    return list;
  });
  std::vector<FitJob> jobs;
  std::vector<std::size_t> owner;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const auto least = std::min_element(errors[i].begin(), errors[i].end());
    if (errors[i].empty() || !(*least < better * errors[i][0])) continue;
    const double size = sizes[static_cast<std::size_t>(least - errors[i].begin())];
    jobs.push_back({resized(fits[i], size), fits[i].shifts});
    owner.push_back(i);
  }
  const std::vector<Fit> again = fitAll(jobs, moreIterations, stage, at, at);
  for (std::size_t k = 0; k < again.size(); ++k)
    if (again[k].cost < fits[owner[k]].cost) fits[owner[k]] = again[k];
}

/// Tries each parameter a little up and down, moves to the best of all, halves the steps where nothing is better:
/// sticking and slipping make errors whose derivatives say nothing of the way. (Hooke and Jeeves 1961, without pattern
/// moves.)
void SearchRun::grope(Fit& fit) const {
  const std::size_t n = fit.model.parameters.size();
  double step = 0.3, here = squaredError(problem_, fit.model, fit);
  for (int round = 0; round < rounds; ++round) {
    const auto moved = [&](std::size_t k) {
      FitModel model = fit.model;
      const FitParameter& p = model.parameters[k / 2];
      // Relative to its size where it has one: a typical change may be far from it.
      const double size = std::min(p.scale, std::max(std::abs(model.values[k / 2]), 1e-3 * p.scale));
      model.values[k / 2] = std::clamp(model.values[k / 2] + (k % 2 == 0 ? 1 : -1) * step * size, p.minimum, p.maximum);
      return model;
    };
    const auto errors = parallel(options_.jobs, 2 * n, [&](std::size_t k) {
      return std::vector<double>{squaredError(problem_, moved(k), fit)};
    });
    std::size_t best = 2 * n;
    double least = better * here;
    for (std::size_t k = 0; k < errors.size(); ++k)
      if (!errors[k].empty() && errors[k][0] < least) {
        best = k;
        least = errors[k][0];
      }
    if (best == 2 * n) {
      step /= 2;
      continue;
    }
    fit.model = moved(best);
    here = least;
  }
}

/// What was accepted is fitted on where it still is far from the noise: a curved valley takes its iterations.
Scored SearchRun::converged(const Scored& scored, const std::string& stage, double at) {
  if (excessOf(scored) < 0.1) return scored;
  std::vector<Fit> fits = fitAll({{scored.fit.model, scored.fit.shifts}}, moreIterations, stage, at, at);
  if (!scored.fit.model.effects.empty()) shake(fits, stage, at);
  refineStep(fits, 1, stage, at);
  const double noise = static_cast<double>(problem_.residuals()) / 2;
  if (!scored.fit.model.effects.empty() && fits[0].cost > 1.3 * noise) {
    Fit groped = fits[0];
    grope(groped);
    const std::vector<Fit> again = fitAll({{groped.model, groped.shifts}}, moreIterations, stage, at, at);
    if (again[0].cost < fits[0].cost) fits = again;
  }
  const Scored better = scoreAll(fits, stage, at, at)[0];
  return better.mean() < scored.mean() ? better : scored;
}

}  // namespace btr
