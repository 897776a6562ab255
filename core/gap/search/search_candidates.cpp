// From all effects at all places to the few that are fitted to the end.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/search/screen.h"
#include "core/gap/search/search_run.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

/// Where the fit of a candidate may begin.
struct FitStart {
  const Screened::Start* from;
  std::size_t base;
  double left;  ///< squared error that it promises to leave
};

/// A model that candidates are added to.
struct Base {
  Fit fit;
  Linearised linear;
};

/// What a candidate promises from all bases together.
struct Promise {
  bool excited = false, refused = false;
  double share = 0;  ///< of the first base's squared error
  std::vector<FitStart> starts;
};

std::vector<Promise> promisesOf(const std::vector<EffectCandidate>& candidates,
                                const std::vector<std::vector<Screened>>& screened, const std::vector<double>& totals) {
  std::vector<Promise> promises(screened[0].size());
  for (std::size_t c = 0; c < promises.size(); ++c) {
    Promise& promise = promises[c];
    std::vector<FitStart> later;
    for (std::size_t b = 0; b < screened.size(); ++b) {
      const Screened& of = screened[b][c];
      promise.excited = promise.excited || of.excited;
      promise.refused = promise.refused || of.refused > 0;
      if (totals[0] > 0) promise.share = std::max(promise.share, 1 - totals[b] * (1 - of.share) / totals[0]);
      for (const Screened::Start& start : of.starts)
        (&start == of.starts.data() ? promise.starts : later).push_back({&start, b, totals[b] * (1 - start.share)});
    }
    // The best that was looked at from each base, then what else was promised.
    for (std::vector<FitStart>* list : {&promise.starts, &later})
      std::stable_sort(list->begin(), list->end(),
                       [](const FitStart& a, const FitStart& b) { return a.left < b.left; });
    promise.starts.insert(promise.starts.end(), later.begin(), later.end());
    // No fit gets from one whole number to another: the second start has another one.
    const auto other = std::find_if(promise.starts.begin(), promise.starts.end(), [&](const FitStart& start) {
      return std::any_of(candidates[c].declared.begin(), candidates[c].declared.end(), [&](const Parameter& p) {
        return p.integer && start.from->effect.at(p.name) != promise.starts[0].from->effect.at(p.name);
      });
    });
    if (other != promise.starts.end()) std::rotate(promise.starts.begin() + 1, other, other + 1);
  }
  return promises;
}

}  // namespace

std::vector<SearchRun::Tried> SearchRun::tryCandidates(Scored& without, const std::vector<Fit>& models,
                                                       const Linearised* known, std::size_t toFit,
                                                       const std::string& stage, double from, double to,
                                                       bool lastChance) {
  const SearchThresholds::Screening& limits = this->limits().screening;
  const double part = (to - from) / 3;
  const double judged_s = problem_.scene.step_s;
  problem_.scene.step_s = stepToSearchWith(models[0]);
  std::vector<Base> bases;
  for (const Fit& fit : models)
    bases.push_back(
        {fit, known && bases.empty() && problem_.scene.step_s == judged_s ? *known : linearise(problem_, fit)});
  const std::vector<EffectCandidate> candidates =
      candidatesFor(problem_, bases[0].fit.model, options_.names, options_.thresholds.candidates);
  std::vector<std::vector<Screened>> screened;
  std::vector<double> totals;
  for (const Base& base : bases) {
    const double begin = from + part * static_cast<double>(screened.size()) / static_cast<double>(bases.size());
    screened.push_back(screen(
        problem_, base.fit, base.linear, candidates, options_.jobs,
        reporter("screening" + stage, candidates.size(), begin, begin + part / static_cast<double>(bases.size())),
        limits));
    totals.push_back(base.linear.profiled.squaredNorm());
  }
  const std::vector<Promise> promises = promisesOf(candidates, screened, totals);
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return promises[a].share > promises[b].share; });

  std::vector<Tried> tried;
  for (const std::size_t i : order) {
    Tried each;
    each.promise = i;
    each.attempt.candidate = candidates[i];
    each.attempt.share = promises[i].share;
    each.attempt.excited = promises[i].excited;
    each.attempt.rank = static_cast<int>(tried.size()) + 1;
    if (!promises[i].starts.empty()) each.attempt.values = promises[i].starts[0].from->effect;
    if (!each.attempt.excited)
      each.attempt.reason = promises[i].refused ? "the scene refuses it at the sizes that were tried"
                                                : "the recordings do not feel it at a typical size";
    else
      each.attempt.reason =
          "screening: would take away " + percent(each.attempt.share) + " of the squared error, others more";
    tried.push_back(std::move(each));
  }

  // One start each of the most promising, a second one of the best of them.
  const auto fitStarts = [&](const std::vector<std::size_t>& which, std::size_t start, double begin, double end) {
    std::vector<FitJob> jobs;
    std::vector<std::size_t> owner;
    for (const std::size_t k : which) {
      const Promise& promise = promises[tried[k].promise];
      if (start >= promise.starts.size()) continue;
      const FitStart& at = promise.starts[start];
      const Base& base = bases[at.base];
      FitModel model = base.fit.model.with(problem_, tried[k].attempt.candidate.placed(at.from->effect));
      std::copy(at.from->parameters.begin(), at.from->parameters.end(), model.values.begin());
      jobs.push_back({model, base.fit.shifts, &base.linear});
      owner.push_back(k);
    }
    const auto fits = tryFits(jobs, limits.iterations, "fitting candidates" + stage, begin, end);
    for (std::size_t i = 0; i < fits.size(); ++i) {
      Tried& each = tried[owner[i]];
      if (!fits[i]) {
        if (!each.attempt.fitted) each.attempt.reason = "the scene refuses the numbers of its fit";
      } else if (!each.attempt.fitted || fits[i]->cost < each.fit.cost) {
        each.fit = *fits[i];
        each.attempt.fitted = true;
      }
    }
  };
  // What has no fit comes last.
  const auto isBetter = [](const Tried& a, const Tried& b) {
    if (a.attempt.fitted != b.attempt.fitted) return a.attempt.fitted;
    return a.attempt.fitted && costsLess(a.fit, b.fit);
  };
  const auto fitsBetter = [&](std::size_t a, std::size_t b) { return isBetter(tried[a], tried[b]); };
  std::vector<std::size_t> promising;
  for (std::size_t k = 0; k < tried.size() && promising.size() < toFit; ++k)
    if (!promises[tried[k].promise].starts.empty() &&
        tried[k].attempt.share >= std::max(limits.leastOfGain * options_.thresholds.confirmation.leastGain,
                                           limits.leastOfBest * tried[0].attempt.share))
      promising.push_back(k);
  fitStarts(promising, 0, from + part, from + 1.6 * part);
  std::stable_sort(promising.begin(), promising.end(), fitsBetter);
  // The better half once more from elsewhere, and the simpler effects that they contain.
  const auto isContained = [&](std::size_t k, const std::vector<std::size_t>& in) {
    return std::any_of(in.begin(), in.end(), [&](std::size_t of) {
      return isRicher(tried[of].attempt.candidate, tried[k].attempt.candidate.placed({}));
    });
  };
  std::vector<std::size_t> again = promising;
  if (again.size() > toFit / 2) again.resize(toFit / 2);
  for (std::size_t k = again.size(); k < promising.size(); ++k)
    if (isContained(promising[k], again)) again.push_back(promising[k]);
  fitStarts(again, 1, from + 1.6 * part, from + 2 * part);
  std::erase_if(promising, [&](std::size_t k) { return !tried[k].attempt.fitted; });
  const auto leastCost = [&] {
    double least = INFINITY;
    for (const std::size_t k : promising) least = std::min(least, tried[k].fit.cost);
    return least;
  };
  const double least = leastCost();
  for (const std::size_t k : promising)
    if (tried[k].fit.cost <= limits.inReach * least)
      fitFromWindows(tried[k].fit, bases[0].fit.model, "fitting candidates" + stage, from + 2 * part);
  if (2 * leastCost() > options_.thresholds.drawnEffects.leastLeft * static_cast<double>(problem_.residuals()))
    fitFromScatter(tried, promising, models, "fitting candidates" + stage, from + 2 * part);
  std::stable_sort(tried.begin(), tried.end(), isBetter);

  for (Tried& each : tried)
    if (each.attempt.fitted && each.fit.cost > tried[0].fit.cost)
      each.attempt.reason = "fitted: leaves " + digits(each.fit.cost / tried[0].fit.cost, 2) +
                            " times the squared error that " + tried[0].attempt.candidate.text() + " leaves";

  // The best are fitted to the end and judged on what they were not fitted to, with the simpler effects that they
  // contain; if none of them will do, the next ones.
  std::vector<std::size_t> best, next;
  for (std::size_t k = 0; k < tried.size() && tried[k].attempt.fitted; ++k)
    // What fits far worse than the best after the first iterations is no rival.
    (best.size() < toFit / 2 && tried[k].fit.cost <= limits.hopeless * tried[0].fit.cost ? best : next).push_back(k);
  std::erase_if(next, [&](std::size_t k) {
    const bool contained = isContained(k, best);
    if (contained) best.push_back(k);
    return contained;
  });
  bool any = confirm(tried, best, without, judged_s, stage, from + 2 * part, to) ||
             confirm(tried, next, without, judged_s, stage, to, to);
  // Screening is linear: far from the truth it may rank low what is missing. Before nothing is said to help, the others
  // are fitted too.
  if (!any && lastChance && excessOf(without) > limits.lastChanceExcess) {
    std::vector<std::size_t> rest;
    for (const Tried& each : tried)
      if (!each.attempt.fitted && !promises[each.promise].starts.empty() &&
          each.attempt.share >= limits.lastChancePromise && rest.size() < limits.lastChance)
        rest.push_back(static_cast<std::size_t>(&each - tried.data()));
    for (const std::size_t start : {0, 1}) fitStarts(rest, start, to, to);
    std::erase_if(rest, [&](std::size_t k) { return !tried[k].attempt.fitted; });
    std::stable_sort(rest.begin(), rest.end(), fitsBetter);
    if (rest.size() > limits.lastChanceConfirmed) rest.resize(limits.lastChanceConfirmed);
    any = confirm(tried, rest, without, judged_s, stage, to, to);
  }
  if (!any) problem_.scene.step_s = judged_s;
  for (Tried& each : tried)
    if (each.attempt.fitted) each.attempt.values = each.fit.model.simulator(problem_).effects.back().parameters;
  std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) {
    if (a.attempt.scored != b.attempt.scored) return a.attempt.scored;
    return a.attempt.scored && a.scored.mean() < b.scored.mean();
  });
  return tried;
}

bool SearchRun::tryPair(const Scored& current, const std::vector<Tried>& singles, Scored& pair) {
  bool found = false;
  const double step_s = problem_.scene.step_s;
  double pair_s = step_s;
  for (std::size_t k = 0; k < std::min(limits().screening.pairFirsts, singles.size()); ++k) {
    if (!singles[k].attempt.scored) continue;
    problem_.scene.step_s = step_s;
    Scored single = singles[k].scored, neither = current;
    bringToStep(single, "in pairs", 0.5);
    const auto seconds =
        tryCandidates(single, {single.fit}, nullptr, limits().screening.fittedInPairs, ", in pairs", 0.5, 0.6);
    if (seconds.empty() || !seconds[0].attempt.scored || seconds[0].attempt.qValue > limits().confirmation.mostFalse)
      continue;
    PairedTest comparison;
    std::string reason;
    // Each of the two must be worth it beside the other, and both together.
    if (!passes(single, seconds[0].scored, seconds[0].fit.model.effects.size() - 1, comparison, reason)) continue;
    bringToStep(neither, "in pairs", 0.6);
    if (!passes(neither, seconds[0].scored, seconds[0].fit.model.effects.size() - 2, comparison, reason)) continue;
    if (found && seconds[0].scored.mean() >= pair.mean()) continue;
    pair = seconds[0].scored;
    pair_s = problem_.scene.step_s;
    found = true;
  }
  problem_.scene.step_s = pair_s;
  return found;
}

void SearchRun::acceptPair(SearchResult& result, const Scored& pair, const std::string& what) {
  const auto& effects = pair.fit.model.effects;
  std::string both;
  for (std::size_t i = effects.size() - 2; i < effects.size(); ++i) {
    both += (both.empty() ? "" : " and ") + effects[i].text();
    conclude(result.attempts, effects[i].text(), true, "needed together with another");
  }
  result.final = pair;
  result.ladder.push_back(step(what + both, result.final));
}

// A flexible effect alone (a payload of any place beside a servo of any strength) takes up most of what two others do,
// and bends the numbers so far that neither of them is found beside it any more.
bool SearchRun::chooseTwoOthers(SearchResult& result, const Choice& choice) {
  if (excessOf(result.final) < limits().screening.doubtfulExcess || !promisesAPair(choice.others)) return false;
  Scored pair;
  const double step_s = problem_.scene.step_s;
  if (!tryPair(choice.without, choice.others, pair)) return false;
  Scored single = result.final;
  bringToStep(single, "in pairs", 0.6);
  const PairedTest gained = compare(single.blocks, pair.blocks);
  if (gained.t < limits().confirmation.leastT || gained.gain < limits().confirmation.leastGain) {
    problem_.scene.step_s = step_s;
    return false;
  }
  conclude(result.attempts, choice.accepted, false, "two others together do better");
  acceptPair(result, pair, choice.accepted + " → ");
  return true;
}

}  // namespace btr
