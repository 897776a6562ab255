#include "core/gap/search/starts/whole_numbers.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <Eigen/QR>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/starts/window_fits.h"

namespace btr {
namespace {

/// A wave that takes away what is left in short windows, and what it would leave.
struct Wave {
  FitModel model;
  double number = 0, left = 0;
};

/// Whole numbers from `minimum` to `maximum`: one by one, and where they are large in steps that are a share of them,
/// since neighbours look alike there.
std::vector<double> numbersFrom(double minimum, double maximum, double step) {
  std::vector<double> numbers;
  for (double number = minimum; number <= maximum; number += std::max(1.0, std::floor(step * number)))
    numbers.push_back(number);
  return numbers;
}

/// The wave of that number, of the size and phase that least squares give it. In short windows a motion begins anew all
/// the time and stays near: what a small wave does is in proportion to it there, and A·sin(n·q + φ) is a sum of
/// A·cos φ times the wave of phase 0 and A·sin φ times that of a quarter of a turn.
/// `rest`: residuals of `without`, the model that has the effect last, at its neutral size.
Wave waveOf(const FitProblem& windows, const FitModel& without, const Eigen::VectorXd& rest, const std::string& whole,
            double number, double small) {
  Wave wave{without, number, rest.squaredNorm()};
  wave.model.effects.back().parameters[whole] = number;
  const int last = static_cast<int>(without.effects.size()) - 1;
  std::optional<std::size_t> size, phase;
  for (std::size_t i = 0; i < without.parameters.size(); ++i)
    if (const FitParameter& p = without.parameters[i]; p.effect == last) {
      if (p.hasNeutral && !size) size = i;
      if (p.goesRound) phase = i;
    }
  if (!size) return wave;
  const FitParameter& sized = without.parameters[*size];
  Eigen::MatrixXd columns(rest.size(), phase ? 2 : 1);
  for (int k = 0; k < columns.cols(); ++k) {
    FitModel probe = wave.model;
    probe.values[*size] = sized.inRange(sized.given + small * sized.scale);
    if (phase) probe.values[*phase] = k * M_PI / 2;
    columns.col(k) = (residualsOf(windows, probe, {}) - rest) / (probe.values[*size] - sized.given);
  }
  const Eigen::VectorXd by = columns.colPivHouseholderQr().solve(-rest);
  wave.left = (rest + columns * by).squaredNorm();
  wave.model.values[*size] = sized.inRange(sized.given + (phase ? by.norm() : by[0]));
  if (phase) wave.model.values[*phase] = std::atan2(by[1], by[0]);
  return wave;
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

  // All other numbers as they were without the effect: with a wrong number they were bent to it.
  FitModel fresh = fit.model;
  std::ranges::copy(without.values, fresh.values.begin());
  for (std::size_t i = without.values.size(); i < fresh.values.size(); ++i)
    if (fresh.parameters[i].hasNeutral) fresh.values[i] = fresh.parameters[i].given;

  const FitService windows = service.inWindows(limits.window_s);
  const Eigen::VectorXd rest = residualsOf(windows.problem(), fresh, {});
  const std::vector<double> numbers = numbersFrom(whole->minimum, whole->maximum, limits.step);
  std::vector<Wave> waves(numbers.size());
  const auto probed = parallel(
      service.options().jobs, numbers.size(),
      [&](std::size_t i) {
        const Wave wave = waveOf(windows.problem(), fresh, rest, whole->name, numbers[i], limits.small);
        std::vector<double> sent = wave.model.values;
        sent.push_back(wave.left);
        return sent;
      },
      service.reporter(stage, numbers.size(), at, at));
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!probed[i].ok()) continue;
    waves[i] = {fresh, numbers[i], probed[i].numbers.back()};
    waves[i].model.effects.back().parameters[whole->name] = numbers[i];
    std::copy_n(probed[i].numbers.begin(), waves[i].model.values.size(), waves[i].model.values.begin());
    if (waves[i].left < service.thresholds().restarts.better * rest.squaredNorm()) order.push_back(i);
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return waves[i].left; });
  std::vector<FitJob> starts;
  // Neighbours are climbed to from each.
  for (const std::size_t i : order)
    if (starts.size() < limits.fitted && std::ranges::none_of(starts, [&](const FitJob& start) {
          return std::abs(numberOf(start.model) - numbers[i]) <= std::max(1.0, limits.apart * numbers[i]);
        }))
      starts.push_back({waves[i].model, {}});

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
