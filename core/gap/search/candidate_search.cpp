#include "core/gap/search/candidate_search.h"

#include <algorithm>
#include <optional>

#include "core/gap/fit/fit_model.h"

namespace btr {

Round CandidateSearch::ask(const Question& question) {
  const SearchThresholds::Screening& limits = service_.thresholds().screening;
  const double from = question.from, to = question.to, part = (to - from) / 3;
  StepGuard step = service_.guardStep(service_.stepToSearchWith(question.models[0]));
  const double judged_s = step.before_s();
  const Linearised* known = service_.step_s() == judged_s ? question.known : nullptr;
  Screening screening = screener_.screenBeside(question.models, known, question.stage, from, from + part);
  screener_.fitPromising(screening, question.toFit, question.stage, from + part, from + 2 * part);
  std::vector<TriedCandidate>& tried = screening.tried;

  // The best are fitted to the end and judged on what they were not fitted to, with the simpler effects that they
  // contain; if none of them will do, the next ones.
  std::vector<std::size_t> best, next;
  for (std::size_t k = 0; k < tried.size() && tried[k].attempt.fitted; ++k)
    // What fits far worse than the best after the first iterations is no rival.
    (best.size() < question.toFit / 2 && tried[k].fit.cost <= limits.hopeless * tried[0].fit.cost ? best : next)
        .push_back(k);
  std::erase_if(next, [&](std::size_t k) {
    const bool contained = screener_.isContained(screening, k, best);
    if (contained) best.push_back(k);
    return contained;
  });
  const auto confirm = [&](const std::vector<std::size_t>& which, double begin) {
    return confirmer_.confirm(tried, which, question.without, judged_s, question.stage, begin, to);
  };
  std::optional<Scored> confirmed = confirm(best, from + 2 * part);
  if (!confirmed) confirmed = confirm(next, to);
  // Before nothing is said to help, the others are fitted too.
  if (!confirmed && question.lastChance && excessOf(question.without) > limits.lastChanceExcess)
    confirmed = confirm(screener_.fitRest(screening, question.stage, to), to);
  if (confirmed) step.keep();
  for (TriedCandidate& each : tried)
    if (each.attempt.fitted)
      each.attempt.values = each.fit.model.simulator(service_.problem()).effects.back().parameters;
  std::stable_sort(tried.begin(), tried.end(), [](const TriedCandidate& a, const TriedCandidate& b) {
    if (a.attempt.scored != b.attempt.scored) return a.attempt.scored;
    return a.attempt.scored && a.scored.mean() < b.scored.mean();
  });
  return {std::move(tried), confirmed ? std::move(*confirmed) : question.without};
}

}  // namespace btr
