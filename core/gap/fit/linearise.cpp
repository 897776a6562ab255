#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/gap/fit/linearise.h"

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/fit/segments.h"

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

namespace {

/// Residuals of a segment, then a column for each parameter, then one for each initial state.
Eigen::MatrixXd differencesOf(const FitProblem& problem, const Fit& fit, std::size_t index, SceneCache& scenes) {
  const FitModel& model = fit.model;
  const Segment& segment = problem.segments[index];
  const std::vector<double>& shift = fit.shifts[index];
  const auto count = static_cast<Eigen::Index>(segment.row.size());
  Eigen::MatrixXd all(count, static_cast<Eigen::Index>(1 + model.parameters.size() + shift.size()));
  Eigen::Index column = 0;
  const auto simulate = [&](const std::vector<double>& numbers, const std::vector<double>& shifts) {
    const auto values = residualsOf(problem, segment, scenes.scene(numbers, segment.trial), shifts);
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(values.data(), count));
  };
  all.col(column++) = simulate(model.values, shift);
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const FitParameter& parameter = model.parameters[i];
    std::vector<double> moved = model.values;
    const double step = parameterStep(problem, parameter, moved[i] / parameter.scale);
    moved[i] += step * parameter.scale;
    all.col(column++) = (simulate(moved, shift) - all.col(0)) / step;
  }
  for (std::size_t i = 0; i < shift.size(); ++i) {
    std::vector<double> moved = shift;
    moved[i] += startStep;
    if (!isFelt(segment, segment.nuisances[i], scenes.scene(model.values, segment.trial))) {
      all.col(column++).setZero();
      continue;
    }
    const std::vector<double> values = residualsBeside(problem, segment, scenes.scene(model.values, segment.trial),
                                                       moved, std::span(all.data(), static_cast<std::size_t>(count)));
    all.col(column++) = (Eigen::Map<const Eigen::VectorXd>(values.data(), count) - all.col(0)) / startStep;
  }
  return all;
}

/// A spin is held by what was said of it, or by how fast a ball can spin at all, and not by the samples that are
/// compared: what holds it counts like a measurement.
bool hasSpin(const Segment& segment) {
  return std::ranges::any_of(segment.nuisances, [](const Nuisance& n) { return n.what == Nuisance::What::ballSpin; });
}

/// An orthonormal basis of what a segment's initial state explains, in standard deviations of its prior, shrunk as far
/// as the prior holds it: by λ/√(1+λ²), where it comes from the samples that are compared. Beside a spin, which was
/// measured, too, what is left weighs 1/√(1+λ²), so that its square is what residuals and prior cost together.
Eigen::MatrixXd explainedByStart(const Segment& segment, Eigen::MatrixXd starts) {
  if (starts.cols() == 0) return starts;
  for (Eigen::Index i = 0; i < starts.cols(); ++i) starts.col(i) /= segment.nuisances[static_cast<std::size_t>(i)].hold;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(starts, Eigen::ComputeThinU);
  Eigen::MatrixXd basis = svd.matrixU();
  const bool spins = hasSpin(segment);
  for (Eigen::Index i = 0; i < basis.cols(); ++i) {
    const double lambda = svd.singularValues()[i], left = 1 / std::sqrt(1 + lambda * lambda);
    basis.col(i) *= spins ? std::sqrt(1 - left) : lambda * left;
  }
  return basis;
}

}  // namespace

Linearised linearise(const FitProblem& problem, const Fit& fit) {
  const auto parameters = static_cast<Eigen::Index>(fit.model.parameters.size());
  const int replays =
      1 + static_cast<int>(parameters) + (fit.shifts.empty() ? 0 : static_cast<int>(fit.shifts[0].size()));
  SceneCache scenes(problem, fit.model);
  const auto numbers = bySegment(problem, replays, [&](std::size_t s) {
    const Eigen::MatrixXd all = differencesOf(problem, fit, s, scenes);
    return std::vector<double>(all.data(), all.data() + all.size());
  });
  Linearised result;
  const auto total = static_cast<Eigen::Index>(problem.residuals());
  result.residuals.resize(total);
  result.raw.resize(total, parameters);
  Eigen::VectorXd atSaid = Eigen::VectorXd::Zero(total);
  Eigen::Index at = 0;
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    const auto count = static_cast<Eigen::Index>(problem.segments[s].row.size());
    const auto width = 1 + parameters + static_cast<Eigen::Index>(fit.shifts[s].size());
    const Eigen::Map<const Eigen::MatrixXd> all(numbers[s].data(), count, width);
    result.residuals.segment(at, count) = all.col(0);
    if (parameters > 0) result.raw.middleRows(at, count) = all.middleCols(1, parameters);
    const Eigen::MatrixXd starts = all.rightCols(width - 1 - parameters);
    result.first.push_back(at);
    result.rawStarts.push_back(starts);
    result.starts.push_back(explainedByStart(problem.segments[s], starts));
    // What was measured of a spin is an error of its own: residuals are those at what was said.
    if (hasSpin(problem.segments[s]))
      atSaid.segment(at, count) -= starts * Eigen::Map<const Eigen::VectorXd>(fit.shifts[s].data(), starts.cols());
    at += count;
  }
  result.profiled = result.profile(problem, result.residuals + atSaid);
  result.columns.resize(total, parameters);
  for (Eigen::Index i = 0; i < parameters; ++i) result.columns.col(i) = result.profile(problem, result.raw.col(i));
  return result;
}

}  // namespace btr
