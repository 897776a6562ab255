#pragma once
#include <vector>

#include "core/sim/engine/lcp_solver.h"

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
///
/// Every number is made by the same operations in the same order however many are worked on at once, and whether a
/// row of the factor is new or still there from the pivot before: the same problem gives the same bits.
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
  struct Wrong {
    unsigned row;
    Side side;  ///< where it belongs
  };
  void take(const LcpProblem& problem);
  bool pivot();
  bool factorFree();
  bool solveFree();
  void findWrong(double largest);
  double* lineOf(std::vector<double>& matrix, unsigned row) {
    return matrix.data() + static_cast<std::size_t>(row) * stride_;
  }

  unsigned n_ = 0, stride_ = 0;  ///< rows, and of a stored line: a multiple of four, zeros behind the problem's
  std::vector<double> a_, b_;    ///< of the problem, the whole square
  std::vector<double> low_, high_, x_;
  std::vector<Side> side_;
  std::vector<unsigned> free_;      ///< rows, ascending
  std::vector<unsigned> factored_;  ///< rows that the factor was made of
  std::vector<double> factor_;      ///< line i: column i of the Cholesky factor of the free rows, from i on
  std::vector<double> inverse_;     ///< of the factor's diagonal
  std::vector<double> right_, product_;
  std::vector<unsigned> chunks_, lines_;  ///< scratch: chunks of four rows and lines of A that count
  std::vector<Wrong> wrong_;
};

}  // namespace btr
