#include "core/gap/search/siblings.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/search/screening/candidates.h"
#include "core/gap/search/screening/screen.h"
#include "core/sim/effect_places.h"

namespace btr {
namespace {

constexpr const char* atOthers = "at the other joints";

bool isAtAJoint(const EffectLibrary& library, const PlacedEffect& effect) {
  return library.make(effect.effect)->place() == Effect::Place::joint && effect.at != everyJointOf(ownerOf(effect.at));
}

/// What names a finding: where effects are counted one by one, their place as well.
std::string findingOf(const EffectLibrary& library, const PlacedEffect& effect) {
  return isAtAJoint(library, effect) ? effect.effect + " of " + ownerOf(effect.at) : effect.text();
}

/// The effect at the joints that have it not yet.
std::vector<EffectCandidate> elsewhere(const FitService& service, const FitModel& model, const PlacedEffect& own) {
  std::vector<EffectCandidate> candidates = service.candidatesBeside(model, {own.effect});
  std::erase_if(candidates, [&](const EffectCandidate& candidate) {
    const PlacedEffect there = candidate.placed({});
    return ownerOf(there.at) != ownerOf(own.at) || !isAtAJoint(service.problem().library, there);
  });
  return candidates;
}

/// All that promise something beside the model: with the sizes that they promise, and with those found where they were.
std::vector<FitJob> withPromising(const FitService& service, const Fit& base, const PlacedEffect& own,
                                  const std::vector<EffectCandidate>& candidates) {
  const FitProblem& problem = service.problem();
  const SearchThresholds& limits = service.thresholds();
  if (candidates.empty()) return {};
  const std::vector<Screened> screened =
      screen(problem, base, linearise(problem, base), candidates, service.options().jobs,
             service.reporter(atOthers, candidates.size(), 0.8, 0.8), limits.screening);
  FitModel promised = base.model, same = base.model;
  for (const Screened& each : screened) {
    if (each.starts.empty() || each.share < limits.screening.leastOfGain * limits.confirmation.leastGain) continue;
    const EffectCandidate& candidate = candidates[each.candidate];
    promised = promised.with(problem, candidate.placed(each.starts[0].effect));
    same = same.with(problem, candidate.placed(own.parameters));
  }
  if (promised.effects.size() == base.model.effects.size()) return {};
  return {{std::move(promised), base.shifts}, {std::move(same), base.shifts}};
}

/// The best of some fits, scored, without the effects from `first` on whose size is not known; nothing if none is left.
std::optional<Scored> prunedBest(const FitService& service, std::vector<FitJob> jobs, std::size_t first) {
  const SearchThresholds& limits = service.thresholds();
  while (true) {
    const std::vector<Fit> fits = completed(service.tryFits(jobs, limits.calibration.toTheEnd, atOthers, 0.8, 0.8));
    if (fits.empty()) return std::nullopt;
    const Fit& best = *std::ranges::min_element(fits, costsLess);
    auto scored = service.tryScores({best}, atOthers, 0.8, 0.8)[0];
    if (!scored) return std::nullopt;
    FitModel left = best.model;
    for (std::size_t i = left.effects.size(); i-- > first;)
      if (scored->sizes.at(i) < limits.confirmation.leastErrors) left = left.without(i);
    if (left.effects.size() == best.model.effects.size()) return scored;
    if (left.effects.size() == first) return std::nullopt;
    jobs = {{std::move(left), best.shifts}};
  }
}

}  // namespace

std::size_t findingsIn(const EffectLibrary& library, const std::vector<PlacedEffect>& effects) {
  std::set<std::string> findings;
  for (const PlacedEffect& effect : effects) findings.insert(findingOf(library, effect));
  return findings.size();
}

std::vector<std::size_t> siblingsOf(const EffectLibrary& library, const std::vector<PlacedEffect>& effects,
                                    std::size_t i) {
  std::vector<std::size_t> siblings;
  for (std::size_t k = 0; k < effects.size(); ++k)
    if (k != i && findingOf(library, effects[k]) == findingOf(library, effects[i])) siblings.push_back(k);
  return siblings;
}

bool isSibling(const EffectLibrary& library, const std::vector<PlacedEffect>& effects, std::size_t i) {
  const std::vector<std::size_t> siblings = siblingsOf(library, effects, i);
  return !siblings.empty() && siblings.front() < i;
}

void addSiblings(const FitService& service, const Confirmer& confirmer, Selection& selection, std::size_t i) {
  const FitProblem& problem = service.problem();
  if (problem.walks) return;
  while (isAtAJoint(problem.library, selection.final.fit.model.effects.at(i))) {
    const Fit base = selection.final.fit;
    const std::size_t first = base.model.effects.size();
    const PlacedEffect own = base.model.fittedEffect(problem, i);
    const std::vector<EffectCandidate> candidates = elsewhere(service, base.model, own);
    const std::vector<FitJob> jobs = withPromising(service, base, own, candidates);
    if (jobs.empty()) return;
    const std::optional<Scored> with = prunedBest(service, jobs, first);
    if (!with) return;
    const Acceptance acceptance = confirmer.judge(selection.final, *with, first);
    if (!acceptance.passes) return;
    std::string where;
    for (std::size_t k = first; k < with->fit.model.effects.size(); ++k) {
      const PlacedEffect& sibling = with->fit.model.effects[k];
      where += (where.empty() ? "" : ", ") + sibling.at;
      selection.remember(accepted(*std::ranges::find(candidates, sibling.at, &EffectCandidate::at), problem,
                                  with->fit.model, k, acceptance.comparison,
                                  "as at " + own.at + "; all of these " + acceptance.reason));
    }
    selection.take(*with, "+ " + own.effect + " at " + where);
  }
}

void replaceSiblings(const FitService& service, Selection& selection, const PlacedEffect& replaced) {
  const FitProblem& problem = service.problem();
  const Fit& fit = selection.final.fit;
  const PlacedEffect taker = fit.model.fittedEffect(problem, fit.model.effects.size() - 1);
  if (taker.at != replaced.at || !isAtAJoint(problem.library, taker) || !isAtAJoint(problem.library, replaced)) return;
  const std::vector<EffectCandidate> candidates = elsewhere(service, fit.model, taker);
  FitModel model = fit.model;
  std::vector<EffectCandidate> taking;
  for (std::size_t i = model.effects.size() - 1; i-- > 0;) {
    if (findingOf(problem.library, model.effects[i]) != findingOf(problem.library, replaced)) continue;
    const auto candidate = std::ranges::find(candidates, model.effects[i].at, &EffectCandidate::at);
    if (candidate == candidates.end()) continue;
    model = model.without(i).with(problem, candidate->placed(taker.parameters));
    taking.push_back(*candidate);
  }
  if (taking.empty()) return;
  const std::optional<Scored> scored =
      service.tryScored({model, fit.shifts}, service.thresholds().calibration.toTheEnd, atOthers, 0.95);
  if (!scored || scored->mean() > selection.final.mean()) return;
  const PairedTest comparison = compare(selection.final.blocks, scored->blocks);
  const std::size_t first = model.effects.size() - taking.size();
  for (std::size_t k = 0; k < taking.size(); ++k) {
    conclude(selection.attempts, PlacedEffect{replaced.effect, taking[k].at, {}}.text(), false,
             taking[k].text() + " does better, as at " + taker.at);
    selection.remember(accepted(taking[k], problem, scored->fit.model, first + k, comparison,
                                "better than " + replaced.effect + ", as at " + taker.at));
  }
  selection.take(*scored, replaced.effect + " → " + taker.effect + " at the other joints");
}

}  // namespace btr
