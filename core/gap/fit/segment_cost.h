#pragma once
#include <ceres/ceres.h>

#include <Eigen/Core>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"

namespace btr {

/// When the costs of one fit take differences for their Jacobians (a replay a column) and when they only bring the last
/// one up to date with what the step just taken showed (Broyden, Math. Comp. 19 (1965) 577: the least change that
/// agrees with it; no replay).
struct JacobianPolicy {
  bool difference = true;                 ///< the next one
  int age = 0;                            ///< updates since the last differences
  const Linearised* inherited = nullptr;  ///< of a model that this one's first parameters and starts come from
  bool startsOnly = false;                ///< the parameters stay: their columns are not asked for
  static constexpr int oldest = 6;
};

/// Residuals of one segment by the scaled parameters (first block, if there are any) and the shifts of its initial
/// state (next block, if there are any). Residuals beyond `limit` count in proportion to their size only (Huber).
class SegmentCost final : public ceres::CostFunction {
 public:
  /// Keeps references to all but `limit`.
  SegmentCost(const FitProblem& problem, const FitModel& model, std::size_t segment, SceneCache& scenes,
              const JacobianPolicy& policy, double limit);
  bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override;

  /// True if Evaluate would simulate at these numbers, given whether derivatives are wanted.
  bool simulatesAt(double const* const* blocks, bool jacobian) const;
  bool differencesNext() const { return policy_.difference || jacobian_.size() == 0; }
  /// Columns of the Jacobian that Evaluate would difference: of parameters, then of the initial state.
  Eigen::Index columns() const;
  /// What Evaluate would simulate at these numbers: residuals, then columns [from, to) of its Jacobian; of later parts
  /// (from > 0) only the columns. Changes nothing.
  std::vector<double> simulated(double const* const* blocks, Eigen::Index from, Eigen::Index to) const;
  /// Takes what other processes simulated, all parts of it in order.
  void take(double const* const* blocks, const std::vector<double>& simulated);

 private:
  Eigen::VectorXd gathered(double const* const* blocks) const;    ///< scaled parameters, then shifts
  std::vector<double> numbersOf(const Eigen::VectorXd& x) const;  ///< of the parameters, unscaled
  Eigen::VectorXd simulate(const Eigen::VectorXd& x) const;
  /// Of another start, near the one whose residuals are `here`.
  Eigen::VectorXd simulateBeside(const Eigen::VectorXd& x, const Eigen::VectorXd& here) const;
  /// Columns [from, to).
  Eigen::MatrixXd differences(const Eigen::VectorXd& x, const Eigen::VectorXd& here, Eigen::Index from,
                              Eigen::Index to) const;

  const FitProblem& problem_;
  const FitModel& model_;
  const Segment& segment_;
  SceneCache& scenes_;
  const JacobianPolicy& policy_;
  std::size_t index_;
  double limit_;
  mutable Eigen::VectorXd last_, here_;       ///< where it was asked for last, and what it was
  mutable Eigen::VectorXd base_, residuals_;  ///< where the Jacobian belongs
  mutable Eigen::MatrixXd jacobian_;          ///< of the residuals as they are, by scaled parameters, then shifts
  mutable Eigen::VectorXd aheadAt_;           ///< where `ahead_` was differenced
  Eigen::MatrixXd ahead_;
};

}  // namespace btr
