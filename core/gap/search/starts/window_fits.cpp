#include "core/gap/search/starts/window_fits.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/segments.h"
#include "core/gap/search/fit_service.h"

namespace btr {

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

/// From window to window to whole trials: each is near enough to begin the next.
std::vector<Fit> fitInLongerWindows(const FitService& service, std::vector<Fit> fits, double length_s,
                                    const std::vector<std::vector<double>>& shifts, const std::string& stage,
                                    double at) {
  const SearchThresholds::Restarts& limits = service.thresholds().restarts;
  const auto goOn = [&](const FitService& over, const std::vector<std::vector<double>>& from) {
    std::vector<FitJob> jobs;
    for (const Fit& each : fits) jobs.push_back({each.model, from});
    fits = completed(over.tryFits(jobs, limits.wholeIterations, stage, at, at));
    if (fits.empty()) return;
    const double least = std::ranges::min_element(fits, costsLess)->cost;
    std::erase_if(fits, [&](const Fit& each) { return each.cost > service.thresholds().wholeNumbers.inReach * least; });
  };
  while ((length_s *= limits.longer) < limits.longestWindow_s) goOn(service.inWindows(length_s), {});
  goOn(service, shifts);
  return fits;
}

}  // namespace btr
