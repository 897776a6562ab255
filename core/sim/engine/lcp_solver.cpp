#include "core/sim/engine/lcp_solver.h"

#include <bit>
#include <cmath>
#include <limits>

#include "core/sim/engine/lcp_wide.h"

namespace btr {
namespace {

constexpr unsigned N = LcpReducer::block, W = LcpReducer::width, lanes = LcpReducer::lanes;
constexpr double infinity = std::numeric_limits<double>::infinity();

static_assert(wideLanes == lanes);

// Cholesky factor of a 6×6 block in place, the diagonal inverted. False if it is not positive definite.
BTR_INLINE bool factorBlock(double* a) {
  BTR_UNROLL
  for (unsigned j = 0; j < N; ++j) {
    double d = a[j * W + j];
    const double before = d;
    BTR_UNROLL
    for (unsigned k = 0; k < j; ++k) d -= a[j * W + k] * a[j * W + k];
    if (!(d > 1e-13 * before)) return false;
    const double inverse = 1 / std::sqrt(d);
    a[j * W + j] = inverse;
    BTR_UNROLL
    for (unsigned i = j + 1; i < N; ++i) {
      double sum = a[i * W + j];
      BTR_UNROLL
      for (unsigned k = 0; k < j; ++k) sum -= a[i * W + k] * a[j * W + k];
      a[i * W + j] = sum * inverse;
    }
  }
  return true;
}

// b := L⁻¹ · b for a 6×6 block b: a forward substitution of whole rows.
BTR_INLINE void solveBlock(const double* l, double* b) {
  Four* rows = reinterpret_cast<Four*>(b);
  BTR_UNROLL
  for (unsigned j = 0; j < N; ++j) {
    Four low = rows[2 * j], high = rows[2 * j + 1];
    BTR_UNROLL
    for (unsigned k = 0; k < j; ++k) {
      low -= l[j * W + k] * rows[2 * k];
      high -= l[j * W + k] * rows[2 * k + 1];
    }
    rows[2 * j] = low * l[j * W + j];
    rows[2 * j + 1] = high * l[j * W + j];
  }
}

// c −= bᵀ · a
BTR_INLINE void subtractProduct(double* c, const double* a, const double* b) {
  const Four* right = reinterpret_cast<const Four*>(a);
  Four* rows = reinterpret_cast<Four*>(c);
  BTR_UNROLL
  for (unsigned i = 0; i < N; ++i) {
    Four low = rows[2 * i], high = rows[2 * i + 1];
    BTR_UNROLL
    for (unsigned k = 0; k < N; ++k) {
      low -= b[k * W + i] * right[2 * k];
      high -= b[k * W + i] * right[2 * k + 1];
    }
    rows[2 * i] = low;
    rows[2 * i + 1] = high;
  }
}

// Whether one of `count` numbers is not zero, of either sign; no branches.
BTR_INLINE bool anyNotZero(const double* numbers, unsigned count) {
  std::uint64_t all = 0;
  for (unsigned i = 0; i < count; ++i) all |= std::bit_cast<std::uint64_t>(numbers[i]);
  return (all << 1) != 0;
}

BTR_INLINE bool anySixNotZero(const double* numbers) {
  const auto bits = [&](unsigned i) { return std::bit_cast<std::uint64_t>(numbers[i]); };
  return ((bits(0) | bits(1) | bits(2) | bits(3) | bits(4) | bits(5)) << 1) != 0;
}

// right − row · x, the row in chunks of four that are `stride` apart
BTR_INLINE double subtractDot(double right, const double* row, std::size_t stride, const double* x, unsigned chunks) {
  Four sum{};
  for (unsigned chunk = 0; chunk < chunks; ++chunk)
    sum += *reinterpret_cast<const Four*>(row + chunk * stride) * *reinterpret_cast<const Four*>(x + chunk * lanes);
  return right - ((sum[0] + sum[1]) + (sum[2] + sum[3]));
}

// Whether one of six rows of four columns is not zero
BTR_INLINE bool anyRowNotZero(const double* rows) {
  const FourBits* bits = reinterpret_cast<const FourBits*>(rows);
  const FourBits all = ((bits[0] | bits[1]) | (bits[2] | bits[3])) | (bits[4] | bits[5]);
  return ((all[0] | all[1] | all[2] | all[3]) << 1) != 0;
}

// x := L⁻¹ · x for six rows of four columns. False if they are all zero (then nothing is done).
BTR_INLINE bool forwardBlock(const double* l, double* x) {
  Four* rows = reinterpret_cast<Four*>(x);
  if (!anyRowNotZero(x)) return false;
  BTR_UNROLL
  for (unsigned r = 0; r < N; ++r) {
    Four sum = rows[r];
    BTR_UNROLL
    for (unsigned c = 0; c < r; ++c) sum -= l[r * W + c] * rows[c];
    rows[r] = sum * l[r * W + r];
  }
  return true;
}

// to −= lᵀ · from for six rows of four columns
BTR_INLINE void subtractForward(const double* l, const double* from, double* to) {
  const Four* x = reinterpret_cast<const Four*>(from);
  Four* rows = reinterpret_cast<Four*>(to);
  BTR_UNROLL
  for (unsigned r = 0; r < N; ++r) {
    Four sum = rows[r];
    BTR_UNROLL
    for (unsigned c = 0; c < N; ++c) sum -= l[c * W + r] * x[c];
    rows[r] = sum;
  }
}

// a −= leftᵀ·right for `count` of the four columns of `left`; both are six rows of four columns.
BTR_INLINE void subtractTile(double* a, unsigned skip, const double* left, const double* right, unsigned count) {
  const Four* rows = reinterpret_cast<const Four*>(right);
  for (unsigned i = 0; i < count; ++i) {
    Four* to = reinterpret_cast<Four*>(a + i * skip);
    Four sum = *to;
    BTR_UNROLL
    for (unsigned r = 0; r < N; ++r) sum -= left[r * lanes + i] * rows[r];
    *to = sum;
  }
}

}  // namespace

bool LcpReducer::sortRows(const LcpProblem& p) {
  bounded_.clear();
  boundedIndex_.assign(p.n, -1);
  for (unsigned i = 0; i < p.n; ++i) {
    const bool free = p.loHi[2 * i] == -infinity && p.loHi[2 * i + 1] == infinity && (!p.findex || p.findex[i] < 0);
    if (free) continue;
    boundedIndex_[i] = static_cast<int>(bounded_.size());
    bounded_.push_back(i);
  }
  for (const unsigned i : bounded_)
    if (p.findex && p.findex[i] >= 0 && boundedIndex_[static_cast<std::size_t>(p.findex[i])] < 0) return false;
  return p.n >= bounded_.size() + 3 * N && (p.n + N - 1) / N <= mostBlocks;
}

// ODE puts the rows of a joint one after the other, joints of six rows first: six rows at a time are a joint, as a
// rule. Where they are not, blocks are only fuller.
void LcpReducer::findBlocks(const LcpProblem& p) {
  blocks_.clear();
  unsigned current = ~0u;
  for (unsigned i = 0; i < p.n; ++i) {
    if (boundedIndex_[i] >= 0) continue;
    if (i / N != current) {
      current = i / N;
      blocks_.emplace_back();
    }
    Block& last = blocks_.back();
    last.rows[last.count++] = i;
  }
  for (unsigned i = 1; i < blocks_.size(); ++i)
    for (unsigned j = 0; j < i; ++j) {
      // Whether they are coupled; a block's columns lie within six numbers.
      const unsigned first = blocks_[j].rows[0], span = blocks_[j].rows[blocks_[j].count - 1] - first + 1;
      bool coupled = false;
      for (unsigned r = 0; r < blocks_[i].count && !coupled; ++r) {
        const double* row = p.a + static_cast<std::size_t>(blocks_[i].rows[r]) * p.skip + first;
        coupled = span == N ? anySixNotZero(row) : anyNotZero(row, span);
      }
      if (!coupled) continue;
      blocks_[i].neighbours |= Set{1} << j;
      blocks_[j].neighbours |= Set{1} << i;
    }
}

// Minimum degree: next is always the block that is coupled to the fewest; those become coupled to each other.
// Blocks that are coupled as in the problem before are ordered as then.
void LcpReducer::orderBlocks() {
  const auto count = static_cast<unsigned>(blocks_.size());
  bool same = count == coupled_.size();
  for (unsigned i = 0; i < count && same; ++i) same = coupled_[i] == blocks_[i].neighbours;
  if (same) return;
  coupled_.resize(count);
  for (unsigned i = 0; i < count; ++i) coupled_[i] = blocks_[i].neighbours;
  order_.clear();
  below_.assign(count, 0);
  Set left = count == mostBlocks ? ~Set{0} : (Set{1} << count) - 1;
  while (left) {
    unsigned best = 0;
    int fewest = 99;
    for (Set rest = left; rest; rest &= rest - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(rest));
      if (const int degree = std::popcount(blocks_[i].neighbours & left); degree < fewest) {
        fewest = degree;
        best = i;
      }
    }
    left &= ~(Set{1} << best);
    order_.push_back(best);
    below_[best] = blocks_[best].neighbours & left;
    for (Set rest = below_[best]; rest; rest &= rest - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(rest));
      blocks_[i].neighbours |= below_[best] & ~(Set{1} << i);
    }
  }
  // Storage for the diagonal blocks and whatever the factor fills, (later, earlier) in the order of elimination.
  slot_.assign(blocks_.size() * blocks_.size(), -1);
  slots_ = 0;
  for (const unsigned k : order_) {
    slot_[k * blocks_.size() + k] = slots_++;
    for (Set rest = below_[k]; rest; rest &= rest - 1)
      slot_[static_cast<unsigned>(std::countr_zero(rest)) * blocks_.size() + k] = slots_++;
  }
}

void LcpReducer::gather(const LcpProblem& p) {
  storage_.assign(static_cast<std::size_t>(slots_) * N * W, 0);
  chunks_ = (static_cast<unsigned>(bounded_.size()) + lanes) / lanes;  // one column more, for b
  right_.assign(blocks_.size() * chunks_ * N * lanes, 0);

  const auto lower = [&](unsigned i, unsigned j) { return p.a[static_cast<std::size_t>(i) * p.skip + j]; };
  for (const unsigned k : order_) {
    const Block& column = blocks_[k];
    double* diagonal = blockAt(k, k);
    for (unsigned r = 0; r < N; ++r) {
      diagonal[r * W + r] = 1;
      if (r >= column.count) continue;
      const double* row = p.a + static_cast<std::size_t>(column.rows[r]) * p.skip;
      for (unsigned c = 0; c <= r; ++c) diagonal[r * W + c] = row[column.rows[c]];
    }
    for (Set rest = below_[k]; rest; rest &= rest - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(rest));
      const Block& row = blocks_[i];
      double* to = blockAt(i, k);
      if (i > k) {
        for (unsigned r = 0; r < row.count; ++r) {
          const double* from = p.a + static_cast<std::size_t>(row.rows[r]) * p.skip;
          for (unsigned c = 0; c < column.count; ++c) to[c * W + r] = from[column.rows[c]];
        }
      } else {
        for (unsigned c = 0; c < column.count; ++c) {
          const double* from = p.a + static_cast<std::size_t>(column.rows[c]) * p.skip;
          for (unsigned r = 0; r < row.count; ++r) to[c * W + r] = from[row.rows[r]];
        }
      }
    }
    const auto last = static_cast<unsigned>(bounded_.size());
    for (unsigned r = 0; r < column.count; ++r)
      chunkAt(k, last / lanes)[r * lanes + last % lanes] = p.bx[2 * column.rows[r]];
    const unsigned first = column.rows[0], end = column.rows[column.count - 1];
    for (unsigned b = 0; b < last; ++b) {
      double* to = chunkAt(k, b / lanes) + b % lanes;
      if (bounded_[b] > end) {
        // A contact is coupled to few joints.
        const double* row = p.a + static_cast<std::size_t>(bounded_[b]) * p.skip;
        if (column.count == N && end - first + 1 == N && !anySixNotZero(row + first)) continue;
        for (unsigned r = 0; r < column.count; ++r) to[r * lanes] = row[column.rows[r]];
      } else {
        for (unsigned r = 0; r < column.count; ++r)
          to[r * lanes] =
              bounded_[b] > column.rows[r] ? lower(bounded_[b], column.rows[r]) : lower(column.rows[r], bounded_[b]);
      }
    }
  }
}

BTR_WIDE bool LcpReducer::factor() {
  for (const unsigned k : order_) {
    const double* diagonal = blockAt(k, k);
    if (!factorBlock(blockAt(k, k))) return false;
    for (Set rest = below_[k]; rest; rest &= rest - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(rest));
      solveBlock(diagonal, blockAt(i, k));
    }
    // Each pair of blocks once, where it is stored.
    for (Set rows = below_[k]; rows; rows &= rows - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(rows));
      for (Set rest = below_[k]; rest; rest &= rest - 1) {
        const auto j = static_cast<unsigned>(std::countr_zero(rest));
        if (slot_[i * blocks_.size() + j] >= 0) subtractProduct(blockAt(i, j), blockAt(i, k), blockAt(j, k));
      }
    }
  }
  return true;
}

// right_ := L⁻¹ · right_
BTR_WIDE void LcpReducer::forward() {
  for (const unsigned k : order_)
    for (unsigned chunk = 0; chunk < chunks_; ++chunk) {
      double* mine = chunkAt(k, chunk);
      if (!forwardBlock(blockAt(k, k), mine)) continue;
      for (Set rest = below_[k]; rest; rest &= rest - 1) {
        const auto i = static_cast<unsigned>(std::countr_zero(rest));
        subtractForward(blockAt(i, k), mine, chunkAt(i, chunk));
      }
    }
}

// Schur complement, block by block; a chunk of columns that the block does not touch is left out.
BTR_WIDE void LcpReducer::subtractEliminated(unsigned count) {
  const unsigned chunks = (count + lanes - 1) / lanes;
  for (unsigned k = 0; k < blocks_.size(); ++k) {
    const double* right = chunkAt(k, count / lanes) + count % lanes;
    touched_.clear();
    for (unsigned i = 0; i < chunks; ++i) {
      const double* left = chunkAt(k, i);
      if (!anyRowNotZero(left)) continue;
      touched_.push_back(i);
      const unsigned first = i * lanes, rows = count - first < lanes ? count - first : lanes;
      for (const unsigned j : touched_)
        subtractTile(smallA_.data() + first * small_.skip + j * lanes, small_.skip, left, chunkAt(k, j), rows);
      for (unsigned r = 0; r < N; ++r)
        for (unsigned row = 0; row < rows; ++row)
          smallBx_[2 * (first + row)] -= left[r * lanes + row] * right[r * lanes];
    }
  }
}

void LcpReducer::formSmall(const LcpProblem& p) {
  const auto count = static_cast<unsigned>(bounded_.size());
  small_.n = count;
  small_.skip = count > 1 ? (count + 3) / 4 * 4 : count;  // as ODE pads its rows
  smallA_.assign(static_cast<std::size_t>(count) * small_.skip + lanes, 0);
  smallBx_.assign(2 * count, 0);
  smallLoHi_.resize(2 * count);
  smallFindex_.resize(count);
  std::vector<double>& a = smallA_;
  for (unsigned i = 0; i < count; ++i) {
    for (unsigned j = 0; j <= i; ++j)
      a[i * small_.skip + j] = p.a[static_cast<std::size_t>(bounded_[i]) * p.skip + bounded_[j]];
    smallBx_[2 * i] = p.bx[2 * bounded_[i]];
    smallLoHi_[2 * i] = p.loHi[2 * bounded_[i]];
    smallLoHi_[2 * i + 1] = p.loHi[2 * bounded_[i] + 1];
    const int of = p.findex ? p.findex[bounded_[i]] : -1;
    smallFindex_[i] = of < 0 ? -1 : boundedIndex_[static_cast<std::size_t>(of)];
  }
  subtractEliminated(count);
  // The whole square, whichever half is read.
  for (unsigned i = 0; i < count; ++i)
    for (unsigned j = 0; j < i; ++j) a[j * small_.skip + i] = a[i * small_.skip + j];
  small_.a = smallA_.data();
  small_.bx = smallBx_.data();
  small_.loHi = smallLoHi_.data();
  small_.findex = smallFindex_.data();
}

bool LcpReducer::reduce(const LcpProblem& problem) {
  if (!sortRows(problem)) return false;
  findBlocks(problem);
  orderBlocks();
  gather(problem);
  if (!factor()) return false;
  forward();
  formSmall(problem);
  return true;
}

BTR_WIDE void LcpReducer::expand(const LcpProblem& problem) {
  const auto count = static_cast<unsigned>(bounded_.size());
  smallX_.assign(chunks_ * lanes, 0);
  for (unsigned i = 0; i < count; ++i) problem.bx[2 * bounded_[i] + 1] = smallX_[i] = smallBx_[2 * i + 1];
  // L⁻ᵀ of what is left of b, last block first.
  double x[mostBlocks][N];
  const std::size_t stride = N * lanes;
  for (auto at = order_.rbegin(); at != order_.rend(); ++at) {
    const unsigned k = *at;
    for (unsigned r = 0; r < N; ++r) {
      const double* row = chunkAt(k, 0) + r * lanes;
      x[k][r] = subtractDot(row[(count / lanes) * stride + count % lanes], row, stride, smallX_.data(), chunks_);
    }
    for (Set rest = below_[k]; rest; rest &= rest - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(rest));
      const double* between = blockAt(i, k);
      for (unsigned r = 0; r < N; ++r) BTR_UNROLL
      for (unsigned c = 0; c < N; ++c) x[k][c] -= between[c * W + r] * x[i][r];
    }
    const double* l = blockAt(k, k);
    for (unsigned r = N; r-- > 0;) {
      for (unsigned c = r + 1; c < N; ++c) x[k][r] -= l[c * W + r] * x[k][c];
      x[k][r] *= l[r * W + r];
    }
    for (unsigned r = 0; r < blocks_[k].count; ++r) problem.bx[2 * blocks_[k].rows[r] + 1] = x[k][r];
  }
}

}  // namespace btr
