// Fits that begin in short windows: over whole trials a wrong number leads far away, and a fit into the next hollow.
#include <algorithm>
#include <cmath>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/segments.h"
#include "core/gap/search/search_run.h"

namespace btr {
namespace {

/// A motion that begins anew in each window stays near the recorded one, whatever is wrong. As many windows from all
/// over the recordings as are replayed in a short time; in each of them the samples that there must be to know its
/// beginning.
FitProblem cutShort(const FitProblem& problem, double length_s, const SearchThresholds::Restarts& limits) {
  for (const FitTrial& trial : problem.trials) {
    const auto& time = trial.recording.columns[0];
    const double sample_s = (time[trial.rows() - 1] - time[0]) / static_cast<double>(trial.rows() - 1);
    length_s = std::max(length_s, limits.windowSamples * sample_s);
  }
  FitProblem windows = problem;
  cutSegments(windows, length_s);
  const double total_s = length_s * static_cast<double>(windows.segments.size());
  const auto every = static_cast<std::size_t>(std::max(1.0, std::round(total_s / limits.windowsReplayed_s)));
  std::vector<Segment> kept;
  for (std::size_t i = 0; i < windows.segments.size(); i += every) kept.push_back(std::move(windows.segments[i]));
  windows.segments = std::move(kept);
  return windows;
}

}  // namespace

SearchRun SearchRun::inWindows(double length_s) const {
  SearchRun windows(cutShort(problem_, length_s, limits().restarts), options_);
  windows.told_ = told_;
  windows.refused_ = refused_;
  return windows;
}

/// From window to window to whole trials: each is near enough to begin the next.
std::vector<Fit> SearchRun::inLongerWindows(std::vector<Fit> fits, double length_s,
                                            const std::vector<std::vector<double>>& shifts, const std::string& stage,
                                            double at) const {
  const SearchThresholds::Restarts& limits = options_.thresholds.restarts;
  const auto goOn = [&](const SearchRun& run, const std::vector<std::vector<double>>& from) {
    std::vector<FitJob> jobs;
    for (const Fit& each : fits) jobs.push_back({each.model, from});
    fits = thoseOf(run.tryFits(jobs, limits.wholeIterations, stage, at, at));
  };
  while ((length_s *= limits.longer) < limits.longestWindow_s) goOn(inWindows(length_s), {});
  goOn(*this, shifts);
  return fits;
}

/// Play makes the error over whole trials rough, with many hollows, of which a wide one with a weaker servo is not the
/// right one. In windows of 0.4 s it is one hollow over all widths.
void SearchRun::fitFromScatter(std::vector<Tried>& tried, const std::vector<std::size_t>& which,
                               const std::vector<Fit>& without, const std::string& stage, double at) const {
  const SearchThresholds::DrawnEffects& limits = options_.thresholds.drawnEffects;
  if (problem_.walks || problem_.impacts) return;
  const SearchRun windows = inWindows(limits.window_s);
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
    if (problem_.library.make(fitted.effects.back().effect)->place() != Effect::Place::joint) continue;
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < fitted.parameters.size(); ++i)
      if (fitted.parameters[i].effect + 1 == static_cast<int>(fitted.effects.size())) own.push_back(i);
    // All other numbers as they were without it: the fit has bent them to what it is not.
    Begun best{k, {}, {}, INFINITY};
    for (const Fit& base : without) {
      FitModel model = fitted;
      std::ranges::copy(base.model.values, model.values.begin());
      model = windows.drawnAround(model, {}, own, "effect scatter", stage, at);
      const double error = residualsOf(windows.problem_, model, {}).squaredNorm();
      if (error < best.error) best = {k, model, base.shifts, error};
    }
    least = std::min(least, best.error);
    begun.push_back(std::move(best));
  }
  for (const Begun& each : begun) {
    if (!(each.error <= limits.inReach * least)) continue;
    std::vector<Fit> fits =
        thoseOf(windows.tryFits({{each.model, {}}}, options_.thresholds.restarts.windowIterations, stage, at, at));
    if (fits.empty()) continue;
    // Of a law that is not the cause a better fit says nothing: others were not begun as often.
    const auto leaves = [&](const FitProblem& problem) {
      return 2 * fits[0].cost / static_cast<double>(problem.residuals());
    };
    if (!(leaves(windows.problem_) <= limits.hopeless * limits.mostLeft)) continue;
    fits = inLongerWindows(std::move(fits), limits.window_s, each.shifts, stage, at);
    if (fits.empty() || !(leaves(problem_) <= limits.mostLeft)) continue;
    // What the candidate has so far was broken off after a few iterations; it is judged with as many.
    Fit& fit = tried[each.tried].fit;
    if (!costsLess(fits[0], fit)) continue;
    const std::optional<Fit> goneOn =
        tryFits({{fit.model, fit.shifts}}, options_.thresholds.restarts.wholeIterations, stage, at, at)[0];
    if (!goneOn || costsLess(fits[0], *goneOn)) fit = fits[0];
  }
}

}  // namespace btr
