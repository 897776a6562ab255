// Whole numbers, as of teeth in a turn, are no parameters of a fit: they are looked for around it.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/search_run.h"

namespace btr {
namespace {

constexpr double farOff = 4;    // mean squared error: whoever leaves more may have gone astray on its way
constexpr double widest = 1.3;  // whole numbers from a fit's own by this factor down and up
constexpr double mostNumbers = 24;
constexpr int phases = 16;
constexpr double shortest_s = 0.1;

/// The last effect's whole number around where it is, its numbers without a neutral value all over their range.
std::vector<FitModel> wavesLike(const FitModel& base, const Parameter& whole) {
  const int last = static_cast<int>(base.effects.size()) - 1;
  const double here = base.effects.back().parameters.at(whole.name);
  const double from = std::max(whole.minimum, std::floor(here / widest));
  const double to = std::min(whole.maximum, std::ceil(here * widest));
  const double step = std::ceil((to - from + 1) / mostNumbers);
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

}  // namespace

/// A wave that pulls a joint hard catches it in another of its troughs than the recorded one, and no fit over whole
/// trials comes back from there: the number of waves that was found is the one that hides it best.
void SearchRun::fitFromWindows(Fit& fit, const FitModel& without, const std::string& stage, double at) const {
  constexpr std::size_t mostStarts = 3;
  constexpr int nearby = 8;
  constexpr double better = 0.995;
  const std::vector<Parameter> declared =
      parametersAt(problem_, fit.model.effects.back().effect, fit.model.effects.back().at);
  const auto whole = std::ranges::find_if(declared, &Parameter::integer);
  if (whole == declared.end() || problem_.walks) return;
  if (2 * fit.cost < farOff * static_cast<double>(problem_.residuals())) return;
  const auto numberOf = [&](const FitModel& model) { return model.effects.back().parameters.at(whole->name); };

  // All other numbers as they are, and as they were without the effect.
  FitModel fresh = fit.model;
  std::ranges::copy(without.values, fresh.values.begin());
  std::vector<FitModel> waves = wavesLike(fit.model, *whole);
  std::ranges::copy(wavesLike(fresh, *whole), std::back_inserter(waves));

  SearchRun windows = inWindows(shortest_s);
  const auto replays = parallel(
      options_.jobs, waves.size(),
      [&](std::size_t i) { return std::vector<double>{residualsOf(windows.problem_, waves[i], {}).squaredNorm()}; },
      reporter(stage, waves.size(), at, at));
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < waves.size(); ++i)
    if (replays[i].ok()) order.push_back(i);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return replays[i].numbers[0]; });
  std::vector<FitJob> starts;
  for (const std::size_t i : order)
    if (starts.size() < mostStarts &&
        std::ranges::none_of(starts, [&](const FitJob& start) { return numberOf(start.model) == numberOf(waves[i]); }))
      starts.push_back({waves[i], {}});

  std::vector<Fit> fits = thoseOf(windows.tryFits(starts, nearby, stage, at, at));
  if (fits.empty()) return;
  std::ranges::sort(fits, costsLess);
  windows.climbWholeNumbers(fits[0], stage, at);
  fits = inLongerWindows(std::move(fits), shortest_s, fit.shifts, stage, at);
  const auto least = std::ranges::min_element(fits, costsLess);
  if (least != fits.end() && least->cost < better * fit.cost) fit = *least;
}

/// Neighbours are tried as long as one fits better.
void SearchRun::climbWholeNumbers(Fit& fit, const std::string& stage, double at) const {
  if (fit.model.effects.empty()) return;
  constexpr int look = 3, iterations = 8, mostRounds = 6;
  constexpr double better = 0.995;
  const PlacedEffect last = fit.model.effects.back();
  for (const Parameter& p : parametersAt(problem_, last.effect, last.at)) {
    if (!p.integer) continue;
    for (int round = 0; round < mostRounds; ++round) {
      const double here = fit.model.effects.back().parameters.at(p.name);
      std::vector<FitJob> jobs;
      for (const double by : {-3, -2, -1, 1, 2, 3}) {
        if (here + by < p.minimum || here + by > p.maximum) continue;
        FitModel model = fit.model;
        model.effects.back().parameters[p.name] = here + by;
        jobs.push_back({model, fit.shifts});
      }
      std::vector<Fit> fits = thoseOf(tryFits(jobs, look, stage, at, at));
      std::ranges::sort(fits, costsLess);
      if (fits.size() > 2) fits.resize(2);
      fits = fitOn(fits, iterations, stage, at, at);
      const auto least = std::ranges::min_element(fits, costsLess);
      if (least == fits.end() || !(least->cost < better * fit.cost)) break;
      fit = *least;
    }
  }
}

}  // namespace btr
