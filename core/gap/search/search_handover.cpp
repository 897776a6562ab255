// Rivals that no screening sees: an effect hands its place over to another one bit by bit. What the recordings do not
// tell from each other lies at the two ends of one valley; from afar, a fit of the other end finds some hill between.
#include <algorithm>
#include <array>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/screen.h"
#include "core/gap/search/search_run.h"

namespace btr {
namespace {

/// The numbers of an effect with its sizes reduced to a share of what they are above neutral.
Values reduced(const Effect& effect, Values numbers, double share) {
  for (const Parameter& p : effect.parameters())
    if (p.neutral && !p.integer) numbers[p.name] = *p.neutral + share * (numbers.at(p.name) - *p.neutral);
  return numbers;
}

}  // namespace

/// Of another effect: the fit beside what is kept of the first one.
struct SearchRun::Way {
  EffectCandidate candidate;
  std::vector<double> before;  ///< numbers one step ago, in the order of the fit's model
  Fit fit;
};

/// Where the ways begin: what does best in the place of the part of effect `i` that is taken away first.
std::vector<SearchRun::Way> SearchRun::waysFrom(const Fit& base, const FitModel& rest, const PlacedEffect& own) const {
  const SearchThresholds::Rivals& limits = this->limits().rivals;
  std::vector<EffectCandidate> candidates =
      candidatesFor(problem_, base.model, options_.names, options_.thresholds.candidates);
  std::erase_if(candidates, [&](const EffectCandidate& c) { return isRicher(c, own); });
  // Its own simpler forms are offered all of what is missing: friction of a hundredth of what was taken away is no
  // smaller friction but another motion.
  const EffectCandidate whole{own.effect, own.at, {}, {}};
  const auto isSimpler = [&](const EffectCandidate& candidate) { return isRicher(whole, candidate.placed({})); };
  for (EffectCandidate& candidate : candidates)
    if (!isSimpler(candidate))
      for (Values& variant : candidate.variants) variant = scaledVariant(candidate, variant, limits.small);
  std::vector<Screened> promising =
      screen(problem_, base, linearise(problem_, base), candidates, options_.jobs,
             reporter("screening, rivals", candidates.size(), 0.95, 0.95), options_.thresholds.screening);
  std::erase_if(promising, [](const Screened& each) { return each.starts.empty(); });
  const auto promised = [](const Screened& each) { return each.starts[0].share; };
  std::ranges::stable_sort(promising, std::greater(), promised);

  std::vector<Way> ways;
  std::size_t others = 0;
  double leastPromise = 0;
  for (const Screened& each : promising) {
    const EffectCandidate& candidate = candidates[each.candidate];
    if (!isSimpler(candidate)) {
      if (others == 0) leastPromise = limits.leastPromise * promised(each);
      if (others == limits.handedTo || promised(each) < leastPromise) continue;
      ++others;
    }
    const Screened::Start& start = each.starts[0];
    Way way{candidate,
            rest.with(problem_, candidate.placed(scaledVariant(candidate, start.effect, 0))).values,
            {base.model.with(problem_, candidate.placed(start.effect)), base.shifts, 0}};
    std::ranges::copy(start.parameters, way.fit.model.values.begin());
    ways.push_back(std::move(way));
  }
  return ways;
}

/// A simpler form of what was taken away, beside the other numbers as they are now, in the size that does best there.
/// Dry friction that stops a joint again and again is found by no fit from another size: its costs are full of steps.
FitModel SearchRun::simplerFormOf(const Fit& full, const FitModel& rest, const EffectCandidate& candidate) const {
  const SearchThresholds::Rivals& limits = this->limits().rivals;
  std::vector<Values> sizes;
  for (const Values& variant : candidate.variants)
    for (double size = limits.smallestForm; size < limits.largestForm; size *= limits.formRatio)
      sizes.push_back(scaledVariant(candidate, variant, size));
  const auto best = [&](const std::vector<Values>& of) {
    const auto costs = parallel(options_.jobs, of.size(), [&](std::size_t k) {
      const FitModel model = rest.with(problem_, candidate.placed(of[k]));
      return std::vector<double>{residualsOf(problem_, model, full.shifts).squaredNorm()};
    });
    // What cannot be simulated has no cost.
    const auto costsLess = [](const JobResult& a, const JobResult& b) {
      return a.ok() && (!b.ok() || a.numbers[0] < b.numbers[0]);
    };
    return of[static_cast<std::size_t>(std::ranges::min_element(costs, costsLess) - costs.begin())];
  };
  const Values found = best(sizes);
  std::vector<Values> around{found};
  for (const double size : limits.formCloser) around.push_back(scaledVariant(candidate, found, size));
  return rest.with(problem_, candidate.placed(best(around)));
}

void SearchRun::handOver(std::size_t i, const SearchResult& result, std::vector<Tried>& others) {
  const SearchThresholds::Rivals& limits = this->limits().rivals;
  const auto& kept = limits.kept;
  const Fit& whole = result.final.fit;
  PlacedEffect own = whole.model.effects[i];
  own.parameters = whole.model.simulator(problem_).effects[problem_.given.effects.size() + i].parameters;
  const FitModel rest = whole.model.without(i);
  const auto effect = problem_.library.make(own.effect);
  const auto keeping = [&](double share) {
    if (share == 0) return rest;
    return rest.withFixed(problem_, {own.effect, own.at, reduced(*effect, own.parameters, share)});
  };
  const double judged_s = problem_.scene.step_s;
  problem_.scene.step_s = stepToSearchWith(whole);
  const double finalCost = residualsOf(problem_, whole.model, whole.shifts).squaredNorm() / 2;

  std::vector<Way> ways = waysFrom({keeping(kept[0]), whole.shifts, 0}, rest, own);
  for (std::size_t k = 0; k < kept.size() && !ways.empty(); ++k) {
    // Straight on from the last two steps.
    const double on = k == 0 ? 0 : (kept[k - 1] - kept[k]) / ((k == 1 ? 1 : kept[k - 2]) - kept[k - 1]);
    std::vector<FitJob> jobs;
    for (Way& way : ways) {
      const std::vector<double>& here = way.fit.model.values;
      FitModel next = keeping(kept[k]).with(problem_, way.candidate.placed(way.fit.model.effects.back().parameters));
      for (std::size_t n = 0; n < next.values.size(); ++n)
        next.values[n] = std::clamp(here[n] + on * (here[n] - way.before[n]), next.parameters[n].minimum,
                                    next.parameters[n].maximum);
      if (k > 0) way.before = here;
      jobs.push_back({next, way.fit.shifts, nullptr, limits.wayTolerance});
    }
    const auto fits = tryFits(jobs, limits.wayIterations, "handing over", 0.95, 0.95);
    const double most = (kept[k] > 0 ? limits.valley : limits.valleyEnd) * finalCost;
    std::vector<Way> goOn;
    for (std::size_t w = 0; w < ways.size(); ++w) {
      if (!fits[w] || fits[w]->cost > most) continue;
      ways[w].fit = *fits[w];
      goOn.push_back(std::move(ways[w]));
    }
    ways = std::move(goOn);
  }
  std::vector<EffectCandidate> offered;
  std::vector<FitJob> jobs;
  for (const Way& way : ways) {
    offered.push_back(way.candidate);
    jobs.push_back({way.fit.model, way.fit.shifts});
  }
  for (const EffectCandidate& candidate :
       candidatesFor(problem_, rest, options_.names, options_.thresholds.candidates)) {
    if (!isRicher({own.effect, own.at, {}, {}}, candidate.placed({})) || candidate.variants.empty()) continue;
    offered.push_back(candidate);
    jobs.push_back({simplerFormOf(whole, rest, candidate), whole.shifts});
  }
  std::vector<Fit> arrived;
  std::vector<const EffectCandidate*> ofArrived;
  const auto fits = tryFits(jobs, options_.thresholds.calibration.toTheEnd, "handing over", 0.95, 0.95);
  for (std::size_t w = 0; w < offered.size(); ++w) {
    if (!fits[w]) continue;
    arrived.push_back(*fits[w]);
    ofArrived.push_back(&offered[w]);
  }
  const auto scored = tryScores(arrived, "handing over", 0.95, 0.95);
  for (std::size_t w = 0; w < scored.size(); ++w)
    if (scored[w]) addRival(*ofArrived[w], *scored[w], result, others);
  problem_.scene.step_s = judged_s;
}

void SearchRun::addRival(const EffectCandidate& candidate, const Scored& scored, const SearchResult& result,
                         std::vector<Tried>& others) const {
  auto known = std::ranges::find(others, candidate.text(), [](const Tried& t) { return t.attempt.candidate.text(); });
  if (known == others.end()) {
    others.push_back({});
    known = others.end() - 1;
    known->attempt.candidate = candidate;
  } else if (known->attempt.scored && known->scored.mean() <= scored.mean()) {
    return;
  }
  known->attempt.fitted = known->attempt.scored = true;
  known->attempt.comparison = compare(result.calibrated.blocks, scored.blocks);
  known->scored = scored;
  known->fit = scored.fit;
  known->attempt.values = scored.fit.model.simulator(problem_).effects.back().parameters;
}

}  // namespace btr
