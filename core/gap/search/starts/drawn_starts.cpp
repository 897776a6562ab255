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

}  // namespace

FitModel drawnAround(const FitService& service, const FitModel& start, const std::vector<std::vector<double>>& shifts,
                     const std::vector<std::size_t>& which, const std::string& purpose, const std::string& stage,
                     double at) {
  const SearchThresholds::Restarts& limits = service.thresholds().restarts;
  const std::size_t draws = limits.draws;
  // Of the error's size, not its square: one foot that slips must not outweigh all that fits well.
  const auto errorOf = [&](const FitModel& model) { return residualsOf(service.problem(), model, shifts).lpNorm<1>(); };
  FitModel best = start;
  double least = errorOf(best), width = 1;
  for (int round = 0; round < limits.drawRounds; ++round, width *= limits.drawCloser) {
    Random random = Random::forPurpose(service.options().seed, purpose, static_cast<std::uint64_t>(round));
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
        service.options().jobs, draws, [&](std::size_t i) { return std::vector<double>{errorOf(models[i])}; },
        service.reporter(stage, draws, at, at));
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
void restartFromDraws(const FitService& service, Fit& fit, const std::string& stage, double at) {
  std::vector<std::size_t> all(fit.model.parameters.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const FitModel best = drawnAround(service, fit.model, fit.shifts, all, "calibration scatter", stage, at);
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
  std::vector<Begun> begun;
  double least = INFINITY;
  for (const std::size_t k : which) {
    const FitModel& fitted = tried[k].fit.model;
    if (service.problem().library.make(fitted.effects.back().effect)->place() != Effect::Place::joint) continue;
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < fitted.parameters.size(); ++i)
      if (fitted.parameters[i].effect + 1 == static_cast<int>(fitted.effects.size())) own.push_back(i);
    // All other numbers as they were without it: the fit has bent them to what it is not.
    Begun best{k, {}, {}, INFINITY};
    for (const Fit& base : without) {
      FitModel model = fitted;
      std::ranges::copy(base.model.values, model.values.begin());
      model = drawnAround(windows, model, {}, own, "effect scatter", stage, at);
      const double error = residualsOf(windows.problem(), model, {}).squaredNorm();
      if (error < best.error) best = {k, model, base.shifts, error};
    }
    least = std::min(least, best.error);
    begun.push_back(std::move(best));
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
