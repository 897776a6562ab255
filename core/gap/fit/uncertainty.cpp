#include "core/gap/fit/uncertainty.h"
#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/linearise.h"

#include <Eigen/Dense>
#include <cmath>

namespace btr {

namespace {

/// (JᵀJ)⁻¹ over the parameters' scales. The flat prior keeps it finite where the recordings say nothing.
Eigen::MatrixXd inverseNormal(const FitModel& model, const Linearised& linear) {
  const Eigen::Index p = linear.columns.cols();
  Eigen::MatrixXd normal = linear.columns.transpose() * linear.columns;
  for (Eigen::Index i = 0; i < p; ++i) {
    const FitParameter& parameter = model.parameters[static_cast<std::size_t>(i)];
    const double weight = parameter.scale / (10 * (parameter.maximum - parameter.minimum));
    normal(i, i) += weight * weight;
  }
  return normal.ldlt().solve(Eigen::MatrixXd::Identity(p, p));
}

}  // namespace

std::vector<double> unsettled(const FitProblem& problem, const Fit& fit, const Linearised& linear,
                              const Eigen::VectorXd& stepChange) {
  // An error of first order: halving the step takes half of it away.
  constexpr double ofHalving = 2;
  const Eigen::MatrixXd toParameters = inverseNormal(fit.model, linear) * linear.columns.transpose();
  const Eigen::VectorXd byStep = ofHalving * toParameters * linear.profile(problem, stepChange);
  const Eigen::VectorXd byFit = toParameters * linear.profiled;
  std::vector<double> ways;
  for (Eigen::Index i = 0; i < byStep.size(); ++i)
    ways.push_back((std::abs(byStep[i]) + std::abs(byFit[i])) *
                   fit.model.parameters[static_cast<std::size_t>(i)].scale);
  return ways;
}

double Uncertainty::half95(std::size_t parameter) const {
  constexpr double normal95 = 1.96;
  return normal95 * standardError[parameter] + (unsettled.empty() ? 0 : unsettled[parameter]);
}

bool isIdentifiable(const FitParameter& parameter, double half95) {
  return half95 < 0.5 * (parameter.maximum - parameter.minimum);
}

Uncertainty uncertaintyOf(const FitProblem& problem, const Fit& fit, const Linearised& linear) {
  const Eigen::Index p = linear.columns.cols();
  Uncertainty result;
  result.correlation = Eigen::MatrixXd::Identity(p, p);
  if (p == 0) return result;
  const Eigen::MatrixXd inverse = inverseNormal(fit.model, linear);
  Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(p, p);
  std::vector<Eigen::VectorXd> scores(static_cast<std::size_t>(problem.blocks), Eigen::VectorXd::Zero(p));
  Eigen::Index at = 0;
  for (const Segment& segment : problem.segments)
    for (const int block : segment.block) {
      scores[static_cast<std::size_t>(block)] += linear.columns.row(at).transpose() * linear.profiled[at];
      ++at;
    }
  for (const Eigen::VectorXd& score : scores) meat += score * score.transpose();
  // Never less than what white noise of one noise floor leaves.
  const Eigen::MatrixXd covariance = inverse * meat * inverse;
  for (Eigen::Index i = 0; i < p; ++i)
    result.standardError.push_back(std::sqrt(std::max(covariance(i, i), inverse(i, i))) *
                                   fit.model.parameters[static_cast<std::size_t>(i)].scale);
  for (Eigen::Index i = 0; i < p; ++i)
    for (Eigen::Index j = 0; j < p; ++j)
      result.correlation(i, j) = inverse(i, j) / std::sqrt(inverse(i, i) * inverse(j, j));
  return result;
}

}  // namespace btr
