#include "core/gap/fit.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>

namespace btr {
namespace {

constexpr double differenceStep = 1e-2;  // of a parameter's scale, or of an initial state's standard error
constexpr double flatPrior = 10;         // ranges of a parameter: holds what the recordings do not tell, nothing else

/// Huber's loss as a residual of its own.
double tamed(double r, double limit) {
  return std::abs(r) <= limit ? r : std::copysign(std::sqrt(limit * (2 * std::abs(r) - limit)), r);
}
double tamedSlope(double r, double limit) {
  return std::abs(r) <= limit ? 1 : limit / std::sqrt(limit * (2 * std::abs(r) - limit));
}

bool takesPart(const Segment& segment, std::size_t k, Fold fold) {
  return fold == Fold::all || segment.fold[k] == static_cast<char>(fold);
}

/// A step that stays inside the bounds.
double stepOf(const FitParameter& parameter, double value) {
  const double step = differenceStep * parameter.scale;
  return value + step > parameter.maximum ? -step : step;
}

/// Residuals of one segment by the scaled parameters and the shifts of its initial state.
class SegmentCost final : public ceres::CostFunction {
 public:
  SegmentCost(const FitProblem& problem, const FitModel& model, const Segment& segment, SceneCache& scenes, Fold fold,
              double limit)
      : problem_(problem), model_(model), segment_(segment), scenes_(scenes), fold_(fold), limit_(limit) {
    if (!model.parameters.empty())
      mutable_parameter_block_sizes()->push_back(static_cast<int>(model.parameters.size()));
    if (!segment.nuisances.empty())
      mutable_parameter_block_sizes()->push_back(static_cast<int>(segment.nuisances.size()));
    set_num_residuals(static_cast<int>(segment.row.size()));
  }

  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override {
    const bool hasParameters = !model_.parameters.empty();
    std::vector<double> numbers(model_.parameters.size()), shift(segment_.nuisances.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = blocks[0][i] * model_.parameters[i].scale;
    for (std::size_t i = 0; i < shift.size(); ++i) shift[i] = blocks[hasParameters ? 1 : 0][i];
    // Ceres asks for the residuals first, then for the same with their derivatives.
    std::vector<double> key = numbers;
    key.insert(key.end(), shift.begin(), shift.end());
    if (key != last_ || here_.empty()) {
      here_ = simulate(numbers, shift);
      last_ = key;
    }
    const std::vector<double>& here = here_;
    for (std::size_t k = 0; k < here.size(); ++k)
      residuals[k] = takesPart(segment_, k, fold_) ? tamed(here[k], limit_) : 0;
    if (!jacobians) return true;

    const auto column = [&](double* jacobian, std::size_t width, std::size_t i, const std::vector<double>& there,
                            double step) {
      for (std::size_t k = 0; k < here.size(); ++k)
        jacobian[k * width + i] =
            takesPart(segment_, k, fold_) ? tamedSlope(here[k], limit_) * (there[k] - here[k]) / step : 0;
    };
    if (double* jacobian = hasParameters ? jacobians[0] : nullptr)
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        const double step = stepOf(model_.parameters[i], numbers[i]);
        std::vector<double> moved = numbers;
        moved[i] += step;
        column(jacobian, numbers.size(), i, simulate(moved, shift), step / model_.parameters[i].scale);
      }
    if (double* jacobian = shift.empty() ? nullptr : jacobians[hasParameters ? 1 : 0])
      for (std::size_t i = 0; i < shift.size(); ++i) {
        std::vector<double> moved = shift;
        moved[i] += startStep;
        column(jacobian, shift.size(), i, simulate(numbers, moved), startStep);
      }
    return true;
  }

  static constexpr double startStep = 0.1;

 private:
  std::vector<double> simulate(const std::vector<double>& numbers, const std::vector<double>& shift) const {
    return residualsOf(problem_, segment_, scenes_.scene(numbers, segment_.trial), shift);
  }

  const FitProblem& problem_;
  const FitModel& model_;
  const Segment& segment_;
  SceneCache& scenes_;
  Fold fold_;
  double limit_;
  mutable std::vector<double> last_, here_;  ///< where it was asked for last, and what it was
};

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
  Eigen::VectorXd all(static_cast<Eigen::Index>(problem.residuals()));
  Eigen::Index at = 0;
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    const Segment& segment = problem.segments[s];
    const auto part = residualsOf(problem, segment, scenes.scene(model.values, segment.trial),
                                  shifts.empty() ? std::vector<double>{} : shifts[s]);
    for (const double value : part) all[at++] = value;
  }
  return all;
}

Fit fitModel(const FitProblem& problem, const FitModel& model, const std::vector<std::vector<double>>& shifts,
             const FitOptions& options) {
  Fit fit{model, shifts.empty() ? zeroShifts(problem) : shifts, 0};
  SceneCache scenes(problem, model);

  // Far outliers: beyond six times what residuals are at the start.
  const Eigen::VectorXd start = residualsOf(problem, model, fit.shifts);
  const double rms = std::sqrt(start.squaredNorm() / std::max<double>(1, static_cast<double>(start.size())));
  const double limit = 6 * std::max(1.0, rms);

  std::vector<double> scaled;
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    scaled.push_back(std::clamp(model.values[i], model.parameters[i].minimum, model.parameters[i].maximum) /
                     model.parameters[i].scale);

  ceres::Problem::Options ownership;
  ceres::Problem least(ownership);
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    std::vector<double*> blocks;
    if (!scaled.empty()) blocks.push_back(scaled.data());
    if (!fit.shifts[s].empty()) blocks.push_back(fit.shifts[s].data());
    if (blocks.empty()) continue;
    // Ceres takes ownership.
    auto cost = std::make_unique<SegmentCost>(problem, model, problem.segments[s], scenes, options.fold, limit);
    least.AddResidualBlock(cost.release(), nullptr, blocks);
    if (fit.shifts[s].empty()) continue;
    const std::size_t count = fit.shifts[s].size();
    auto prior = std::make_unique<Prior>(std::vector<double>(count, 0.0), std::vector<double>(count, 1.0));
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
      least.SetParameterLowerBound(scaled.data(), static_cast<int>(i),
                                   model.parameters[i].minimum / model.parameters[i].scale);
      least.SetParameterUpperBound(scaled.data(), static_cast<int>(i),
                                   model.parameters[i].maximum / model.parameters[i].scale);
    }
  }
  if (least.NumParameterBlocks() == (options.startsOnly && !scaled.empty() ? 1 : 0)) {
    fit.cost = start.squaredNorm() / 2;
    return fit;
  }

  ceres::Solver::Options solver;
  solver.max_num_iterations = options.iterations;
  solver.function_tolerance = 3e-4;
  solver.parameter_tolerance = 1e-6;
  solver.initial_trust_region_radius = 10;
  solver.linear_solver_type = problem.segments.size() > 8 ? ceres::DENSE_SCHUR : ceres::DENSE_QR;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &least, &summary);
  fit.cost = summary.final_cost;
  for (std::size_t i = 0; i < scaled.size(); ++i)
    fit.model.values[i] =
        std::clamp(scaled[i] * model.parameters[i].scale, model.parameters[i].minimum, model.parameters[i].maximum);
  return fit;
}

}  // namespace btr
