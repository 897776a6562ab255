// Which effects would explain what is left: one perturbed replay a variant.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/screening/screen.h"
#include "core/gap/search/thresholds.h"
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

/// Squared change of all residuals from which they count as sensitive.
double leastChange(const Linearised& linear, const SearchThresholds::Screening& limits) {
  return std::min(limits.sensitivePerResidual * static_cast<double>(linear.residuals.size()), limits.sensitiveMost);
}

struct Try {
  Values effect;
  VectorXd change;            ///< of the residuals, initial states taken out
  VectorXd left;              ///< fitted parameters taken out too
  double wanted = 0;          ///< of its own size that would do best if all were linear
  double step = 0, gain = 0;  ///< the same, no larger than is believed, and what that would take
  double gainAsIs = 0;        ///< what it takes at its own size
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

/// One number list per candidate: norm, best promised share, sizes that the scene refuses, number of starts, then for
/// each share, effect values, parameters.
std::vector<double> screenOne(const FitProblem& problem, const Fit& fit, const Linearised& linear,
                              const Projector& projector, const VectorXd& rest, const EffectCandidate& candidate,
                              const SearchThresholds::Screening& limits) {
  int refused = 0;
  /// Nothing where the scene cannot be: a mass below zero, say.
  const auto changeBy = [&](const Values& values) -> std::optional<VectorXd> {
    try {
      const VectorXd with = residualsOf(problem, fit.model.with(problem, candidate.placed(values)), fit.shifts);
      return linear.profile(problem, with - linear.residuals);
    } catch (const InputError&) {
      ++refused;
      return std::nullopt;
    }
  };
  const auto gainOf = [&](const VectorXd& change) { return rest.squaredNorm() - (rest + change).squaredNorm(); };
  const Parameter* const phase = phaseOf(candidate.declared);
  std::vector<Try> tries;
  /// How much it changes the residuals.
  const auto tryOut = [&](const Values& variant) {
    const auto change = changeBy(variant);
    if (!change) return 0.0;
    Try attempt{variant, *change, {}};
    const double all = attempt.change.squaredNorm();
    attempt.left = projector.leftOf(attempt.change);
    const double norm = attempt.left.squaredNorm();
    // What the fitted parameters can do as well is no evidence.
    if (norm <= limits.indistinct * all || norm <= 0) return all;
    double step = -rest.dot(attempt.left) / norm;
    if (step < 0 && phase) {
      // A wave of the other sign is one of half a turn on.
      double& angle = attempt.effect[phase->name];
      angle += angle > (phase->minimum + phase->maximum) / 2 ? -M_PI : M_PI;
      attempt.change = -attempt.change;
      attempt.left = -attempt.left;
      step = -step;
    }
    attempt.wanted = step;
    attempt.step = std::clamp(step, 0.0, limits.largestStep);
    attempt.gain = gainOf(attempt.step * attempt.left);
    attempt.gainAsIs = gainOf(attempt.left);
    tries.push_back(std::move(attempt));
    return all;
  };
  double sensitivity = 0;
  for (const Values& variant : candidate.variants) sensitivity = std::max(sensitivity, tryOut(variant));
  // What changes nothing in a usual size may be there in one that is not: a ball that hardly rolls on a carpet is
  // sensitive to creep only where there is a lot of it.
  double atAnySize = sensitivity;
  if (sensitivity <= leastChange(linear, limits))
    for (const double size : limits.insensitiveSizes)
      for (std::size_t i = 0; i < std::min(limits.insensitiveVariants, candidate.variants.size()); ++i)
        atAnySize = std::max(atAnySize, tryOut(scaledVariant(candidate, candidate.variants[i], size)));
  // A usual size is one of a servo's joint; what another machine has may be thousands of times as large, which a linear
  // step is not believed.
  const std::vector<Try> usual = tries;
  for (const Try& attempt : usual)
    if (attempt.wanted > limits.largestStep)
      for (const double size : {std::sqrt(limits.largestStep * attempt.wanted), attempt.wanted})
        tryOut(scaledVariant(candidate, attempt.effect, size));
  const double total = linear.profiled.squaredNorm();
  // Or thousands of times as small: what then moves all far beyond what is to be explained does not say how a little
  // of it would. The variants that promise most are tried in sizes that change about as much as there is.
  std::vector<const Try*> tooLarge;
  for (const Try& attempt : usual)
    if (attempt.wanted < limits.farTooLarge && attempt.change.squaredNorm() > limits.muchMore * total)
      tooLarge.push_back(&attempt);
  std::ranges::stable_sort(tooLarge, std::ranges::greater{}, &Try::gain);
  tooLarge.resize(std::min(tooLarge.size(), limits.smallerVariants));
  for (const Try* attempt : tooLarge) {
    double size = 1, all = attempt->change.squaredNorm();
    for (int round = 0; round < limits.smallerRounds && all > limits.muchMore * total; ++round) {
      size *= std::sqrt(total / all);
      all = tryOut(scaledVariant(candidate, attempt->effect, size));
    }
  }
  if (atAnySize <= leastChange(linear, limits)) tries.clear();
  struct Found {
    double gain;
    Values effect;
    VectorXd parameters;
  };
  std::vector<Found> found;
  const auto add = [&](double gain, const Values& effect, const VectorXd& change) {
    if (gain > 0) found.push_back({gain, effect, projector.answer(linear.profiled + change)});
  };
  for (const Try& attempt : tries) {
    add(attempt.gain, scaledVariant(candidate, attempt.effect, attempt.step), attempt.step * attempt.change);
    add(attempt.gainAsIs, attempt.effect, attempt.change);
  }

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

  // Few effects are proportional to their size (play, limits): the promise is looked at where it lies, and at smaller
  // and larger sizes. What does best there comes first.
  const double promised = found.empty() ? 0 : found[0].gain;
  if (promised > limits.worthLooking * total) {
    std::vector<Found> seen;
    for (const double size : limits.lookedAt) {
      const Values values = scaledVariant(candidate, found[0].effect, size);
      if (size != 1 && values == found[0].effect) continue;
      const auto change = changeBy(values);
      if (!change) continue;
      const double gain = gainOf(projector.leftOf(*change));
      if (gain > 0) seen.push_back({gain, values, projector.answer(linear.profiled + *change)});
    }
    std::stable_sort(seen.begin(), seen.end(), [](const Found& a, const Found& b) { return a.gain > b.gain; });
    found.insert(found.begin(), seen.begin(), seen.begin() + std::min<std::ptrdiff_t>(1, std::ssize(seen)));
  }

  std::vector<double> numbers{sensitivity, total > 0 ? promised / total : 0, static_cast<double>(refused),
                              static_cast<double>(found.size())};
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

/// The segments where most is unexplained and what belongs to them.
struct Part {
  FitProblem problem;
  Fit fit;
  Linearised linear;
};

/// One of `ofSegments`, rounded up.
Part worstOf(const FitProblem& problem, const Fit& fit, const Linearised& linear, std::size_t ofSegments) {
  std::vector<std::size_t> order;
  std::vector<double> error;
  for (std::size_t s = 0; s < problem.segments.size(); ++s) {
    const auto rows = static_cast<Eigen::Index>(problem.segments[s].row.size());
    error.push_back(linear.profiled.segment(linear.first[s], rows).squaredNorm() /
                    static_cast<double>(std::max<Eigen::Index>(1, rows)));
    order.push_back(s);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return error[a] > error[b]; });
  order.resize((order.size() + ofSegments - 1) / ofSegments);
  std::sort(order.begin(), order.end());

  Part part{problem, {fit.model, {}, fit.cost}, {}};
  part.problem.segments.clear();
  std::vector<Eigen::Index> rows;
  for (const std::size_t s : order) {
    part.problem.segments.push_back(problem.segments[s]);
    part.fit.shifts.push_back(fit.shifts[s]);
    part.linear.starts.push_back(linear.starts[s]);
    for (std::size_t k = 0; k < problem.segments[s].row.size(); ++k)
      rows.push_back(linear.first[s] + static_cast<Eigen::Index>(k));
  }
  part.linear.residuals = linear.residuals(rows);
  part.linear.profiled = linear.profiled(rows);
  part.linear.columns = linear.columns(rows, Eigen::all);
  return part;
}

/// The first variants of each of its whole numbers: of a wave, one of another number says nothing.
EffectCandidate firstOf(EffectCandidate candidate, std::size_t firstVariants) {
  std::map<std::vector<double>, std::size_t> seen;
  std::erase_if(candidate.variants, [&](const Values& variant) {
    std::vector<double> whole;
    for (const Parameter& p : candidate.declared)
      if (p.integer) whole.push_back(variant.at(p.name));
    return ++seen[whole] > firstVariants;
  });
  return candidate;
}

/// Of many candidates, those that a first look at the worst segments, with few variants, finds promising. The others'
/// share is that of this look.
std::vector<char> firstLook(const FitProblem& problem, const Fit& fit, const Linearised& linear,
                            const std::vector<EffectCandidate>& candidates, int jobs,
                            const std::function<bool(std::size_t)>& goOn, const SearchThresholds::Screening& limits,
                            std::vector<Screened>& result) {
  const Part part = worstOf(problem, fit, linear, limits.segmentsPart);
  const Projector projector(part.linear.columns, fit.model);
  const VectorXd rest = projector.leftOf(part.linear.profiled);
  const auto numbers = parallel(
      jobs, candidates.size(),
      [&](std::size_t i) {
        return screenOne(part.problem, part.fit, part.linear, projector, rest,
                         firstOf(candidates[i], limits.firstVariants), limits);
      },
      goOn);
  std::vector<std::size_t> order;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    result[c].share = numbers[c].ok() ? numbers[c].numbers[1] : 0;
    result[c].excited = numbers[c].ok() && numbers[c].numbers[0] > leastChange(part.linear, limits);
    order.push_back(c);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return result[a].share > result[b].share; });
  std::vector<char> promising(candidates.size(), 0);
  for (std::size_t k = 0; k < std::min(limits.promising, order.size()); ++k) promising[order[k]] = 1;
  return promising;
}

}  // namespace

std::vector<Screened> screen(const FitProblem& problem, const Fit& fit, const Linearised& linear,
                             const std::vector<EffectCandidate>& candidates, int jobs,
                             const std::function<bool(std::size_t)>& goOn,
                             const SearchThresholds::Screening& thresholds) {
  std::vector<Screened> result(candidates.size());
  for (std::size_t c = 0; c < candidates.size(); ++c) result[c].candidate = c;
  std::vector<char> promising(candidates.size(), 1);
  if (candidates.size() > thresholds.many && problem.segments.size() > 2)
    promising = firstLook(problem, fit, linear, candidates, jobs, goOn, thresholds, result);
  std::vector<std::size_t> chosen;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    if (promising[c]) chosen.push_back(c);

  const Projector projector(linear.columns, fit.model);
  const VectorXd rest = projector.leftOf(linear.profiled);
  const auto numbers = parallel(
      jobs, chosen.size(),
      [&](std::size_t i) {
        return screenOne(problem, fit, linear, projector, rest, candidates[chosen[i]], thresholds);
      },
      goOn);

  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const std::size_t c = chosen[k];
    Screened& screened = result[c];
    screened.excited = false;
    screened.share = 0;
    const auto& list = numbers[k].numbers;
    if (numbers[k].ok()) {
      screened.excited = list[0] > leastChange(linear, thresholds);
      screened.share = list[1];
      screened.refused = static_cast<int>(list[2]);
      const auto starts = static_cast<std::size_t>(list[3]);
      std::size_t at = 4;
      for (std::size_t s = 0; s < starts; ++s) {
        Screened::Start start;
        start.share = list[at++];
        for (const Parameter& p : candidates[c].declared) start.effect[p.name] = list[at++];
        for (std::size_t i = 0; i < fit.model.parameters.size(); ++i) start.parameters.push_back(list[at++]);
        screened.starts.push_back(std::move(start));
      }
    }
  }
  return result;
}

}  // namespace btr
