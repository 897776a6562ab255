#include "core/gap/search/laws/other_settings.h"

#include <algorithm>
#include <map>

#include "core/gap/fit/segments.h"

namespace btr {
namespace {

using Trials = std::vector<std::size_t>;

std::map<Values, Trials> trialsBySettings(const FitProblem& problem) {
  std::map<Values, Trials> trials;
  for (std::size_t t = 0; t < problem.trials.size(); ++t) trials[problem.trials[t].recording.settings].push_back(t);
  return trials;
}

Trials allBut(const FitProblem& problem, const Trials& trials) {
  Trials others;
  for (std::size_t t = 0; t < problem.trials.size(); ++t)
    if (std::ranges::find(trials, t) == trials.end()) others.push_back(t);
  return others;
}

/// What the fit leaves of some trials when its numbers are those of the others.
double errorAt(const FitProblem& problem, const Trials& trials, const Fit& fit, int iterations) {
  const Trials others = allBut(problem, trials);
  const Fit ofOthers = fitModel(only(problem, others), fit.model, only(problem, fit.shifts, others), {iterations});
  return residualsOf(only(problem, trials), ofOthers.model, only(problem, fit.shifts, trials)).squaredNorm();
}

}  // namespace

bool holdsAtOtherSettings(const FitProblem& problem, const Fit& without, const Fit& with, int iterations) {
  const std::map<Values, Trials> bySettings = trialsBySettings(problem);
  if (bySettings.size() < 2) return true;
  double before = 0, after = 0;
  for (const auto& [settings, trials] : bySettings) {
    before += errorAt(problem, trials, without, iterations);
    after += errorAt(problem, trials, with, iterations);
  }
  return after < before;
}

}  // namespace btr
