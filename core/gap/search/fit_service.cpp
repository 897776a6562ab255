#include "core/gap/search/fit_service.h"

#include <algorithm>
#include <cmath>

#include "core/gap/fit/alignment.h"
#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/fit/score.h"
#include "core/gap/search/starts/window_fits.h"
#include "core/sim/worker_pool.h"
#include "core/spec/error.h"
#include "core/spec/system/cancelled.h"

namespace btr {
namespace {

std::vector<double> packed(const Fit& fit) {
  std::vector<double> numbers{fit.cost};
  numbers.insert(numbers.end(), fit.model.values.begin(), fit.model.values.end());
  for (const auto& shift : fit.shifts) numbers.insert(numbers.end(), shift.begin(), shift.end());
  return numbers;
}

/// Back from numbers.
void unpack(const std::vector<double>& numbers, const FitProblem& problem, Fit& fit) {
  std::size_t at = 0;
  fit.cost = numbers[at++];
  for (double& value : fit.model.values) value = numbers[at++];
  fit.shifts.clear();
  for (const Segment& segment : problem.segments) {
    fit.shifts.emplace_back(numbers.begin() + static_cast<std::ptrdiff_t>(at),
                            numbers.begin() + static_cast<std::ptrdiff_t>(at + segment.nuisances.size()));
    at += segment.nuisances.size();
  }
}

/// Of a fit as it is, without what tames outliers.
double costOf(const FitProblem& problem, const Fit& fit) {
  double cost = residualsOf(problem, fit.model, fit.shifts).squaredNorm() / 2;
  for (std::size_t s = 0; s < fit.shifts.size(); ++s)
    cost += priorCost(problem.segments[s].nuisances, fit.shifts[s]) / 2;
  return cost;
}

}  // namespace

bool FitService::isConsidered(const std::string& effect) const {
  return options_.names.empty() || std::ranges::find(options_.names, effect) != options_.names.end();
}

std::vector<EffectCandidate> FitService::candidatesBeside(const FitModel& model) const {
  return candidatesBeside(model, options_.names);
}

std::vector<EffectCandidate> FitService::candidatesBeside(const FitModel& model,
                                                          const std::vector<std::string>& names) const {
  return candidatesFor(problem_, model, names, thresholds().candidates);
}

std::vector<Parameter> FitService::parametersOf(const PlacedEffect& effect) const {
  return parametersAt(problem_, effect.effect, effect.at, thresholds().candidates);
}

std::function<bool(std::size_t)> FitService::reporter(const std::string& stage, std::size_t count, double from,
                                                      double to) const {
  if (!options_.progress) return {};
  return [this, stage, count, from, to](std::size_t done) {
    const double share = count > 0 ? static_cast<double>(done) / static_cast<double>(count) : 1;
    return report(stage, from + (to - from) * share);
  };
}

bool FitService::report(const std::string& stage, double share) const {
  reported_ = std::max(reported_, share);
  return options_.progress(stage, reported_);
}

void FitService::announce(const std::string& stage, double share) const {
  if (options_.progress && !report(stage, share)) throw Cancelled{};
}

int FitService::workersFor(std::size_t count) const {
  const bool inside = 2 * static_cast<int>(count) <= options_.jobs && problem_.segments.size() > count;
  return inside ? 1 : options_.jobs;
}

std::vector<std::optional<Fit>> FitService::tryFits(const std::vector<FitJob>& jobs, int iterations,
                                                    const std::string& stage, double from, double to) const {
  const auto fitOne = [&](std::size_t i) {
    FitOptions options{.iterations = iterations, .inherited = jobs[i].inherited, .tolerance = jobs[i].tolerance};
    if (options_.progress && !WorkerPool::inWorker())
      options.goOn = [&, i](double share) {
        const double done = (static_cast<double>(i) + share) / static_cast<double>(jobs.size());
        return report(stage, from + (to - from) * done);
      };
    return packed(fitModel(problem_, jobs[i].model, jobs[i].shifts, options));
  };
  const auto results = parallel(workersFor(jobs.size()), jobs.size(), fitOne, reporter(stage, jobs.size(), from, to));
  std::vector<std::optional<Fit>> fits(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (!results[i].ok()) {
      refused_->add("fit", results[i].refused);
      continue;
    }
    fits[i] = Fit{jobs[i].model, jobs[i].shifts, 0};
    unpack(results[i].numbers, problem_, *fits[i]);
  }
  return fits;
}

std::vector<Fit> completed(std::vector<std::optional<Fit>> tried) {
  std::vector<Fit> fits;
  for (std::optional<Fit>& fit : tried)
    if (fit) fits.push_back(std::move(*fit));
  return fits;
}

std::vector<Fit> FitService::fitAll(const std::vector<FitJob>& jobs, int iterations, const std::string& stage,
                                    double from, double to) const {
  std::vector<Fit> fits = completed(tryFits(jobs, iterations, stage, from, to));
  if (fits.size() < jobs.size()) throw InputError(stage + ": " + refused_->last());
  return fits;
}

std::vector<Fit> FitService::refit(const std::vector<Fit>& fits, int iterations, const std::string& stage, double from,
                                   double to) const {
  std::vector<FitJob> jobs;
  for (const Fit& fit : fits) jobs.push_back({fit.model, fit.shifts});
  return fitAll(jobs, iterations, stage, from, to);
}

void FitService::bringToStep(Scored& scored, const std::string& stage, double at) const {
  if (scored.step_s == problem_.scene.step_s) return;
  scored = scoreAll(refit({scored.fit}, thresholds().step.iterations, stage, at, at), stage, at, at)[0];
}

std::vector<std::optional<Scored>> FitService::tryScores(const std::vector<Fit>& fits, const std::string& stage,
                                                         double from, double to) const {
  const auto results = parallel(
      workersFor(fits.size()), fits.size(),
      [&](std::size_t i) {
        const Scored scored = crossValidate(problem_, fits[i]);
        std::vector<double> list = scored.blocks;
        list.insert(list.end(), scored.unshifted.begin(), scored.unshifted.end());
        list.insert(list.end(), scored.heldOut.begin(), scored.heldOut.end());
        list.insert(list.end(), scored.sizes.begin(), scored.sizes.end());
        list.insert(list.end(), {scored.aligned.shift_s, scored.aligned.took, scored.aligned.ofMost});
        return list;
      },
      reporter(stage, fits.size(), from, to));
  std::vector<std::optional<Scored>> scored(fits.size());
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!results[i].ok()) {
      refused_->add("score", results[i].refused);
      continue;
    }
    const std::vector<double>& numbers = results[i].numbers;
    const auto blocks = static_cast<std::ptrdiff_t>(problem_.blocks), sizes = std::ssize(fits[i].model.effects);
    const auto end = numbers.end() - 3;  // of the sizes
    scored[i] = Scored{fits[i],
                       {numbers.begin(), numbers.begin() + blocks},
                       Eigen::VectorXd(static_cast<Eigen::Index>(problem_.residuals())),
                       {end - sizes, end},
                       problem_.scene.step_s,
                       {end[0], end[1], end[2]},
                       {numbers.begin() + blocks, numbers.begin() + 2 * blocks}};
    std::copy(numbers.begin() + 2 * blocks, end - sizes, scored[i]->heldOut.begin());
  }
  return scored;
}

std::optional<Scored> FitService::tryScored(const FitJob& job, int iterations, const std::string& stage,
                                            double at) const {
  const std::vector<Fit> fits = completed(tryFits({job}, iterations, stage, at, at));
  return fits.empty() ? std::nullopt : tryScores(fits, stage, at, at)[0];
}

std::vector<Scored> FitService::scoreAll(const std::vector<Fit>& fits, const std::string& stage, double from,
                                         double to) const {
  std::vector<Scored> all;
  for (std::optional<Scored>& scored : tryScores(fits, stage, from, to)) {
    if (!scored) throw InputError(stage + ": " + refused_->last());
    all.push_back(std::move(*scored));
  }
  return all;
}

std::vector<Scored> FitService::fitAndScore(const std::vector<FitJob>& jobs, const Fit& full, const std::string& stage,
                                            double from, double to) {
  std::vector<Scored> scored;
  double most = 0;
  {
    const StepGuard coarse = guardStep(stepToSearchWith(full));
    const std::vector<Fit> fits = fitAll(jobs, thresholds().step.withoutIterations, stage, from, (from + to) / 2);
    scored = scoreAll(fits, stage, (from + to) / 2, to);
    most = thresholds().step.farWorse * (residualsOf(problem_, full.model, full.shifts).squaredNorm() / 2);
  }
  for (std::size_t i = 0; i < scored.size(); ++i) {
    if (scored[i].fit.cost <= most) bringToStep(scored[i], stage, to);
    // Dry friction makes costs rough: a fit with another step may end where the present one leads no further, beside a
    // model that does better with the numbers that it began with.
    const FitJob& begun = jobs[i];
    if (costOf(problem_, {begun.model, begun.shifts, 0}) < scored[i].fit.cost)
      scored[i] = scoreAll(refit({{begun.model, begun.shifts, 0}}, thresholds().step.iterations, stage, to, to), stage,
                           to, to)[0];
  }
  return scored;
}

FitService FitService::inWindows(double length_s) const {
  FitService windows(cutShort(problem_, length_s, thresholds().restarts), options_);
  windows.reported_ = reported_;
  windows.refused_ = refused_;
  return windows;
}

double FitService::leftBy(const Fit& fit) const {
  Eigen::VectorXd residuals = residualsOf(problem_, fit.model, fit.shifts);
  align(problem_, residuals);
  return residuals.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, residuals.size()));
}

Eigen::VectorXd FitService::stepChange(const Fit& fit) const {
  FitProblem finer = problem_;
  const StepGuard half(finer.scene.step_s, step_s() / 2);
  return residualsOf(problem_, fit.model, fit.shifts) - residualsOf(finer, fit.model, fit.shifts);
}

double FitService::stepToSearchWith(const Fit& fit) const {
  const SearchThresholds::Step& limits = thresholds().step;
  const double judged_s = problem_.scene.step_s;
  if (calibrated_s_ <= judged_s) return judged_s;
  const Eigen::VectorXd fine = residualsOf(problem_, fit.model, fit.shifts);
  const auto count = static_cast<double>(std::max<Eigen::Index>(1, fine.size()));
  const double error = fine.norm() / std::sqrt(count);
  const double most =
      std::max(limits.harmless, (error > limits.muchError ? limits.ofMuchError : limits.ofError) * error);
  FitProblem coarse = problem_;
  for (double step_s = calibrated_s_; step_s > limits.coarser * judged_s; step_s /= 2) {
    const StepGuard longer(coarse.scene.step_s, step_s);
    if (std::sqrt(stepErrorOf(residualsOf(coarse, fit.model, fit.shifts) - fine)) < most) return step_s;
  }
  return judged_s;
}

void FitService::refineStep(std::vector<Fit>& fits, std::size_t judged, const std::string& stage, double at) {
  const SearchThresholds::Step& limits = thresholds().step;
  /// What half the step changes, of what may hide in the noise.
  const auto coarsenessOf = [&](const Fit& fit) {
    // Where much is unexplained anyway, the step is not what matters.
    const double error = std::sqrt(2 * fit.cost / static_cast<double>(std::max<std::size_t>(1, problem_.residuals())));
    if (error > limits.mostError && problem_.scene.step_s <= problem_.givenStep_s) return 0.0;
    return std::sqrt(stepErrorOf(stepChange(fit))) /
           std::max(limits.hidden,
                    (error > limits.muchError ? limits.hiddenOfMuchError : limits.hiddenOfError) * error);
  };
  judged = std::min(judged, fits.size());
  const auto coarseness = [&] {
    double worst = 0;
    for (std::size_t i = 0; i < judged; ++i) worst = std::max(worst, coarsenessOf(fits[i]));
    return worst;
  };
  // The numbers move little with the step: they are fitted again where it no longer matters, not on the way there.
  const double finest_s = problem_.finestStep * problem_.givenStep_s;
  while (step_s() > finest_s) {
    const double before = coarseness();
    double now = before;
    StepGuard step = guardStep();
    while (now > 1 && step_s() > finest_s) {
      step.set(step_s() / 2);
      now = coarseness();
    }
    // Feet that land another way with each step do so at any.
    if (now > std::max(1.0, limits.settled * before) || step_s() == step.before_s()) return;
    step.keep();
    fits = refit(fits, limits.iterations, stage, at, at);
  }
}

}  // namespace btr
