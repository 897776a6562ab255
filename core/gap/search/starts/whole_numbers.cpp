#include "core/gap/search/starts/whole_numbers.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/starts/window_fits.h"

namespace btr {
namespace {

/// The last effect's whole number around where it is, its numbers without a neutral value all over their range.
std::vector<FitModel> wavesLike(const FitModel& base, const Parameter& whole,
                                const SearchThresholds::WholeNumbers& limits) {
  const int last = static_cast<int>(base.effects.size()) - 1;
  const double here = base.effects.back().parameters.at(whole.name);
  const double from = std::max(whole.minimum, std::floor(here / limits.widest));
  const double to = std::min(whole.maximum, std::ceil(here * limits.widest));
  const double step = std::ceil((to - from + 1) / limits.most);
  std::vector<FitModel> waves;
  for (double number = from; number <= to; number += step)
    for (int k = 0; k < limits.phases; ++k) {
      FitModel wave = base;
      wave.effects.back().parameters[whole.name] = number;
      for (std::size_t i = 0; i < wave.values.size(); ++i)
        if (const FitParameter& p = wave.parameters[i]; p.effect == last && !p.hasNeutral)
          wave.values[i] = p.minimum + (k + 0.5) / limits.phases * (p.maximum - p.minimum);
      waves.push_back(wave);
    }
  return waves;
}

}  // namespace

/// A wave that pulls a joint hard catches it in another of its troughs than the recorded one, and no fit over whole
/// trials comes back from there: the number of waves that was found is the one that hides it best.
void restartWholeNumberInWindows(const FitService& service, Fit& fit, const FitModel& without, const std::string& stage,
                                 double at) {
  const SearchThresholds::WholeNumbers& limits = service.thresholds().wholeNumbers;
  const std::vector<Parameter> declared = service.parametersOf(fit.model.effects.back());
  const auto whole = std::ranges::find_if(declared, &Parameter::integer);
  if (whole == declared.end() || service.problem().walks) return;
  if (2 * fit.cost < limits.leastLeft * static_cast<double>(service.problem().residuals())) return;
  const auto numberOf = [&](const FitModel& model) { return model.effects.back().parameters.at(whole->name); };

  // All other numbers as they are, and as they were without the effect.
  FitModel fresh = fit.model;
  std::ranges::copy(without.values, fresh.values.begin());
  std::vector<FitModel> waves = wavesLike(fit.model, *whole, limits);
  std::ranges::copy(wavesLike(fresh, *whole, limits), std::back_inserter(waves));

  const FitService windows = service.inWindows(limits.window_s);
  const auto replays = parallel(
      service.options().jobs, waves.size(),
      [&](std::size_t i) { return std::vector<double>{residualsOf(windows.problem(), waves[i], {}).squaredNorm()}; },
      service.reporter(stage, waves.size(), at, at));
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < waves.size(); ++i)
    if (replays[i].ok()) order.push_back(i);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return replays[i].numbers[0]; });
  std::vector<FitJob> starts;
  for (const std::size_t i : order)
    if (starts.size() < limits.fitted &&
        std::ranges::none_of(starts, [&](const FitJob& start) { return numberOf(start.model) == numberOf(waves[i]); }))
      starts.push_back({waves[i], {}});

  std::vector<Fit> fits =
      completed(windows.tryFits(starts, service.thresholds().restarts.windowIterations, stage, at, at));
  if (fits.empty()) return;
  std::ranges::sort(fits, costsLess);
  climbWholeNumbers(windows, fits[0], stage, at);
  fits = fitInLongerWindows(service, std::move(fits), limits.window_s, fit.shifts, stage, at);
  const auto least = std::ranges::min_element(fits, costsLess);
  if (least != fits.end() && least->cost < service.thresholds().restarts.better * fit.cost) fit = *least;
}

/// Neighbours are tried as long as one fits better.
void climbWholeNumbers(const FitService& service, Fit& fit, const std::string& stage, double at) {
  if (fit.model.effects.empty()) return;
  const SearchThresholds::Restarts& limits = service.thresholds().restarts;
  const PlacedEffect last = fit.model.effects.back();
  for (const Parameter& p : service.parametersOf(last)) {
    if (!p.integer) continue;
    for (int round = 0; round < limits.neighbourRounds; ++round) {
      const double here = fit.model.effects.back().parameters.at(p.name);
      std::vector<FitJob> jobs;
      for (const double by : limits.neighbours) {
        if (here + by < p.minimum || here + by > p.maximum) continue;
        FitModel model = fit.model;
        model.effects.back().parameters[p.name] = here + by;
        jobs.push_back({model, fit.shifts});
      }
      std::vector<Fit> fits = completed(service.tryFits(jobs, limits.neighbourIterations, stage, at, at));
      std::ranges::sort(fits, costsLess);
      if (fits.size() > limits.neighboursFittedOn) fits.resize(limits.neighboursFittedOn);
      fits = service.refit(fits, limits.neighbourBestIterations, stage, at, at);
      const auto least = std::ranges::min_element(fits, costsLess);
      if (least == fits.end() || !(least->cost < limits.better * fit.cost)) break;
      fit = *least;
    }
  }
}

}  // namespace btr
