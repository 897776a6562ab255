#include "core/gap/search/refinement.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/score.h"
#include "core/gap/search/screening/candidates.h"
#include "core/gap/search/siblings.h"

namespace btr {
namespace {

/// A model whose effect `effect` has details that are fitted now.
struct Refined {
  FitModel model;
  std::size_t effect = 0;
  EffectCandidate candidate;  ///< that effect, where it stands for a richer one; no name otherwise

  bool isSimplerForm() const { return !candidate.effect.empty(); }
};

/// The model's effect `i` with its details, and in its place each of its simpler forms that has some.
std::vector<Refined> refinementsOf(const FitService& service, const FitModel& model, std::size_t i) {
  const FitProblem& problem = service.problem();
  std::vector<Refined> all;
  if (FitModel own = model.refined(problem, i); own.parameters.size() > model.parameters.size())
    all.push_back({std::move(own), i, {}});
  const PlacedEffect placed = model.fittedEffect(problem, i);
  const std::vector<std::string> simpler = problem.library.make(placed.effect)->contains();
  if (simpler.empty()) return all;
  const FitModel others = model.without(i);
  for (const EffectCandidate& candidate : service.candidatesBeside(others, simpler)) {
    if (candidate.at != placed.at || !service.isConsidered(candidate.effect)) continue;
    // What both have is about as large in both.
    Values from;
    for (const Parameter& p : candidate.declared)
      if (const auto same = placed.parameters.find(p.name); same != placed.parameters.end()) from.insert(*same);
    const FitModel plain = others.with(problem, candidate.placed(from));
    FitModel refined = plain.refined(problem, others.effects.size());
    if (refined.parameters.size() > plain.parameters.size() && refined.parameters.size() <= model.parameters.size())
      all.push_back({std::move(refined), others.effects.size(), candidate});
  }
  return all;
}

constexpr const char* stage = "refining what was found";

/// The model with details of its law as `sizeOf` has them.
FitJob begunWith(const FitService& service, const Refined& refined, const Fit& from,
                 const std::function<double(const FitParameter&)>& sizeOf) {
  const auto declared = service.problem().library.make(refined.model.effects[refined.effect].effect)->parameters();
  FitModel model = refined.model;
  for (std::size_t k = 0; k < model.parameters.size(); ++k) {
    const FitParameter& p = model.parameters[k];
    const Parameter* const known = p.effect == static_cast<int>(refined.effect) ? find(declared, p.name) : nullptr;
    if (known && known->refines) model.values[k] = std::clamp(sizeOf(p), p.minimum, p.maximum);
  }
  return {std::move(model), from.shifts};
}

/// The best fit from several sizes of the details, or nothing where the scene refuses them all. `like`: the same law at
/// another joint, whose details are known; this one's are about as large.
std::optional<Fit> fitted(const FitService& service, const Refined& refined, const Fit& from,
                          const std::optional<PlacedEffect>& like) {
  std::vector<FitJob> jobs;
  if (like && like->effect == refined.model.effects[refined.effect].effect)
    jobs.push_back(begunWith(service, refined, from, [&](const auto& p) { return like->parameters.at(p.name); }));
  else
    for (const double share : service.thresholds().refinement.shares)
      jobs.push_back(begunWith(service, refined, from,
                               [&](const auto& p) { return p.minimum + share * (p.maximum - p.minimum); }));
  const std::vector<Fit> fits =
      completed(service.tryFits(jobs, service.thresholds().refinement.iterations, stage, 0.8, 0.8));
  if (fits.empty()) return std::nullopt;
  return *std::ranges::min_element(fits, costsLess);
}

bool isBetter(const Scored& refined, const Scored& plain, const SearchThresholds& limits) {
  const PairedTest comparison = compare(plain.blocks, refined.blocks);
  return comparison.t >= limits.confirmation.leastT && comparison.gain >= limits.confirmation.leastGain &&
         plain.mean() - refined.mean() >= limits.confirmation.leastShareOfExcess * excessOf(plain);
}

/// Refines effect `i`, where that does better; the law that stands there then, or nothing. `like`: see fitted.
std::optional<PlacedEffect> refine(const FitService& service, Confirmer& confirmer, Selection& selection, std::size_t i,
                                   const std::optional<PlacedEffect>& like = std::nullopt) {
  std::vector<Refined> refinements = refinementsOf(service, selection.final.fit.model, i);
  std::vector<Fit> fits;
  std::vector<Refined> made;
  for (Refined& refined : refinements)
    if (const auto fit = fitted(service, refined, selection.final.fit, like)) {
      fits.push_back(*fit);
      made.push_back(std::move(refined));
    }
  const auto scored = service.tryScores(fits, stage, 0.8, 0.8);
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < scored.size(); ++k)
    if (scored[k] && isBetter(*scored[k], selection.final, service.thresholds()) &&
        (!best || scored[k]->mean() < scored[*best]->mean()))
      best = k;
  if (!best) return std::nullopt;
  const PlacedEffect own = selection.final.fit.model.effects[i];
  const PairedTest comparison = compare(selection.final.blocks, scored[*best]->blocks);
  const Scored better = confirmer.converged(*scored[*best], stage, 0.8);
  const Refined& refined = made[*best];
  const PlacedEffect now = better.fit.model.fittedEffect(service.problem(), refined.effect);
  if (!refined.isSimplerForm()) {
    selection.take(better, own.text() + ", refined");
    return now;
  }
  const std::string text = refined.candidate.text();
  selection.remember(accepted(refined.candidate, service.problem(), better.fit.model, refined.effect, comparison,
                              "simpler than " + own.text() + ", and better in detail"));
  conclude(selection.attempts, own.text(), false, text + " does better in detail");
  selection.take(better, own.text() + " → " + text);
  return now;
}

}  // namespace

void refineLaws(const FitService& service, Confirmer& confirmer, Selection& selection) {
  const EffectLibrary& library = service.problem().library;
  const std::vector<PlacedEffect> before = selection.final.fit.model.effects;
  // What takes an effect's place comes last: those that are still to be refined keep theirs.
  const auto placeOf = [&](const PlacedEffect& effect) {
    const auto& now = selection.final.fit.model.effects;
    return static_cast<std::size_t>(std::ranges::find(now, effect.text(), &PlacedEffect::text) - now.begin());
  };
  for (std::size_t i = before.size(); i-- > 0;) {
    if (isSibling(library, before, i)) continue;
    // Details that one joint does not show are not looked for at the others.
    if (const auto law = refine(service, confirmer, selection, placeOf(before[i])))
      for (const std::size_t k : siblingsOf(library, before, i))
        refine(service, confirmer, selection, placeOf(before[k]), law);
  }
}

}  // namespace btr
