// Which effects would explain what is left: one perturbed replay a variant.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/gap/candidates.h"
#include "core/spec/error.h"

namespace btr {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Least squares on the fitted parameters' columns, ready to be taken out of many vectors.
class Projector {
 public:
  Projector(const MatrixXd& columns, const FitModel& model) : columns_(columns) {
    MatrixXd normal = columns.transpose() * columns;
    for (Eigen::Index i = 0; i < normal.rows(); ++i) {
      // A parameter may move over its range, not further.
      const FitParameter& p = model.parameters[static_cast<std::size_t>(i)];
      normal(i, i) += std::pow(p.scale / (p.maximum - p.minimum), 2);
    }
    solver_.compute(normal);
  }
  /// By how much the parameters [scales] would take `vector` away: −(least squares).
  VectorXd answer(const VectorXd& vector) const {
    if (columns_.cols() == 0) return VectorXd(0);
    return -solver_.solve(columns_.transpose() * vector);
  }
  VectorXd leftOf(const VectorXd& vector) const {
    return columns_.cols() == 0 ? vector : VectorXd(vector + columns_ * answer(vector));
  }

 private:
  const MatrixXd& columns_;
  Eigen::LDLT<MatrixXd> solver_;
};

struct Try {
  Values effect;
  VectorXd change;  ///< of the residuals, initial states taken out
  VectorXd left;    ///< fitted parameters taken out too
  double step = 0, gain = 0;
};

/// Non-negative least squares on a few columns by coordinate descent.
VectorXd nonNegative(const std::vector<const Try*>& tries, const VectorXd& target) {
  VectorXd steps = VectorXd::Zero(static_cast<Eigen::Index>(tries.size()));
  VectorXd rest = target;
  for (int round = 0; round < 100; ++round)
    for (std::size_t i = 0; i < tries.size(); ++i) {
      const double norm = tries[i]->left.squaredNorm();
      if (norm <= 0) continue;
      const double wanted = std::max(0.0, steps[static_cast<Eigen::Index>(i)] - rest.dot(tries[i]->left) / norm);
      rest += (wanted - steps[static_cast<Eigen::Index>(i)]) * tries[i]->left;
      steps[static_cast<Eigen::Index>(i)] = wanted;
    }
  return steps;
}

/// One number list per candidate: norm, number of starts, then for each share, effect values, parameters.
std::vector<double> screenOne(const FitProblem& problem, const Fit& fit, const Linearised& linear,
                              const Projector& projector, const VectorXd& rest, const EffectCandidate& candidate) {
  std::vector<Try> tries;
  double felt = 0;
  for (const Values& variant : candidate.variants) {
    const FitModel model = fit.model.with(problem, candidate.placed(variant));
    Try attempt{variant, {}, {}, 0, 0};
    try {
      const VectorXd with = residualsOf(problem, model, fit.shifts);
      attempt.change = linear.profile(problem, with - linear.residuals);
    } catch (const InputError&) {
      continue;  // a scene that cannot be: a mass below zero, say
    }
    felt = std::max(felt, attempt.change.squaredNorm());
    attempt.left = projector.leftOf(attempt.change);
    const double norm = attempt.left.squaredNorm();
    // What the fitted parameters can do as well is no evidence.
    if (norm <= 1e-6 * attempt.change.squaredNorm() || norm <= 0) continue;
    attempt.step = std::clamp(-rest.dot(attempt.left) / norm, 0.0, 20.0);
    attempt.gain = rest.squaredNorm() - (rest + attempt.step * attempt.left).squaredNorm();
    tries.push_back(std::move(attempt));
  }
  const double total = linear.profiled.squaredNorm();
  struct Found {
    double gain;
    Values effect;
    VectorXd parameters;
  };
  std::vector<Found> found;
  const auto add = [&](double gain, const Values& effect, const VectorXd& change) {
    if (gain > 0) found.push_back({gain, effect, projector.answer(linear.profiled + change)});
  };
  for (const Try& attempt : tries)
    add(attempt.gain, scaledVariant(candidate, attempt.effect, attempt.step), attempt.step * attempt.change);

  // Several sizes of one effect together: the best variant of each of its neutral parameters.
  std::vector<const Try*> best;
  std::vector<const Parameter*> which;
  for (const Parameter& p : candidate.declared) {
    if (!p.neutral) continue;
    const Try* top = nullptr;
    for (const Try& attempt : tries)
      if (attempt.effect.at(p.name) != *p.neutral && (!top || attempt.gain > top->gain)) top = &attempt;
    if (top) {
      best.push_back(top);
      which.push_back(&p);
    }
  }
  if (best.size() > 1) {
    const VectorXd steps = nonNegative(best, rest);
    VectorXd left = rest, change = VectorXd::Zero(rest.size());
    Values joint = best[0]->effect;
    for (std::size_t i = 0; i < best.size(); ++i) {
      const double step = steps[static_cast<Eigen::Index>(i)];
      left += step * best[i]->left;
      change += step * best[i]->change;
      joint[which[i]->name] = scaledVariant(candidate, best[i]->effect, step).at(which[i]->name);
    }
    add(rest.squaredNorm() - left.squaredNorm(), joint, change);
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.gain > b.gain; });

  std::vector<double> numbers{felt, static_cast<double>(found.size())};
  for (const Found& each : found) {
    numbers.push_back(total > 0 ? each.gain / total : 0);
    for (const Parameter& p : candidate.declared) numbers.push_back(each.effect.at(p.name));
    for (std::size_t i = 0; i < fit.model.parameters.size(); ++i) {
      const FitParameter& p = fit.model.parameters[i];
      numbers.push_back(std::clamp(fit.model.values[i] + each.parameters[static_cast<Eigen::Index>(i)] * p.scale,
                                   p.minimum, p.maximum));
    }
  }
  return numbers;
}

}  // namespace

std::vector<Screened> screen(const FitProblem& problem, const Fit& fit, const Linearised& linear,
                             const std::vector<EffectCandidate>& candidates, int jobs,
                             const std::function<bool(std::size_t)>& goOn) {
  const Projector projector(linear.columns, fit.model);
  const VectorXd rest = projector.leftOf(linear.profiled);
  const auto numbers = parallel(
      jobs, candidates.size(),
      [&](std::size_t i) { return screenOne(problem, fit, linear, projector, rest, candidates[i]); }, goOn);

  std::vector<Screened> result;
  const double enough = 0.01 * static_cast<double>(linear.residuals.size());
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    Screened screened;
    screened.candidate = c;
    const auto& list = numbers[c];
    if (!list.empty()) {
      screened.excited = list[0] > std::min(enough, 25.0);
      const auto starts = static_cast<std::size_t>(list[1]);
      std::size_t at = 2;
      for (std::size_t s = 0; s < starts; ++s) {
        Screened::Start start;
        start.share = list[at++];
        for (const Parameter& p : candidates[c].declared) start.effect[p.name] = list[at++];
        for (std::size_t i = 0; i < fit.model.parameters.size(); ++i) start.parameters.push_back(list[at++]);
        screened.starts.push_back(std::move(start));
      }
      if (!screened.starts.empty()) screened.share = screened.starts[0].share;
    }
    result.push_back(std::move(screened));
  }
  return result;
}

}  // namespace btr
