#include "core/gap/search/screening/candidate_search.h"

#include <algorithm>
#include <optional>

#include "core/gap/fit/fit_model.h"

namespace btr {

std::vector<std::size_t> CandidateSearch::beyondBest(Screening& screening, const std::string& stage, double at) const {
  const SearchThresholds& limits = service_.thresholds();
  const std::vector<TriedCandidate>& tried = screening.tried;
  const TriedCandidate* best = nullptr;
  double promised = 0;
  for (const TriedCandidate& each : tried) {
    promised = std::max(promised, each.attempt.share);
    if (each.passes && (!best || each.scored.mean() < best->scored.mean())) best = &each;
  }
  if (!best || excessOf(best->scored) <= limits.screening.lastChanceExcess) return {};
  std::vector<std::size_t> better = screener_.fitRest(screening, limits.screening.aboutAsMuch * promised, stage, at);
  std::erase_if(better, [&](std::size_t k) { return !costsLess(tried[k].fit, best->scored.fit); });
  return better;
}

Round CandidateSearch::search(const Request& request) {
  const SearchThresholds::Screening& limits = service_.thresholds().screening;
  const double from = request.from, to = request.to, part = (to - from) / 3;
  StepGuard step = service_.guardStep(service_.stepToSearchWith(request.models[0]));
  const double judged_s = step.before_s();
  const Linearised* known = service_.step_s() == judged_s ? request.known : nullptr;
  const SearchThresholds::ShortRace& race = service_.thresholds().shortRace;
  const SearchThresholds::Screening ofThese = request.fewScreened ? service_.thresholds().rivals.of(limits) : limits;
  Screening screening =
      screener_.screenBeside(request.models, request.eligible, known, ofThese, request.stage, from, from + part);
  screener_.fitPromising(screening, request.toFit, !request.shortRace, request.stage, from + part, from + 2 * part);
  std::vector<TriedCandidate>& tried = screening.tried;
  const bool muchLeft = !tried.empty() && tried[0].attempt.fitted && race.isRun(service_.leftBy(tried[0].fit));
  const double hopeless = muchLeft ? race.hopeless : limits.hopeless;

  // The best are fitted to the end and judged on what they were not fitted to, with the simpler effects that they
  // contain; if none of them will do, the next ones.
  std::vector<std::size_t> best, next;
  for (std::size_t k = 0; k < tried.size() && tried[k].attempt.fitted && tried[k].fit.cost <= request.hopeless; ++k)
    // What fits far worse than the best after the first iterations is no rival.
    (best.size() < request.toFit / 2 && tried[k].fit.cost <= hopeless * tried[0].fit.cost ? best : next).push_back(k);
  std::erase_if(next, [&](std::size_t k) {
    const bool contained = screener_.isContained(screening, k, best);
    if (contained) best.push_back(k);
    return contained;
  });
  const auto confirm = [&](const std::vector<std::size_t>& which, double begin) {
    return confirmer_.confirm(tried, which, request.without, judged_s, request.stage, begin, to);
  };
  std::optional<Scored> confirmed = confirm(best, from + 2 * part);
  if (!confirmed) confirmed = confirm(next, to);
  // Before nothing is said to help, the others are fitted too.
  if (!confirmed && request.lastChance && excessOf(request.without) > limits.lastChanceExcess)
    confirmed = confirm(screener_.fitRest(screening, limits.lastChancePromise, request.stage, to), to);
  else if (confirmed && request.beyondBest)
    if (const auto better = beyondBest(screening, request.stage, to); !better.empty())
      if (std::optional<Scored> again = confirm(better, to)) confirmed = std::move(again);
  if (confirmed) step.keep();
  for (TriedCandidate& each : tried)
    if (each.attempt.fitted)
      each.attempt.values = each.fit.model.simulator(service_.problem()).effects.back().parameters;
  std::stable_sort(tried.begin(), tried.end(), [](const TriedCandidate& a, const TriedCandidate& b) {
    if (a.attempt.scored != b.attempt.scored) return a.attempt.scored;
    return a.attempt.scored && a.scored.mean() < b.scored.mean();
  });
  return {std::move(tried), confirmed ? std::move(*confirmed) : request.without};
}

}  // namespace btr
