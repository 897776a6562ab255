#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"

namespace btr {

/// Steps of differences: of a parameter, in its scale, the way that stays inside its bounds (`scaled`: its value in
/// scales); of an initial state, in its standard error.
double parameterStep(const FitProblem& problem, const FitParameter& parameter, double scaled);
inline constexpr double startStep = 0.1;

/// Residuals and how they change with the parameters, what initial states explain taken out of both: least squares over
/// the columns is then least squares over parameters and initial states. Columns are per `scale` of their parameter.
struct Linearised {
  Eigen::VectorXd residuals;               ///< as they are
  Eigen::VectorXd profiled;                ///< initial states taken out
  Eigen::MatrixXd columns;                 ///< by residual and parameter, initial states taken out
  std::vector<Eigen::MatrixXd> starts;     ///< by segment: orthonormal columns of what its initial state explains
  Eigen::MatrixXd raw;                     ///< by residual and parameter, as they are
  std::vector<Eigen::MatrixXd> rawStarts;  ///< by segment: by residual and initial state, as they are
  std::vector<Eigen::Index> first;         ///< by segment: its first residual
  /// Takes what initial states explain out of a column.
  Eigen::VectorXd profile(const FitProblem& problem, const Eigen::VectorXd& column) const;
};
Linearised linearise(const FitProblem& problem, const Fit& fit);

}  // namespace btr
