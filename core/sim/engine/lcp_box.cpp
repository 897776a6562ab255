#include "core/sim/engine/lcp_box.h"

#include <algorithm>
#include <cmath>

#include "core/sim/engine/lcp_wide.h"

namespace btr {
namespace {

// to −= factor · from
BTR_INLINE void subtractTimes(double* to, double factor, const double* from, unsigned first, unsigned count) {
  for (unsigned chunk = first / wideLanes; chunk * wideLanes < count; ++chunk)
    *reinterpret_cast<Four*>(to + chunk * wideLanes) -=
        factor * *reinterpret_cast<const Four*>(from + chunk * wideLanes);
}

BTR_INLINE void addTimes(double* to, double factor, const double* from, unsigned count) {
  for (unsigned chunk = 0; chunk * wideLanes < count; ++chunk)
    *reinterpret_cast<Four*>(to + chunk * wideLanes) +=
        factor * *reinterpret_cast<const Four*>(from + chunk * wideLanes);
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
  for (unsigned i = 0; i < n_; ++i) {
    if (side_[i] == Side::free) free_.push_back(i);
    if (side_[i] == Side::low) x_[i] = low_[i];
    if (side_[i] == Side::high) x_[i] = high_[i];
  }
  if (!factorFree()) return false;
  product_ = b_;
  for (unsigned j = 0; j < n_; ++j)
    if (side_[j] != Side::free && x_[j] != 0) subtractTimes(product_.data(), x_[j], lineOf(a_, j), 0, n_);
  const auto count = static_cast<unsigned>(free_.size());
  for (unsigned i = 0; i < count; ++i) right_[i] = product_[free_[i]];
  for (unsigned k = 0; k < count; ++k) {
    const double solved = right_[k] * inverse_[k];
    subtractTimes(right_.data(), solved, lineOf(factor_, k), k + 1, count);
    right_[k] = solved;
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
  for (unsigned i = 0; i < n_; ++i) product_[i] = -b_[i];
  for (unsigned j = 0; j < n_; ++j)
    if (x_[j] != 0) addTimes(product_.data(), x_[j], lineOf(a_, j), n_);
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
