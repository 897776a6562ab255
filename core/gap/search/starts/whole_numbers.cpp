#include "core/gap/search/starts/whole_numbers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

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
  const bool hasPhase =
      std::ranges::any_of(base.parameters, [&](const FitParameter& p) { return p.effect == last && !p.hasNeutral; });
  const int phases = hasPhase ? limits.phases : 1;
  std::vector<FitModel> waves;
  for (double number = from; number <= to; number += step)
    for (int k = 0; k < phases; ++k) {
      FitModel wave = base;
      wave.effects.back().parameters[whole.name] = number;
      for (std::size_t i = 0; i < wave.values.size(); ++i)
        if (const FitParameter& p = wave.parameters[i]; p.effect == last && !p.hasNeutral)
          wave.values[i] = p.minimum + (k + 0.5) / phases * (p.maximum - p.minimum);
      waves.push_back(wave);
    }
  return waves;
}

/// A whole number that counts something: of kinds, each is fitted anyway.
bool counts(const Parameter& p, const SearchThresholds& thresholds) {
  return p.integer && p.maximum - p.minimum > thresholds.candidates.mostKinds;
}

/// Whole numbers beside one, within its range, each once: those next to it and, where it counts something and is no
/// kind, its harmonics.
std::vector<double> besides(const Parameter& whole, double here, const SearchThresholds& thresholds) {
  std::vector<double> numbers;
  for (const double by : thresholds.restarts.neighbours) numbers.push_back(here + by);
  if (counts(whole, thresholds))
    for (const double times : thresholds.restarts.harmonics) numbers.push_back(std::round(times * here));
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  std::erase_if(numbers, [&](double n) { return n == here || n < whole.minimum || n > whole.maximum; });
  return numbers;
}

}  // namespace

/// A wave that pulls a joint hard catches it in another of its troughs than the recorded one, and no fit over whole
/// trials comes back from there: the number of waves that was found is the one that hides it best.
void restartWholeNumberInWindows(const FitService& service, Fit& fit, const FitModel& without, const std::string& stage,
                                 double at) {
  const SearchThresholds::WholeNumbers& limits = service.thresholds().wholeNumbers;
  const std::vector<Parameter> declared = service.parametersOf(fit.model.effects.back());
  const auto whole =
      std::ranges::find_if(declared, [&](const Parameter& p) { return counts(p, service.thresholds()); });
  if (whole == declared.end() || service.problem().walks) return;
  if (2 * fit.cost < limits.leastLeft * static_cast<double>(service.problem().residuals())) return;
  const auto numberOf = [&](const FitModel& model) { return model.effects.back().parameters.at(whole->name); };

  // All other numbers as they are, and as they were without the effect.
  FitModel fresh = fit.model;
  std::ranges::copy(without.values, fresh.values.begin());
  std::vector<FitModel> waves = wavesLike(fit.model, *whole, limits);
  std::ranges::copy(wavesLike(fresh, *whole, limits), std::back_inserter(waves));

  const FitService windows = service.inWindows(limits.window_s);
  const double best = service.thresholds().restarts.better * residualsOf(windows.problem(), without, {}).squaredNorm();
  const auto replays = parallel(
      service.options().jobs, waves.size(),
      [&](std::size_t i) { return std::vector<double>{residualsOf(windows.problem(), waves[i], {}).squaredNorm()}; },
      service.reporter(stage, waves.size(), at, at));
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < waves.size(); ++i)
    // Where a motion begins anew all the time, a wave of the right number and phase helps at once, whatever its size.
    if (replays[i].ok() && replays[i].numbers[0] < best) order.push_back(i);
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
  std::erase_if(fits, [&](const Fit& each) { return each.cost > limits.inReach * fits[0].cost; });
  fits = fitInLongerWindows(service, std::move(fits), limits.window_s, fit.shifts, stage, at);
  const auto least = std::ranges::min_element(fits, costsLess);
  if (least != fits.end() && least->cost < service.thresholds().restarts.better * fit.cost) fit = *least;
}

/// Neighbours and harmonics are tried as long as one fits better, each number once. A torque that is held for a whole
/// period of the commands takes twice as much damping away as one held for half of it: beside a damping that was fitted
/// to either, no number between the two does better.
void climbWholeNumbers(const FitService& service, Fit& fit, const std::string& stage, double at) {
  if (fit.model.effects.empty()) return;
  const SearchThresholds::Restarts& limits = service.thresholds().restarts;
  const PlacedEffect last = fit.model.effects.back();
  for (const Parameter& p : service.parametersOf(last)) {
    if (!p.integer) continue;
    std::set<double> tried{fit.model.effects.back().parameters.at(p.name)};
    for (int round = 0; round < limits.neighbourRounds; ++round) {
      const double here = fit.model.effects.back().parameters.at(p.name);
      std::vector<FitJob> jobs;
      for (const double number : besides(p, here, service.thresholds())) {
        if (!tried.insert(number).second) continue;
        FitModel model = fit.model;
        model.effects.back().parameters[p.name] = number;
        jobs.push_back({model, fit.shifts});
      }
      if (jobs.empty()) break;
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
