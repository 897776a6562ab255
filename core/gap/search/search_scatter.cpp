// Where a fit begins decides where it ends: beginnings drawn all over the ranges, judged by replays alone.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/search_run.h"
#include "core/spec/random.h"

namespace btr {
namespace {

/// A draw between two values, both within the parameter's range. An effect's rates and speeds have bounds that lie
/// decades apart: they are drawn by order of magnitude.
double drawn(const FitParameter& p, double from, double to, Random& random, double decade) {
  const bool byMagnitude = p.effect >= 0 && p.minimum > 0 && p.maximum >= decade * p.minimum;
  return byMagnitude ? std::exp(random.uniform(std::log(from), std::log(to))) : random.uniform(from, to);
}

}  // namespace

FitModel SearchRun::drawnAround(const FitModel& start, const std::vector<std::vector<double>>& shifts,
                                const std::vector<std::size_t>& which, const std::string& purpose,
                                const std::string& stage, double at) const {
  const SearchThresholds::Restarts& limits = this->limits().restarts;
  const std::size_t draws = limits.draws;
  // Of the error's size, not its square: one foot that slips must not outweigh all that is told well.
  const auto errorOf = [&](const FitModel& model) { return residualsOf(problem_, model, shifts).lpNorm<1>(); };
  FitModel best = start;
  double least = errorOf(best), width = 1;
  for (int round = 0; round < limits.drawRounds; ++round, width *= limits.drawCloser) {
    Random random = Random::forPurpose(options_.seed, purpose, static_cast<std::uint64_t>(round));
    std::vector<FitModel> models(draws, best);
    for (FitModel& model : models)
      for (const std::size_t i : which) {
        const FitParameter& p = start.parameters[i];
        const double half = width / 2 * (p.maximum - p.minimum);
        const double from = round == 0 ? p.minimum : std::max(p.minimum, best.values[i] - half);
        const double to = round == 0 ? p.maximum : std::min(p.maximum, best.values[i] + half);
        model.values[i] = drawn(p, from, to, random, limits.decade);
      }
    const auto replays = parallel(
        options_.jobs, draws, [&](std::size_t i) { return std::vector<double>{errorOf(models[i])}; },
        reporter(stage, draws, at, at));
    for (std::size_t i = 0; i < draws; ++i)
      if (replays[i].ok() && replays[i].numbers[0] < least) {
        least = replays[i].numbers[0];
        best = models[i];
      }
  }
  return best;
}

/// A foot that lands a step earlier, or that holds instead of sliding, makes the error rough over the numbers, and
/// derivatives lead into the next hollow. A replay costs a tenth of a Jacobian: the numbers are drawn all over their
/// ranges first, then ever closer around the best.
void SearchRun::scatter(Fit& fit, const std::string& stage, double at) const {
  std::vector<std::size_t> all(fit.model.parameters.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const FitModel best = drawnAround(fit.model, fit.shifts, all, "calibration scatter", stage, at);
  if (best.values == fit.model.values) return;
  const std::optional<Fit> fitted =
      tryFits({{best, fit.shifts}}, limits().calibration.drawnIterations, stage, at, at)[0];
  if (fitted && costsLess(*fitted, fit)) fit = *fitted;
}

}  // namespace btr
