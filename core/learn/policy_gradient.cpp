#include "core/learn/policy_gradient.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "core/spec/require.h"

namespace btr {
namespace {

double feasibleValue(const Parameter& p, double value) {
  if (p.integer || !p.choices.empty()) value = std::round(value);
  return std::clamp(value, p.minimum, p.maximum);
}

PolicyGroup groupOf(const std::vector<double>& fitness) {
  PolicyGroup group;
  group.count = static_cast<int>(fitness.size());
  for (const double value : fitness) group.mean += value;
  if (group.count > 0) group.mean /= group.count;
  double squares = 0;
  for (const double value : fitness) squares += (value - group.mean) * (value - group.mean);
  group.standardError =
      group.count > 1 ? std::sqrt(squares / (group.count - 1) / group.count) : std::numeric_limits<double>::quiet_NaN();
  return group;
}

/// Welch's test; two equal constants are no difference, two different ones a certain one. A single policy has no
/// scatter to judge by.
std::optional<double> welch(const PolicyGroup& a, const PolicyGroup& b) {
  if (a.count < 2 || b.count < 2) return std::nullopt;
  const double va = a.standardError * a.standardError, vb = b.standardError * b.standardError;
  if (va + vb == 0) return a.mean == b.mean ? 1 : 0;
  const double t = std::abs(a.mean - b.mean) / std::sqrt(va + vb);
  const double freedom = (va + vb) * (va + vb) / (va * va / (a.count - 1) + vb * vb / (b.count - 1));
  const boost::math::students_t distribution(freedom);
  return std::min(1.0, 2 * boost::math::cdf(boost::math::complement(distribution, t)));
}

/// A of one parameter and how sure it is. `low`, `high`: π lies so close to a bound that there is nothing below or
/// above.
void decide(ParameterGradient& g, bool low, bool high) {
  const PolicyGroup &below = g.below, &same = g.same, &above = g.above;
  if (low || high) {
    const PolicyGroup& inward = low ? above : below;
    if ((low && high) || inward.count == 0 || same.count == 0) return;
    g.pValue = welch(inward, same);
    if (inward.mean > same.mean) g.gradient = low ? inward.mean - same.mean : same.mean - inward.mean;
    return;
  }
  if (below.count == 0 || same.count == 0 || above.count == 0) return;
  if (same.mean > above.mean && same.mean > below.mean) {
    g.pValue = welch(same, above.mean > below.mean ? above : below);
    return;
  }
  g.gradient = above.mean - below.mean;
  g.pValue = welch(above, below);
}

}  // namespace

std::vector<double> feasible(std::span<const Parameter> genotype, std::span<const double> at) {
  require(at.size() == genotype.size(), "a value for each gene");
  std::vector<double> values;
  for (std::size_t n = 0; n < genotype.size(); ++n) values.push_back(feasibleValue(genotype[n], at[n]));
  return values;
}

std::vector<std::vector<double>> drawPolicies(std::span<const Parameter> genotype, std::span<const double> centre,
                                              std::span<const double> epsilons, int count, Random& random) {
  std::vector<std::vector<double>> policies;
  for (int i = 0; i < count; ++i) {
    std::vector<double> policy(centre.begin(), centre.end());
    for (std::size_t n = 0; n < policy.size(); ++n)
      policy[n] += epsilons[n] * (static_cast<double>(random.below(3)) - 1);
    policies.push_back(feasible(genotype, policy));
  }
  return policies;
}

PolicyGradient policyGradient(std::span<const Parameter> genotype, std::span<const double> centre,
                              std::span<const double> epsilons, double eta,
                              std::span<const std::vector<double>> policies, std::span<const double> fitness) {
  require(policies.size() == fitness.size(), "a fitness for each policy");
  const std::vector<double> origin = feasible(genotype, centre);
  PolicyGradient result;
  double squares = 0;
  for (std::size_t n = 0; n < genotype.size(); ++n) {
    std::vector<double> below, same, above;
    for (std::size_t i = 0; i < policies.size(); ++i)
      if (std::isfinite(fitness[i]))
        (policies[i][n] > origin[n] ? above : policies[i][n] < origin[n] ? below : same).push_back(fitness[i]);
    ParameterGradient& g =
        result.parameters.emplace_back(ParameterGradient{groupOf(below), groupOf(same), groupOf(above)});
    decide(g, feasibleValue(genotype[n], centre[n] - epsilons[n]) == origin[n],
           feasibleValue(genotype[n], centre[n] + epsilons[n]) == origin[n]);
    squares += g.gradient * g.gradient;
  }
  const double length = std::sqrt(squares);
  for (std::size_t n = 0; n < genotype.size(); ++n) {
    ParameterGradient& g = result.parameters[n];
    g.step = length > 0 ? eta * epsilons[n] * g.gradient / length : 0;
    result.centre.push_back(std::clamp(centre[n] + g.step, genotype[n].minimum, genotype[n].maximum));
  }
  return result;
}

}  // namespace btr
