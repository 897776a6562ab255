// Calibration of robots on their feet: where it begins decides where it ends.
#include <algorithm>

#include "core/gap/search_run.h"
#include "core/spec/random.h"

namespace btr {

/// A foot that lands a step earlier, or that holds instead of sliding, makes the error rough over the numbers, and
/// derivatives lead into the next hollow. A replay costs a tenth of a Jacobian: the numbers are drawn all over their
/// ranges first, then ever closer around the best.
void SearchRun::scatter(Fit& fit, const std::string& stage, double at) const {
  constexpr int rounds = 6, iterations = 15;
  constexpr std::size_t draws = 24;
  constexpr double closer = 0.5;
  const std::vector<FitParameter>& parameters = fit.model.parameters;
  // Of the error's size, not its square: one foot that slips must not outweigh all that is told well.
  const auto errorOf = [&](const FitModel& model) { return residualsOf(problem_, model, fit.shifts).lpNorm<1>(); };
  FitModel best = fit.model;
  double least = errorOf(best), width = 1;
  for (int round = 0; round < rounds; ++round, width *= closer) {
    Random random = Random::forPurpose(options_.seed, "calibration scatter", static_cast<std::uint64_t>(round));
    std::vector<FitModel> drawn(draws, best);
    for (FitModel& model : drawn)
      for (std::size_t i = 0; i < parameters.size(); ++i) {
        const double half = width / 2 * (parameters[i].maximum - parameters[i].minimum);
        const double from = std::max(parameters[i].minimum, best.values[i] - half);
        const double to = std::min(parameters[i].maximum, best.values[i] + half);
        model.values[i] =
            round == 0 ? random.uniform(parameters[i].minimum, parameters[i].maximum) : random.uniform(from, to);
      }
    const auto errors = parallel(
        options_.jobs, draws, [&](std::size_t i) { return std::vector<double>{errorOf(drawn[i])}; },
        reporter(stage, draws, at, at));
    for (std::size_t i = 0; i < draws; ++i)
      if (!errors[i].empty() && errors[i][0] < least) {
        least = errors[i][0];
        best = drawn[i];
      }
  }
  if (best.values == fit.model.values) return;
  const Fit fitted = fitAll({{best, fit.shifts}}, iterations, stage, at, at)[0];
  if (costsLess(fitted, fit)) fit = fitted;
}

}  // namespace btr
