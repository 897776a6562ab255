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

/// How long a servo's damping holds it back behind its command.
double damps_s(const Scene& scene, const Binding::Measured& measured) {
  const Drive& drive = scene.robots[measured.object].drives[measured.part];
  return drive.kind == Drive::Kind::servo && drive.p > 0 ? drive.d / drive.p : 0;
}

}  // namespace

Eigen::VectorXd clockColumn(const FitProblem& problem, const Eigen::VectorXd& residuals) {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(residuals.size());
  if (problem.walks || problem.impacts) return column;
  std::vector<Scene> scenes;
  for (std::size_t t = 0; t < problem.trials.size(); ++t) scenes.push_back(problem.sceneOf(problem.given, t));
  Eigen::Index at = 0;
  for (const Segment& segment : problem.segments) {
    const FitTrial& trial = problem.trials[segment.trial];
    const std::vector<double>& time = trial.recording.columns[0];
    const std::size_t count = segment.row.size();
    const auto residual = [&](std::size_t k) { return residuals[at + static_cast<Eigen::Index>(k)]; };
    const auto simulated = [&](std::size_t k) {
      const std::size_t c = segment.channel[k];
      const double recorded = trial.recording.columns[trial.binding.measured[c].column][segment.row[k]];
      return recorded / trial.noiseFloor[c] + residual(k);
    };
    // Rows of a channel follow one another; between three of them, the parabola.
    for (std::size_t k = 1; k + 1 < count; ++k) {
      const std::size_t c = segment.channel[k];
      if (!isOfAJoint(trial, c) || segment.channel[k - 1] != c || segment.channel[k + 1] != c) continue;
      if (residual(k - 1) == afterFault || residual(k) == afterFault || residual(k + 1) == afterFault) continue;
      const double now = time[segment.row[k]];
      const double earlier_s = now - time[segment.row[k - 1]], later_s = time[segment.row[k + 1]] - now;
      const double before = (simulated(k) - simulated(k - 1)) / earlier_s;
      const double after = (simulated(k + 1) - simulated(k)) / later_s;
      const double first = (before * later_s + after * earlier_s) / (earlier_s + later_s);
      const double second = 2 * (after - before) / (earlier_s + later_s);
      column[at + static_cast<Eigen::Index>(k)] =
          first + damps_s(scenes[segment.trial], trial.binding.measured[c]) * second;
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
