#pragma once
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"

namespace btr {

struct Linearised;

struct FitOptions {
  int iterations = 20;
  bool startsOnly = false;  ///< the parameters stay; only initial states are fitted
  /// Of a fit whose parameters this model begins with, near where it starts: saves the first differences.
  const Linearised* inherited = nullptr;
  /// Called after each iteration with the share of all that were allowed; false throws Cancelled.
  std::function<bool(double)> goOn = {};
  double tolerance = 3e-4;  ///< ends where an iteration takes a smaller share of the cost
};

/// A model fitted to the recordings.
struct Fit {
  FitModel model;
  std::vector<std::vector<double>> shifts;  ///< of the initial states, by segment and nuisance
  double cost = 0;                          ///< ½ sum of squared residuals, and of the shifts
};

/// Bounded least squares (Levenberg–Marquardt, Ceres) over the model's parameters and each segment's initial state. Far
/// outliers count in proportion to their size only (Huber). Starts from model.values; `shifts` may be empty: zero.
Fit fitModel(const FitProblem& problem, const FitModel& model, const std::vector<std::vector<double>>& shifts,
             const FitOptions& options);

/// All residuals of a fitted model, one segment after the other.
Eigen::VectorXd residualsOf(const FitProblem& problem, const FitModel& model,
                            const std::vector<std::vector<double>>& shifts);

}  // namespace btr
