#pragma once
#include <optional>
#include <span>
#include <vector>

#include "core/spec/parameter.h"
#include "core/spec/random.h"

namespace btr {

// The policy gradient of Kohl and Stone (Policy gradient reinforcement learning for fast quadrupedal locomotion, ICRA
// 2004), taken apart into its two halves, so that a learner and a page show the same arithmetic.

/// `at` within the bounds of the genotype, whole where a parameter is whole.
std::vector<double> feasible(std::span<const Parameter> genotype, std::span<const double> at);

/// Randomly generated policies around π: each parameter independently, with probability 1/3 each, π_n + ε_n, π_n or
/// π_n − ε_n, made feasible.
std::vector<std::vector<double>> drawPolicies(std::span<const Parameter> genotype, std::span<const double> centre,
                                              std::span<const double> epsilons, int count, Random& random);

/// The policies whose n-th parameter lies below π's, at it or above it. Which group a policy belongs to is read from
/// its feasible value: one that the bounds pushed back onto π counts as unchanged.
struct PolicyGroup {
  int count = 0;             ///< policies with known fitness
  double mean = 0;           ///< of their fitness, 0 if there are none
  double standardError = 0;  ///< of the mean, from the scatter within the group (n − 1); NaN below two policies
};

/// What an iteration says of one parameter:
///   A = 0              if Avg0 > Avg+ and Avg0 > Avg−, or if a group is empty
///   A = Avg+ − Avg−    otherwise
/// At a bound one of the outer groups cannot have members; the other one alone then decides between staying and going
/// inward: A = Avg+ − Avg0 or Avg0 − Avg−, but never towards the bound.
struct ParameterGradient {
  PolicyGroup below, same, above;
  double gradient = 0;  ///< A, in units of fitness per ε
  double step = 0;      ///< of π, in the parameter's unit, before the bounds
  /// Two-sided, of the compared groups having equal means (Welch); nothing where it is not known: one of them is empty
  /// or a single policy.
  std::optional<double> pValue = {};
};

struct PolicyGradient {
  std::vector<ParameterGradient> parameters;
  std::vector<double> centre;  ///< π after the step, within the bounds; not rounded
};

/// π_n ← π_n + η·ε_n·A_n/|A|, within the bounds; |A| = 0 keeps π. η counts steps of one ε. Fitness that is not finite
/// is not known: that policy is left out.
PolicyGradient policyGradient(std::span<const Parameter> genotype, std::span<const double> centre,
                              std::span<const double> epsilons, double eta,
                              std::span<const std::vector<double>> policies, std::span<const double> fitness);

}  // namespace btr
