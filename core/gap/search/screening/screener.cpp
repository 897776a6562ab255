#include "core/gap/search/screening/screener.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

#include "core/gap/fit/fit_model.h"
#include "core/gap/search/starts/drawn_starts.h"
#include "core/gap/search/starts/whole_numbers.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

/// The best start of each kind first. What screening did not promise begins where another kind does.
void putKindsFirst(Promise& promise, const std::vector<Parameter>& declared, double most) {
  const auto kind = std::ranges::find_if(
      declared, [&](const Parameter& p) { return p.integer && !p.neutral && p.maximum - p.minimum <= most; });
  if (kind == declared.end() || promise.starts.empty()) return;
  const auto kindOf = [&](const FitStart& start) { return start.from.effect.at(kind->name); };
  std::vector<FitStart> first{promise.starts[0]}, missing;
  for (double value = kind->minimum; value <= kind->maximum; ++value) {
    if (value == kindOf(first[0])) continue;
    const auto of = std::ranges::find(promise.starts, value, kindOf);
    FitStart start = of != promise.starts.end() ? *of : first[0];
    start.from.effect[kind->name] = value;
    (of != promise.starts.end() ? first : missing).push_back(start);
  }
  std::stable_sort(first.begin() + 1, first.end(),
                   [](const FitStart& a, const FitStart& b) { return a.left < b.left; });
  first.insert(first.end(), missing.begin(), missing.end());
  promise.kinds = first.size();
  promise.starts.insert(promise.starts.begin(), first.begin(), first.end());
}

Promise promiseOf(const EffectCandidate& candidate, std::size_t c, const std::vector<std::vector<Screened>>& screened,
                  const std::vector<double>& totals, double mostKinds) {
  Promise promise;
  std::vector<FitStart> later;
  for (std::size_t b = 0; b < screened.size(); ++b) {
    const Screened& of = screened[b][c];
    promise.excited = promise.excited || of.excited;
    promise.refused = promise.refused || of.refused > 0;
    if (totals[0] > 0) promise.share = std::max(promise.share, 1 - totals[b] * (1 - of.share) / totals[0]);
    for (const Screened::Start& start : of.starts)
      (&start == of.starts.data() ? promise.starts : later).push_back({start, b, totals[b] * (1 - start.share)});
  }
  // The best that was looked at from each base, then what else was promised.
  for (std::vector<FitStart>* list : {&promise.starts, &later})
    std::stable_sort(list->begin(), list->end(), [](const FitStart& a, const FitStart& b) { return a.left < b.left; });
  promise.starts.insert(promise.starts.end(), later.begin(), later.end());
  // No fit gets from one whole number to another: the second start has another one.
  const auto other = std::find_if(promise.starts.begin(), promise.starts.end(), [&](const FitStart& start) {
    return std::any_of(candidate.declared.begin(), candidate.declared.end(), [&](const Parameter& p) {
      return p.integer && start.from.effect.at(p.name) != promise.starts[0].from.effect.at(p.name);
    });
  });
  if (other != promise.starts.end()) std::rotate(promise.starts.begin() + 1, other, other + 1);
  putKindsFirst(promise, candidate.declared, mostKinds);
  return promise;
}

/// True if an effect that another one needs is none of `there` and promises something by itself: then that one is due.
bool waitsFor(const EffectLibrary& library, const std::string& effect, const std::vector<PlacedEffect>& there,
              const std::vector<EffectCandidate>& candidates, const std::vector<Promise>& promises) {
  const std::vector<std::string> needs = library.make(effect)->needs();
  const auto isNeeded = [&](const std::string& name) { return std::ranges::count(needs, name) > 0; };
  if (std::ranges::any_of(there, isNeeded, &PlacedEffect::effect)) return false;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    if (isNeeded(candidates[c].effect) && promises[c].excited) return true;
  return false;
}

/// What has no fit comes last.
bool isBetter(const TriedCandidate& a, const TriedCandidate& b) {
  if (a.attempt.fitted != b.attempt.fitted) return a.attempt.fitted;
  return a.attempt.fitted && costsLess(a.fit, b.fit);
}

std::string reasonOf(const Promise& promise) {
  if (promise.excited)
    return "screening: would take away " + percent(promise.share) + " of the squared error, others more";
  return promise.refused ? "the scene refuses it at the sizes that were tried"
                         : "the recordings are not sensitive to it at a typical size";
}

}  // namespace

Screening Screener::screenBeside(const std::vector<Fit>& models, const Eligible& eligible, const Linearised* known,
                                 const SearchThresholds::Screening& limits, const std::string& stage, double from,
                                 double to) const {
  Screening screening;
  for (const Fit& fit : models)
    screening.bases.push_back({fit, known && screening.bases.empty() ? *known : linearise(service_.problem(), fit)});
  std::vector<EffectCandidate> candidates = service_.candidatesBeside(screening.bases[0].fit.model);
  std::erase_if(candidates, [&](const EffectCandidate& c) { return !eligible(c); });
  std::vector<std::vector<Screened>> screened;
  std::vector<double> totals;
  const double part = to - from;
  for (const FitBase& base : screening.bases) {
    const auto count = static_cast<double>(screening.bases.size());
    const double begin = from + part * static_cast<double>(screened.size()) / count;
    screened.push_back(screen(service_.problem(), base.fit, base.linear, candidates, service_.options().jobs,
                              service_.reporter("screening" + stage, candidates.size(), begin, begin + part / count),
                              limits));
    totals.push_back(base.linear.profiled.squaredNorm());
  }
  for (std::size_t c = 0; c < candidates.size(); ++c)
    screening.promises.push_back(
        promiseOf(candidates[c], c, screened, totals, service_.thresholds().candidates.mostKinds));
  const std::vector<PlacedEffect> there = screening.bases[0].fit.model.simulator(service_.problem()).effects;
  std::vector<bool> waits(candidates.size());
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    waits[c] = waitsFor(service_.problem().library, candidates[c].effect, there, candidates, screening.promises);
    if (!waits[c]) continue;
    screening.promises[c].starts.clear();
    screening.promises[c].share = 0;
  }
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return screening.promises[a].share > screening.promises[b].share;
  });
  for (const std::size_t i : order) {
    const Promise& promise = screening.promises[i];
    TriedCandidate each;
    each.promise = i;
    each.attempt.candidate = candidates[i];
    each.attempt.share = promise.share;
    each.attempt.excited = promise.excited;
    each.attempt.rank = static_cast<int>(screening.tried.size()) + 1;
    if (!promise.starts.empty()) each.attempt.values = promise.starts[0].from.effect;
    each.attempt.reason = waits[i] ? "looked for only beside an effect that comes first" : reasonOf(promise);
    screening.tried.push_back(std::move(each));
  }
  return screening;
}

void Screener::fitFrom(Screening& screening, const std::vector<std::size_t>& which, std::size_t start,
                       const std::string& stage, double from, double to) const {
  std::vector<FitJob> jobs;
  std::vector<std::size_t> owner;
  for (const std::size_t k : which) {
    const TriedCandidate& each = screening.tried[k];
    const Promise& promise = screening.promiseOf(each);
    if (start >= promise.starts.size()) continue;
    const FitStart& at = promise.starts[start];
    const FitBase& base = screening.bases[at.base];
    FitModel model = base.fit.model.with(service_.problem(), each.attempt.candidate.placed(at.from.effect));
    std::copy(at.from.parameters.begin(), at.from.parameters.end(), model.values.begin());
    jobs.push_back({model, base.fit.shifts, &base.linear});
    owner.push_back(k);
  }
  const auto fits =
      service_.tryFits(jobs, service_.thresholds().screening.iterations, "fitting candidates" + stage, from, to);
  keepBetter(screening, owner, fits);
}

void Screener::fitKinds(Screening& screening, const std::vector<std::size_t>& all,
                        const std::vector<std::size_t>& twice, const std::string& stage, double at) const {
  for (std::size_t start = 1; true; ++start) {
    std::vector<std::size_t> left;
    for (const std::size_t k : all)
      if (start < screening.promiseOf(screening.tried[k]).kinds && (start > 1 || !std::ranges::count(twice, k)))
        left.push_back(k);
    if (start > 1 && left.empty()) return;
    fitFrom(screening, left, start, stage, at, at);
  }
}

std::vector<std::size_t> Screener::fitBesideHeld(Screening& screening, const std::string& stage, double at) const {
  const SearchThresholds::Screening& limits = service_.thresholds().screening;
  const FitProblem& problem = service_.problem();
  std::vector<EffectCandidate> candidates;
  for (const TriedCandidate& each : screening.tried) candidates.push_back(each.attempt.candidate);
  std::vector<std::size_t> fitted;
  for (std::size_t b = 1; b < screening.bases.size(); ++b) {
    const Fit& free = screening.bases[b].fit;
    // No effects yet: what its simulator has without parameters are the numbers as given.
    const Fit held{FitModel{}, free.shifts, 0};
    const std::vector<Screened> screened =
        screen(problem, held, linearise(problem, held), candidates, service_.options().jobs,
               service_.reporter(stage, candidates.size(), at, at), limits);
    std::vector<std::size_t> best;
    for (std::size_t k = 0; k < screened.size(); ++k)
      if (!screened[k].starts.empty()) best.push_back(k);
    std::ranges::stable_sort(best, std::greater(), [&](std::size_t k) { return screened[k].starts[0].share; });
    if (best.size() > limits.fromGiven) best.resize(limits.fromGiven);

    std::vector<FitJob> jobs;
    for (const std::size_t k : best)
      jobs.push_back({held.model.with(problem, candidates[k].placed(screened[k].starts[0].effect)), held.shifts});
    const auto alone = service_.tryFits(jobs, limits.iterations, stage, at, at);
    jobs.clear();
    std::vector<std::size_t> owner;
    for (std::size_t i = 0; i < best.size(); ++i)
      if (alone[i]) {
        jobs.push_back({free.model.with(problem, alone[i]->model.fittedEffect(problem, 0)), alone[i]->shifts});
        owner.push_back(best[i]);
      }
    keepBetter(screening, owner, service_.tryFits(jobs, limits.iterations, stage, at, at));
    fitted.insert(fitted.end(), owner.begin(), owner.end());
  }
  return fitted;
}

void Screener::keepBetter(Screening& screening, const std::vector<std::size_t>& owner,
                          const std::vector<std::optional<Fit>>& fits) const {
  for (std::size_t i = 0; i < fits.size(); ++i) {
    TriedCandidate& each = screening.tried[owner[i]];
    if (!fits[i]) {
      if (!each.attempt.fitted) each.attempt.reason = "the scene refuses the numbers of its fit";
    } else if (!each.attempt.fitted || fits[i]->cost < each.fit.cost) {
      each.fit = *fits[i];
      each.attempt.fitted = true;
    }
  }
}

bool Screener::isContained(const Screening& screening, std::size_t k, const std::vector<std::size_t>& in) const {
  const std::vector<TriedCandidate>& tried = screening.tried;
  return std::any_of(in.begin(), in.end(), [&](std::size_t of) {
    return isRicher(service_.problem().library, tried[of].attempt.candidate, tried[k].attempt.candidate.placed({}));
  });
}

void Screener::fitPromising(Screening& screening, std::size_t toFit, bool inWindows, const std::string& stage,
                            double from, double to) const {
  const SearchThresholds::Screening& limits = service_.thresholds().screening;
  std::vector<TriedCandidate>& tried = screening.tried;
  const std::string what = "fitting candidates" + stage;
  const double middle = from + 0.6 * (to - from);
  std::vector<std::size_t> promising;
  for (std::size_t k = 0; k < tried.size() && promising.size() < toFit; ++k)
    if (!screening.promiseOf(tried[k]).starts.empty() &&
        tried[k].attempt.share >= std::max(limits.leastOfGain * service_.thresholds().confirmation.leastGain,
                                           limits.leastOfBest * tried[0].attempt.share))
      promising.push_back(k);
  fitFrom(screening, promising, 0, stage, from, middle);
  std::stable_sort(promising.begin(), promising.end(),
                   [&](std::size_t a, std::size_t b) { return isBetter(tried[a], tried[b]); });
  // The better half once more from elsewhere, and the simpler effects that they contain.
  std::vector<std::size_t> again = promising;
  if (again.size() > toFit / 2) again.resize(toFit / 2);
  for (std::size_t k = again.size(); k < promising.size(); ++k)
    if (isContained(screening, promising[k], again)) again.push_back(promising[k]);
  fitFrom(screening, again, 1, stage, middle, to);
  fitKinds(screening, promising, again, stage, to);
  for (const std::size_t k : fitBesideHeld(screening, what, to))
    if (std::ranges::find(promising, k) == promising.end()) promising.push_back(k);
  std::erase_if(promising, [&](std::size_t k) { return !tried[k].attempt.fitted; });

  const auto bestOfThem = [&] {
    return *std::ranges::min_element(promising, {}, [&](std::size_t k) { return tried[k].fit.cost; });
  };
  const double least = promising.empty() ? 0 : tried[bestOfThem()].fit.cost;
  for (const std::size_t k : promising)
    if (inWindows && tried[k].fit.cost <= limits.inReach * least)
      restartWholeNumberInWindows(service_, tried[k].fit, screening.bases[0].fit.model, what, to);
  if (inWindows && !promising.empty() &&
      service_.leftBy(tried[bestOfThem()].fit) > service_.thresholds().drawnEffects.leastLeft) {
    std::vector<Fit> models;
    for (const FitBase& base : screening.bases) models.push_back(base.fit);
    restartFromDrawsInWindows(service_, tried, promising, models, what, to);
  }
  std::stable_sort(tried.begin(), tried.end(), isBetter);
  for (TriedCandidate& each : tried)
    if (each.attempt.fitted && each.fit.cost > tried[0].fit.cost)
      each.attempt.reason = "fitted: leaves " + digits(each.fit.cost / tried[0].fit.cost, 2) +
                            " times the squared error that " + tried[0].attempt.candidate.text() + " leaves";
}

std::vector<std::size_t> Screener::fitRest(Screening& screening, double leastPromise, const std::string& stage,
                                           double at) const {
  const SearchThresholds::Screening& limits = service_.thresholds().screening;
  const std::vector<TriedCandidate>& tried = screening.tried;
  std::vector<std::size_t> rest;
  for (std::size_t k = 0; k < tried.size() && rest.size() < limits.lastChance; ++k)
    if (!tried[k].attempt.fitted && !screening.promiseOf(tried[k]).starts.empty() &&
        tried[k].attempt.share >= leastPromise)
      rest.push_back(k);
  for (const std::size_t start : {0, 1}) fitFrom(screening, rest, start, stage, at, at);
  fitKinds(screening, rest, rest, stage, at);
  std::erase_if(rest, [&](std::size_t k) { return !tried[k].attempt.fitted; });
  std::stable_sort(rest.begin(), rest.end(),
                   [&](std::size_t a, std::size_t b) { return isBetter(tried[a], tried[b]); });
  if (rest.size() > limits.lastChanceConfirmed) rest.resize(limits.lastChanceConfirmed);
  return rest;
}

}  // namespace btr
