#include "core/gap/search/starts/drawn_starts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/starts/window_fits.h"
#include "core/spec/random.h"

namespace btr {
namespace {

/// A draw between two values, both within the parameter's range. An effect's rates and speeds have bounds that lie
/// decades apart: they are drawn by order of magnitude.
double drawn(const FitParameter& p, double from, double to, Random& random, double decade) {
  const bool byMagnitude = p.effect >= 0 && p.minimum > 0 && p.maximum >= decade * p.minimum;
  return byMagnitude ? std::exp(random.uniform(std::log(from), std::log(to))) : random.uniform(from, to);
}

/// Draws of a model in rounds, each in half the width of the one before, around the best so far.
class Draws {
 public:
  Draws(const FitService& service, const FitModel& start, const std::vector<std::vector<double>>& shifts,
        std::vector<std::size_t> which, std::string purpose)
      : service_(&service),
        start_(start),
        best_(start),
        shifts_(shifts),
        which_(std::move(which)),
        purpose_(std::move(purpose)),
        least_(errorOf(start)) {}

  const FitModel& best() const { return best_; }
  /// Of the error's size, not its square: one foot that slips must not outweigh all that fits well.
  double least() const { return least_; }

  void drawRound(const std::string& stage, double at) {
    const SearchThresholds::Restarts& limits = service_->thresholds().restarts;
    const std::size_t draws = limits.draws;
    Random random = Random::forPurpose(service_->options().seed, purpose_, static_cast<std::uint64_t>(round_));
    std::vector<FitModel> models(draws, best_);
    for (FitModel& model : models)
      for (const std::size_t i : which_) {
        const FitParameter& p = start_.parameters[i];
        const double half = width_ / 2 * (p.maximum - p.minimum);
        const double from = round_ == 0 ? p.minimum : std::max(p.minimum, best_.values[i] - half);
        const double to = round_ == 0 ? p.maximum : std::min(p.maximum, best_.values[i] + half);
        model.values[i] = drawn(p, from, to, random, limits.decade);
      }
    const auto replays = parallel(
        service_->options().jobs, draws, [&](std::size_t i) { return std::vector<double>{errorOf(models[i])}; },
        service_->reporter(stage, draws, at, at));
    for (std::size_t i = 0; i < draws; ++i)
      if (replays[i].ok() && replays[i].numbers[0] < least_) {
        least_ = replays[i].numbers[0];
        best_ = models[i];
      }
    ++round_;
    width_ *= limits.drawCloser;
  }

 private:
  double errorOf(const FitModel& model) const { return residualsOf(service_->problem(), model, shifts_).lpNorm<1>(); }

  const FitService* service_;
  FitModel start_, best_;
  std::vector<std::vector<double>> shifts_;
  std::vector<std::size_t> which_;
  std::string purpose_;
  double least_, width_ = 1;
  int round_ = 0;
};

}  // namespace

/// A foot that lands a step earlier, or that holds instead of sliding, makes the error rough over the numbers, and
/// derivatives lead into the next hollow. A replay costs a tenth of a Jacobian: the numbers are drawn all over their
/// ranges first, then ever closer around the best.
void restartFromDraws(const FitService& service, Fit& fit, const std::string& stage, double at) {
  std::vector<std::size_t> all(fit.model.parameters.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  Draws draws(service, fit.model, fit.shifts, all, "calibration scatter");
  for (int round = 0; round < service.thresholds().restarts.drawRounds; ++round) draws.drawRound(stage, at);
  const FitModel& best = draws.best();
  if (best.values == fit.model.values) return;
  const std::optional<Fit> fitted =
      service.tryFits({{best, fit.shifts}}, service.thresholds().calibration.drawnIterations, stage, at, at)[0];
  if (fitted && costsLess(*fitted, fit)) fit = *fitted;
}

/// Play makes the error over whole trials rough, with many hollows, of which a wide one with a weaker servo is not the
/// right one. In windows of 0.4 s it is one hollow over all widths.
void restartFromDrawsInWindows(const FitService& service, std::vector<TriedCandidate>& tried,
                               const std::vector<std::size_t>& which, const std::vector<Fit>& without,
                               const std::string& stage, double at) {
  const SearchThresholds::DrawnEffects& limits = service.thresholds().drawnEffects;
  if (service.problem().walks || service.problem().impacts) return;
  const FitService windows = service.inWindows(limits.window_s);
  struct Begun {
    std::size_t tried;
    FitModel model;
    std::vector<std::vector<double>> shifts;  // of whole trials
    double error;
  };
  struct Racer {
    std::size_t tried, base;
    Draws draws;
  };
  std::vector<Racer> race;
  for (const std::size_t k : which) {
    const FitModel& fitted = tried[k].fit.model;
    if (service.problem().library.make(fitted.effects.back().effect)->place() != Effect::Place::joint) continue;
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < fitted.parameters.size(); ++i)
      if (fitted.parameters[i].effect + 1 == static_cast<int>(fitted.effects.size())) own.push_back(i);
    // All other numbers as they were without it: the fit has bent them to what it is not.
    for (std::size_t base = 0; base < without.size(); ++base) {
      FitModel model = fitted;
      std::ranges::copy(without[base].model.values, model.values.begin());
      race.push_back({k, base, Draws(windows, model, {}, own, "effect scatter")});
    }
  }
  std::vector<double> sizesWithout, errorsWithout;
  for (const Fit& base : without) {
    const Eigen::VectorXd residuals = residualsOf(windows.problem(), base.model, {});
    sizesWithout.push_back(residuals.lpNorm<1>());
    errorsWithout.push_back(residuals.squaredNorm());
  }
  for (int round = 0; round < service.thresholds().restarts.drawRounds; ++round) {
    double least = INFINITY;
    for (Racer& each : race) {
      each.draws.drawRound(stage, at);
      least = std::min(least, each.draws.least());
    }
    // What helps in no size from all over its range is not found by drawing closer around the best of these.
    if (round + 1 >= limits.raceFrom)
      std::erase_if(race, [&](const Racer& each) {
        return each.draws.least() > std::sqrt(limits.race) * least ||
               each.draws.least() > limits.helpsAtAll * sizesWithout[each.base];
      });
  }
  if (race.empty()) return;
  std::vector<Begun> begun;
  double least = INFINITY;
  for (const Racer& each : race) {
    const FitModel& model = each.draws.best();
    const double error = residualsOf(windows.problem(), model, {}).squaredNorm();
    // What helps nothing in any size that was drawn begins nowhere better than where it is.
    if (error > limits.helps * errorsWithout[each.base]) continue;
    least = std::min(least, error);
    const Begun begins{each.tried, model, without[each.base].shifts, error};
    const auto known = std::ranges::find(begun, each.tried, &Begun::tried);
    if (known == begun.end())
      begun.push_back(begins);
    else if (error < known->error)
      *known = begins;
  }
  for (const Begun& each : begun) {
    if (!(each.error <= limits.inReach * least)) continue;
    std::vector<Fit> fits =
        completed(windows.tryFits({{each.model, {}}}, service.thresholds().restarts.windowIterations, stage, at, at));
    if (fits.empty()) continue;
    // Of a law that is not the cause a better fit says nothing: others were not begun as often.
    const auto leaves = [&](const FitProblem& problem) {
      return 2 * fits[0].cost / static_cast<double>(problem.residuals());
    };
    if (!(leaves(windows.problem()) <= limits.hopeless * limits.mostLeft)) continue;
    fits = fitInLongerWindows(service, std::move(fits), limits.window_s, each.shifts, stage, at);
    if (fits.empty() || !(leaves(service.problem()) <= limits.mostLeft)) continue;
    // What the candidate has so far was broken off after a few iterations; it is judged with as many.
    Fit& fit = tried[each.tried].fit;
    if (!costsLess(fits[0], fit)) continue;
    const std::optional<Fit> goneOn =
        service.tryFits({{fit.model, fit.shifts}}, service.thresholds().restarts.wholeIterations, stage, at, at)[0];
    if (!goneOn || costsLess(fits[0], *goneOn)) fit = fits[0];
  }
}

}  // namespace btr
