#include "core/gap/segment_cost.h"

#include <cmath>

namespace btr {
namespace {

/// Huber's loss as a residual of its own.
double tamed(double r, double limit) {
  return std::abs(r) <= limit ? r : std::copysign(std::sqrt(limit * (2 * std::abs(r) - limit)), r);
}
double tamedSlope(double r, double limit) {
  return std::abs(r) <= limit ? 1 : limit / std::sqrt(limit * (2 * std::abs(r) - limit));
}

}  // namespace

SegmentCost::SegmentCost(const FitProblem& problem, const FitModel& model, std::size_t segment, SceneCache& scenes,
                         const JacobianPolicy& policy, double limit)
    : problem_(problem),
      model_(model),
      segment_(problem.segments[segment]),
      scenes_(scenes),
      policy_(policy),
      index_(segment),
      limit_(limit) {
  if (!model.parameters.empty()) mutable_parameter_block_sizes()->push_back(static_cast<int>(model.parameters.size()));
  if (!segment_.nuisances.empty())
    mutable_parameter_block_sizes()->push_back(static_cast<int>(segment_.nuisances.size()));
  set_num_residuals(static_cast<int>(segment_.row.size()));
}

Eigen::VectorXd SegmentCost::simulate(const Eigen::VectorXd& x) const {
  std::vector<double> numbers(model_.parameters.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = x[static_cast<Eigen::Index>(i)] * model_.parameters[i].scale;
  const std::vector<double> shift(x.begin() + static_cast<std::ptrdiff_t>(numbers.size()), x.end());
  const std::vector<double> list = residualsOf(problem_, segment_, scenes_.scene(numbers, segment_.trial), shift);
  return Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
}

void SegmentCost::differences(const Eigen::VectorXd& x) const {
  const auto parameters = static_cast<Eigen::Index>(model_.parameters.size());
  const bool first = jacobian_.size() == 0;
  jacobian_.resize(here_.size(), x.size());
  const Linearised* known = first ? policy_.inherited : nullptr;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    if (known && i < known->raw.cols()) {
      jacobian_.col(i) = known->raw.block(known->first[index_], i, here_.size(), 1);
      continue;
    }
    if (known && i >= parameters) {
      jacobian_.col(i) = known->rawStarts[index_].col(i - parameters);
      continue;
    }
    const double step =
        i < parameters ? parameterStep(problem_, model_.parameters[static_cast<std::size_t>(i)], x[i]) : startStep;
    Eigen::VectorXd moved = x;
    moved[i] += step;
    jacobian_.col(i) = (simulate(moved) - here_) / step;
  }
}

bool SegmentCost::Evaluate(double const* const* blocks, double* residuals, double** jacobians) const {
  const auto parameters = static_cast<Eigen::Index>(model_.parameters.size());
  const auto starts = static_cast<Eigen::Index>(segment_.nuisances.size());
  Eigen::VectorXd x(parameters + starts);
  if (parameters > 0) x.head(parameters) = Eigen::Map<const Eigen::VectorXd>(blocks[0], parameters);
  if (starts > 0) x.tail(starts) = Eigen::Map<const Eigen::VectorXd>(blocks[parameters > 0 ? 1 : 0], starts);
  // Ceres asks for the residuals first, then for the same with their derivatives.
  if (last_.size() == 0 || x != last_) {
    here_ = simulate(x);
    last_ = x;
  }
  for (Eigen::Index k = 0; k < here_.size(); ++k) residuals[k] = tamed(here_[k], limit_);
  if (!jacobians) return true;

  if (policy_.difference || jacobian_.size() == 0) {
    differences(x);
  } else if (const Eigen::VectorXd step = x - base_; step.squaredNorm() > 0) {
    jacobian_ += (here_ - residuals_ - jacobian_ * step) * step.transpose() / step.squaredNorm();
  }
  base_ = x;
  residuals_ = here_;

  const auto hand = [&](double* jacobian, Eigen::Index from, Eigen::Index width) {
    if (!jacobian) return;
    for (Eigen::Index k = 0; k < here_.size(); ++k)
      for (Eigen::Index i = 0; i < width; ++i)
        jacobian[k * width + i] = tamedSlope(here_[k], limit_) * jacobian_(k, from + i);
  };
  if (parameters > 0) hand(jacobians[0], 0, parameters);
  if (starts > 0) hand(jacobians[parameters > 0 ? 1 : 0], parameters, starts);
  return true;
}

}  // namespace btr
