// Structure search: which effects does the simulator lack?
#include "core/gap/search/search.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/gap/fit/block_scores.h"
#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/starts_anew.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/search_run.h"
#include "core/spec/cancelled.h"
#include "core/spec/random.h"

namespace btr {
void conclude(std::vector<Attempt>& attempts, const std::string& candidate, bool accepted, const std::string& reason) {
  for (Attempt& attempt : attempts)
    if (attempt.candidate.text() == candidate) {
      attempt.accepted = accepted;
      attempt.reason = reason;
    }
}

bool SearchRun::promisesAPair(const std::vector<Tried>& tried) const {
  const double least = limits().screening.pairPromise;
  return std::any_of(tried.begin(), tried.end(), [&](const Tried& each) { return each.attempt.share > least; });
}

Scored SearchRun::calibrate() {
  const FitModel given = givenModel(problem_);
  if (given.parameters.empty()) {
    std::vector<Fit> asIs{scoreAsIs(problem_, {given, {}, 0}).fit};
    refineStep(asIs, 1, "calibrating", 0.05);
    return scoreAsIs(problem_, asIs[0]);
  }
  // From the numbers as given, and from two drawn around them.
  std::vector<FitModel> starts{given, given, given};
  Random random = Random::forPurpose(options_.seed, "calibration starts");
  for (std::size_t s = 1; s < starts.size(); ++s)
    for (std::size_t i = 0; i < given.values.size(); ++i) {
      const FitParameter& p = given.parameters[i];
      starts[s].values[i] = std::clamp(p.given + limits().calibration.startSpread * p.scale * random.uniform(-1, 1),
                                       p.minimum, p.maximum);
    }
  std::vector<Fit> fits = fitAll({{given, {}}}, limits().calibration.iterations, "calibrating", 0.02, 0.05);
  // ½ a residual is the cost of noise alone: then there is nothing to look for elsewhere.
  if (fits[0].cost > limits().calibration.leastForStarts * static_cast<double>(problem_.residuals())) {
    const std::vector<Fit> others = thoseOf(
        tryFits({{starts[1], {}}, {starts[2], {}}}, limits().calibration.startIterations, "calibrating", 0.05, 0.08));
    fits.insert(fits.end(), others.begin(), others.end());
  }
  std::vector<Fit> best{*std::min_element(fits.begin(), fits.end(), costsLess)};
  if (problem_.walks && fits.size() > 1) scatter(best[0], "calibrating", 0.08);
  startAnew(best[0], "calibrating", 0.08);
  // A step that was harmless beside the error as given may not be so beside what is left of it.
  refineStep(best, 1, "calibrating", 0.08);
  return scoreAll(best, "calibrating", 0.08, 0.1)[0];
}

/// Of a fit that ended where single trials stuck, all numbers once more.
void SearchRun::startAnew(Fit& fit, const std::string& stage, double at) const {
  const Fit anew = withStartsAnew(problem_, fit);
  if (anew.shifts == fit.shifts) return;
  const Fit all = fitOn({anew}, limits().calibration.againIterations, stage, at, at)[0];
  fit = costsLess(all, anew) ? all : anew;
}

/// What was accepted is fitted on where it still is far from the noise: a curved valley takes its iterations.
Scored SearchRun::converged(const Scored& scored, const std::string& stage, double at) {
  if (excessOf(scored) < limits().calibration.leastToFitOn) return scored;
  std::vector<Fit> fits = fitOn({scored.fit}, limits().calibration.toTheEnd, stage, at, at);
  startAnew(fits[0], stage, at);
  climbWholeNumbers(fits[0], stage, at);
  refineStep(fits, 1, stage, at);
  const Scored better = scoreAll(fits, stage, at, at)[0];
  Scored same = scored;
  bringToStep(same, stage, at);
  return better.mean() < same.mean() ? better : same;
}

void SearchRun::settle(SearchResult& result, bool fitToTheEnd, const std::string& stage, double at) {
  if (fitToTheEnd) result.final = converged(result.final, stage, at);
  bringToStep(result.final, stage, at);
  result.ladder.back() = step(result.ladder.back().what, result.final);
}

GapReport::Step SearchRun::step(const std::string& what, const Scored& scored) const {
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

void SearchRun::remember(std::vector<Attempt>& attempts, const Attempt& attempt) const {
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

/// Of the first effect, the numbers as given are a base as well where calibration went far and left much: there it may
/// have bent them to take up what is missing.
std::vector<Fit> SearchRun::basesOf(const SearchResult& result, bool first) const {
  std::vector<Fit> bases{result.final.fit};
  if (!first || excessOf(result.final) < limits().calibration.muchLeft) return bases;
  const FitModel& model = result.final.fit.model;
  FitModel given = model;
  bool far = false;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    given.values[i] = model.parameters[i].given;
    far = far ||
          std::abs(model.values[i] - given.values[i]) > limits().calibration.farFromGiven * model.parameters[i].scale;
  }
  if (far) bases.push_back({given, result.given.fit.shifts, 0});
  return bases;
}

SearchResult SearchRun::run() {
  SearchResult result;
  if (options_.progress && !options_.progress("replaying as given", 0)) throw Cancelled{};
  result.given = scoreAsIs(problem_, {givenModel(problem_), {}, 0});
  result.ladder.push_back(step("as given", result.given));
  const double givenStep_s = problem_.scene.step_s;
  result.calibrated = calibrate();
  if (problem_.scene.step_s < givenStep_s)
    result.given = scoreAsIs(problem_, {givenModel(problem_), result.given.fit.shifts, 0});
  // Where the fit began a trial may suit the numbers as given, too: what they are worth must not hang on where the
  // search for the initial states began.
  Scored again = scoreAsIs(problem_, {givenModel(problem_), result.calibrated.fit.shifts, 0});
  if (again.fit.cost < result.given.fit.cost) result.given = std::move(again);
  result.ladder.back() = step("as given", result.given);
  const std::vector<double> inside = blockScores(
      problem_, residualsOf(problem_, result.calibrated.fit.model, result.calibrated.fit.shifts), Fold::all);
  double fitted = 0, blocks = 0;
  for (const double block : inside)
    if (block >= 0) {
      fitted += block;
      ++blocks;
    }
  if (problem_.window_s == 0 && blocks > 0 &&
      result.calibrated.mean() > limits().calibration.unstableRatio * fitted / blocks &&
      result.calibrated.mean() > limits().calibration.unstableError) {
    result.unstable = true;
    return result;
  }
  // Never worse than what was given.
  if (result.calibrated.mean() >= result.given.mean()) result.calibrated = result.given;
  result.ladder.push_back(step("calibrated", result.calibrated));
  search_s_ = problem_.scene.step_s;
  result.calibratedLinear = linearise(problem_, result.calibrated.fit);
  result.calibratedUncertainty = uncertaintyOf(problem_, result.calibrated.fit, result.calibratedLinear);
  result.final = result.calibrated;
  holdUntold(result);

  bool recalibrated = false;
  std::optional<Choice> choice;  // of the last effect, where it was accepted alone
  for (int stage = 0; stage < options_.maximumEffects; ++stage) {
    // What the integration itself is wrong by is not physics that was left out.
    if (result.final.mean() < limits().screening.nothingLeft + stepErrorOf(stepChange(result.final.fit))) break;
    const double from = 0.1 + 0.7 * stage / options_.maximumEffects, to = from + 0.7 / options_.maximumEffects;
    auto tried = tryCandidates(result.final, basesOf(result, stage == 0),
                               stage == 0 ? &result.calibratedLinear : nullptr, limits().screening.fitted,
                               stage == 0 ? "" : ", effect " + std::to_string(stage + 1), from, to, true);
    if (stage == 0) firstStage_ = tried;
    std::size_t winner = tried.size();
    for (std::size_t k = 0; k < tried.size(); ++k) {
      if (!tried[k].passes) continue;
      if (winner == tried.size())
        winner = k;
      else
        tried[k].attempt.reason = tried[winner].attempt.candidate.text() + " does better";
    }
    if (winner < tried.size()) tried[winner].attempt.accepted = true;
    for (const Tried& each : tried) remember(result.attempts, each.attempt);
    if (winner < tried.size()) {
      choice = Choice{result.final, tried[winner].attempt.candidate.text(), tried};
      choice->others.erase(choice->others.begin() + static_cast<std::ptrdiff_t>(winner));
      result.final = converged(tried[winner].scored, "confirming", to);
      if (stage == 0 && !recalibrated && calibrateFrom(result)) {
        recalibrated = true;
        choice.reset();
        --stage;
        continue;
      }
      result.ladder.push_back(step("+ " + tried[winner].attempt.candidate.text(), result.final));
    } else if (Scored pair; static_cast<int>(result.final.fit.model.effects.size()) + 2 <= options_.maximumEffects &&
                            excessOf(result.final) > limits().screening.lastChanceExcess && promisesAPair(tried) &&
                            tryPair(result.final, tried, pair)) {
      acceptPair(result, pair, "+ ");
      choice.reset();
      ++stage;
    } else if (choice && static_cast<int>(result.final.fit.model.effects.size()) < options_.maximumEffects &&
               chooseTwoOthers(result, *choice)) {
      choice.reset();
    } else {
      break;
    }
  }
  prune(result);
  takeApart(result);
  prune(result);
  if (!result.final.fit.model.effects.empty()) settle(result, true, "fitting once more", 0.86);
  findRivals(result);
  result.step_s = problem_.scene.step_s;
  measure(result);
  if (leaveUntold(result)) measure(result);
  measureRivals(result);
  result.refused = refused_->notes();
  return result;
}

void SearchRun::measure(SearchResult& result) const {
  result.stepChange = stepChange(result.final.fit);
  result.finalLinear = linearise(problem_, result.final.fit);
  result.finalUncertainty = uncertaintyOf(problem_, result.final.fit, result.finalLinear);
  result.finalUncertainty.unsettled = unsettled(problem_, result.final.fit, result.finalLinear, result.stepChange);
}

void SearchRun::measureRivals(SearchResult& result) const {
  for (Found& found : result.effects)
    for (const Fit& rival : found.rivalFits) {
      found.rivalUncertainties.push_back(uncertaintyOf(problem_, rival, linearise(problem_, rival)));
      if (options_.progress && !tell("what rivals would make of the numbers", 0.95)) throw Cancelled{};
    }
}

double excessOf(const Scored& scored) { return std::max(0.0, scored.mean() - 1); }

SearchResult searchEffects(const FitProblem& problem, const SearchOptions& options) {
  return SearchRun(problem, options).run();
}

}  // namespace btr
