// The few candidates that fits promise most of: fitted to the end, scored on what they were not fitted to, accepted or
// not.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/search_discoveries.h"
#include "core/gap/search/search_run.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

/// The last effect of a model `size` times as large.
FitModel resized(FitModel model, double size) {
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const FitParameter& p = model.parameters[i];
    if (p.effect + 1 == static_cast<int>(model.effects.size()) && p.hasNeutral)
      model.values[i] = std::clamp(p.given + size * (model.values[i] - p.given), p.minimum, p.maximum);
  }
  return model;
}

/// A model with the last effect as it is and all other numbers as a fit without that effect has them.
FitModel following(FitModel model, const Fit& others) {
  auto followed = others.model.values.begin();
  for (std::size_t i = 0; i < model.values.size(); ++i)
    if (model.parameters[i].effect + 1 != static_cast<int>(model.effects.size())) model.values[i] = *followed++;
  return model;
}

/// The same model with its last effect held.
FitModel held(const FitProblem& problem, const FitModel& model) {
  return model.without(model.effects.size() - 1).withFixed(problem, model.simulator(problem).effects.back());
}

}  // namespace

bool SearchRun::isAtLeast(const Fit& fit) const {
  const SearchThresholds::Confirmation& limits = this->limits().confirmation;
  const auto costAt = [&](double size) {
    return residualsOf(problem_, resized(fit.model, size), fit.shifts).squaredNorm();
  };
  const double here = costAt(1);
  return std::abs(costAt(limits.largerSize) - here) < limits.flat * (costAt(0) - here);
}

/// Dry friction and play leave side minima along an effect's size: where another size fits better at once, the fit is
/// taken up again from there.
void SearchRun::shake(std::vector<Fit>& fits, const std::string& stage, double at) const {
  const SearchThresholds::Restarts& limits = this->limits().restarts;
  const auto& sizes = limits.sizes;
  const auto replays = parallel(options_.jobs, fits.size(), [&](std::size_t i) {
    std::vector<double> list;
    for (const double size : sizes)
      list.push_back(residualsOf(problem_, resized(fits[i].model, size), fits[i].shifts).squaredNorm());
    return list;
  });
  std::vector<FitJob> jobs;
  std::vector<std::size_t> owner;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!replays[i].ok()) continue;
    const std::vector<double>& errors = replays[i].numbers;
    const auto least = std::ranges::min_element(errors);
    if (!(*least < limits.better * errors[0])) continue;
    const double size = sizes[static_cast<std::size_t>(least - errors.begin())];
    jobs.push_back({resized(fits[i].model, size), fits[i].shifts});
    owner.push_back(i);
  }
  const auto again = tryFits(jobs, limits.iterations, stage, at, at);
  for (std::size_t k = 0; k < again.size(); ++k)
    if (again[k] && again[k]->cost < fits[owner[k]].cost) fits[owner[k]] = *again[k];
}

/// Where an effect and a calibrated number do nearly the same (wind and rolling resistance on a ball that rolls until
/// it stops), a fit creeps along a rough valley and ends too soon. The effect's size is moved and held while the others
/// follow, set free there, and moved on for as long as that helps.
void SearchRun::scan(Fit& fit, const std::string& stage, double at) const {
  const SearchThresholds::Restarts& limits = this->limits().restarts;
  for (int round = 0; round < limits.alongRounds; ++round) {
    std::vector<FitModel> moved;
    std::vector<FitJob> jobs;
    for (const double size : limits.alongSizes) {
      const FitModel model = resized(fit.model, size);
      const FitModel others = held(problem_, model);
      if (model.values == fit.model.values || others.parameters.empty()) continue;
      moved.push_back(model);
      jobs.push_back({others, fit.shifts});
    }
    const auto along = tryFits(jobs, limits.heldIterations, stage, at, at);
    std::vector<FitJob> free;
    for (std::size_t k = 0; k < along.size(); ++k)
      if (along[k] && along[k]->cost < limits.alongInReach * fit.cost)
        free.push_back({following(moved[k], *along[k]), along[k]->shifts});
    const std::vector<Fit> again = thoseOf(tryFits(free, limits.iterations, stage, at, at));
    if (again.empty()) return;
    const Fit& best = *std::ranges::min_element(again, costsLess);
    if (!(best.cost < limits.alongBetter * fit.cost)) return;
    fit = best;
  }
}

/// Play of a quarter of its width, crossed slowly, is a side minimum of play: what is left then is no valley, and no
/// step by step leads out of it. The effect begins again far off, its other numbers where they usually are; calibrated
/// numbers follow before it is set free.
void SearchRun::leap(Fit& fit, const std::string& stage, double at) const {
  const SearchThresholds::Restarts& limits = this->limits().restarts;
  const std::size_t last = fit.model.effects.size() - 1;
  std::vector<FitModel> moved;
  std::vector<FitJob> jobs;
  for (const double size : limits.farSizes) {
    FitModel model = resized(fit.model, size);
    for (std::size_t i = 0; i < model.values.size(); ++i) {
      const FitParameter& p = model.parameters[i];
      if (p.effect == static_cast<int>(last) && !p.hasNeutral) model.values[i] = p.given;
    }
    moved.push_back(model);
    jobs.push_back({held(problem_, model), fit.shifts});
  }
  // Where nothing follows, nothing need be held.
  std::vector<std::optional<Fit>> along;
  if (!jobs[0].model.parameters.empty()) along = tryFits(jobs, limits.heldIterations, stage, at, at);
  std::vector<FitJob> free;
  for (std::size_t k = 0; k < moved.size(); ++k) {
    if (along.empty())
      free.push_back({moved[k], fit.shifts});
    else if (along[k])
      free.push_back({following(moved[k], *along[k]), along[k]->shifts});
  }
  const std::vector<Fit> again = thoseOf(tryFits(free, limits.iterations, stage, at, at));
  if (again.empty()) return;
  const Fit& best = *std::ranges::min_element(again, costsLess);
  if (best.cost < limits.farBetter * fit.cost) fit = best;
}

bool SearchRun::confirm(std::vector<Tried>& tried, const std::vector<std::size_t>& candidates, Scored& without,
                        double judged_s, const std::string& stage, double from, double to) {
  const SearchThresholds::Confirmation& limits = this->limits().confirmation;
  const SearchThresholds::Step& ofStep = this->limits().step;
  const std::string what = "confirming" + stage;
  const double half = (from + to) / 2, fitted_s = problem_.scene.step_s;
  std::vector<FitJob> jobs;
  for (const std::size_t k : candidates) jobs.push_back({tried[k].fit.model, tried[k].fit.shifts});
  const auto fittedOn = tryFits(jobs, limits.iterations, what, from, half);
  std::vector<std::size_t> which;
  std::vector<Fit> fits;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (fittedOn[i]) {
      which.push_back(candidates[i]);
      fits.push_back(*fittedOn[i]);
    } else {
      tried[candidates[i]].attempt.reason = "the scene refuses the numbers of its fit";
    }
  }
  if (which.empty()) return false;
  shake(fits, what, half);
  giveBack(fits, what, half);

  // Effects may need finer steps than the simulator without them: friction at reversals, play. What fits far worse than
  // the best is no winner at any step.
  std::vector<std::size_t> close, far;
  std::vector<Fit> closeFits, farFits;
  const double least = std::min_element(fits.begin(), fits.end(), costsLess)->cost;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const bool isClose = fits[i].cost <= ofStep.farWorse * least;
    (isClose ? close : far).push_back(which[i]);
    (isClose ? closeFits : farFits).push_back(fits[i]);
  }
  for (Fit& fit : closeFits) {
    // Beside little that is left all are near the best; where a fit takes long, only that one is looked after.
    if (fit.cost > (problem_.walks ? limits.worthMoreOfWalks : limits.worthMore) * least) continue;
    climbWholeNumbers(fit, what, half);
    const double left = 2 * fit.cost / static_cast<double>(problem_.residuals());
    if (left > limits.leastToLeap && left < limits.mostToLeap && fit.cost <= least) leap(fit, what, half);
    // What leaves no more than the noise may still stop behind a better one.
    if ((left > limits.leastToFollow || fit.cost > limits.leastToFollow * least) && left < limits.mostToFollow)
      scan(fit, what, half);
  }
  auto scored = tryScores(farFits, what, half, half);
  if (judged_s < fitted_s) {
    problem_.scene.step_s = judged_s;
    closeFits = fitOn(closeFits, ofStep.iterations, what, half, half);
  }
  refineStep(closeFits, limits.decideStep, what, half);
  const Scored before = without;
  if (problem_.scene.step_s < judged_s) without = scoreAll({without.fit}, what, half, half)[0];
  const auto ofClose = tryScores(closeFits, what, half, to);

  scored.insert(scored.end(), ofClose.begin(), ofClose.end());
  far.insert(far.end(), close.begin(), close.end());
  for (std::size_t i = 0; i < far.size(); ++i) {
    Tried& each = tried[far[i]];
    if (!scored[i]) {
      each.attempt.reason = "the scene refuses the numbers that half of the recordings would give it";
      continue;
    }
    each.fit = scored[i]->fit;
    each.scored = *scored[i];
    each.attempt.scored = true;
    each.passes =
        passes(without, each.scored, each.fit.model.effects.size() - 1, each.attempt.comparison, each.attempt.reason);
    if (i < farFits.size() && each.passes) {
      each.passes = false;
      each.attempt.reason = tried[close[0]].attempt.candidate.text() + " fits far better";
    }
  }
  controlFalseDiscoveries(tried);
  const bool any = std::any_of(far.begin(), far.end(), [&](std::size_t k) { return tried[k].passes; });
  if (!any) {  // what needed the finer step is not there
    problem_.scene.step_s = fitted_s;
    without = before;
  }
  return any;
}

void SearchRun::controlFalseDiscoveries(std::vector<Tried>& tried) const {
  // What the screening left behind counts as tested and found to be nothing.
  std::vector<double> pValues;
  for (const Tried& each : tried) pValues.push_back(each.attempt.scored ? each.attempt.comparison.pValue : 1);
  const std::vector<double> rates = falseDiscoveryRates(pValues);
  for (std::size_t k = 0; k < tried.size(); ++k) {
    tried[k].attempt.qValue = rates[k];
    if (!tried[k].passes || rates[k] <= limits().confirmation.mostFalse) continue;
    tried[k].passes = false;
    tried[k].attempt.reason =
        "among " + std::to_string(tried.size()) +
        " effects and places that were looked at, chance does as well (q = " + digits(rates[k], 2) + ")";
  }
}

bool SearchRun::passes(const Scored& without, const Scored& with, std::size_t newEffect, PairedTest& comparison,
                       std::string& reason) const {
  const SearchThresholds::Confirmation& limits = this->limits().confirmation;
  comparison = compare(without.blocks, with.blocks);
  const double excess = excessOf(without);
  const double taken = without.mean() - with.mean();
  if (comparison.t < limits.leastT) {
    reason = "not better on held-out blocks (t = " + toText(std::round(10 * comparison.t) / 10) + ")";
    return false;
  }
  if (comparison.gain < limits.leastGain) {
    reason = "takes only " + percent(comparison.gain) + " of the held-out squared error";
    return false;
  }
  if (excess <= 0 || taken < limits.leastShareOfExcess * excess) {
    reason = "takes only " + percent(excess > 0 ? taken / excess : 0) + " of the excess error";
    return false;
  }
  // Standard errors count on sensitivities: where bounces or reversals make them rough, what takes most of a large
  // error is not small for that.
  const bool takesMost = excess > limits.largeExcess && taken > limits.mostOfExcess * excess;
  const double errors = with.sizes.at(newEffect);
  if (errors < limits.leastErrors && !takesMost && !isAtLeast(with.fit)) {
    reason = "its size is only " + toText(std::round(10 * errors) / 10) + " standard errors";
    return false;
  }
  // Of first order: half the step takes half of the error away. Where feet land it stays far above the noise's share.
  const double ofIntegration = limits.timesIntegration * stepErrorOf(stepChange(with.fit));
  if (taken < ofIntegration) {
    reason = "takes " + digits(taken, 2) + " noise floors² where the integration itself is wrong by about " +
             digits(ofIntegration, 2);
    return false;
  }
  reason = "takes " + percent(comparison.gain) +
           " of the held-out squared error (t = " + toText(std::round(10 * comparison.t) / 10) + ")";
  return true;
}

}  // namespace btr
