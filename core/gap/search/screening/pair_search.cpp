#include "core/gap/search/screening/pair_search.h"

#include <algorithm>

#include "core/gap/fit/fit_model.h"

namespace btr {

bool PairSearch::promisesAPair(const std::vector<TriedCandidate>& tried) const {
  const double least = service_.thresholds().screening.pairPromise;
  return std::any_of(tried.begin(), tried.end(),
                     [&](const TriedCandidate& each) { return each.attempt.share > least; });
}

std::optional<Scored> PairSearch::find(const Scored& current, const std::vector<TriedCandidate>& singles) {
  const SearchThresholds& limits = service_.thresholds();
  std::optional<Scored> pair;
  double pair_s = service_.step_s();
  for (std::size_t k = 0; k < std::min(limits.screening.pairFirsts, singles.size()); ++k) {
    if (!singles[k].attempt.scored) continue;
    const StepGuard step = service_.guardStep();
    Scored single = singles[k].scored, neither = current;
    service_.bringToStep(single, "in pairs", 0.5);
    const Round round =
        candidates_.search({single, {single.fit}, nullptr, limits.screening.fittedInPairs, ", in pairs", 0.5, 0.6});
    if (round.tried.empty()) continue;
    const TriedCandidate& second = round.tried[0];
    if (!second.attempt.scored || second.attempt.qValue > limits.confirmation.mostFalse) continue;
    // Each of the two must be worth it beside the other, and both together.
    const std::size_t effects = second.fit.model.effects.size();
    if (!confirmer_.judge(round.without, second.scored, effects - 1).passes) continue;
    service_.bringToStep(neither, "in pairs", 0.6);
    if (!confirmer_.judge(neither, second.scored, effects - 2).passes) continue;
    if (pair && second.scored.mean() >= pair->mean()) continue;
    pair = second.scored;
    pair_s = service_.step_s();
  }
  if (pair) service_.guardStep(pair_s).keep();
  return pair;
}

void PairSearch::accept(Selection& selection, const Scored& pair, const std::string& what) {
  const auto& effects = pair.fit.model.effects;
  std::string both;
  for (std::size_t i = effects.size() - 2; i < effects.size(); ++i) {
    both += (both.empty() ? "" : " and ") + effects[i].text();
    conclude(selection.attempts, effects[i].text(), true, "needed together with another");
  }
  selection.take(pair, what + both);
}

// A flexible effect by itself (a payload of any place beside a servo of any strength) takes up most of what two others
// do, and bends the numbers so far that neither of them is found beside it any more.
bool PairSearch::replaceOne(Selection& selection, const Choice& choice) {
  const SearchThresholds& limits = service_.thresholds();
  if (excessOf(selection.final) < limits.screening.doubtfulExcess || !promisesAPair(choice.others)) return false;
  StepGuard step = service_.guardStep();
  const std::optional<Scored> pair = find(choice.without, choice.others);
  if (!pair) return false;
  Scored single = selection.final;
  service_.bringToStep(single, "in pairs", 0.6);
  const PairedTest gained = compare(single.blocks, pair->blocks);
  if (gained.t < limits.confirmation.leastT || gained.gain < limits.confirmation.leastGain) return false;
  step.keep();
  conclude(selection.attempts, choice.accepted, false, "two others together do better");
  accept(selection, *pair, choice.accepted + " → ");
  return true;
}

}  // namespace btr
