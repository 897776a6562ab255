#pragma once
#include <cstdint>
#include <vector>

namespace btr {

/// The mixed complementarity problem of one ODE step, in ODE's own layout:
///   A·x = b + w,  lo ≤ x ≤ hi,  w = 0 where lo < x < hi, w ≥ 0 at lo, w ≤ 0 at hi
/// A is symmetric and positive definite; its lower triangle is given in rows of `skip` numbers. b and x, lo and hi
/// stand in pairs. findex[i] ≥ 0: the bounds of row i are ±hi times |x[findex[i]]| as it is without the rows that have
/// a findex.
struct LcpProblem {
  unsigned n = 0, skip = 0;
  const double* a = nullptr;
  double* bx = nullptr;
  const double* loHi = nullptr;
  const int* findex = nullptr;
};

/// Takes the rows without bounds out of a problem (a robot's joints and servos: nearly all of it). They are factored in
/// blocks of six, in an order and with the gaps that the kinematic tree leaves (Cholesky, minimum degree); the bounded
/// rows (contacts, dry friction, saturated servos) keep their Schur complement, a small problem of the same form for
/// ODE's own solver.
class LcpReducer {
 public:
  static constexpr unsigned block = 6;  ///< rows of a hinge with its servo, or of a universal joint with two
  static constexpr unsigned mostBlocks = 64;
  static constexpr unsigned lanes = 4;  ///< numbers that are worked on at once
  static constexpr unsigned width = 8;  ///< of a stored block's rows: six and two zeros

  /// False if the problem is unusual (a bound that depends on an unbounded row, not positive definite, too large, too
  /// small to be worth it): nothing was changed, and it is to be solved whole.
  bool reduce(const LcpProblem& problem);
  /// The small problem, with its own memory. n may be 0.
  const LcpProblem& small() const { return small_; }
  /// From the small problem's x to all of it: writes x of the problem that was reduced.
  void expand(const LcpProblem& problem);

 private:
  using Set = std::uint64_t;  ///< of blocks
  bool sortRows(const LcpProblem& problem);
  void findBlocks(const LcpProblem& problem);
  void orderBlocks();
  void gather(const LcpProblem& problem);
  bool factor();
  void forward();
  void formSmall(const LcpProblem& problem);
  void subtractEliminated(unsigned count);
  double* blockAt(unsigned row, unsigned column) {
    return storage_.data() + static_cast<std::size_t>(slot_[row * blocks_.size() + column]) * block * width;
  }
  double* chunkAt(unsigned blockIndex, unsigned chunk) {
    return right_.data() + (blockIndex * chunks_ + chunk) * block * lanes;
  }

  struct Block {
    unsigned count = 0;         ///< rows in use; the others are those of an identity
    unsigned rows[block] = {};  ///< of the problem
    Set neighbours = 0;         ///< blocks it is coupled to, then also through those that were eliminated
  };
  std::vector<unsigned> bounded_;  ///< rows of the problem
  std::vector<int> boundedIndex_;  ///< by row of the problem, −1 unbounded
  std::vector<Block> blocks_;
  std::vector<Set> coupled_;     ///< by block: its neighbours in the problem that order_, below_, slot_ are of
  std::vector<unsigned> order_;  ///< of elimination
  std::vector<Set> below_;       ///< by block: what its column of the factor fills
  /// Blocks of matrix, then factor, rows of `width`; those beside the diagonal transposed, as their solver and all
  /// products want them.
  std::vector<double> storage_;
  std::vector<std::int16_t> slot_;  ///< of block pair in storage_, −1 empty
  std::int16_t slots_ = 0;
  std::vector<double> right_;  ///< columns of bounded rows, then b: by block, chunk of four columns, row, column
  unsigned chunks_ = 0;
  std::vector<unsigned> touched_;  ///< scratch: chunks of a block that are not zero
  LcpProblem small_;
  std::vector<double> smallA_, smallBx_, smallLoHi_, smallX_;
  std::vector<int> smallFindex_;
};

}  // namespace btr
