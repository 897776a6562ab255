#pragma once
#include <vector>

#include "core/sim/lcp_solver.h"

namespace btr {

/// Solves the small problems that contacts, dry friction and saturated servos leave: bounded rows, A positive definite.
///
/// For given bounds by block principal pivoting (Júdice and Pires 1994): every row is free or at a bound; the free ones
/// are solved, all rows that contradict change sides; where that makes no progress only the last one does (Murty),
/// which ends for every positive definite A.
///
/// Bounds that depend on another row (friction on the normal force) come from the solution without them first, which is
/// all that ODE does: friction at most μ times the normal force that there would be WITHOUT friction. A foot that
/// friction presses into the floor or lifts off it then slides too easily or too hardly, by an amount that does not
/// vanish with the step. So the bounds follow the normal forces of each solution until both agree: Coulomb's law.
class BoxSolver {
 public:
  static constexpr unsigned mostRows = 64;
  static constexpr int mostPasses = 20;   ///< of friction after normal forces
  static constexpr double agreed = 1e-4;  ///< change of a bound that no longer matters, of the largest force

  /// Writes x. False (x is then unspecified) if the problem is too large, not positive definite or not finite.
  /// `coulomb` false: ODE's bounds, for comparison.
  bool solve(const LcpProblem& problem, bool coulomb);

 private:
  enum class Side : char { free, low, high };
  bool pivot(const LcpProblem& problem);
  bool solveFree(const LcpProblem& problem);
  double residual(const LcpProblem& problem, unsigned row) const;

  std::vector<double> low_, high_, x_, factor_, right_;
  std::vector<Side> side_;
  std::vector<unsigned> free_;
};

}  // namespace btr
