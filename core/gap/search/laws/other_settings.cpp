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

}  // namespace

bool holdsAtOtherSettings(const FitProblem& problem, const Fit& without, const Fit& with, int iterations) {
  const std::map<Values, Trials> bySettings = trialsBySettings(problem);
  if (bySettings.size() < 2) return true;
  double before = 0, after = 0;
  for (const auto& [settings, trials] : bySettings) {
    const Trials others = allBut(problem, trials);
    const FitProblem fitted = only(problem, others), predicted = only(problem, trials);
    const auto errorOf = [&](const Fit& fit) {
      const Fit ofOthers = fitModel(fitted, fit.model, only(problem, fit.shifts, others), {iterations});
      return residualsOf(predicted, ofOthers.model, only(problem, fit.shifts, trials)).squaredNorm();
    };
    before += errorOf(without);
    after += errorOf(with);
  }
  return after < before;
}

}  // namespace btr
