#include "core/gap/search/confirmer.h"

#include <algorithm>
#include <cmath>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/search/model_comparison.h"
#include "core/gap/search/screening/search_discoveries.h"
#include "core/gap/search/starts/held_numbers.h"
#include "core/gap/search/starts/restarts.h"
#include "core/gap/search/starts/whole_numbers.h"
#include "core/spec/figures.h"

namespace btr {
bool isWithinHalfAStep(const FitProblem& problem, const FitModel& model, std::size_t effect) {
  bool isTime = false;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const FitParameter& p = model.parameters[i];
    const double size = std::abs(model.values[i] - p.given);
    if (p.effect != static_cast<int>(effect) || !p.hasNeutral || size == 0) continue;
    if (p.unit != "s" || size >= problem.givenStep_s / 2) return false;
    isTime = true;
  }
  return isTime;
}

void controlFalseDiscoveries(std::vector<TriedCandidate>& tried, double mostFalse) {
  // What the screening left behind counts as tested and found to be nothing.
  std::vector<double> pValues;
  for (const TriedCandidate& each : tried) pValues.push_back(each.attempt.scored ? each.attempt.comparison.pValue : 1);
  const std::vector<double> rates = falseDiscoveryRates(pValues);
  for (std::size_t k = 0; k < tried.size(); ++k) {
    tried[k].attempt.qValue = rates[k];
    if (!tried[k].passes || rates[k] <= mostFalse) continue;
    tried[k].passes = false;
    tried[k].attempt.reason =
        "among " + std::to_string(tried.size()) +
        " effects and places that were looked at, chance does as well (q = " + digits(rates[k], 2) + ")";
  }
}

bool Confirmer::isAtLeast(const Fit& fit) const {
  const SearchThresholds::Confirmation& limits = service_.thresholds().confirmation;
  const auto costAt = [&](double size) {
    return residualsOf(service_.problem(), resized(fit.model, size), fit.shifts).squaredNorm();
  };
  return isKnownFromBelow(costAt(0), costAt(1), costAt(limits.largerSize), limits);
}

Acceptance Confirmer::judge(const Scored& without, const Scored& with, std::size_t newEffect) const {
  const SearchThresholds::Confirmation& limits = service_.thresholds().confirmation;
  const PairedTest comparison = compare(without.blocks, with.blocks);
  const auto rejected = [&](const std::string& reason) { return Acceptance{false, comparison, reason}; };
  const double excess = excessOf(without);
  const double taken = without.mean() - with.mean();
  if (comparison.t < limits.leastT)
    return rejected(
        "not better on blocks that it was not fitted to (t = " + toText(std::round(10 * comparison.t) / 10) + ")");
  if (comparison.gain < limits.leastGain)
    return rejected("takes only " + percent(comparison.gain) + " of the cross-validated squared error");
  if (excess <= 0 || taken < limits.leastShareOfExcess * excess)
    return rejected("takes only " + percent(excess > 0 ? taken / excess : 0) + " of the excess error");
  // Standard errors count on sensitivities: where bounces or reversals make them rough, what takes most of a large
  // error is not small for that.
  const bool takesMost = excess > limits.largeExcess && taken > limits.mostOfExcess * excess;
  const double errors = with.sizes.at(newEffect);
  if (errors < limits.leastErrors && !takesMost && !isAtLeast(with.fit))
    return rejected("its size is only " + toText(std::round(10 * errors) / 10) + " standard errors");
  if (isWithinHalfAStep(service_.problem(), with.fit.model, newEffect))
    return rejected("lasts less than half a step of the scene, within which recordings may be read elsewhere");
  // Where feet land it stays far above the noise's share.
  const double ofIntegration = limits.timesIntegration * stepErrorOf(service_.stepChange(with.fit));
  if (taken < ofIntegration)
    return rejected("takes " + digits(taken, 2) + " noise floors² where the integration itself is wrong by about " +
                    digits(ofIntegration, 2));
  // What another engine's integration is wrong by shows first as a shift in time; the rest of it is smaller.
  const double ofShift = service_.thresholds().shift.ofTaken;
  if (taken < std::min(without.aligned.numericalFloor(ofShift), with.aligned.numericalFloor(ofShift)))
    return rejected("takes " + digits(taken, 2) +
                    " noise floors² where a shift in time of less than half a step makes " +
                    digits(with.aligned.took, 2));
  return {true, besideAFarthestShift(comparison, without, with, service_.thresholds().shift),
          "takes " + percent(comparison.gain) +
              " of the cross-validated squared error (t = " + toText(std::round(10 * comparison.t) / 10) + ")"};
}

std::vector<Fit> Confirmer::fitted(std::vector<TriedCandidate>& tried, std::vector<std::size_t>& which,
                                   const std::string& what, double from, double to) const {
  std::vector<FitJob> jobs;
  for (const std::size_t k : which) jobs.push_back({tried[k].fit.model, tried[k].fit.shifts});
  const auto refitted = service_.tryFits(jobs, service_.thresholds().confirmation.iterations, what, from, to);
  std::vector<std::size_t> left;
  std::vector<Fit> fits;
  for (std::size_t i = 0; i < which.size(); ++i) {
    if (refitted[i]) {
      left.push_back(which[i]);
      fits.push_back(*refitted[i]);
    } else {
      tried[which[i]].attempt.reason = "the scene refuses the numbers of its fit";
    }
  }
  which = left;
  return fits;
}

void Confirmer::restart(Fit& fit, double least, double worthTaking, const std::string& what, double at) const {
  const SearchThresholds::Confirmation& limits = service_.thresholds().confirmation;
  // Beside little that is left all are near the best; where a fit takes long, only that one is looked after.
  double left = service_.leftBy(fit);
  if (fit.cost > least && left > worthTaking) return;
  const SearchThresholds::ShortRace& race = service_.thresholds().shortRace;
  const double usual = race.isRun(left) ? race.worthMore : limits.worthMore;
  const double worth = service_.problem().walks ? limits.worthMoreOfWalks : usual;
  if (fit.cost > worth * least) return;
  climbWholeNumbers(service_, fit, what, at);
  left = service_.leftBy(fit);
  if (left > limits.leastForFarSizes && left < limits.mostForFarSizes && fit.cost <= least)
    restartFarOff(service_, fit, what, at);
  // What leaves no more than the noise may still stop behind a better one.
  if ((left > limits.leastForValley || fit.cost > limits.leastForValley * least) && left < limits.mostForValley)
    followValley(service_, fit, what, at);
}

std::optional<Scored> Confirmer::confirm(std::vector<TriedCandidate>& tried, const std::vector<std::size_t>& candidates,
                                         const Scored& without, double judged_s, const std::string& stage, double from,
                                         double to) {
  const SearchThresholds::Confirmation& limits = service_.thresholds().confirmation;
  const SearchThresholds::Step& ofStep = service_.thresholds().step;
  const std::string what = "confirming" + stage;
  const double half = (from + to) / 2;
  std::vector<std::size_t> which = candidates;
  std::vector<Fit> fits = fitted(tried, which, what, from, half);
  if (which.empty()) return std::nullopt;
  restartAtOtherSizes(service_, fits, what, half);
  releaseHeld(service_, held_, fits, what, half);

  // Effects may need finer steps than the simulator without them: friction at reversals, play. What fits far worse than
  // the best is no winner at any step.
  std::vector<std::size_t> close, all;  // of `all`, those that are far come first
  std::vector<Fit> closeFits, farFits;
  const double least = std::min_element(fits.begin(), fits.end(), costsLess)->cost;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const bool isClose = fits[i].cost <= ofStep.farWorse * least;
    (isClose ? close : all).push_back(which[i]);
    (isClose ? closeFits : farFits).push_back(fits[i]);
  }
  const double leftWithout = service_.leftBy(without.fit);
  const double leftByBest = service_.leftBy(*std::ranges::min_element(closeFits, costsLess));
  const double worthTaking = leftWithout - limits.worthShare * (leftWithout - leftByBest);
  for (Fit& fit : closeFits) restart(fit, least, worthTaking, what, half);
  auto scored = service_.tryScores(farFits, what, half, half);
  StepGuard step = service_.guardStep();
  if (judged_s < service_.step_s()) {
    step.set(judged_s);
    closeFits = service_.refit(closeFits, ofStep.iterations, what, half, half);
  }
  service_.refineStep(closeFits, limits.decideStep, what, half);
  Scored withoutNow = without;
  if (service_.step_s() < judged_s) withoutNow = service_.scoreAll({without.fit}, what, half, half)[0];
  const auto ofClose = service_.tryScores(closeFits, what, half, to);

  scored.insert(scored.end(), ofClose.begin(), ofClose.end());
  all.insert(all.end(), close.begin(), close.end());
  for (std::size_t i = 0; i < all.size(); ++i) {
    TriedCandidate& each = tried[all[i]];
    if (!scored[i]) {
      each.attempt.reason = "the scene refuses the numbers that half of the recordings would give it";
      continue;
    }
    each.fit = scored[i]->fit;
    each.scored = *scored[i];
    each.attempt.scored = true;
    Acceptance acceptance = judge(withoutNow, each.scored, each.fit.model.effects.size() - 1);
    each.passes = acceptance.passes;
    each.attempt.comparison = acceptance.comparison;
    each.attempt.reason = std::move(acceptance.reason);
    if (i < farFits.size() && each.passes) {
      each.passes = false;
      each.attempt.reason = tried[close[0]].attempt.candidate.text() + " fits far better";
    }
  }
  controlFalseDiscoveries(tried, limits.mostFalse);
  if (std::none_of(all.begin(), all.end(), [&](std::size_t k) { return tried[k].passes; })) return std::nullopt;
  step.keep();
  return withoutNow;
}

Scored Confirmer::converged(const Scored& scored, const std::string& stage, double at) {
  const SearchThresholds::Calibration& limits = service_.thresholds().calibration;
  if (excessOf(scored) < limits.leastToFitOn) return scored;
  std::vector<Fit> fits = service_.refit({scored.fit}, limits.toTheEnd, stage, at, at);
  restartInitialStates(service_, fits[0], stage, at);
  climbWholeNumbers(service_, fits[0], stage, at);
  service_.refineStep(fits, 1, stage, at);
  const Scored better = service_.scoreAll(fits, stage, at, at)[0];
  Scored same = scored;
  service_.bringToStep(same, stage, at);
  return better.mean() < same.mean() ? better : same;
}

void Confirmer::settle(Selection& selection, bool fitToTheEnd, const std::string& stage, double at) {
  Scored settled = fitToTheEnd ? converged(selection.final, stage, at) : selection.final;
  service_.bringToStep(settled, stage, at);
  selection.takeInstead(settled);
}

}  // namespace btr
