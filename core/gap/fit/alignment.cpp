#include "core/gap/fit/alignment.h"

#include <algorithm>

#include "core/gap/fit/segments.h"
#include "core/gap/recordings/binding.h"

namespace btr {
namespace {

bool isOfAJoint(const FitTrial& trial, std::size_t channel) {
  using What = Binding::Measured::What;
  const What what = trial.binding.measured[channel].what;
  return what == What::position || what == What::rate;
}

}  // namespace

Eigen::VectorXd clockColumn(const FitProblem& problem, const Eigen::VectorXd& residuals) {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(residuals.size());
  if (problem.walks || problem.impacts) return column;
  Eigen::Index at = 0;
  for (const Segment& segment : problem.segments) {
    const FitTrial& trial = problem.trials[segment.trial];
    const std::vector<double>& time = trial.recording.columns[0];
    const std::size_t count = segment.row.size();
    const auto simulated = [&](std::size_t k) {
      const std::size_t c = segment.channel[k];
      return trial.recording.columns[trial.binding.measured[c].column][segment.row[k]] / trial.noiseFloor[c] +
             residuals[at + static_cast<Eigen::Index>(k)];
    };
    // Rows of a channel follow one another.
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t c = segment.channel[k];
      if (!isOfAJoint(trial, c)) continue;
      const std::size_t before = k > 0 && segment.channel[k - 1] == c ? k - 1 : k;
      const std::size_t after = k + 1 < count && segment.channel[k + 1] == c ? k + 1 : k;
      const auto isFaulty = [&](std::size_t i) { return residuals[at + static_cast<Eigen::Index>(i)] == afterFault; };
      if (before == after || isFaulty(before) || isFaulty(k) || isFaulty(after)) continue;
      column[at + static_cast<Eigen::Index>(k)] =
          (simulated(after) - simulated(before)) / (time[segment.row[after]] - time[segment.row[before]]);
    }
    at += static_cast<Eigen::Index>(count);
  }
  return column;
}

double bestShift_s(const FitProblem& problem, const Eigen::VectorXd& residuals, const Eigen::VectorXd& column,
                   const Eigen::VectorXd& counts) {
  const double most_s = problem.givenStep_s / 2;
  const double norm = counts.dot(column.cwiseAbs2());
  if (!(norm > 0)) return 0;
  return std::clamp(-counts.dot(residuals.cwiseProduct(column)) / norm, -most_s, most_s);
}

Alignment align(const FitProblem& problem, Eigen::VectorXd& residuals) {
  const Eigen::VectorXd column = clockColumn(problem, residuals);
  Alignment result;
  result.shift_s = bestShift_s(problem, residuals, column, Eigen::VectorXd::Ones(residuals.size()));
  const double before = residuals.squaredNorm();
  residuals += result.shift_s * column;
  result.took = (before - residuals.squaredNorm()) / static_cast<double>(std::max<Eigen::Index>(1, residuals.size()));
  return result;
}

}  // namespace btr
