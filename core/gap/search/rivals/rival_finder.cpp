#include "core/gap/search/rivals/rival_finder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/search/model_comparison.h"
#include "core/gap/search/rivals/shown_sizes.h"
#include "core/gap/search/screening/search_discoveries.h"
#include "core/gap/search/siblings.h"
#include "core/spec/require.h"

namespace btr {
namespace {

/// How many numbers an effect brings.
std::size_t sizeOf(const FitModel& model, std::size_t effect) {
  return static_cast<std::size_t>(std::count_if(model.parameters.begin(), model.parameters.end(),
                                                [&](const auto& p) { return p.effect == static_cast<int>(effect); }));
}

bool contains(const FitModel& model, const EffectCandidate& candidate) {
  return std::any_of(model.effects.begin(), model.effects.end(),
                     [&](const PlacedEffect& e) { return e.effect == candidate.effect && e.at == candidate.at; });
}

/// The p-value of an effect adjusted for all candidates of its place in the model.
double rateAmong(const std::vector<TriedCandidate>& others, const Found& found) {
  std::vector<double> pValues{found.comparison.pValue};
  for (const TriedCandidate& other : others) {
    const EffectCandidate& candidate = other.attempt.candidate;
    if (candidate.effect != found.effect.effect || candidate.at != found.effect.at)
      pValues.push_back(other.attempt.scored ? other.attempt.comparison.pValue : 1);
  }
  return falseDiscoveryRates(pValues)[0];
}

}  // namespace

void RivalFinder::add(const HandedOver& arrived, std::vector<TriedCandidate>& others) const {
  const EffectCandidate& candidate = arrived.candidate;
  const Scored& scored = arrived.scored;
  auto known =
      std::ranges::find(others, candidate.text(), [](const TriedCandidate& t) { return t.attempt.candidate.text(); });
  if (known == others.end()) {
    others.push_back({});
    known = others.end() - 1;
    known->attempt.candidate = candidate;
  } else if (known->attempt.scored && known->scored.mean() <= scored.mean()) {
    return;
  }
  known->attempt.fitted = known->attempt.scored = true;
  known->attempt.comparison = compare(calibrated_.blocks, scored.blocks);
  known->scored = scored;
  known->fit = scored.fit;
  known->attempt.values = scored.fit.model.simulator(service_.problem()).effects.back().parameters;
  known->settled_s = scored.step_s;
}

bool RivalFinder::isHollow(const TriedCandidate& other, const PlacedEffect& simpler) const {
  if (!isRicher(service_.problem().library, other.attempt.candidate, simpler)) return false;
  std::size_t sizes = 0;
  for (const Parameter& p : service_.problem().library.make(simpler.effect)->parameters())
    sizes += p.neutral && !p.integer;
  return showsNoMoreThan(sizes, service_.problem(), other.fit, other.fit.model.effects.size() - 1);
}

bool RivalFinder::isAllThatShows(const TriedCandidate& simpler, const Scored& final, std::size_t i) const {
  const SearchThresholds::Rivals& limits = service_.thresholds().rivals;
  const PlacedEffect& own = final.fit.model.effects[i];
  if (!isSimplerForm(service_.problem().library, simpler.attempt.candidate, own) ||
      simpler.scored.mean() > limits.nothingShows * final.mean())
    return false;
  if (simpler.scored.mean() > limits.allThatShows * final.mean())
    return shownSizes(service_.problem(), final.fit, i) == 0;
  return showsNoMoreThan(sizesOf(simpler.fit.model, simpler.fit.model.effects.size() - 1), service_.problem(),
                         final.fit, i);
}

bool RivalFinder::replace(std::size_t i, const std::vector<TriedCandidate>& others, Selection& selection) const {
  const SearchThresholds& limits = service_.thresholds();
  const FitModel& model = selection.final.fit.model;
  const PlacedEffect own = model.effects[i];
  const std::string ownText = own.text();
  const auto numbersOf = [](const TriedCandidate& other) {
    return sizeOf(other.fit.model, other.fit.model.effects.size() - 1);
  };
  // So little is no reason for another name: neither for a richer one, nor against a simpler form of this one.
  const double imperfection = imperfectionOf(calibrated_, selection.final, limits.screening);
  const TriedCandidate* chosen = nullptr;
  for (const TriedCandidate& other : others) {
    if (!other.attempt.scored || contains(model, other.attempt.candidate)) continue;
    if (isWithinHalfAStep(service_.problem(), other.fit.model, other.fit.model.effects.size() - 1)) continue;
    if (chosen) {
      // A simpler one that does as well as the better one.
      if (numbersOf(other) < numbersOf(*chosen) && !isRefuted(other.scored, chosen->scored, limits.rivals))
        chosen = &other;
      continue;
    }
    const PairedTest lost = compare(other.scored.blocks, selection.final.blocks);
    const double better = selection.final.mean() - other.scored.mean();
    const bool clearlyBetter = lost.t <= -limits.confirmation.leastT && lost.gain < -limits.rivals.clearlyBetterGain &&
                               (numbersOf(other) <= sizeOf(model, i) || better > imperfection);
    // Where much is unexplained, few blocks tell little: equals leave about the same.
    const bool equal = !isRefuted(other.scored, selection.final, limits.rivals) &&
                       other.scored.mean() <= limits.rivals.equals * selection.final.mean();
    // What was the better of two when fewer others stood beside it need not be so any more.
    const bool betterOfEquals = equal && numbersOf(other) == sizeOf(model, i) &&
                                other.scored.mean() < limits.rivals.ofEquals * selection.final.mean() &&
                                other.scored.fit.cost < limits.rivals.ofEquals * selection.final.fit.cost;
    const bool asSimple =
        equal || (-better < imperfection && isSimplerForm(service_.problem().library, other.attempt.candidate, own));
    const bool takes = clearlyBetter || betterOfEquals || (numbersOf(other) < sizeOf(model, i) && asSimple);
    if ((takes && !isHollow(other, own)) || (!takes && isAllThatShows(other, selection.final, i))) chosen = &other;
  }
  if (!chosen) return false;
  const std::string text = chosen->attempt.candidate.text();
  const bool simpler = numbersOf(*chosen) < sizeOf(model, i);
  conclude(selection.attempts, ownText, false, text + (simpler ? " is simpler and does as well" : " does better"));
  conclude(selection.attempts, text, true,
           simpler ? "simpler than " + ownText + " and not worse" : "better than " + ownText);
  selection.take(chosen->scored, ownText + " → " + text);
  return true;
}

void RivalFinder::addTogether(std::size_t i, const Scored& final, const std::vector<TriedCandidate>& others,
                              Found& found) const {
  const PlacedEffect& own = found.effect;
  const std::vector<std::string> names = service_.problem().library.make(own.effect)->togetherWith();
  if (names.empty()) return;
  FitModel model = final.fit.model.without(i);
  for (const EffectCandidate& candidate : service_.candidatesBeside(model, names)) {
    if (candidate.at != own.at) continue;
    Values from;
    for (const TriedCandidate& other : others)
      if (other.attempt.fitted && other.attempt.candidate.text() == candidate.text()) from = other.attempt.values;
    model = model.with(service_.problem(), candidate.placed(from));
  }
  if (model.effects.size() + 1 != final.fit.model.effects.size() + names.size()) return;
  const std::optional<Scored> scored =
      service_.tryScored({model, final.fit.shifts}, service_.thresholds().rivals.togetherIterations, "rivals", 0.95);
  if (!scored || isWorse(compare(scored->blocks, final.blocks), service_.thresholds().rivals)) return;
  const double ratio = std::sqrt(scored->mean() / std::max(1e-12, final.mean()));
  for (std::size_t k = 0; k < names.size(); ++k) {
    found.rivals.push_back({names[k], own.at, ratio, names[(k + 1) % names.size()]});
    found.rivalFits.push_back(scored->fit);
  }
}

void RivalFinder::compareAtOneStep(Selection& selection, std::vector<TriedCandidate>& others) {
  const SearchThresholds& limits = service_.thresholds();
  confirmer_.settle(selection, false, "rivals", 0.95);
  const bool muchLeft = limits.shortRace.isRun(selection.final.mean());
  for (TriedCandidate& other : others) {
    if (!other.attempt.scored || other.scored.mean() > limits.step.farWorse * selection.final.mean()) continue;
    if (muchLeft && other.settled_s == service_.step_s()) continue;
    if (excessOf(selection.final) >= limits.calibration.leastToFitOn ||
        isDistinguished(other.scored, selection.final, limits.rivals))
      other.scored =
          service_.scoreAll(service_.refit({other.scored.fit}, limits.calibration.toTheEnd, "rivals", 0.95, 0.95),
                            "rivals", 0.95, 0.95)[0];
    service_.bringToStep(other.scored, "rivals", 0.95);
    other.fit = other.scored.fit;
    other.settled_s = service_.step_s();
  }
}

Found RivalFinder::foundAt(std::size_t i, const Offered& offered, Selection& selection) const {
  const FitModel& model = selection.final.fit.model;
  const PlacedEffect own = model.effects[i];
  Found found{own, compare(offered.without.blocks, selection.final.blocks), 1, {}, {}, {}};
  found.qValue = rateAmong(offered.others, found);
  for (const TriedCandidate& other : offered.others) {
    const EffectCandidate& candidate = other.attempt.candidate;
    if (!other.attempt.scored || contains(model, candidate) || isRicher(service_.problem().library, candidate, own))
      continue;
    if (isDistinguished(other.scored, selection.final, service_.thresholds().rivals)) continue;
    found.rivals.push_back(
        {candidate.effect, candidate.at, std::sqrt(other.scored.mean() / std::max(1e-12, selection.final.mean()))});
    found.rivalFits.push_back(other.fit);
    for (Attempt& attempt : selection.attempts)
      if (attempt.candidate.text() == candidate.text() && !attempt.scored)
        attempt.reason = "explains it as well, found from " + own.text();
  }
  addTogether(i, selection.final, offered.others, found);
  return found;
}

std::vector<std::size_t> RivalFinder::inOrder(const FitModel& model) const {
  std::vector<std::size_t> order;
  for (std::size_t i = model.effects.size(); i-- > 0;) order.push_back(i);
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t i) { return !isSibling(service_.problem().library, model.effects, i); });
  return order;
}

Eligible RivalFinder::eligibleFor(std::size_t i, const Scored& final,
                                  const std::vector<std::optional<Found>>& found) const {
  const EffectLibrary& library = service_.problem().library;
  const std::vector<PlacedEffect>& effects = final.fit.model.effects;
  if (!isSibling(library, effects, i)) return {};
  const PlacedEffect& own = effects[i];
  std::set<std::string> names;
  const std::optional<Found>& first = found[siblingsOf(library, effects, i).front()];
  require(first.has_value(), "what was found first is asked for first");
  for (const GapReport::Rival& rival : first->rivals) names.insert(rival.effect);
  if (excessOf(final) > service_.thresholds().screening.lastChanceExcess)
    for (const EffectCandidate& other : service_.candidatesBeside(final.fit.model.without(i)))
      if (isRicher(library, other, own) || isSimplerForm(library, other, own)) names.insert(other.effect);
  return {own.at, std::move(names)};
}

RivalFinder::Offered RivalFinder::inPlaceOf(std::size_t i, const Scored& final, const Eligible& eligible) {
  const FitModel& model = final.fit.model;
  if (model.effects.size() == 1) return {calibrated_, first_};
  const Scored without =
      service_.fitAndScore({{model.without(i), final.fit.shifts}}, final.fit, "rivals", 0.86, 0.88)[0];
  if (eligible.isNone()) return {without, {}};
  // What leaves many times what the effect leaves is not told from it by fitting it to the end.
  const SearchThresholds& limits = service_.thresholds();
  const bool isShort = limits.shortRace.isRun(final.mean());
  const double inReach = isShort ? limits.shortRace.hopeless : limits.screening.inReach;
  Round round = candidates_.search({.without = without,
                                    .models = {without.fit},
                                    .toFit = limits.screening.fittedAsRivals,
                                    .stage = ", rivals",
                                    .from = 0.88,
                                    .to = 0.95,
                                    .hopeless = inReach * final.fit.cost,
                                    .eligible = eligible,
                                    .fewScreened = true,
                                    .shortRace = isShort});
  return {std::move(round.without), std::move(round.tried)};
}

RivalFinder::Offered& RivalFinder::offeredTo(std::size_t i, const Scored& final, const Eligible& eligible) {
  std::set<std::string> beside;
  const auto& effects = final.fit.model.effects;
  for (std::size_t k = 0; k < effects.size(); ++k)
    if (k != i) beside.insert(effects[k].text());
  const auto [place, isNew] = known_.try_emplace(beside);
  Offered& offered = place->second;
  if (isNew) {
    offered = inPlaceOf(i, final, eligible);
    if (eligible.isNone()) return offered;
    for (const HandedOver& arrived : handover_.handOver(i, final, eligible)) add(arrived, offered.others);
  }
  return offered;
}

RivalSearch RivalFinder::find(Selection selection) {
  int replaced = 0;
  known_.clear();
  std::vector<std::optional<Found>> found;
  std::vector<std::size_t> order;
  const auto begin = [&] {
    order = inOrder(selection.final.fit.model);
    found.assign(order.size(), std::nullopt);
  };
  begin();
  for (std::size_t k = 0; k < order.size();) {
    const std::size_t i = order[k];
    Offered& offered = offeredTo(i, selection.final, eligibleFor(i, selection.final, found));
    compareAtOneStep(selection, offered.others);
    const PlacedEffect asked = selection.final.fit.model.effects[i];
    if (replaced < service_.thresholds().rivals.replaced && replace(i, offered.others, selection)) {
      replaceSiblings(service_, selection, asked);
      confirmer_.settle(selection, true, "rivals", 0.95);
      ++replaced;
      begin();
      k = 0;
    } else {
      found[i] = foundAt(i, offered, selection);
      ++k;
    }
  }
  std::vector<Found> effects;
  for (std::optional<Found>& each : found) effects.push_back(std::move(*each));
  return {std::move(selection), std::move(effects)};
}

}  // namespace btr
