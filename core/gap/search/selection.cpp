#include "core/gap/search/selection.h"

#include <cmath>
#include <utility>

namespace btr {

void Selection::take(const Scored& model, const std::string& what) {
  final = model;
  ladder.push_back(rungOf(what, final));
}

void Selection::takeInstead(const Scored& model) {
  final = model;
  ladder.back() = rungOf(ladder.back().what, final);
}

void Selection::remember(const Attempt& attempt) {
  for (Attempt& known : attempts)
    if (known.candidate.text() == attempt.candidate.text()) {
      // The first time that it came as far as ever: what is promised beside others later says less of it.
      const auto reached = [](const Attempt& a) { return a.accepted ? 3 : a.scored ? 2 : a.fitted ? 1 : 0; };
      if (!attempt.accepted && reached(attempt) <= reached(known)) return;
      const int rank = known.rank;
      const double share = known.share;
      known = attempt;
      known.rank = rank;
      known.share = share;
      return;
    }
  attempts.push_back(attempt);
}

void conclude(std::vector<Attempt>& attempts, const std::string& candidate, bool accepted, const std::string& reason) {
  for (Attempt& attempt : attempts)
    if (attempt.candidate.text() == candidate) {
      attempt.accepted = accepted;
      attempt.reason = reason;
    }
}

Attempt accepted(const EffectCandidate& candidate, const FitProblem& problem, const FitModel& model, std::size_t effect,
                 const PairedTest& comparison, std::string reason) {
  Attempt attempt;
  attempt.candidate = candidate;
  attempt.accepted = attempt.fitted = attempt.scored = true;
  attempt.values = model.fittedEffect(problem, effect).parameters;
  attempt.comparison = comparison;
  attempt.reason = std::move(reason);
  return attempt;
}

GapReport::Step rungOf(const std::string& what, const Scored& scored) {
  GapReport::Step step{what, std::sqrt(scored.mean()), 0};
  double n = 0, square = 0;
  for (const double block : scored.blocks)
    if (block >= 0) {
      ++n;
      square += (block - scored.mean()) * (block - scored.mean());
    }
  if (n > 1 && step.error > 0) step.standardError = std::sqrt(square / (n - 1) / n) / (2 * step.error);
  return step;
}

}  // namespace btr
