#include "core/gap/fit/score.h"
#include "core/gap/fit/alignment.h"
#include "core/gap/fit/block_scores.h"
#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/uncertainty.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace btr {

double Scored::mean() const {
  double sum = 0, count = 0;
  for (const double block : blocks)
    if (block >= 0) {
      sum += block;
      ++count;
    }
  return count > 0 ? sum / count : 0;
}

Scored scoreAsIs(const FitProblem& problem, const Fit& fit) {
  constexpr int startIterations = 20;
  Scored scored;
  FitOptions options;
  options.iterations = startIterations;
  options.startsOnly = true;
  scored.fit = fitModel(problem, fit.model, fit.shifts, options);
  scored.heldOut = residualsOf(problem, scored.fit.model, scored.fit.shifts);
  scored.aligned = align(problem, scored.heldOut);
  scored.blocks = blockScores(problem, scored.heldOut, Fold::all);
  scored.step_s = problem.scene.step_s;
  return scored;
}

namespace {

/// Where the parameters would go without one half of the blocks: a Gauss–Newton step from the fit to everything, in
/// which a tenth of what everything says of each parameter is kept, so that one to which only the other half is
/// sensitive does not run away. `train` marks the residuals that count.
std::vector<double> withoutOther(const Fit& fit, const Linearised& linear, const Eigen::VectorXd& train,
                                 double length) {
  constexpr double kept = 0.1;
  const Eigen::MatrixXd columns = train.asDiagonal() * linear.columns;
  Eigen::MatrixXd normal = columns.transpose() * columns;
  for (Eigen::Index i = 0; i < normal.rows(); ++i) normal(i, i) += kept * linear.columns.col(i).squaredNorm() + 1e-12;
  const Eigen::VectorXd step = -normal.ldlt().solve(columns.transpose() * linear.profiled);
  std::vector<double> values = fit.model.values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const FitParameter& p = fit.model.parameters[i];
    values[i] = std::clamp(values[i] + length * step[static_cast<Eigen::Index>(i)] * p.scale, p.minimum, p.maximum);
  }
  return values;
}

std::vector<double> sizesInErrors(const FitModel& model, const Uncertainty& uncertainty) {
  std::vector<double> sizes(model.effects.size(), 0);
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const FitParameter& p = model.parameters[i];
    if (p.effect < 0 || !p.hasNeutral || !(uncertainty.standardError[i] > 0)) continue;
    double& most = sizes[static_cast<std::size_t>(p.effect)];
    most = std::max(most, std::abs(model.values[i] - p.given) / uncertainty.standardError[i]);
  }
  return sizes;
}

}  // namespace

Scored crossValidate(const FitProblem& problem, const Fit& fit) {
  return crossValidate(problem, fit, linearise(problem, fit));
}

Scored crossValidate(const FitProblem& problem, const Fit& fit, const Linearised& linear) {
  Scored scored{fit,
                std::vector<double>(static_cast<std::size_t>(problem.blocks), -1),
                Eigen::VectorXd::Zero(static_cast<Eigen::Index>(problem.residuals())),
                {},
                problem.scene.step_s,
                {},
                std::vector<double>(static_cast<std::size_t>(problem.blocks), -1)};
  const auto addBlocks = [&](const Eigen::VectorXd& residuals, Fold fold, std::vector<double>& all) {
    const std::vector<double> blocks = blockScores(problem, residuals, fold);
    for (std::size_t b = 0; b < blocks.size(); ++b)
      if (blocks[b] >= 0) all[b] = blocks[b];
  };
  scored.sizes = sizesInErrors(fit.model, uncertaintyOf(problem, fit, linear));
  for (const Fold trained : {Fold::first, Fold::second}) {
    const Fold other = trained == Fold::first ? Fold::second : Fold::first;
    Eigen::VectorXd train(linear.residuals.size());
    Eigen::Index at = 0;
    for (const Segment& segment : problem.segments)
      for (const char fold : segment.fold) train[at++] = fold == static_cast<char>(trained) ? 1 : 0;
    const double before = train.dot(linear.residuals.cwiseAbs2());
    FitModel half = fit.model;
    Eigen::VectorXd residuals = linear.residuals;
    // The step is a linear guess: shorter where it does not fit its own half at least as well.
    for (const double length : {1.0, 0.3, 0.0}) {
      half.values = withoutOther(fit, linear, train, length);
      residuals = length > 0 ? residualsOf(problem, half, fit.shifts) : linear.residuals;
      if (train.dot(residuals.cwiseAbs2()) <= 1.001 * before) break;
    }
    const Eigen::VectorXd column = clockColumn(problem, residuals);
    const double shift_s = bestShift_s(problem, residuals, column, train);
    const Eigen::VectorXd tests = Eigen::VectorXd::Ones(train.size()) - train;
    const Eigen::VectorXd unshifted = residuals - problem.shift_s * column;
    residuals += shift_s * column;
    scored.aligned.shift_s += (problem.shift_s + shift_s) / 2;
    scored.aligned.took +=
        (tests.dot(unshifted.cwiseAbs2()) - tests.dot(residuals.cwiseAbs2())) / static_cast<double>(residuals.size());
    addBlocks(residuals, other, scored.blocks);
    addBlocks(unshifted, other, scored.unshifted);
    scored.heldOut += tests.cwiseProduct(residuals);
  }
  scored.aligned.ofMost = std::abs(scored.aligned.shift_s) / mostShift_s(problem);
  return scored;
}

namespace {

/// t of the mean of paired differences.
double studentOf(const std::vector<double>& differences) {
  const auto n = static_cast<double>(differences.size());
  if (n < 3) return 0;
  double mean = 0, square = 0;
  for (const double d : differences) mean += d / n;
  for (const double d : differences) square += (d - mean) * (d - mean);
  const double error = std::sqrt(square / (n - 1) / n);
  return error > 0 ? mean / error : 0;
}

}  // namespace

PairedTest compare(const std::vector<double>& without, const std::vector<double>& with) {
  constexpr double resolution = 0.02;  // of a block's mean square: quantised rest gives 0
  std::vector<double> logarithms, raw;
  double before = 0, after = 0;
  for (std::size_t b = 0; b < without.size(); ++b) {
    if (without[b] < 0 || with[b] < 0) continue;
    logarithms.push_back(std::log((without[b] + resolution) / (with[b] + resolution)));
    raw.push_back(without[b] - with[b]);
    before += without[b];
    after += with[b];
  }
  PairedTest result;
  if (raw.size() < 3 || before <= 0) return result;
  result.gain = 1 - after / before;
  const double byLogarithm = studentOf(logarithms), byError = studentOf(raw);
  result.t = std::abs(byLogarithm) > std::abs(byError) ? byLogarithm : byError;
  // Both must not point apart: a model that wins here and loses there is not better.
  if (byLogarithm * byError < 0 && result.gain < 0.05) result.t = std::min(byLogarithm, byError);
  const boost::math::students_t distribution(static_cast<double>(raw.size() - 1));
  result.pValue = std::min(1.0, 2 * boost::math::cdf(boost::math::complement(distribution, result.t)));
  return result;
}

}  // namespace btr
