#include "core/gap/search/starts/whole_numbers.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/starts/window_fits.h"

namespace btr {
namespace {

/// A model whose last effect has that number, and the squared error that it leaves in short windows.
struct Wave {
  FitModel model;
  double number = 0, left = 0;
};

/// Those that leave less than `most`, the best first.
std::vector<Wave> bestOf(std::vector<Wave> waves, double most) {
  std::erase_if(waves, [&](const Wave& wave) { return wave.left >= most; });
  std::ranges::stable_sort(waves, {}, &Wave::left);
  return waves;
}

/// Whole numbers from `minimum` to `maximum`: one by one, and where they are large in steps that are a share of them,
/// since neighbours look alike there.
std::vector<double> numbersFrom(double minimum, double maximum, double step) {
  std::vector<double> numbers;
  for (double number = minimum; number <= maximum; number += std::max(1.0, std::floor(step * number)))
    numbers.push_back(number);
  return numbers;
}

/// Where the last effect's size and its angle stand among a model's numbers.
struct SizeAndPhase {
  std::size_t size = 0, phase = 0;
};

/// Nothing for an effect that is no wave.
std::optional<SizeAndPhase> waveIn(const FitModel& model) {
  const int last = static_cast<int>(model.effects.size()) - 1;
  std::optional<std::size_t> size, phase;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const FitParameter& p = model.parameters[i];
    if (p.effect != last) continue;
    if (p.hasNeutral && !size) size = i;
    if (p.goesRound) phase = i;
  }
  if (!size || !phase) return {};
  return SizeAndPhase{*size, *phase};
}

/// Size and phase that least squares give a wave of that number, and what it leaves. In short windows a motion begins
/// anew all the time and stays near: what a small wave does is in proportion to it there, and A·sin(n·q + φ) is a sum
/// of A·cos φ times the wave of phase 0 and A·sin φ times that of a quarter of a turn. `rest`: residuals of `without`.
std::vector<double> waveOf(const FitProblem& windows, const FitModel& without, const SizeAndPhase& at,
                           const Eigen::VectorXd& rest, const std::string& whole, double number, double small) {
  FitModel probe = without;
  probe.effects.back().parameters[whole] = number;
  const FitParameter& size = without.parameters[at.size];
  probe.values[at.size] = size.inRange(size.given + small * size.scale);
  Eigen::MatrixXd columns(rest.size(), 2);
  for (int quarter = 0; quarter < 2; ++quarter) {
    probe.values[at.phase] = quarter * M_PI / 2;
    columns.col(quarter) = (residualsOf(windows, probe, {}) - rest) / (probe.values[at.size] - size.given);
  }
  const Eigen::VectorXd by = columns.colPivHouseholderQr().solve(-rest);
  return {size.inRange(size.given + by.norm()), std::atan2(by[1], by[0]), (rest + columns * by).squaredNorm()};
}

/// Those of all numbers that take something away, the best first. `without`: the model that has the effect last, at its
/// neutral size.
std::vector<Wave> wavesOf(const FitService& windows, const FitModel& without, const SizeAndPhase& at,
                          const Parameter& whole, const std::function<bool(std::size_t)>& goOn) {
  const SearchThresholds::WholeNumbers& limits = windows.thresholds().wholeNumbers;
  const Eigen::VectorXd rest = residualsOf(windows.problem(), without, {});
  const std::vector<double> numbers = numbersFrom(whole.minimum, whole.maximum, limits.step);
  const auto probed = parallel(
      windows.options().jobs, numbers.size(),
      [&](std::size_t i) { return waveOf(windows.problem(), without, at, rest, whole.name, numbers[i], limits.small); },
      goOn);
  std::vector<Wave> waves;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!probed[i].ok()) continue;
    Wave wave{without, numbers[i], probed[i].numbers[2]};
    wave.model.effects.back().parameters[whole.name] = numbers[i];
    wave.model.values[at.size] = probed[i].numbers[0];
    wave.model.values[at.phase] = probed[i].numbers[1];
    waves.push_back(std::move(wave));
  }
  return bestOf(std::move(waves), windows.thresholds().restarts.better * rest.squaredNorm());
}

/// What is no wave is no sum of two columns, but has no side minima by its phase either: numbers around the fit's own,
/// all else as it is and, in `fresh`, as it was `without` the effect.
std::vector<Wave> numbersAround(const FitService& windows, const FitModel& fitted, const FitModel& fresh,
                                const FitModel& without, const Parameter& whole,
                                const std::function<bool(std::size_t)>& goOn) {
  const SearchThresholds::WholeNumbers& limits = windows.thresholds().wholeNumbers;
  const double here = fitted.effects.back().parameters.at(whole.name);
  const double from = std::max(whole.minimum, std::floor(here / limits.around));
  const double to = std::min(whole.maximum, std::ceil(here * limits.around));
  const double step = std::ceil((to - from + 1) / limits.most);
  std::vector<Wave> all;
  for (const FitModel& model : {fitted, fresh})
    for (double number = from; number <= to; number += step) {
      all.push_back({model, number, 0});
      all.back().model.effects.back().parameters[whole.name] = number;
    }
  const auto replays = parallel(
      windows.options().jobs, all.size(),
      [&](std::size_t i) {
        return std::vector<double>{residualsOf(windows.problem(), all[i].model, {}).squaredNorm()};
      },
      goOn);
  std::vector<Wave> replayed;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!replays[i].ok()) continue;
    all[i].left = replays[i].numbers[0];
    replayed.push_back(std::move(all[i]));
  }
  const double rest = residualsOf(windows.problem(), without, {}).squaredNorm();
  return bestOf(std::move(replayed), windows.thresholds().restarts.better * rest);
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

  const FitService windows = service.inWindows(limits.window_s);
  const auto goOn = service.reporter(stage, 1, at, at);
  // All other numbers as they were without the effect: with a wrong number of waves they were bent to it.
  FitModel fresh = fit.model;
  std::ranges::copy(without.values, fresh.values.begin());
  std::vector<Wave> waves;
  if (const auto where = waveIn(fit.model)) {
    fresh.values[where->size] = fresh.parameters[where->size].given;
    waves = wavesOf(windows, fresh, *where, *whole, goOn);
  } else {
    waves = numbersAround(windows, fit.model, fresh, without, *whole, goOn);
  }
  std::vector<FitJob> starts;
  for (const Wave& wave : waves) {
    const auto isNear = [&](const FitJob& start) {
      const double number = start.model.effects.back().parameters.at(whole->name);
      return std::abs(number - wave.number) <= limits.apart * wave.number;
    };
    if (starts.size() < limits.fitted && std::ranges::none_of(starts, isNear)) starts.push_back({wave.model, {}});
  }

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
