#include "core/gap/search/rivals/rival_handover.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/screening/screen.h"

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
struct RivalHandover::Way {
  EffectCandidate candidate;
  std::vector<double> before;  ///< numbers one step ago, in the order of the fit's model
  Fit fit;
};

/// Where the ways begin: what does best in the place of the part of effect `i` that is taken away first.
std::vector<RivalHandover::Way> RivalHandover::waysFrom(const Fit& base, const FitModel& rest, const PlacedEffect& own,
                                                        const Eligible& eligible, bool muchLeft) const {
  const SearchThresholds::Rivals& limits = service_.thresholds().rivals;
  const SearchThresholds::ShortRace& race = service_.thresholds().shortRace;
  const std::size_t handedTo = muchLeft ? race.handedTo : limits.handedTo;
  const FitProblem& problem = service_.problem();
  std::vector<EffectCandidate> candidates = service_.candidatesBeside(base.model);
  std::erase_if(candidates,
                [&](const EffectCandidate& c) { return isRicher(problem.library, c, own) || !eligible(c); });
  // Its own simpler forms are offered all of what is missing: friction of a hundredth of what was taken away is no
  // smaller friction but another motion.
  const auto isSimpler = [&](const EffectCandidate& candidate) {
    return isSimplerForm(problem.library, candidate, own);
  };
  for (EffectCandidate& candidate : candidates)
    if (!isSimpler(candidate))
      for (Values& variant : candidate.variants) variant = scaledVariant(candidate, variant, limits.small);
  std::vector<Screened> promising = screen(problem, base, linearise(problem, base), candidates, service_.options().jobs,
                                           service_.reporter("screening, rivals", candidates.size(), 0.95, 0.95),
                                           limits.of(service_.thresholds().screening));
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
      if (others == handedTo || promised(each) < leastPromise) continue;
      ++others;
    }
    const Screened::Start& start = each.starts[0];
    Way way{candidate,
            rest.with(problem, candidate.placed(scaledVariant(candidate, start.effect, 0))).values,
            {base.model.with(problem, candidate.placed(start.effect)), base.shifts, 0}};
    std::ranges::copy(start.parameters, way.fit.model.values.begin());
    ways.push_back(std::move(way));
  }
  return ways;
}

/// A simpler form of what was taken away, beside the other numbers as they are now, in the size that does best there.
/// Dry friction that stops a joint again and again is found by no fit from another size: its costs are full of steps.
FitModel RivalHandover::simplerFormOf(const Fit& full, const FitModel& rest, const EffectCandidate& candidate,
                                      bool muchLeft) const {
  const SearchThresholds::Rivals& limits = service_.thresholds().rivals;
  const SearchThresholds::ShortRace& race = service_.thresholds().shortRace;
  const double ratio = muchLeft ? race.formRatio : limits.formRatio;
  const FitProblem& problem = service_.problem();
  std::vector<Values> sizes;
  for (const Values& variant : candidate.variants)
    for (double size = limits.smallestForm; size < limits.largestForm; size *= ratio)
      sizes.push_back(scaledVariant(candidate, variant, size));
  const auto best = [&](const std::vector<Values>& of) {
    const auto costs = parallel(service_.options().jobs, of.size(), [&](std::size_t k) {
      const FitModel model = rest.with(problem, candidate.placed(of[k]));
      return std::vector<double>{residualsOf(problem, model, full.shifts).squaredNorm()};
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
  return rest.with(problem, candidate.placed(best(around)));
}

/// Fits a little, and leaves only what is near enough then.
void RivalHandover::keepInRace(std::vector<FitJob>& jobs, std::vector<EffectCandidate>& offered, double most) const {
  const auto fits = service_.tryFits(jobs, service_.thresholds().shortRace.iterations, "handing over", 0.95, 0.95);
  std::vector<FitJob> left;
  std::vector<EffectCandidate> ofLeft;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (!fits[i] || fits[i]->cost > most) continue;
    left.push_back({fits[i]->model, fits[i]->shifts});
    ofLeft.push_back(std::move(offered[i]));
  }
  jobs = std::move(left);
  offered = std::move(ofLeft);
}

std::vector<HandedOver> RivalHandover::handOver(std::size_t i, const Scored& final, const Eligible& eligible) {
  const SearchThresholds::Rivals& limits = service_.thresholds().rivals;
  const auto& kept = limits.kept;
  const FitProblem& problem = service_.problem();
  const Fit& whole = final.fit;
  PlacedEffect own = whole.model.effects[i];
  own.parameters = whole.model.simulator(problem).effects[problem.given.effects.size() + i].parameters;
  const FitModel rest = whole.model.without(i);
  const auto effect = problem.library.make(own.effect);
  const auto keeping = [&](double share) {
    if (share == 0) return rest;
    return rest.withFixed(problem, {own.effect, own.at, reduced(*effect, own.parameters, share)});
  };
  const StepGuard coarse = service_.guardStep(service_.stepToSearchWith(whole));
  const double finalCost = residualsOf(problem, whole.model, whole.shifts).squaredNorm() / 2;
  const SearchThresholds::ShortRace& race = service_.thresholds().shortRace;
  const bool muchLeft = race.isRun(final.mean());
  const int iterations = muchLeft ? race.wayIterations : limits.wayIterations;
  const double onTheWay = finalCost * (muchLeft ? race.valley : limits.valley);
  const double atItsEnd = finalCost * (muchLeft ? race.valleyEnd : limits.valleyEnd);

  std::vector<Way> ways = waysFrom({keeping(kept[0]), whole.shifts, 0}, rest, own, eligible, muchLeft);
  for (std::size_t k = 0; k < kept.size() && !ways.empty(); ++k) {
    // Straight on from the last two steps.
    const double on = k == 0 ? 0 : (kept[k - 1] - kept[k]) / ((k == 1 ? 1 : kept[k - 2]) - kept[k - 1]);
    std::vector<FitJob> jobs;
    for (Way& way : ways) {
      const std::vector<double>& here = way.fit.model.values;
      FitModel next = keeping(kept[k]).with(problem, way.candidate.placed(way.fit.model.effects.back().parameters));
      for (std::size_t n = 0; n < next.values.size(); ++n)
        next.values[n] = std::clamp(here[n] + on * (here[n] - way.before[n]), next.parameters[n].minimum,
                                    next.parameters[n].maximum);
      if (k > 0) way.before = here;
      jobs.push_back({next, way.fit.shifts, nullptr, limits.wayTolerance});
    }
    const auto fits = service_.tryFits(jobs, iterations, "handing over", 0.95, 0.95);
    const double most = kept[k] > 0 ? onTheWay : atItsEnd;
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
  for (const EffectCandidate& candidate : service_.candidatesBeside(rest)) {
    if (!isSimplerForm(problem.library, candidate, own) || !eligible(candidate) || candidate.variants.empty()) continue;
    offered.push_back(candidate);
    jobs.push_back({simplerFormOf(whole, rest, candidate, muchLeft), whole.shifts});
  }
  if (muchLeft) keepInRace(jobs, offered, atItsEnd);
  std::vector<Fit> arrived;
  std::vector<const EffectCandidate*> ofArrived;
  const auto fits = service_.tryFits(jobs, service_.thresholds().calibration.toTheEnd, "handing over", 0.95, 0.95);
  for (std::size_t w = 0; w < offered.size(); ++w) {
    if (!fits[w]) continue;
    arrived.push_back(*fits[w]);
    ofArrived.push_back(&offered[w]);
  }
  std::vector<HandedOver> handedOver;
  const auto scored = service_.tryScores(arrived, "handing over", 0.95, 0.95);
  for (std::size_t w = 0; w < scored.size(); ++w)
    if (scored[w]) handedOver.push_back({*ofArrived[w], *scored[w]});
  return handedOver;
}

}  // namespace btr
