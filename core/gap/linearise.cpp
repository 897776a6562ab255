// Sensitivities of a fitted model, and what they say of its parameters.
#include <Eigen/Dense>
#include <cmath>

#include "core/gap/fit.h"

namespace btr {

double parameterStep(const FitProblem& problem, const FitParameter& parameter, double scaled) {
  const double size = problem.differenceStep;
  return (scaled + size) * parameter.scale > parameter.maximum ? -size : size;
}

Eigen::VectorXd Linearised::profile(const FitProblem& problem, const Eigen::VectorXd& column) const {
  Eigen::VectorXd left = column;
  Eigen::Index at = 0;
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    const auto count = static_cast<Eigen::Index>(problem.segments[s].row.size());
    const Eigen::MatrixXd& basis = starts[s];
    if (basis.cols() > 0) {
      const Eigen::VectorXd part = left.segment(at, count);
      left.segment(at, count) = part - basis * (basis.transpose() * part);
    }
    at += count;
  }
  return left;
}

Linearised linearise(const FitProblem& problem, const Fit& fit) {
  const FitModel& model = fit.model;
  SceneCache scenes(problem, model);
  Linearised result;
  const auto total = static_cast<Eigen::Index>(problem.residuals());
  result.residuals.resize(total);
  Eigen::MatrixXd& raw = result.raw;
  raw.resize(total, static_cast<Eigen::Index>(model.parameters.size()));
  Eigen::Index at = 0;
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    const Segment& segment = problem.segments[s];
    const auto count = static_cast<Eigen::Index>(segment.row.size());
    const auto simulate = [&](const std::vector<double>& numbers, const std::vector<double>& shift) {
      const auto values = residualsOf(problem, segment, scenes.scene(numbers, segment.trial), shift);
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), count));
    };
    const Eigen::VectorXd here = simulate(model.values, fit.shifts[s]);
    result.residuals.segment(at, count) = here;
    for (std::size_t i = 0; i < model.parameters.size(); ++i) {
      const FitParameter& parameter = model.parameters[i];
      std::vector<double> moved = model.values;
      const double step = parameterStep(problem, parameter, moved[i] / parameter.scale);
      moved[i] += step * parameter.scale;
      raw.block(at, static_cast<Eigen::Index>(i), count, 1) = (simulate(moved, fit.shifts[s]) - here) / step;
    }
    Eigen::MatrixXd starts(count, static_cast<Eigen::Index>(fit.shifts[s].size()));
    for (std::size_t i = 0; i < fit.shifts[s].size(); ++i) {
      std::vector<double> moved = fit.shifts[s];
      moved[i] += startStep;
      starts.col(static_cast<Eigen::Index>(i)) = (simulate(model.values, moved) - here) / startStep;
    }
    result.first.push_back(at);
    result.rawStarts.push_back(starts);
    if (starts.cols() > 0) {
      // With their prior of one standard error: an orthonormal basis B of what they explain, shrunk by λ/√(1+λ²).
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(starts, Eigen::ComputeThinU);
      Eigen::MatrixXd basis = svd.matrixU();
      for (Eigen::Index i = 0; i < basis.cols(); ++i) {
        const double lambda = svd.singularValues()[i];
        basis.col(i) *= lambda / std::sqrt(1 + lambda * lambda);
      }
      starts = basis;
    }
    result.starts.push_back(starts);
    at += count;
  }
  result.profiled = result.profile(problem, result.residuals);
  result.columns.resize(total, raw.cols());
  for (Eigen::Index i = 0; i < raw.cols(); ++i) result.columns.col(i) = result.profile(problem, raw.col(i));
  return result;
}

Uncertainty uncertaintyOf(const FitProblem& problem, const Fit& fit, const Linearised& linear) {
  const Eigen::Index p = linear.columns.cols();
  Uncertainty result;
  result.correlation = Eigen::MatrixXd::Identity(p, p);
  if (p == 0) return result;
  // The flat prior keeps this invertible where the recordings say nothing.
  Eigen::MatrixXd normal = linear.columns.transpose() * linear.columns;
  for (Eigen::Index i = 0; i < p; ++i) {
    const FitParameter& parameter = fit.model.parameters[static_cast<std::size_t>(i)];
    const double weight = parameter.scale / (10 * (parameter.maximum - parameter.minimum));
    normal(i, i) += weight * weight;
  }
  const Eigen::MatrixXd inverse = normal.ldlt().solve(Eigen::MatrixXd::Identity(p, p));
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

std::vector<double> blockScores(const FitProblem& problem, const Eigen::VectorXd& residuals, Fold fold) {
  std::vector<double> sum(static_cast<std::size_t>(problem.blocks), 0), count(sum.size(), 0);
  Eigen::Index at = 0;
  for (const Segment& segment : problem.segments)
    for (std::size_t k = 0; k < segment.row.size(); ++k, ++at) {
      if (fold != Fold::all && segment.fold[k] != static_cast<char>(fold)) continue;
      const auto block = static_cast<std::size_t>(segment.block[k]);
      sum[block] += residuals[at] * residuals[at];
      ++count[block];
    }
  for (std::size_t b = 0; b < sum.size(); ++b) sum[b] = count[b] > 0 ? sum[b] / count[b] : -1;
  return sum;
}

}  // namespace btr
