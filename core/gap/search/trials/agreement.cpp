#include "core/gap/search/trials/agreement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/gap/recordings/doctor/even_grid.h"
#include "core/gap/search/trials/disagreement.h"

namespace btr {
namespace {

std::vector<Recording> leftOut(const std::vector<Recording>& recordings, const std::vector<std::size_t>& which) {
  std::vector<Recording> kept;
  for (std::size_t t = 0; t < recordings.size(); ++t)
    if (std::ranges::find(which, t) == which.end()) kept.push_back(recordings[t]);
  return kept;
}

double medianError(const std::vector<double>& errors, const std::vector<std::size_t>& but) {
  std::vector<double> others;
  for (std::size_t t = 0; t < errors.size(); ++t)
    if (std::ranges::find(but, t) == but.end() && std::isfinite(errors[t])) others.push_back(errors[t]);
  return others.empty() ? NAN : median(std::move(others));
}

double meanError(const std::vector<double>& errors, const std::vector<std::size_t>& but) {
  double sum = 0, count = 0;
  for (std::size_t t = 0; t < errors.size(); ++t)
    if (std::ranges::find(but, t) == but.end()) {
      sum += errors[t];
      ++count;
    }
  return count > 0 ? sum / count : NAN;
}

Agreement::Without searched(const std::vector<Recording>& recordings, const std::vector<std::size_t>& aside,
                            const SearchOptions& options,
                            const std::function<FitProblem(const std::vector<Recording>&)>& ready) {
  SearchOptions again = options;
  if (options.progress)
    again.progress = [&](const std::string& stage, double share) {
      return options.progress(stage + " without trials that disagree", share);
    };
  FitProblem problem = ready(leftOut(recordings, aside));
  SearchResult found = searchEffects(problem, again);
  return {std::move(problem), std::move(found)};
}

/// One round: trials that disagree with the others of `recordings`, and the search without them.
Agreement oneRound(const std::vector<Recording>& recordings, const FitProblem& problem, const SearchResult& found,
                   const SearchOptions& options,
                   const std::function<FitProblem(const std::vector<Recording>&)>& ready) {
  const SearchThresholds::Trials& limits = options.thresholds.trials;
  Agreement result;
  // Of a walk nobody can foretell where a foot lands; of a toss where it hits: one is never like another.
  if (problem.walks || problem.impacts || found.unstable) return result;
  const std::vector<std::size_t> suspects = outlyingTrials(problem, found, options.jobs, limits);
  if (suspects.empty()) return result;
  auto without = searched(recordings, suspects, options, ready);
  // Free runs of the others depend on the last digits: what they made of anything is not known.
  if (without.found.unstable) return result;
  const FitModel& others = without.found.final.fit.model;

  // What was found of all of them fits the suspects and the others as well: they show more, and nothing is wrong.
  const std::vector<double> byAll = errorsByTrial(problem, found.final.fit.model, limits.iterations);
  const std::vector<double> byOthers = errorsByTrial(problem, others, limits.iterations);
  const double median = medianError(byOthers, suspects);
  if (outlying(byAll, limits).empty() &&
      meanError(byAll, suspects) <= limits.worseTogether * std::max(1.0, meanError(byOthers, suspects)))
    return result;

  for (const std::size_t trial : suspects) {
    // What the others made fits it: it only shows more of the same.
    if (std::sqrt(byOthers[trial]) <= limits.asOthers * std::sqrt(std::max(1.0, median))) continue;
    result.told.push_back(explainDisagreement(problem, trial, suspects, others, median, ready, limits));
    if (result.told.back().setAside) result.aside.push_back(trial);
  }
  if (result.aside.empty()) return result;
  if (result.aside != suspects) without = searched(recordings, result.aside, options, ready);
  if (without.found.unstable) return {};
  result.without = std::move(without);
  return result;
}

}  // namespace

Agreement agreeOn(const std::vector<Recording>& recordings, const FitProblem& problem, const SearchResult& found,
                  const SearchOptions& options, const std::function<FitProblem(const std::vector<Recording>&)>& ready) {
  Agreement result = oneRound(recordings, problem, found, options, ready);
  for (int round = 1; result.without && round < options.thresholds.trials.rounds; ++round) {
    std::vector<std::size_t> kept;  // by trial of this round: its place among all
    for (std::size_t t = 0; t < recordings.size(); ++t)
      if (std::ranges::find(result.aside, t) == result.aside.end()) kept.push_back(t);
    Agreement next =
        oneRound(leftOut(recordings, result.aside), result.without->problem, result.without->found, options, ready);
    // Those that were only named are judged anew with every round.
    std::erase_if(result.told, [](const GapReport::Disagreement& each) { return !each.setAside; });
    result.told.insert(result.told.end(), next.told.begin(), next.told.end());
    if (!next.without) break;
    for (const std::size_t trial : next.aside) result.aside.push_back(kept[trial]);
    std::ranges::sort(result.aside);
    result.without = std::move(next.without);
  }
  std::ranges::stable_sort(result.told, std::ranges::less{}, &GapReport::Disagreement::trial);
  return result;
}

std::string textOf(const std::vector<GapReport::Disagreement>& told, std::size_t trials) {
  std::string aside, named;
  std::size_t count = 0;
  for (const GapReport::Disagreement& each : told) {
    std::string& list = each.setAside ? aside : named;
    list += (list.empty() ? "" : "; ") + each.trial + ": " + each.what;
    count += each.setAside;
  }
  std::string text;
  if (count > 0)
    text += std::to_string(count) + " of " + std::to_string(trials) + " trials " +
            (count == 1 ? "was set aside, as it disagrees" : "were set aside, as they disagree") +
            " with the others (" + aside + "). ";
  if (!named.empty()) text += "Far off the others, and fitted like them (" + named + "). ";
  return text;
}

}  // namespace btr
