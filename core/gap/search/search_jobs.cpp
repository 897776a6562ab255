// Fits and scores of many models at once.
#include <algorithm>
#include <cmath>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/search_run.h"
#include "core/sim/worker_pool.h"
#include "core/spec/error.h"

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

}  // namespace

int SearchRun::workersFor(std::size_t count) const {
  const bool inside = 2 * static_cast<int>(count) <= options_.jobs && problem_.segments.size() > count;
  return inside ? 1 : options_.jobs;
}

std::vector<std::optional<Fit>> SearchRun::tryFits(const std::vector<FitJob>& jobs, int iterations,
                                                   const std::string& stage, double from, double to) const {
  const auto fitOne = [&](std::size_t i) {
    FitOptions options{.iterations = iterations, .inherited = jobs[i].inherited, .tolerance = jobs[i].tolerance};
    if (options_.progress && !WorkerPool::inWorker())
      options.goOn = [&, i](double share) {
        const double done = (static_cast<double>(i) + share) / static_cast<double>(jobs.size());
        return tell(stage, from + (to - from) * done);
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

std::vector<Fit> SearchRun::thoseOf(std::vector<std::optional<Fit>> tried) {
  std::vector<Fit> fits;
  for (std::optional<Fit>& fit : tried)
    if (fit) fits.push_back(std::move(*fit));
  return fits;
}

std::vector<Fit> SearchRun::fitAll(const std::vector<FitJob>& jobs, int iterations, const std::string& stage,
                                   double from, double to) const {
  std::vector<Fit> fits = thoseOf(tryFits(jobs, iterations, stage, from, to));
  if (fits.size() < jobs.size()) throw InputError(stage + ": " + refused_->last());
  return fits;
}

std::vector<Fit> SearchRun::fitOn(const std::vector<Fit>& fits, int iterations, const std::string& stage, double from,
                                  double to) const {
  std::vector<FitJob> jobs;
  for (const Fit& fit : fits) jobs.push_back({fit.model, fit.shifts});
  return fitAll(jobs, iterations, stage, from, to);
}

void SearchRun::bringToStep(Scored& scored, const std::string& stage, double at) const {
  if (scored.step_s == problem_.scene.step_s) return;
  scored = scoreAll(fitOn({scored.fit}, limits().step.iterations, stage, at, at), stage, at, at)[0];
}

std::vector<std::optional<Scored>> SearchRun::tryScores(const std::vector<Fit>& fits, const std::string& stage,
                                                        double from, double to) const {
  const auto results = parallel(
      workersFor(fits.size()), fits.size(),
      [&](std::size_t i) {
        const Scored scored = crossValidate(problem_, fits[i]);
        std::vector<double> list = scored.blocks;
        list.insert(list.end(), scored.heldOut.begin(), scored.heldOut.end());
        list.insert(list.end(), scored.sizes.begin(), scored.sizes.end());
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
    scored[i] = Scored{fits[i],
                       {numbers.begin(), numbers.begin() + blocks},
                       Eigen::VectorXd(static_cast<Eigen::Index>(problem_.residuals())),
                       {numbers.end() - sizes, numbers.end()},
                       problem_.scene.step_s};
    std::copy(numbers.begin() + blocks, numbers.end() - sizes, scored[i]->heldOut.begin());
  }
  return scored;
}

std::vector<Scored> SearchRun::scoreAll(const std::vector<Fit>& fits, const std::string& stage, double from,
                                        double to) const {
  std::vector<Scored> all;
  for (std::optional<Scored>& scored : tryScores(fits, stage, from, to)) {
    if (!scored) throw InputError(stage + ": " + refused_->last());
    all.push_back(std::move(*scored));
  }
  return all;
}

std::vector<Scored> SearchRun::fitAndScore(const std::vector<FitJob>& jobs, const Fit& full, const std::string& stage,
                                           double from, double to) {
  const double judged_s = problem_.scene.step_s;
  problem_.scene.step_s = stepToSearchWith(full);
  const std::vector<Fit> fits = fitAll(jobs, limits().step.withoutIterations, stage, from, (from + to) / 2);
  std::vector<Scored> scored = scoreAll(fits, stage, (from + to) / 2, to);
  const double cost = residualsOf(problem_, full.model, full.shifts).squaredNorm() / 2;
  problem_.scene.step_s = judged_s;
  for (std::size_t i = 0; i < fits.size(); ++i)
    if (fits[i].cost <= limits().step.farWorse * cost) bringToStep(scored[i], stage, to);
  return scored;
}

Eigen::VectorXd SearchRun::stepChange(const Fit& fit) const {
  FitProblem finer = problem_;
  finer.scene.step_s /= 2;
  return residualsOf(problem_, fit.model, fit.shifts) - residualsOf(finer, fit.model, fit.shifts);
}

double stepErrorOf(const Eigen::VectorXd& stepChange) {
  return stepChange.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, stepChange.size()));
}

double SearchRun::stepToSearchWith(const Fit& fit) const {
  const SearchThresholds::Step& limits = this->limits().step;
  const double judged_s = problem_.scene.step_s;
  if (search_s_ <= judged_s) return judged_s;
  const Eigen::VectorXd fine = residualsOf(problem_, fit.model, fit.shifts);
  const auto count = static_cast<double>(std::max<Eigen::Index>(1, fine.size()));
  const double error = fine.norm() / std::sqrt(count);
  const double most =
      std::max(limits.harmless, (error > limits.muchError ? limits.ofMuchError : limits.ofError) * error);
  FitProblem coarse = problem_;
  for (coarse.scene.step_s = search_s_; coarse.scene.step_s > limits.coarser * judged_s; coarse.scene.step_s /= 2)
    if (std::sqrt(stepErrorOf(residualsOf(coarse, fit.model, fit.shifts) - fine)) < most) return coarse.scene.step_s;
  return judged_s;
}

void SearchRun::refineStep(std::vector<Fit>& fits, std::size_t judged, const std::string& stage, double at) {
  const SearchThresholds::Step& limits = this->limits().step;
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
  while (problem_.scene.step_s > finest_s) {
    const double before_s = problem_.scene.step_s, before = coarseness();
    double now = before;
    while (now > 1 && problem_.scene.step_s > finest_s) {
      problem_.scene.step_s /= 2;
      now = coarseness();
    }
    // Feet that land another way with each step do so at any.
    if (now > std::max(1.0, limits.settled * before)) problem_.scene.step_s = before_s;
    if (problem_.scene.step_s == before_s) return;
    fits = fitOn(fits, limits.iterations, stage, at, at);
  }
}

}  // namespace btr
