#include "core/gap/fit/segment_cost.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/segments.h"

#include <cmath>
#include <span>

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

std::vector<double> SegmentCost::numbersOf(const Eigen::VectorXd& x) const {
  std::vector<double> numbers(model_.parameters.size());
  for (std::size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = x[static_cast<Eigen::Index>(i)] * model_.parameters[i].scale;
  return numbers;
}

Eigen::VectorXd SegmentCost::simulate(const Eigen::VectorXd& x) const {
  const std::vector<double> numbers = numbersOf(x);
  const std::vector<double> shift(x.begin() + static_cast<std::ptrdiff_t>(numbers.size()), x.end());
  const std::vector<double> list = residualsOf(problem_, segment_, scenes_.scene(numbers, segment_.trial), shift);
  return Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
}

Eigen::VectorXd SegmentCost::simulateBeside(const Eigen::VectorXd& x, const Eigen::VectorXd& here) const {
  const std::vector<double> numbers = numbersOf(x);
  const std::vector<double> shift(x.begin() + static_cast<std::ptrdiff_t>(numbers.size()), x.end());
  const std::vector<double> list = residualsBeside(problem_, segment_, scenes_.scene(numbers, segment_.trial), shift,
                                                   {here.data(), static_cast<std::size_t>(here.size())});
  return Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
}

Eigen::MatrixXd SegmentCost::differences(const Eigen::VectorXd& x, const Eigen::VectorXd& here, Eigen::Index from,
                                         Eigen::Index to) const {
  const auto parameters = static_cast<Eigen::Index>(model_.parameters.size());
  Eigen::MatrixXd jacobian(here.size(), to - from);
  const Linearised* known = jacobian_.size() == 0 ? policy_.inherited : nullptr;
  for (Eigen::Index i = from; i < to; ++i) {
    auto column = jacobian.col(i - from);
    if (policy_.startsOnly && i < parameters) {
      column.setZero();
      continue;
    }
    if (known && i < known->raw.cols()) {
      column = known->raw.block(known->first[index_], i, here.size(), 1);
      continue;
    }
    const bool felt = i < parameters || isFelt(segment_, segment_.nuisances[static_cast<std::size_t>(i - parameters)],
                                               scenes_.scene(numbersOf(x), segment_.trial));
    if (!felt) {
      column.setZero();
      continue;
    }
    if (known && i >= parameters) {
      column = known->rawStarts[index_].col(i - parameters);
      // A spin that nothing felt before, and that the model's new effect asks for.
      if (!column.isZero(0)) continue;
    }
    const double step =
        i < parameters ? parameterStep(problem_, model_.parameters[static_cast<std::size_t>(i)], x[i]) : startStep;
    Eigen::VectorXd moved = x;
    moved[i] += step;
    column = ((i < parameters ? simulate(moved) : simulateBeside(moved, here)) - here) / step;
  }
  return jacobian;
}

Eigen::VectorXd SegmentCost::gathered(double const* const* blocks) const {
  const auto parameters = static_cast<Eigen::Index>(model_.parameters.size());
  const auto starts = static_cast<Eigen::Index>(segment_.nuisances.size());
  Eigen::VectorXd x(parameters + starts);
  if (parameters > 0) x.head(parameters) = Eigen::Map<const Eigen::VectorXd>(blocks[0], parameters);
  if (starts > 0) x.tail(starts) = Eigen::Map<const Eigen::VectorXd>(blocks[parameters > 0 ? 1 : 0], starts);
  return x;
}

bool SegmentCost::simulatesAt(double const* const* blocks, bool jacobian) const {
  const Eigen::VectorXd x = gathered(blocks);
  return last_.size() == 0 || x != last_ || (jacobian && differencesNext() && (aheadAt_.size() == 0 || x != aheadAt_));
}

Eigen::Index SegmentCost::columns() const {
  return static_cast<Eigen::Index>(model_.parameters.size() + segment_.nuisances.size());
}

std::vector<double> SegmentCost::simulated(double const* const* blocks, Eigen::Index from, Eigen::Index to) const {
  const Eigen::VectorXd x = gathered(blocks);
  const Eigen::VectorXd here = last_.size() > 0 && x == last_ ? here_ : simulate(x);
  std::vector<double> numbers;
  if (from == 0) numbers.assign(here.begin(), here.end());
  const Eigen::MatrixXd columns = differences(x, here, from, to);
  numbers.insert(numbers.end(), columns.data(), columns.data() + columns.size());
  return numbers;
}

void SegmentCost::take(double const* const* blocks, const std::vector<double>& simulated) {
  const auto rows = static_cast<Eigen::Index>(segment_.row.size());
  if (std::ssize(simulated) < rows) return;  // it failed there: Evaluate simulates
  last_ = gathered(blocks);
  here_ = Eigen::Map<const Eigen::VectorXd>(simulated.data(), rows);
  if (std::ssize(simulated) != rows * (1 + last_.size())) return;
  aheadAt_ = last_;
  ahead_ = Eigen::Map<const Eigen::MatrixXd>(simulated.data() + rows, rows, last_.size());
}

bool SegmentCost::Evaluate(double const* const* blocks, double* residuals, double** jacobians) const {
  const auto parameters = static_cast<Eigen::Index>(model_.parameters.size());
  const auto starts = static_cast<Eigen::Index>(segment_.nuisances.size());
  const Eigen::VectorXd x = gathered(blocks);
  // Ceres asks for the residuals first, then for the same with their derivatives.
  if (last_.size() == 0 || x != last_) {
    here_ = simulate(x);
    last_ = x;
  }
  for (Eigen::Index k = 0; k < here_.size(); ++k) residuals[k] = tamed(here_[k], limit_);
  if (!jacobians) return true;

  if (differencesNext()) {
    jacobian_ = aheadAt_.size() > 0 && x == aheadAt_ ? ahead_ : differences(x, here_, 0, x.size());
    aheadAt_.resize(0);  // what it was may have been inherited: not for a second time
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
