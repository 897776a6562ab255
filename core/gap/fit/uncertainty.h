#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/linearise.h"

namespace btr {

/// Standard errors of the parameters from the blocks' scatter (a sandwich: residuals of one block belong together), and
/// the correlations.
struct Uncertainty {
  std::vector<double> standardError;  ///< in the parameter's unit; infinite where it is not identifiable
  Eigen::MatrixXd correlation;
  std::vector<double> unsettled;  ///< unsettled(), where it was asked for; else empty

  /// Half the 95 % interval of a parameter, in its unit.
  double half95(std::size_t parameter) const;
};
/// Whether an interval of which this is the half says where a parameter is between its bounds.
bool isIdentifiable(const FitParameter& parameter, double half95);
Uncertainty uncertaintyOf(const FitProblem& problem, const Fit& fit, const Linearised& linearised);

/// How far each parameter may still be from where it belongs, beside what noise does, in its unit: the way that the
/// step's integration error, seen as residuals, has pushed it, and the way that a further step of the fit would go.
/// `stepChange`: the fit's residuals less those with half the step.
std::vector<double> unsettled(const FitProblem& problem, const Fit& fit, const Linearised& linearised,
                              const Eigen::VectorXd& stepChange);

}  // namespace btr
