// From all effects at all places to the few that are fitted to the end.
#include <algorithm>
#include <cmath>

#include "core/gap/search_run.h"

namespace btr {
namespace {

constexpr int firstIterations = 4, lastIterations = 15;
constexpr double hopeless = 2;
constexpr std::size_t candidatesInPairs = 4;

std::string percent(double share) { return toText(std::round(1000 * share) / 10) + " %"; }

}  // namespace

std::vector<SearchRun::Tried> SearchRun::tryCandidates(const Fit& base, const Linearised& linear, std::size_t toFit,
                                                 const std::string& stage, double from, double to) {
  const std::vector<EffectCandidate> candidates = candidatesFor(problem_, base.model, options_.names);
  const double part = (to - from) / 3;
  const std::vector<Screened> screened = screen(problem_, base, linear, candidates, options_.jobs,
                                                reporter("screening" + stage, candidates.size(), from, from + part));
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < screened.size(); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return screened[a].share > screened[b].share; });

  std::vector<Tried> tried;
  for (const std::size_t i : order) {
    Tried each;
    each.attempt.candidate = candidates[i];
    each.attempt.share = screened[i].share;
    each.attempt.excited = screened[i].excited;
    each.attempt.rank = static_cast<int>(tried.size()) + 1;
    each.fit.cost = INFINITY;
    if (!screened[i].starts.empty()) each.attempt.values = screened[i].starts[0].effect;
    if (!each.attempt.excited)
      each.attempt.reason = "the recordings do not feel it at a typical size";
    else
      each.attempt.reason = "screening: would take away " + toText(std::round(1000 * each.attempt.share) / 10) +
                            " % of the squared error, others more";
    tried.push_back(std::move(each));
  }

  // One start each of the most promising, a second one of the best of them.
  const auto fitStarts = [&](const std::vector<std::size_t>& which, std::size_t start, double begin, double end) {
    std::vector<FitModel> models;
    std::vector<std::size_t> owner;
    for (const std::size_t k : which) {
      const Screened& of = screened[order[k]];
      if (start >= of.starts.size()) continue;
      FitModel model = base.model.with(problem_, tried[k].attempt.candidate.placed(of.starts[start].effect));
      std::copy(of.starts[start].parameters.begin(), of.starts[start].parameters.end(), model.values.begin());
      models.push_back(model);
      owner.push_back(k);
    }
    const std::vector<Fit> fits =
        fitAll(models, base.shifts, firstIterations, "fitting candidates" + stage, begin, end, &linear);
    for (std::size_t i = 0; i < fits.size(); ++i)
      if (fits[i].cost < tried[owner[i]].fit.cost) {
        tried[owner[i]].fit = fits[i];
        tried[owner[i]].attempt.fitted = true;
      }
  };
  std::vector<std::size_t> promising;
  for (std::size_t k = 0; k < tried.size() && promising.size() < toFit; ++k)
    if (screened[order[k]].excited && !screened[order[k]].starts.empty() &&
        screened[order[k]].share >= std::max(0.7 * leastGain, 0.1 * screened[order[0]].share))
      promising.push_back(k);
  fitStarts(promising, 0, from + part, from + 1.6 * part);
  std::stable_sort(promising.begin(), promising.end(),
                   [&](std::size_t a, std::size_t b) { return tried[a].fit.cost < tried[b].fit.cost; });
  if (promising.size() > toFit / 2) promising.resize(toFit / 2);
  fitStarts(promising, 1, from + 1.6 * part, from + 2 * part);
  std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) { return a.fit.cost < b.fit.cost; });

  // The best are fitted to the end, then judged on what they were not fitted to.
  std::vector<Fit> best;
  for (std::size_t k = 0; k < std::min(toFit / 2, tried.size()); ++k)
    // What fits far worse than the best after the first iterations is no rival.
    if (tried[k].attempt.fitted && tried[k].fit.cost <= hopeless * tried[0].fit.cost) best.push_back(tried[k].fit);
  best = polish(best, lastIterations, stage, from + 2 * part, to - part / 2);
  // Effects may need finer steps than the simulator without them: friction at reversals, play.
  while (!best.empty() && problem_.scene.step_s > finest_s_ &&
         std::any_of(best.begin(), best.begin() + std::min<std::ptrdiff_t>(2, std::ssize(best)),
                     [&](const Fit& fit) { return needsFinerStep(fit); })) {
    problem_.scene.step_s /= 2;
    best = polish(best, againIterations, stage, to - part / 2, to - part / 2);
  }
  const std::vector<Scored> scored = scoreAll(best, "confirming" + stage, to - part / 2, to);
  for (std::size_t i = 0; i < scored.size(); ++i) {
    tried[i].fit = best[i];
    tried[i].scored = scored[i];
    tried[i].attempt.scored = true;
  }
  for (Tried& each : tried) {
    if (!each.attempt.fitted) continue;
    each.attempt.values = each.fit.model.simulator(problem_).effects.back().parameters;
  }
  std::stable_sort(tried.begin(), tried.begin() + static_cast<std::ptrdiff_t>(scored.size()),
                   [](const Tried& a, const Tried& b) { return a.scored.mean() < b.scored.mean(); });
  return tried;
}

bool SearchRun::passes(const Scored& without, const Scored& with, std::size_t newEffect, Comparison& comparison,
                    std::string& reason) const {
  comparison = compare(without.blocks, with.blocks);
  const double excess = excessOf(without);
  const double taken = without.mean() - with.mean();
  if (comparison.t < leastT) {
    reason = "not better on held-out blocks (t = " + toText(std::round(10 * comparison.t) / 10) + ")";
    return false;
  }
  if (comparison.gain < leastGain) {
    reason = "takes only " + percent(comparison.gain) + " of the held-out squared error";
    return false;
  }
  if (excess <= 0 || taken < leastShareOfExcess * excess) {
    reason = "takes only " + percent(excess > 0 ? taken / excess : 0) + " of the excess error";
    return false;
  }
  const double errors = with.sizes.at(newEffect);
  if (errors < leastErrors) {
    reason = "its size is only " + toText(std::round(10 * errors) / 10) + " standard errors";
    return false;
  }
  reason = "takes " + percent(comparison.gain) +
           " of the held-out squared error (t = " + toText(std::round(10 * comparison.t) / 10) + ")";
  return true;
}

bool SearchRun::tryPair(const Scored& current, const std::vector<Tried>& singles, Scored& pair) {
  bool found = false;
  for (std::size_t k = 0; k < std::min<std::size_t>(2, singles.size()); ++k) {
    if (!singles[k].attempt.scored) continue;
    const Linearised linear = linearise(problem_, singles[k].fit);
    const auto seconds = tryCandidates(singles[k].fit, linear, candidatesInPairs, ", in pairs", 0.5, 0.6);
    if (seconds.empty() || !seconds[0].attempt.scored) continue;
    Comparison comparison;
    std::string reason;
    // Each of the two must be worth it beside the other, and both together.
    if (!passes(singles[k].scored, seconds[0].scored, seconds[0].fit.model.effects.size() - 1, comparison, reason))
      continue;
    if (!passes(current, seconds[0].scored, seconds[0].fit.model.effects.size() - 2, comparison, reason)) continue;
    if (!found || seconds[0].scored.mean() < pair.mean()) pair = seconds[0].scored;
    found = true;
  }
  return found;
}

}  // namespace btr
