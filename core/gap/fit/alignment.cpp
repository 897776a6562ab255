#include "core/gap/fit/alignment.h"

#include <algorithm>
#include <cmath>

#include "core/gap/fit/segments.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/replay/followed_torques.h"

namespace btr {
namespace {

using What = Binding::Measured::What;

bool isOfAJoint(const Binding& binding, const Binding::Measured& measured) {
  return measured.what == What::position || measured.what == What::rate || isFollowedTorque(binding, measured);
}

/// How long a servo's damping holds it back behind its command.
double damps_s(const Scene& scene, const Binding::Measured& measured) {
  const Drive& drive = scene.robots[measured.object].drives[measured.part];
  return drive.kind == Drive::Kind::servo && drive.p > 0 ? drive.d / drive.p : 0;
}

}  // namespace

std::vector<double> clockColumn(const FitProblem& problem, const Segment& segment, const Scene& scene,
                                std::span<const double> residuals) {
  const FitTrial& trial = problem.trials[segment.trial];
  const std::vector<double>& time = trial.recording.columns[0];
  std::vector<double> column(residuals.size(), 0);
  const auto simulated = [&](std::size_t k) {
    const std::size_t c = segment.channel[k];
    const double recorded = trial.recording.columns[trial.binding.measured[c].column][segment.row[k]];
    return recorded + residuals[k] * trial.floorAt(c, segment.row[k]);
  };
  // Rows of a channel follow one another; between three of them, the parabola. At its ends a torque, which has no state
  // that began there, has the slope to its one neighbour.
  const auto isThere = [&](std::size_t k, std::size_t c) {
    return k < residuals.size() && segment.channel[k] == c && residuals[k] != afterFault;
  };
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    const std::size_t c = segment.channel[k];
    const Binding::Measured& measured = trial.binding.measured[c];
    if (!isOfAJoint(trial.binding, measured) || !isThere(k, c)) continue;
    const bool hasBefore = k > 0 && isThere(k - 1, c), hasAfter = isThere(k + 1, c);
    if (!hasBefore || !hasAfter) {
      if (hasBefore == hasAfter || !isFollowedTorque(trial.binding, measured)) continue;
      const std::size_t other = hasBefore ? k - 1 : k + 1;
      column[k] = (simulated(other) - simulated(k)) / (time[segment.row[other]] - time[segment.row[k]]) /
                  trial.floorAt(c, segment.row[k]);
      continue;
    }
    const double now = time[segment.row[k]];
    const double earlier_s = now - time[segment.row[k - 1]], later_s = time[segment.row[k + 1]] - now;
    const double before = (simulated(k) - simulated(k - 1)) / earlier_s;
    const double after = (simulated(k + 1) - simulated(k)) / later_s;
    const double first = (before * later_s + after * earlier_s) / (earlier_s + later_s);
    const double second = 2 * (after - before) / (earlier_s + later_s);
    column[k] = (first + damps_s(scene, trial.binding.measured[c]) * second) / trial.floorAt(c, segment.row[k]);
  }
  return column;
}

Eigen::VectorXd clockColumn(const FitProblem& problem, const Eigen::VectorXd& residuals) {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(residuals.size());
  if (problem.walks || problem.impacts) return column;
  std::vector<Scene> scenes;
  for (std::size_t t = 0; t < problem.trials.size(); ++t) scenes.push_back(problem.sceneOf(problem.given, t));
  std::size_t at = 0;
  const std::span<const double> all(residuals.data(), static_cast<std::size_t>(residuals.size()));
  for (const Segment& segment : problem.segments) {
    const std::vector<double> part =
        clockColumn(problem, segment, scenes[segment.trial], all.subspan(at, segment.row.size()));
    std::ranges::copy(part, column.begin() + static_cast<std::ptrdiff_t>(at));
    at += segment.row.size();
  }
  return column;
}

double mostShift_s(const FitProblem& problem) {
  constexpr double slack = 1.1;  // so that half a row is not at the bound
  double most_s = problem.givenStep_s / 2;
  for (const FitTrial& trial : problem.trials)
    if (!followedTorques(trial.binding).empty()) most_s = std::max(most_s, slack * trial.recording.samplePeriod() / 2);
  return most_s;
}

double bestShift_s(const FitProblem& problem, const Eigen::VectorXd& residuals, const Eigen::VectorXd& column,
                   const Eigen::VectorXd& counts) {
  const double most_s = mostShift_s(problem);
  const double norm = counts.dot(column.cwiseAbs2());
  if (!(norm > 0)) return 0;
  // In all, with what is shifted already.
  return std::clamp(-counts.dot(residuals.cwiseProduct(column)) / norm, -most_s - problem.shift_s,
                    most_s - problem.shift_s);
}

Alignment align(const FitProblem& problem, Eigen::VectorXd& residuals) {
  const Eigen::VectorXd column = clockColumn(problem, residuals);
  const double shift_s = bestShift_s(problem, residuals, column, Eigen::VectorXd::Ones(residuals.size()));
  const double before = (residuals - problem.shift_s * column).squaredNorm();
  residuals += shift_s * column;
  const auto count = static_cast<double>(std::max<Eigen::Index>(1, residuals.size()));
  return {problem.shift_s + shift_s, (before - residuals.squaredNorm()) / count,
          std::abs(problem.shift_s + shift_s) / mostShift_s(problem)};
}

}  // namespace btr
