#include "core/sim/lcp_box.h"

#include <algorithm>
#include <cmath>

namespace btr {
namespace {

double element(const LcpProblem& p, unsigned i, unsigned j) {
  return i > j ? p.a[static_cast<std::size_t>(i) * p.skip + j] : p.a[static_cast<std::size_t>(j) * p.skip + i];
}

}  // namespace

// Free rows by Cholesky, the others at their bounds.
bool BoxSolver::solveFree(const LcpProblem& p) {
  free_.clear();
  for (unsigned i = 0; i < p.n; ++i) {
    if (side_[i] == Side::free) free_.push_back(i);
    if (side_[i] == Side::low) x_[i] = low_[i];
    if (side_[i] == Side::high) x_[i] = high_[i];
  }
  const auto count = static_cast<unsigned>(free_.size());
  factor_.resize(static_cast<std::size_t>(count) * count);
  right_.resize(count);
  for (unsigned i = 0; i < count; ++i) {
    double sum = p.bx[2 * free_[i]];
    for (unsigned j = 0; j < p.n; ++j)
      if (side_[j] != Side::free && x_[j] != 0) sum -= element(p, free_[i], j) * x_[j];
    double* row = factor_.data() + static_cast<std::size_t>(i) * count;
    for (unsigned j = 0; j <= i; ++j) {
      const double* other = factor_.data() + static_cast<std::size_t>(j) * count;
      double value = p.a[static_cast<std::size_t>(free_[i]) * p.skip + free_[j]];
      const double before = value;
      for (unsigned k = 0; k < j; ++k) value -= row[k] * other[k];
      if (i == j && !(value > 1e-14 * before)) return false;
      row[j] = i == j ? 1 / std::sqrt(value) : value * other[j];
    }
    for (unsigned k = 0; k < i; ++k) sum -= row[k] * right_[k];
    right_[i] = sum * row[i];
  }
  for (unsigned i = count; i-- > 0;) {
    for (unsigned k = i + 1; k < count; ++k) right_[i] -= factor_[static_cast<std::size_t>(k) * count + i] * right_[k];
    right_[i] *= factor_[static_cast<std::size_t>(i) * count + i];
    x_[free_[i]] = right_[i];
  }
  return true;
}

double BoxSolver::residual(const LcpProblem& p, unsigned row) const {
  double w = -p.bx[2 * row];
  for (unsigned j = 0; j < p.n; ++j) w += element(p, row, j) * x_[j];
  return w;
}

bool BoxSolver::pivot(const LcpProblem& p) {
  unsigned fewest = p.n + 1;
  int patience = 10;
  for (int iteration = 0; iteration < 200 + 10 * static_cast<int>(p.n); ++iteration) {
    if (!solveFree(p)) return false;
    double largest = 0;
    for (unsigned i = 0; i < p.n; ++i) largest = std::max(largest, std::abs(x_[i]));
    if (!std::isfinite(largest)) return false;
    // Rows that contradict their side, and where they belong.
    std::vector<std::pair<unsigned, Side>> wrong;
    for (unsigned i = 0; i < p.n; ++i) {
      if (side_[i] == Side::free) {
        if (x_[i] < low_[i] - 1e-13 * largest) wrong.emplace_back(i, Side::low);
        if (x_[i] > high_[i] + 1e-13 * largest) wrong.emplace_back(i, Side::high);
        continue;
      }
      if (low_[i] == high_[i]) continue;
      const double w = residual(p, i), rounding = 1e-13 * (std::abs(p.bx[2 * i]) + element(p, i, i) * largest);
      if (side_[i] == Side::low ? w < -rounding : w > rounding) wrong.emplace_back(i, Side::free);
    }
    if (wrong.empty()) return true;
    const auto count = static_cast<unsigned>(wrong.size());
    if (count < fewest) {
      fewest = count;
      patience = 10;
    } else if (patience > 0) {
      --patience;
    }
    if (patience > 0)
      for (const auto& [row, side] : wrong) side_[row] = side;
    else
      side_[wrong.back().first] = wrong.back().second;
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
  low_.resize(p.n);
  high_.resize(p.n);
  x_.assign(p.n, 0);
  side_.resize(p.n);
  // Without friction first.
  bool friction = false;
  for (unsigned i = 0; i < p.n; ++i) {
    const bool hangs = p.findex && p.findex[i] >= 0;
    friction = friction || hangs;
    low_[i] = hangs ? 0 : p.loHi[2 * i];
    high_[i] = hangs ? 0 : p.loHi[2 * i + 1];
    side_[i] = hangs ? Side::low : Side::free;
  }
  if (!pivot(p)) return false;
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
    if (!pivot(p)) return false;
  }
  for (unsigned i = 0; i < p.n; ++i) p.bx[2 * i + 1] = x_[i];
  return true;
}

}  // namespace btr
