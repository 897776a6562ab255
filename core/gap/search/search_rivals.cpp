// What else would explain the recordings as well, and what is of no use beside the others.
#include <algorithm>
#include <cmath>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/search/search_discoveries.h"
#include "core/gap/search/search_run.h"

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

/// Of a comparison with the final model.
bool isWorse(const PairedTest& lost, const SearchThresholds::Rivals& limits) {
  return lost.t >= limits.worseT && lost.gain > limits.worseGain;
}

/// The same where the other may explain all but the noise already: what takes a few percent of the noise itself
/// (sensors of counts are no dice) does not refute it.
bool isRefuted(const Scored& other, const Scored& by, const SearchThresholds::Rivals& limits) {
  const PairedTest lost = compare(other.blocks, by.blocks);
  return isWorse(lost, limits) && !(other.mean() <= 1 && lost.gain < limits.gainOfNoise);
}

/// Predicts worse and fits worse. What fits as well and predicts worse only pays for a number more: recordings that it
/// explains as well do not tell it from the final model.
bool isDistinguished(const Scored& other, const Scored& final, const SearchThresholds::Rivals& limits) {
  return isRefuted(other, final, limits) && other.fit.cost > limits.fitsWorse * final.fit.cost;
}

}  // namespace

void SearchRun::prune(SearchResult& result) {
  for (bool changed = true; changed && result.final.fit.model.effects.size() > 1;) {
    changed = false;
    std::vector<FitJob> jobs;
    for (std::size_t i = 0; i < result.final.fit.model.effects.size(); ++i)
      jobs.push_back({result.final.fit.model.without(i), result.final.fit.shifts});
    auto scored = fitAndScore(jobs, result.final.fit, "dropping each in turn", 0.8, 0.86);
    for (std::size_t i = 0; i < scored.size() && !changed; ++i) {
      if (isMissed(scored[i], result.final, limits().confirmation)) continue;
      bringToStep(scored[i], "dropping each in turn", 0.86);
      if (isMissed(scored[i], result.final, limits().confirmation)) continue;
      const PlacedEffect& dropped = result.final.fit.model.effects[i];
      result.ladder.push_back(step("− " + dropped.text(), scored[i]));
      conclude(result.attempts, dropped.text(), false, "useless once the others were there");
      result.final = scored[i];
      changed = true;
    }
  }
}

/// The simpler effects of a richer one, side by side, where they have fewer numbers and do as well: friction that was
/// allowed to differ by direction and does not is dry and viscous friction.
void SearchRun::takeApart(SearchResult& result) {
  for (std::size_t i = 0; i < result.final.fit.model.effects.size();) {
    const FitModel& whole = result.final.fit.model;
    const PlacedEffect own = whole.effects[i];
    const std::vector<std::string> names = problem_.library.make(own.effect)->contains();
    FitModel parts = whole.without(i);
    const std::size_t others = parts.effects.size();
    std::vector<EffectCandidate> added;
    for (const std::string& name : names)
      for (const EffectCandidate& candidate : candidatesFor(problem_, parts, {name}, options_.thresholds.candidates))
        if (candidate.at == own.at && isConsidered(name)) {
          parts = parts.with(problem_, candidate.placed({}));
          added.push_back(candidate);
        }
    if (added.size() < 2 || parts.parameters.size() >= whole.parameters.size() ||
        static_cast<int>(parts.effects.size()) > options_.maximumEffects) {
      ++i;
      continue;
    }
    const std::vector<Fit> fits = thoseOf(
        tryFits({{parts, result.final.fit.shifts}}, limits().rivals.apartIterations, "taking apart", 0.86, 0.86));
    const auto apart = tryScores(fits, "taking apart", 0.86, 0.86);
    if (apart.empty() || !apart[0] || isWorse(compare(apart[0]->blocks, result.final.blocks), limits().rivals)) {
      ++i;
      continue;
    }
    const Scored& scored = *apart[0];
    const std::string ownText = own.text();
    std::string what = ownText + " →";
    for (std::size_t k = 0; k < added.size(); ++k) {
      what += (k ? " and " : " ") + added[k].text();
      Attempt attempt;
      attempt.candidate = added[k];
      attempt.accepted = attempt.fitted = attempt.scored = true;
      attempt.values =
          scored.fit.model.simulator(problem_).effects[problem_.given.effects.size() + others + k].parameters;
      attempt.comparison = compare(result.calibrated.blocks, scored.blocks);
      attempt.reason = "with the others simpler than " + ownText + " and not worse";
      remember(result.attempts, attempt);
    }
    conclude(result.attempts, ownText, false, "its simpler forms together do as well");
    result.final = scored;
    result.ladder.push_back(step(what, result.final));
    i = 0;
  }
}

/// True if the candidate is a richer form of the effect at the same place: not a rival of what it contains.
bool SearchRun::isRicher(const EffectCandidate& candidate, const PlacedEffect& effect) const {
  const std::vector<std::string> simpler = problem_.library.make(candidate.effect)->contains();
  return candidate.at == effect.at && std::find(simpler.begin(), simpler.end(), effect.effect) != simpler.end();
}

/// Fits of other effects in the place of the final model's effect `i`, and the final model without it.
std::vector<SearchRun::Tried> SearchRun::inPlaceOf(std::size_t i, const SearchResult& result, Scored& without) {
  const FitModel& model = result.final.fit.model;
  if (model.effects.size() == 1) {
    without = result.calibrated;
    return firstStage_;
  }
  without = fitAndScore({{model.without(i), result.final.fit.shifts}}, result.final.fit, "rivals", 0.86, 0.88)[0];
  return tryCandidates(without, {without.fit}, nullptr, limits().screening.fittedAsRivals, ", rivals", 0.88, 0.95);
}

/// True if another effect took the place of effect `i`: the simpler of equals, or simply a better one.
bool SearchRun::replace(std::size_t i, const std::vector<Tried>& others, SearchResult& result) const {
  const FitModel& model = result.final.fit.model;
  const PlacedEffect own = model.effects[i];
  const std::string ownText = own.text();
  const auto numbersOf = [](const Tried& other) { return sizeOf(other.fit.model, other.fit.model.effects.size() - 1); };
  const Tried* chosen = nullptr;
  for (const Tried& other : others) {
    if (!other.attempt.scored || contains(model, other.attempt.candidate)) continue;
    if (chosen) {
      // A simpler one that does as well as the better one.
      if (numbersOf(other) < numbersOf(*chosen) && !isRefuted(other.scored, chosen->scored, limits().rivals))
        chosen = &other;
      continue;
    }
    const PairedTest lost = compare(other.scored.blocks, result.final.blocks);
    const bool clearlyBetter =
        lost.t <= -limits().confirmation.leastT && lost.gain < -limits().rivals.clearlyBetterGain;
    // Where much is unexplained, few blocks tell little: equals leave about the same.
    const bool equal = !isRefuted(other.scored, result.final, limits().rivals) &&
                       other.scored.mean() <= limits().rivals.equals * result.final.mean();
    if (clearlyBetter || (numbersOf(other) < sizeOf(model, i) && equal)) chosen = &other;
  }
  if (!chosen) return false;
  const std::string text = chosen->attempt.candidate.text();
  const bool simpler = numbersOf(*chosen) < sizeOf(model, i);
  conclude(result.attempts, ownText, false, text + (simpler ? " is simpler and does as well" : " does better"));
  conclude(result.attempts, text, true,
           simpler ? "simpler than " + ownText + " and not worse" : "better than " + ownText);
  result.final = chosen->scored;
  result.ladder.push_back(step(ownText + " → " + text, result.final));
  return true;
}

void SearchRun::addTogether(std::size_t i, const SearchResult& result, const std::vector<Tried>& others,
                            Found& found) const {
  const PlacedEffect& own = found.effect;
  const std::vector<std::string> names = problem_.library.make(own.effect)->togetherWith();
  if (names.empty()) return;
  FitModel model = result.final.fit.model.without(i);
  for (const EffectCandidate& candidate : candidatesFor(problem_, model, names, options_.thresholds.candidates)) {
    if (candidate.at != own.at) continue;
    Values from;
    for (const Tried& other : others)
      if (other.attempt.fitted && other.attempt.candidate.text() == candidate.text()) from = other.attempt.values;
    model = model.with(problem_, candidate.placed(from));
  }
  if (model.effects.size() + 1 != result.final.fit.model.effects.size() + names.size()) return;
  const std::vector<Fit> fits =
      thoseOf(tryFits({{model, result.final.fit.shifts}}, limits().rivals.togetherIterations, "rivals", 0.95, 0.95));
  const auto scored = tryScores(fits, "rivals", 0.95, 0.95);
  if (scored.empty() || !scored[0] || isWorse(compare(scored[0]->blocks, result.final.blocks), limits().rivals)) return;
  const double ratio = std::sqrt(scored[0]->mean() / std::max(1e-12, result.final.mean()));
  for (std::size_t k = 0; k < names.size(); ++k) {
    found.rivals.push_back({names[k], own.at, ratio, names[(k + 1) % names.size()]});
    found.rivalFits.push_back(fits[0]);
  }
}

double SearchRun::rateAmong(const std::vector<Tried>& others, const Found& found) {
  std::vector<double> pValues{found.comparison.pValue};
  for (const Tried& other : others) {
    const EffectCandidate& candidate = other.attempt.candidate;
    if (candidate.effect != found.effect.effect || candidate.at != found.effect.at)
      pValues.push_back(other.attempt.scored ? other.attempt.comparison.pValue : 1);
  }
  return falseDiscoveryRates(pValues)[0];
}

/// What comes near the final model is fitted as far as that was and scored with the same step, the finest that any of
/// them needed.
void SearchRun::compareAtOneStep(SearchResult& result, std::vector<Tried>& others) {
  settle(result, false, "rivals", 0.95);
  for (Tried& other : others) {
    if (!other.attempt.scored || other.scored.mean() > limits().step.farWorse * result.final.mean()) continue;
    if (excessOf(result.final) >= limits().calibration.leastToFitOn ||
        isDistinguished(other.scored, result.final, limits().rivals))
      other.scored = scoreAll(fitOn({other.scored.fit}, limits().calibration.toTheEnd, "rivals", 0.95, 0.95), "rivals",
                              0.95, 0.95)[0];
    bringToStep(other.scored, "rivals", 0.95);
    other.fit = other.scored.fit;
  }
}

/// What was offered the place of effect `i`, fitted beside the same others: looked for once, and offered again to
/// whatever has taken the place since.
SearchRun::Offered& SearchRun::offeredTo(std::size_t i, const SearchResult& result,
                                         std::map<std::set<std::string>, Offered>& known) {
  std::set<std::string> beside;
  const auto& effects = result.final.fit.model.effects;
  for (std::size_t k = 0; k < effects.size(); ++k)
    if (k != i) beside.insert(effects[k].text());
  const auto [place, isNew] = known.try_emplace(beside);
  Offered& offered = place->second;
  if (isNew) {
    offered.others = inPlaceOf(i, result, offered.without);
    handOver(i, result, offered.others);
  }
  return offered;
}

Found SearchRun::foundAt(std::size_t i, const Offered& offered, SearchResult& result) const {
  const FitModel& model = result.final.fit.model;
  const PlacedEffect own = model.effects[i];
  Found found{own, compare(offered.without.blocks, result.final.blocks), 1, {}, {}, {}};
  found.qValue = rateAmong(offered.others, found);
  for (const Tried& other : offered.others) {
    const EffectCandidate& candidate = other.attempt.candidate;
    if (!other.attempt.scored || contains(model, candidate) || isRicher(candidate, own)) continue;
    if (isDistinguished(other.scored, result.final, limits().rivals)) continue;
    found.rivals.push_back(
        {candidate.effect, candidate.at, std::sqrt(other.scored.mean() / std::max(1e-12, result.final.mean()))});
    found.rivalFits.push_back(other.fit);
    for (Attempt& attempt : result.attempts)
      if (attempt.candidate.text() == candidate.text() && !attempt.scored)
        attempt.reason = "explains it as well, found from " + own.text();
  }
  addTogether(i, result, offered.others, found);
  return found;
}

/// Rivals of each effect beside the others, the last found first: it is the least sure. Where one is replaced, all are
/// asked beside what stands there now.
void SearchRun::findRivals(SearchResult& result) {
  std::map<std::set<std::string>, Offered> known;
  int replaced = 0;
  result.effects.clear();
  for (std::size_t left = result.final.fit.model.effects.size(); left > 0;) {
    Offered& offered = offeredTo(left - 1, result, known);
    compareAtOneStep(result, offered.others);
    if (replaced < limits().rivals.replaced && replace(left - 1, offered.others, result)) {
      settle(result, true, "rivals", 0.95);
      ++replaced;
      left = result.final.fit.model.effects.size();
      result.effects.clear();
    } else {
      --left;
      result.effects.push_back(foundAt(left, offered, result));
    }
  }
  std::ranges::reverse(result.effects);
}

}  // namespace btr
