#include "core/gap/fit/fit.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

#include "core/gap/fit/evaluate_ahead.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/fit/segment_cost.h"
#include "core/gap/fit/segments.h"
#include "core/spec/system/cancelled.h"

namespace btr {
namespace {

constexpr double flatPrior = 10;  // ranges of a parameter: holds what the recordings do not tell, nothing else

/// weight·(x − x0): keeps what the recordings do not tell where it was.
class Prior final : public ceres::CostFunction {
 public:
  Prior(std::vector<double> centre, std::vector<double> weight)
      : centre_(std::move(centre)), weight_(std::move(weight)) {
    mutable_parameter_block_sizes()->push_back(static_cast<int>(centre_.size()));
    set_num_residuals(static_cast<int>(centre_.size()));
  }
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const std::size_t n = centre_.size();
    for (std::size_t i = 0; i < n; ++i) residuals[i] = weight_[i] * (blocks[0][i] - centre_[i]);
    if (jacobians && jacobians[0])
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) jacobians[0][i * n + j] = i == j ? weight_[i] : 0;
    return true;
  }

 private:
  std::vector<double> centre_, weight_;
};

/// Says after each iteration whether the next Jacobian is differenced, and whoever waits how far the fit is; ends a
/// solve whose Jacobian was only updated as soon as a step fails.
class AgeingJacobian final : public ceres::IterationCallback {
 public:
  AgeingJacobian(JacobianPolicy& policy, const FitOptions& options) : policy_(policy), options_(options) {}
  bool cancelled() const { return cancelled_; }
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.iteration > 0) ++iterations_;
    cancelled_ = options_.goOn && !options_.goOn(std::min(1.0, static_cast<double>(iterations_) / options_.iterations));
    if (cancelled_) return ceres::SOLVER_ABORT;
    if (summary.iteration == 0) {
      policy_.difference = false;
      return ceres::SOLVER_CONTINUE;
    }
    if (!summary.step_is_successful)
      return policy_.age > 0 ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
    policy_.age = policy_.difference ? 0 : policy_.age + 1;
    policy_.difference = policy_.age >= JacobianPolicy::oldest;
    return ceres::SOLVER_CONTINUE;
  }

 private:
  JacobianPolicy& policy_;
  const FitOptions& options_;
  int iterations_ = 0;
  bool cancelled_ = false;
};

std::vector<double> priorWeights(const FitModel& model) {
  std::vector<double> weights;
  for (const FitParameter& p : model.parameters) weights.push_back(p.scale / (flatPrior * (p.maximum - p.minimum)));
  return weights;
}

std::vector<std::vector<double>> zeroShifts(const FitProblem& problem) {
  std::vector<std::vector<double>> shifts;
  for (const Segment& segment : problem.segments) shifts.emplace_back(segment.nuisances.size(), 0.0);
  return shifts;
}

}  // namespace

Eigen::VectorXd residualsOf(const FitProblem& problem, const FitModel& model,
                            const std::vector<std::vector<double>>& shifts) {
  SceneCache scenes(problem, model);
  const auto numbers = bySegment(problem, 1, [&](std::size_t s) {
    const Segment& segment = problem.segments[s];
    return residualsOf(problem, segment, scenes.scene(model.values, segment.trial),
                       shifts.empty() ? std::vector<double>{} : shifts[s]);
  });
  Eigen::VectorXd all(static_cast<Eigen::Index>(problem.residuals()));
  Eigen::Index at = 0;
  for (const std::vector<double>& part : numbers)
    for (const double value : part) all[at++] = value;
  return all;
}

namespace {

/// Downhill from where it is, once.
Fit descended(const FitProblem& problem, const FitModel& model, const std::vector<std::vector<double>>& shifts,
              const FitOptions& options) {
  Fit fit{model, shifts.empty() ? zeroShifts(problem) : shifts, 0};
  SceneCache scenes(problem, model);
  JacobianPolicy policy;
  policy.inherited = options.inherited;
  policy.startsOnly = options.startsOnly;

  // Far outliers: beyond six times what residuals are at the start.
  const Eigen::VectorXd start = residualsOf(problem, model, fit.shifts);
  const double rms = std::sqrt(start.squaredNorm() / std::max<double>(1, static_cast<double>(start.size())));
  const double limit = 6 * std::max(1.0, rms);

  std::vector<double> scaled;
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    scaled.push_back(std::clamp(model.values[i], model.parameters[i].minimum, model.parameters[i].maximum) /
                     model.parameters[i].scale);

  EvaluateAhead ahead(problem);
  ceres::Problem::Options ownership;
  if (problem.jobs > 1) ownership.evaluation_callback = &ahead;
  ceres::Problem least(ownership);
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    std::vector<double*> blocks;
    if (!scaled.empty()) blocks.push_back(scaled.data());
    if (!fit.shifts[s].empty()) blocks.push_back(fit.shifts[s].data());
    if (blocks.empty()) continue;
    // Ceres takes ownership.
    auto cost = std::make_unique<SegmentCost>(problem, model, s, scenes, policy, limit);
    ahead.add(*cost, blocks);
    least.AddResidualBlock(cost.release(), nullptr, blocks);
    if (fit.shifts[s].empty()) continue;
    const std::size_t count = fit.shifts[s].size();
    std::vector<double> holds;
    for (const Nuisance& nuisance : problem.segments[s].nuisances) holds.push_back(nuisance.hold);
    auto prior = std::make_unique<Prior>(std::vector<double>(count, 0.0), holds);
    least.AddResidualBlock(prior.release(), nullptr, fit.shifts[s].data());
  }
  if (!scaled.empty() && options.startsOnly && least.HasParameterBlock(scaled.data())) {
    least.SetParameterBlockConstant(scaled.data());
  } else if (!scaled.empty()) {
    std::vector<double> centre;
    for (const FitParameter& p : model.parameters) centre.push_back(p.given / p.scale);
    auto prior = std::make_unique<Prior>(centre, priorWeights(model));
    least.AddResidualBlock(prior.release(), nullptr, scaled.data());
    for (std::size_t i = 0; i < scaled.size(); ++i) {
      const FitParameter& p = model.parameters[i];
      const double over = p.goesRound ? 2 * M_PI : 0;
      least.SetParameterLowerBound(scaled.data(), static_cast<int>(i), (p.minimum - over) / p.scale);
      least.SetParameterUpperBound(scaled.data(), static_cast<int>(i), (p.maximum + over) / p.scale);
    }
  }
  if (least.NumParameterBlocks() == (options.startsOnly && !scaled.empty() ? 1 : 0)) {
    fit.cost = start.squaredNorm() / 2;
    return fit;
  }

  ceres::Solver::Options solver;
  solver.function_tolerance = options.tolerance;
  solver.parameter_tolerance = 1e-6;
  solver.initial_trust_region_radius = 10;
  // Steps are cut off at the bounds and judged there. A line search along each, Ceres' default where there are bounds,
  // took two fifths of all replays; without it costs end as low on average.
  solver.max_num_line_search_step_size_iterations = 0;
  // Numbers come in typical changes, residuals in noise floors: what a whole typical change moves by less than the
  // noise is held by the damping. Scaled to equal columns it would be the first to run away, and shrink all steps.
  solver.jacobi_scaling = false;
  solver.min_lm_diagonal = 1;
  solver.linear_solver_type = problem.segments.size() > 8 ? ceres::DENSE_SCHUR : ceres::DENSE_QR;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  AgeingJacobian ageing(policy, options);
  solver.callbacks.push_back(&ageing);
  ceres::Solver::Summary summary;
  // What updated Jacobians cannot improve any more is tried again with new differences.
  for (int left = options.iterations; left > 0;) {
    solver.max_num_iterations = left;
    policy.difference = true;
    policy.age = policy.inherited ? 1 : 0;
    ceres::Solve(solver, &least, &summary);
    if (ageing.cancelled()) throw Cancelled{};
    left -= std::max(1, static_cast<int>(summary.iterations.size()) - 1);
    const bool stale = policy.age > 0;
    policy.inherited = nullptr;
    if (!stale || summary.termination_type == ceres::NO_CONVERGENCE || summary.termination_type == ceres::FAILURE)
      break;
    solver.initial_trust_region_radius = std::max(1.0, summary.iterations.back().trust_region_radius);
  }
  fit.cost = summary.final_cost;
  for (std::size_t i = 0; i < scaled.size(); ++i)
    fit.model.values[i] = model.parameters[i].inRange(scaled[i] * model.parameters[i].scale);
  return fit;
}

/// By segment: squared residuals and what holds its initial state.
std::vector<double> costsOf(const FitProblem& problem, const Fit& fit) {
  const Eigen::VectorXd residuals = residualsOf(problem, fit.model, fit.shifts);
  std::vector<double> costs;
  Eigen::Index at = 0;
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    const Segment& segment = problem.segments[s];
    const auto count = static_cast<Eigen::Index>(segment.row.size());
    double cost = residuals.segment(at, count).squaredNorm();
    at += count;
    for (std::size_t i = 0; i < segment.nuisances.size(); ++i)
      cost += std::pow(segment.nuisances[i].hold * fit.shifts[s][i], 2);
    costs.push_back(cost);
  }
  return costs;
}

/// What bounces has many valleys: a trial that came down a bounce too late under earlier numbers may stay there under
/// better ones. Initial states that fit clearly better when they begin anew take the place of those; true if any do.
bool beginAnew(const FitProblem& problem, Fit& fit, const FitOptions& options) {
  constexpr double clearly = 0.95;
  constexpr int iterations = 10;
  FitOptions starts;
  starts.iterations = iterations;
  starts.startsOnly = true;
  starts.tolerance = options.tolerance;
  const Fit anew = descended(problem, fit.model, {}, starts);
  const std::vector<double> now = costsOf(problem, fit), then = costsOf(problem, anew);
  bool any = false;
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    if (!problem.segments[s].bounces || !(then[s] < clearly * now[s])) continue;
    fit.shifts[s] = anew.shifts[s];
    any = true;
  }
  return any;
}

}  // namespace

Fit fitModel(const FitProblem& problem, const FitModel& model, const std::vector<std::vector<double>>& shifts,
             const FitOptions& options) {
  Fit fit = descended(problem, model, shifts, options);
  const bool bounces = std::ranges::any_of(problem.segments, &Segment::bounces);
  if (!bounces || shifts.empty() || !beginAnew(problem, fit, options)) return fit;
  FitOptions again = options;
  again.inherited = nullptr;
  return descended(problem, fit.model, fit.shifts, again);
}

}  // namespace btr
