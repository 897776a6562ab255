#include "core/gap/search/starts/restarts.h"

#include <algorithm>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/fit/starts_anew.h"
#include "core/gap/search/fit_service.h"

namespace btr {
namespace {

/// The same model with its last effect held.
FitModel held(const FitProblem& problem, const FitModel& model) {
  return model.without(model.effects.size() - 1).withFixed(problem, model.simulator(problem).effects.back());
}

/// A model with the last effect as it is and all other numbers as a fit without that effect has them.
FitModel following(FitModel model, const Fit& others) {
  auto followed = others.model.values.begin();
  for (std::size_t i = 0; i < model.values.size(); ++i)
    if (model.parameters[i].effect + 1 != static_cast<int>(model.effects.size())) model.values[i] = *followed++;
  return model;
}

}  // namespace

FitModel resized(FitModel model, double size) {
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const FitParameter& p = model.parameters[i];
    if (p.effect + 1 == static_cast<int>(model.effects.size()) && p.hasNeutral)
      model.values[i] = std::clamp(p.given + size * (model.values[i] - p.given), p.minimum, p.maximum);
  }
  return model;
}

/// Dry friction and play leave side minima along an effect's size: where another size fits better at once, the fit is
/// taken up again from there.
void restartAtOtherSizes(const FitService& service, std::vector<Fit>& fits, const std::string& stage, double at) {
  const SearchThresholds::Restarts& limits = service.thresholds().restarts;
  const auto& sizes = limits.sizes;
  const auto replays = parallel(service.options().jobs, fits.size(), [&](std::size_t i) {
    std::vector<double> list;
    for (const double size : sizes)
      list.push_back(residualsOf(service.problem(), resized(fits[i].model, size), fits[i].shifts).squaredNorm());
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
  const auto again = service.tryFits(jobs, limits.iterations, stage, at, at);
  for (std::size_t k = 0; k < again.size(); ++k)
    if (again[k] && again[k]->cost < fits[owner[k]].cost) fits[owner[k]] = *again[k];
}

/// Where an effect and a calibrated number do nearly the same (wind and rolling resistance on a ball that rolls until
/// it stops), a fit creeps along a rough valley and ends too soon. The effect's size is moved and held while the others
/// follow, set free there, and moved on for as long as that helps.
void followValley(const FitService& service, Fit& fit, const std::string& stage, double at) {
  const SearchThresholds::Restarts& limits = service.thresholds().restarts;
  for (int round = 0; round < limits.alongRounds; ++round) {
    std::vector<FitModel> moved;
    std::vector<FitJob> jobs;
    for (const double size : limits.alongSizes) {
      const FitModel model = resized(fit.model, size);
      const FitModel others = held(service.problem(), model);
      if (model.values == fit.model.values || others.parameters.empty()) continue;
      moved.push_back(model);
      jobs.push_back({others, fit.shifts});
    }
    const auto along = service.tryFits(jobs, limits.heldIterations, stage, at, at);
    std::vector<FitJob> free;
    for (std::size_t k = 0; k < along.size(); ++k)
      if (along[k] && along[k]->cost < limits.alongInReach * fit.cost)
        free.push_back({following(moved[k], *along[k]), along[k]->shifts});
    const std::vector<Fit> again = completed(service.tryFits(free, limits.iterations, stage, at, at));
    if (again.empty()) return;
    const Fit& best = *std::ranges::min_element(again, costsLess);
    if (!(best.cost < limits.alongBetter * fit.cost)) return;
    fit = best;
  }
}

/// Play of a quarter of its width, crossed slowly, is a side minimum of play: what is left then is no valley, and no
/// step by step leads out of it. The effect begins again far off, its other numbers where they usually are; calibrated
/// numbers follow before it is set free.
void restartFarOff(const FitService& service, Fit& fit, const std::string& stage, double at) {
  const SearchThresholds::Restarts& limits = service.thresholds().restarts;
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
    jobs.push_back({held(service.problem(), model), fit.shifts});
  }
  // Where nothing follows, nothing need be held.
  std::vector<std::optional<Fit>> along;
  if (!jobs[0].model.parameters.empty()) along = service.tryFits(jobs, limits.heldIterations, stage, at, at);
  std::vector<FitJob> free;
  for (std::size_t k = 0; k < moved.size(); ++k) {
    if (along.empty())
      free.push_back({moved[k], fit.shifts});
    else if (along[k])
      free.push_back({following(moved[k], *along[k]), along[k]->shifts});
  }
  const std::vector<Fit> again = completed(service.tryFits(free, limits.iterations, stage, at, at));
  if (again.empty()) return;
  const Fit& best = *std::ranges::min_element(again, costsLess);
  if (best.cost < limits.farBetter * fit.cost) fit = best;
}

void restartInitialStates(const FitService& service, Fit& fit, const std::string& stage, double at) {
  const Fit anew = withStartsAnew(service.problem(), fit);
  if (anew.shifts == fit.shifts) return;
  const Fit all = service.refit({anew}, service.thresholds().calibration.againIterations, stage, at, at)[0];
  fit = costsLess(all, anew) ? all : anew;
}

}  // namespace btr
