#include "core/gap/search/laws/law_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/replay/followed_torques.h"
#include "core/gap/search/laws/law_screen.h"
#include "core/gap/search/laws/other_settings.h"
#include "core/gap/search/model_comparison.h"
#include "core/gap/search/selection.h"
#include "core/spec/error.h"

namespace btr {
namespace {

bool knowsLaws(const EffectLibrary& library) {
  return std::ranges::find(library.names, measuredLaw) != library.names.end();
}

/// Laws are of joints. A walk's rest is what its feet do.
bool canLearn(const FitProblem& problem) {
  if (problem.walks || !knowsLaws(problem.library)) return false;
  const Binding& binding = problem.trials[0].binding;
  return std::ranges::any_of(binding.measured, [&](const Binding::Measured& measured) {
    return measured.what == Binding::Measured::What::position || isFollowedTorque(binding, measured);
  });
}

/// Finds a law step by step: one curve, then a second.
class LawSearch {
 public:
  LawSearch(const FitProblem& problem, const FitModel& named, int jobs, const SearchThresholds& thresholds)
      : problem_(problem), named_(named), jobs_(jobs), limits_(thresholds.law) {}

  /// The law `there` with one curve more, fitted and scored; nothing where none promises anything, or the best one
  /// leaves more than `hopeless` after a short fit.
  std::optional<LearnedLaw> extend(const Law& there, const Fit& fit, const Linearised& linear,
                                   double hopeless = std::numeric_limits<double>::infinity());
  std::size_t looked() const { return looked_; }

 private:
  /// A law's values scaled so that the start is no worse than without its last term.
  Law damped(Law law, const Fit& fit) const;
  Fit fitted(const Law& law, const Fit& from, int iterations) const;
  /// Cross-validated, and carried on as long as much is left and more iterations take some of it: an unfinished curve
  /// looks as if it needed a name beside it.
  LearnedLaw polished(LearnedLaw learned) const;
  LearnedLaw scored(const Fit& fit, const Law& law) const;
  /// Which of the options predicts other blocks best after a short fit in replay, if it leaves at most `hopeless`.
  const LawOption* best(const std::vector<LawOption>& options, const Fit& fit, double hopeless) const;

  const FitProblem& problem_;
  FitModel named_;
  int jobs_;
  const SearchThresholds::Law& limits_;
  std::size_t looked_ = 0;
};

Law LawSearch::damped(Law law, const Fit& fit) const {
  const FitModel named = withNumbersOf(named_, fit.model);
  const std::vector<double> full = law.values.back();
  double least = INFINITY;
  Law best = law;
  for (const double length : {1.0, 0.5, 0.2, 0.0}) {
    for (std::size_t i = 0; i < full.size(); ++i) law.values.back()[i] = length * full[i];
    const double cost = residualsOf(problem_, law.in(problem_, named, true), fit.shifts).squaredNorm();
    if (cost < least) {
      least = cost;
      best = law;
    }
  }
  return best;
}

Fit LawSearch::fitted(const Law& law, const Fit& from, int iterations) const {
  return fitModel(problem_, law.in(problem_, withNumbersOf(named_, from.model)), from.shifts, {iterations});
}

LearnedLaw LawSearch::scored(const Fit& fit, const Law& law) const {
  LearnedLaw learned{law.of(fit.model), {}, linearise(problem_, fit), {}, 0, 1};
  learned.scored = crossValidate(problem_, fit, learned.linear);
  return learned;
}

LearnedLaw LawSearch::polished(LearnedLaw learned) const {
  for (int more = 0; more < limits_.polishings && excessOf(learned.scored) > limits_.leastExcess; ++more) {
    // A curve has many knots: its sensitivities, which scoring took, begin the next fit.
    FitOptions onwards{limits_.iterations};
    onwards.inherited = &learned.linear;
    const Fit& fit = learned.scored.fit;
    LearnedLaw next = scored(fitModel(problem_, fit.model, fit.shifts, onwards), learned.law);
    const bool settled = next.scored.mean() > limits_.settled * learned.scored.mean();
    if (next.scored.mean() < learned.scored.mean()) learned = std::move(next);
    if (settled) break;
  }
  return learned;
}

const LawOption* LawSearch::best(const std::vector<LawOption>& options, const Fit& fit, double hopeless) const {
  std::size_t count = 0;
  while (count < options.size() && count < limits_.fitted && options[count].share >= limits_.ofBest * options[0].share)
    ++count;
  const auto errors = parallel(count > 1 ? jobs_ : 1, count, [&](std::size_t i) -> std::vector<double> {
    FitProblem alone = problem_;
    if (count > 1) alone.jobs = 1;
    const FitModel model = damped(options[i].law, fit).in(alone, withNumbersOf(named_, fit.model));
    return {crossValidate(alone, fitModel(alone, model, fit.shifts, {limits_.firstIterations})).mean()};
  });
  const LawOption* chosen = nullptr;
  double least = hopeless;
  for (std::size_t i = 0; i < count; ++i)
    if (errors[i].ok() && errors[i].numbers[0] < least) {
      least = errors[i].numbers[0];
      chosen = &options[i];
    }
  return chosen;
}

std::optional<LearnedLaw> LawSearch::extend(const Law& there, const Fit& fit, const Linearised& linear,
                                            double hopeless) {
  const std::vector<LawOption> options = screenLaws(problem_, named_, fit, linear, there, jobs_, limits_);
  looked_ += options.size();
  const LawOption* option = options.empty() ? nullptr : best(options, fit, hopeless);
  if (!option) return std::nullopt;
  const LawOption finer = refineTerm(problem_, named_, fit, linear, there, *option, jobs_, limits_);
  std::optional<LearnedLaw> learned;
  for (const Law& law : {finer.law, option->law}) {
    if (learned && law.terms.back().knots == learned->law.terms.back().knots) break;
    LearnedLaw next = polished(scored(fitted(damped(law, fit), fit, limits_.iterations), law));
    if (!learned || next.scored.mean() < learned->scored.mean()) learned = std::move(next);
  }
  // What few knots leave of a curve that bends much is seen only once they are where they belong. (Beside a first curve
  // a name is preferred to what a second one could follow so.)
  while (learned && there.terms.empty() && excessOf(learned->scored) > limits_.leastExcess &&
         learned->law.terms.back().knots < std::min(limits_.knots, mostLawKnots)) {
    const Law law = denserLaw(problem_, named_, learned->scored.fit, learned->linear, learned->law, jobs_, limits_);
    if (law.terms.back().knots <= learned->law.terms.back().knots) break;
    LearnedLaw denser = polished(scored(fitted(law, learned->scored.fit, limits_.iterations), law));
    if (denser.scored.mean() > limits_.settled * learned->scored.mean()) break;
    learned = std::move(denser);
  }
  return learned;
}

void measure(const FitProblem& problem, LearnedLaw& law) {
  if (law.linear.residuals.size() == 0) law.linear = linearise(problem, law.scored.fit);
  law.uncertainty = uncertaintyOf(problem, law.scored.fit, law.linear);
}

Scored fitAndScore(const FitProblem& problem, const FitModel& model, const std::vector<std::vector<double>>& shifts,
                   int iterations) {
  return crossValidate(problem, fitModel(problem, model, shifts, {iterations}));
}

/// The largest change of an effect's size, as a factor ≥ 1, from one model to another.
double changeOfSize(const FitModel& from, const FitModel& to, int effect) {
  double most = 1;
  for (std::size_t i = 0; i < from.parameters.size(); ++i) {
    const FitParameter& p = from.parameters[i];
    if (p.effect != effect || !p.hasNeutral || !std::isfinite(p.given)) continue;
    const double before = from.values[i] - p.given, after = to.values[i] - p.given;
    if (std::abs(before) < 1e-3 * p.scale) continue;
    most = std::max(most, before * after > 0 ? std::max(before / after, after / before) : INFINITY);
  }
  return most;
}

/// Takes an effect back from what was found; the final simulator is then that of `scored`.
void takeBack(const FitProblem& problem, SearchResult& found, std::size_t effect, const Scored& scored,
              const std::string& why) {
  const std::string text = found.effects[effect].effect.text();
  conclude(found.attempts, text, false, why);
  found.effects.erase(found.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  for (Found& other : found.effects) {
    // Their fits have the effect that fell.
    other.rivalFits.clear();
    other.rivalUncertainties.clear();
  }
  found.final = scored;
  found.finalLinear = linearise(problem, scored.fit);
  found.finalUncertainty = uncertaintyOf(problem, scored.fit, found.finalLinear);
  found.ladder.push_back(rungOf("− " + text, scored));
}

constexpr const char* aCurveDoes = "a curve that was learned does as well without it";

/// Whether a name takes all but a small part of what a curve in its place does: that is the name once more, drawn by
/// knots. Mean squared errors with neither, with the name, with the curve.
bool isTheNameItself(double neither, double named, double curve, const SearchThresholds::Law& limits) {
  return neither - named > limits.asNamed * (neither - curve);
}

/// Effects that are not missed with the law beside them, or only as another size, fall; the least missed one first. One
/// without which there is no law, or that the law would only repeat, stays, and the law goes.
void dropWhatTheLawReplaces(const FitProblem& problem, SearchResult& found, LawBesideNames& result,
                            const SearchThresholds& thresholds) {
  const SearchThresholds::Law& limits = thresholds.law;
  while (result.law && !found.effects.empty()) {
    const Scored& both = result.law->scored;
    std::optional<std::size_t> fallen;
    double leastT = INFINITY;
    for (std::size_t i = 0; i < found.effects.size(); ++i) {
      const Scored without = fitAndScore(problem, both.fit.model.without(i), both.fit.shifts, limits.iterations);
      const double t = compare(without.blocks, both.blocks).t;
      const bool isOther = changeOfSize(found.final.fit.model, both.fit.model, static_cast<int>(i)) > limits.keepsSize;
      if (isMissed(without, both, thresholds.confirmation) && !isOther) continue;
      if (t >= leastT) continue;
      leastT = t;
      fallen = i;
    }
    if (!fallen) return;
    const SearchResult before = found;
    const FitModel model = found.final.fit.model.without(*fallen);
    takeBack(problem, found, *fallen, fitAndScore(problem, model, found.final.fit.shifts, limits.iterations),
             aCurveDoes);
    const double neither = found.final.mean(), named = before.final.mean();
    result.law = learnLaw(problem, found.final, found.finalLinear, problem.jobs, thresholds);
    if (result.law && isTheNameItself(neither, named, result.law->scored.mean(), limits)) result.law.reset();
    if (result.law)
      result.fell.push_back(before.effects[*fallen].effect.text());
    else
      found = before;
  }
}

/// A law alone, in the place of all names, where it does clearly better than these and as well as both together.
bool standsAlone(const LearnedLaw& alone, const SearchResult& found, const LawBesideNames& beside,
                 const SearchThresholds::Law& limits) {
  if (alone.scored.mean() >= limits.standsAlone * found.final.mean()) return false;
  if (compare(found.final.blocks, alone.scored.blocks).t <= limits.leastT) return false;
  return !beside.law || alone.scored.mean() <= limits.asWell * beside.law->scored.mean();
}

/// By a paired test among all that was looked at, and by its share of what was left beyond the noise.
bool passes(const Scored& before, const Scored& after, double share, std::size_t looked,
            const SearchThresholds::Law& limits) {
  const PairedTest test = compare(before.blocks, after.blocks);
  return test.t > limits.leastT && test.pValue * static_cast<double>(looked) <= limits.mostFalse &&
         before.mean() - after.mean() >= share * excessOf(before);
}

void rate(LearnedLaw& law, const Scored& without, std::size_t looked) {
  law.shareOfRest = std::clamp(1 - law.scored.mean() / without.mean(), 0.0, 1.0);
  law.pValue = std::min(
      1.0, compare(without.blocks, law.scored.blocks).pValue * static_cast<double>(std::max<std::size_t>(1, looked)));
}

Scored withoutEffects(const FitProblem& problem, const SearchResult& found, int iterations) {
  FitModel model = found.final.fit.model;
  while (!model.effects.empty()) model = model.without(model.effects.size() - 1);
  return fitAndScore(problem, model, found.calibrated.fit.shifts, iterations);
}

/// The law with a second curve, where it takes enough of what the first leaves. `without`: the model without a law.
std::optional<LearnedLaw> secondCurve(const FitProblem& problem, const LearnedLaw& first, const Scored& without,
                                      int jobs, const SearchThresholds& thresholds) {
  LawSearch search(problem, first.scored.fit.model.without(first.scored.fit.model.effects.size() - 1), jobs,
                   thresholds);
  auto two = search.extend(first.law, first.scored.fit, first.linear);
  if (!two || !passes(first.scored, two->scored, thresholds.law.secondShare, search.looked(), thresholds.law) ||
      !holdsAtOtherSettings(problem, first.scored.fit, two->scored.fit, thresholds.law.iterations))
    return std::nullopt;
  measure(problem, *two);
  rate(*two, without, search.looked());
  return two;
}

/// Looks for names once more, with the law in the simulator: what is large hides what is small. They count where both
/// together do clearly better than the law, and as well as a second curve in their place. True: `found` has them, and
/// a final simulator of them alone; the result has the law fitted together with them.
bool nameBesideLaw(const FitProblem& problem, SearchResult& found, LawBesideNames& result,
                   const std::optional<LearnedLaw>& second, const SearchOptions& options) {
  const SearchThresholds::Law& limits = options.thresholds.law;
  FitProblem withLaw = problem;
  withLaw.given.effects.push_back(result.law->law.placed());
  SearchOptions again = options;
  if (options.progress)
    again.progress = [&](const std::string& stage, double share) {
      return options.progress(stage + " beside a law", share);
    };
  const SearchResult names = searchEffects(withLaw, again);
  if (names.unstable || names.effects.empty()) return false;
  const FitModel& named = names.final.fit.model;
  const Fit fit = fitModel(problem, result.law->law.in(problem, named), names.final.fit.shifts, {limits.iterations});
  LearnedLaw both{result.law->law.of(fit.model), crossValidate(problem, fit), {}, {}, 0, 1};
  if (!passes(result.law->scored, both.scored, limits.secondShare, 1, limits)) return false;
  if (second && both.scored.mean() > limits.asWell * second->scored.mean()) return false;
  const Scored without = fitAndScore(problem, named, found.final.fit.shifts, limits.iterations);
  measure(problem, both);
  rate(both, without, 1);
  found.effects = names.effects;
  for (Found& each : found.effects) {
    // Their simulators have a law that the problem does not.
    each.rivalFits.clear();
    each.rivalUncertainties.clear();
  }
  found.attempts = names.attempts;
  found.final = without;
  found.finalLinear = linearise(problem, without.fit);
  found.finalUncertainty = uncertaintyOf(problem, without.fit, found.finalLinear);
  found.ladder.push_back(rungOf("+ " + named.text(), without));
  result.law = std::move(both);
  return true;
}

}  // namespace

std::optional<LearnedLaw> learnLaw(const FitProblem& problem, const Scored& without, const Linearised& linear, int jobs,
                                   const SearchThresholds& thresholds, double hopeless) {
  const SearchThresholds::Law& limits = thresholds.law;
  if (excessOf(without) < limits.leastExcess || !canLearn(problem)) return std::nullopt;
  LawSearch search(problem, without.fit.model, jobs, thresholds);
  auto law = search.extend({}, without.fit, linear, hopeless);
  if (!law || !passes(without, law->scored, limits.leastShare, search.looked(), limits) ||
      !holdsAtOtherSettings(problem, without.fit, law->scored.fit, limits.iterations))
    return std::nullopt;
  measure(problem, *law);
  rate(*law, without, search.looked());
  return law;
}

LawBesideNames learnBesideNames(const FitProblem& problem, SearchResult& found, const SearchOptions& options) {
  const SearchThresholds& thresholds = options.thresholds;
  const int jobs = options.jobs;
  LawBesideNames result;
  result.applies = canLearn(problem);
  if (!result.applies) return result;
  const double left = found.final.mean() - stepErrorOf(found.stepChange);
  if (left < 1 + thresholds.law.leastExcess + imperfectionOf(found.calibrated, found.final, thresholds.screening))
    return result;
  result.law = learnLaw(problem, found.final, found.finalLinear, jobs, thresholds);
  if (!found.effects.empty()) {
    const auto bare = withoutEffects(problem, found, thresholds.law.iterations);
    const double inReach = thresholds.law.standsAlone * thresholds.screening.hopeless * found.final.mean();
    auto alone = learnLaw(problem, bare, linearise(problem, bare.fit), jobs, thresholds, inReach);
    if (alone && standsAlone(*alone, found, result, thresholds.law)) {
      while (!found.effects.empty()) {
        result.fell.push_back(found.effects.back().effect.text());
        takeBack(problem, found, found.effects.size() - 1, bare, aCurveDoes);
      }
      result.law = std::move(alone);
    } else {
      dropWhatTheLawReplaces(problem, found, result, thresholds);
    }
  }
  const bool unnamed = found.effects.empty();
  if (result.law && excessOf(result.law->scored) > thresholds.law.leastExcess) {
    auto second = secondCurve(problem, *result.law, found.final, jobs, thresholds);
    const bool named = unnamed && nameBesideLaw(problem, found, result, second, options);
    if (!named && second) result.law = std::move(second);
  }
  // Little that is left beside names, with little shape, puts no curve into the simulator.
  const SearchThresholds::Verdict& verdict = thresholds.verdict;
  const bool isLittle = unnamed
                            ? left <= verdict.unexplained
                            : left <= verdict.clearlyLeft && result.law && result.law->shareOfRest <= verdict.shapeLeft;
  if (isLittle) result.law.reset();
  return result;
}

SearchResult withLearned(const FitProblem& problem, const SearchResult& found, const LearnedLaw& law) {
  SearchResult with = found;
  with.final = law.scored;
  with.finalLinear = law.linear;
  with.finalUncertainty = law.uncertainty;
  with.ladder.push_back(rungOf("+ measured_law at " + law.law.at, law.scored));
  FitProblem finer = problem;
  finer.scene.step_s /= 2;
  with.stepChange = law.linear.residuals - residualsOf(finer, law.scored.fit.model, law.scored.fit.shifts);
  return with;
}

}  // namespace btr
