#include "core/sim/engine/lcp_box.h"

#include <algorithm>
#include <cmath>

#include "core/sim/engine/lcp_wide.h"

namespace btr {
namespace {

// to[4·chunk …] ±= Σ x[j]·(line j of a), over the rows j that are named, one after the other; for `Chunks` chunks at a
// time, whose sums stay in registers.
template <int Sign, unsigned Chunks>
BTR_INLINE void addLines(double* to, const unsigned* chunk, const double* a, unsigned stride, const double* x,
                         const std::vector<unsigned>& rows) {
  Four sum[Chunks];
  for (unsigned c = 0; c < Chunks; ++c) sum[c] = *reinterpret_cast<const Four*>(to + chunk[c] * wideLanes);
  for (const unsigned j : rows) {
    const double* line = a + static_cast<std::size_t>(j) * stride;
    for (unsigned c = 0; c < Chunks; ++c) {
      const Four part = x[j] * *reinterpret_cast<const Four*>(line + chunk[c] * wideLanes);
      if constexpr (Sign > 0)
        sum[c] += part;
      else
        sum[c] -= part;
    }
  }
  for (unsigned c = 0; c < Chunks; ++c) *reinterpret_cast<Four*>(to + chunk[c] * wideLanes) = sum[c];
}

template <int Sign>
BTR_INLINE void addLines(double* to, const std::vector<unsigned>& chunks, const double* a, unsigned stride,
                         const double* x, const std::vector<unsigned>& rows) {
  std::size_t done = 0;
  for (; done + 4 <= chunks.size(); done += 4) addLines<Sign, 4>(to, chunks.data() + done, a, stride, x, rows);
  for (; done < chunks.size(); ++done) addLines<Sign, 1>(to, chunks.data() + done, a, stride, x, rows);
}

// The chunk that holds this row is among them: rows come ascending.
BTR_INLINE void addChunkOf(unsigned row, std::vector<unsigned>& chunks) {
  if (chunks.empty() || chunks.back() != row / wideLanes) chunks.push_back(row / wideLanes);
}

}  // namespace

void BoxSolver::take(const LcpProblem& p) {
  n_ = p.n;
  stride_ = (n_ + wideLanes - 1) / wideLanes * wideLanes;
  const std::size_t square = static_cast<std::size_t>(n_) * stride_;
  a_.assign(square, 0);
  factor_.assign(square, 0);
  for (unsigned i = 0; i < n_; ++i)
    for (unsigned j = 0; j <= i; ++j)
      lineOf(a_, i)[j] = lineOf(a_, j)[i] = p.a[static_cast<std::size_t>(i) * p.skip + j];
  b_.assign(stride_, 0);
  for (unsigned i = 0; i < n_; ++i) b_[i] = p.bx[2 * i];
  x_.assign(n_, 0);
  low_.resize(n_);
  high_.resize(n_);
  side_.resize(n_);
  inverse_.resize(n_);
  right_.resize(stride_);
  product_.resize(stride_);
  factored_.clear();
}

// Columns of the factor that are of the same rows of A as before stay as they are. The others are made together, line
// by line: each of its numbers by the same operations in the same order as if they were made one after the other, but
// they do not wait for each other. Left of a line's own column stand zeros, and at it.
BTR_WIDE bool BoxSolver::factorFree() {
  const auto count = static_cast<unsigned>(free_.size());
  const auto same = static_cast<unsigned>(
      std::mismatch(free_.begin(), free_.end(), factored_.begin(), factored_.end()).first - free_.begin());
  factored_.resize(same);
  if (same == count) return true;
  const unsigned first = same / wideLanes * wideLanes, chunks = (count + wideLanes - 1) / wideLanes;
  factored_.resize(first);
  for (unsigned k = 0; k < count; ++k) {
    const double* row = lineOf(a_, free_[k]);
    double* line = lineOf(factor_, k);
    for (unsigned j = std::max(k, first); j < count; ++j) line[j] = row[free_[j]];
  }
  for (unsigned k = 0; k < count; ++k) {
    double* line = lineOf(factor_, k);
    if (k >= first) {
      if (!(line[k] > 1e-14 * lineOf(a_, free_[k])[free_[k]])) return false;
      inverse_[k] = 1 / std::sqrt(line[k]);
    }
    for (unsigned chunk = std::max(k, first) / wideLanes; chunk < chunks; ++chunk)
      *reinterpret_cast<Four*>(line + chunk * wideLanes) *= inverse_[k];
    for (unsigned i = k + 1; i < count; ++i) {
      const double entry = line[i];
      double* to = lineOf(factor_, i);
      for (unsigned chunk = std::max(i, first) / wideLanes; chunk < chunks; ++chunk)
        *reinterpret_cast<Four*>(to + chunk * wideLanes) -=
            entry * *reinterpret_cast<const Four*>(line + chunk * wideLanes);
    }
    if (k >= first) std::fill(line + k / wideLanes * wideLanes, line + k + 1, 0);
  }
  factored_ = free_;
  return true;
}

// Free rows by Cholesky, the others at their bounds.
BTR_WIDE bool BoxSolver::solveFree() {
  free_.clear();
  chunks_.clear();
  lines_.clear();
  for (unsigned i = 0; i < n_; ++i) {
    if (side_[i] == Side::free) {
      free_.push_back(i);
      addChunkOf(i, chunks_);
      continue;
    }
    x_[i] = side_[i] == Side::low ? low_[i] : high_[i];
    if (x_[i] != 0) lines_.push_back(i);
  }
  if (!factorFree()) return false;
  const auto count = static_cast<unsigned>(free_.size());
  product_ = b_;
  addLines<-1>(product_.data(), chunks_, a_.data(), stride_, x_.data(), lines_);
  for (unsigned i = 0; i < count; ++i) right_[i] = product_[free_[i]];
  // Four at a time, which stay in a register.
  for (unsigned first = 0; first < count; first += wideLanes) {
    double* four = right_.data() + first;
    Four left = *reinterpret_cast<const Four*>(four);
    for (unsigned k = 0; k < first; ++k) left -= right_[k] * *reinterpret_cast<const Four*>(lineOf(factor_, k) + first);
    BTR_UNROLL
    for (unsigned lane = 0; lane < wideLanes; ++lane) {
      const unsigned k = first + lane;
      if (k >= count) break;
      const double solved = left[lane] * inverse_[k];
      left -= solved * *reinterpret_cast<const Four*>(lineOf(factor_, k) + first);
      four[lane] = solved;
    }
  }
  for (unsigned i = count; i-- > 0;) {
    const double* column = lineOf(factor_, i);
    double sum = right_[i];
    for (unsigned k = i + 1; k < count; ++k) sum -= column[k] * right_[k];
    x_[free_[i]] = right_[i] = sum * inverse_[i];
  }
  return true;
}

// Rows that contradict their side.
BTR_WIDE void BoxSolver::findWrong(double largest) {
  // Only rows at a bound are asked for what is left.
  chunks_.clear();
  lines_.clear();
  for (unsigned i = 0; i < n_; ++i) {
    if (side_[i] != Side::free && low_[i] != high_[i]) addChunkOf(i, chunks_);
    if (x_[i] != 0) lines_.push_back(i);
    product_[i] = -b_[i];
  }
  addLines<1>(product_.data(), chunks_, a_.data(), stride_, x_.data(), lines_);
  wrong_.clear();
  for (unsigned i = 0; i < n_; ++i) {
    if (side_[i] == Side::free) {
      if (x_[i] < low_[i] - 1e-13 * largest) wrong_.push_back({i, Side::low});
      if (x_[i] > high_[i] + 1e-13 * largest) wrong_.push_back({i, Side::high});
      continue;
    }
    if (low_[i] == high_[i]) continue;
    const double w = product_[i], rounding = 1e-13 * (std::abs(b_[i]) + lineOf(a_, i)[i] * largest);
    if (side_[i] == Side::low ? w < -rounding : w > rounding) wrong_.push_back({i, Side::free});
  }
}

bool BoxSolver::pivot() {
  unsigned fewest = n_ + 1;
  int patience = 10;
  for (int iteration = 0; iteration < 200 + 10 * static_cast<int>(n_); ++iteration) {
    if (!solveFree()) return false;
    double largest = 0;
    for (unsigned i = 0; i < n_; ++i) largest = std::max(largest, std::abs(x_[i]));
    if (!std::isfinite(largest)) return false;
    findWrong(largest);
    if (wrong_.empty()) return true;
    const auto count = static_cast<unsigned>(wrong_.size());
    if (count < fewest) {
      fewest = count;
      patience = 10;
    } else if (patience > 0) {
      --patience;
    }
    if (patience > 0)
      for (const auto& [row, side] : wrong_) side_[row] = side;
    else
      side_[wrong_.back().row] = wrong_.back().side;
  }
  return false;
}

bool BoxSolver::solve(const LcpProblem& p, bool coulomb) {
  if (p.n > mostRows) return false;
  if (p.n == 1 && !p.findex) {
    const double x = p.bx[0] / p.a[0];
    if (!(p.a[0] > 0) || !std::isfinite(x)) return false;
    p.bx[1] = std::clamp(x, p.loHi[0], p.loHi[1]);
    return true;
  }
  take(p);
  // Without friction first.
  bool friction = false;
  for (unsigned i = 0; i < p.n; ++i) {
    const bool hangs = p.findex && p.findex[i] >= 0;
    friction = friction || hangs;
    low_[i] = hangs ? 0 : p.loHi[2 * i];
    high_[i] = hangs ? 0 : p.loHi[2 * i + 1];
    side_[i] = hangs ? Side::low : Side::free;
  }
  if (!pivot()) return false;
  for (int pass = 0; friction && pass < (coulomb ? mostPasses : 1); ++pass) {
    double largest = 0, change = 0;
    for (unsigned i = 0; i < p.n; ++i) largest = std::max(largest, std::abs(x_[i]));
    for (unsigned i = 0; i < p.n; ++i) {
      if (!p.findex || p.findex[i] < 0) continue;
      const double most = p.loHi[2 * i + 1] * std::abs(x_[static_cast<std::size_t>(p.findex[i])]);
      // A bound matters where a row is at it, or would now be beyond it.
      if (side_[i] != Side::free || std::abs(x_[i]) > most) change = std::max(change, std::abs(most - high_[i]));
      low_[i] = -most;
      high_[i] = most;
      if (pass == 0) side_[i] = Side::free;
    }
    if (pass > 0 && change <= agreed * largest) break;
    if (!pivot()) return false;
  }
  for (unsigned i = 0; i < p.n; ++i) p.bx[2 * i + 1] = x_[i];
  return true;
}

}  // namespace btr
