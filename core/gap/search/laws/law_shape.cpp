// Names for curves: each family is a formula of few numbers, fitted to the knots by weighted least squares.
#include "core/gap/search/laws/law_shape.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace btr {
namespace {

constexpr double fitsAsWell = 0.93;     // of the curve's weighted variance; less is not that shape [hand]
constexpr double ofNumbers = 0.005;     // of the variance, that a further number must take [hand]
constexpr double tolerated = 0.04;      // of the largest value: what no formula need reproduce [hand]
constexpr double leastCurvature = 0.3;  // of a hardening spring's force at the end: its cubic part [hand]

struct Curve {
  const LawTerm& term;
  Eigen::VectorXd x, y, weight;  // weight: 1/σ
  double length = 1;
  /// 1 − weighted squared deviation of the best combination of columns / weighted variance; its coefficients.
  double fit(const Eigen::MatrixXd& columns, Eigen::VectorXd& coefficients) const {
    const Eigen::MatrixXd weighted = weight.asDiagonal() * columns;
    const Eigen::VectorXd right = weight.cwiseProduct(y);
    coefficients = weighted.colPivHouseholderQr().solve(right);
    const double mean = weight.cwiseAbs2().dot(y) / weight.squaredNorm();
    const double all = weight.cwiseProduct((y.array() - mean).matrix()).squaredNorm();
    return all > 0 ? 1 - (weighted * coefficients - right).squaredNorm() / all : 0;
  }
};

/// Keeps the better of two, a number more at a price.
void keep(LawShape& best, double& score, const LawShape& shape, int numbers) {
  const double own = shape.fit - ofNumbers * numbers;
  if (shape.fit < fitsAsWell || own <= score) return;
  best = shape;
  score = own;
}

/// −A·u·exp(½ − u²/2), u = (x − c)/w: zero at c, A at one w to either side, nothing far away.
void tryDetents(const Curve& curve, LawShape& best, double& score) {
  Eigen::VectorXd c;
  LawShape own;
  for (int i = 1; i < 80; ++i)
    for (double w = curve.length / 40; w < curve.length / 5; w *= 1.15) {
      const double middle = curve.term.low + curve.length * i / 80;
      const Eigen::ArrayXd u = (curve.x.array() - middle) / w;
      Eigen::MatrixXd columns(curve.x.size(), 2);
      columns << (u * (0.5 - u.square() / 2).exp()).matrix(), Eigen::VectorXd::Ones(curve.x.size());
      const double fit = curve.fit(columns, c);
      if (c[0] < 0 && fit > own.fit) own = {"detent", fit, middle, 2 * w, -c[0]};
    }
  keep(best, score, own, 4);
}

/// A·sin(k·x + φ) + c over at least most of a period.
void tryCams(const Curve& curve, LawShape& best, double& score) {
  Eigen::VectorXd c;
  LawShape own;
  for (double periods = 0.8; periods < 6; periods *= 1.03) {
    const double k = 2 * M_PI * periods / curve.length;
    Eigen::MatrixXd columns(curve.x.size(), 3);
    columns << (k * curve.x.array()).sin().matrix(), (k * curve.x.array()).cos().matrix(),
        Eigen::VectorXd::Ones(curve.x.size());
    const double fit = curve.fit(columns, c);
    if (fit <= own.fit) continue;
    // Falls through zero where k·x + φ = π.
    const double phase = std::atan2(c[1], c[0]), period = curve.length / periods;
    double middle = (M_PI - phase) / k;
    middle += period * std::round((curve.term.low + curve.length / 2 - middle) / period);
    own = {"cam", fit, middle, period, std::hypot(c[0], c[1])};
  }
  keep(best, score, own, 4);
}

/// −k₁·(x − c) − k₃·(x − c)³.
void tryHardening(const Curve& curve, LawShape& best, double& score) {
  Eigen::VectorXd c;
  LawShape own;
  for (int i = 0; i <= 60; ++i) {
    const double middle = curve.term.low + curve.length * i / 60;
    const Eigen::ArrayXd u = (curve.x.array() - middle) / curve.length;
    Eigen::MatrixXd columns(curve.x.size(), 2);
    columns << u.matrix(), u.cube().matrix();
    const double fit = curve.fit(columns, c);
    const double far = std::max(std::abs(u[0]), std::abs(u[u.size() - 1]));
    const double cubic = -c[1] * far * far * far, linear = -c[0] * far;
    if (fit > own.fit && cubic > 0 && linear > -0.2 * cubic && cubic > leastCurvature * (cubic + std::max(0.0, linear)))
      own = {"hardening spring", fit, middle, 0, cubic + linear};
  }
  keep(best, score, own, 3);
}

/// Nothing between a and b; −k·(x − b) above, −k′·(x − a) below, k, k′ ≥ 0 and not both 0.
void tryDeadZones(const Curve& curve, LawShape& best, double& score) {
  constexpr double leastFree = 0.15;  // of the motion
  Eigen::VectorXd c;
  LawShape own;
  for (int i = 0; i <= 40; ++i)
    for (int j = i + 1; j <= 40; ++j) {
      const double a = curve.term.low + curve.length * i / 40, b = curve.term.low + curve.length * j / 40;
      if (b - a < leastFree * curve.length) continue;
      Eigen::MatrixXd columns(curve.x.size(), 3);
      columns << (curve.x.array() - b).max(0).matrix(), (curve.x.array() - a).min(0).matrix(),
          Eigen::VectorXd::Ones(curve.x.size());
      if (i == 0) columns.col(1).setZero();
      if (j == 40) columns.col(0).setZero();
      const double fit = curve.fit(columns, c);
      const double above = -c[0], below = -c[1], most = std::max(above, below);
      if (fit > own.fit && most > 0 && above >= -0.1 * most && below >= -0.1 * most)
        own = {"dead zone", fit, (a + b) / 2, (b - a) / 2, most};
    }
  keep(best, score, own, 4);
}

/// c + d·t, or c + d·(1 − exp(−t/T)).
void tryDrift(const Curve& curve, LawShape& best, double& score) {
  Eigen::VectorXd c;
  LawShape own;
  for (const double ofLength : {0.1, 0.2, 0.4, 0.8, 1e3}) {
    Eigen::MatrixXd columns(curve.x.size(), 2);
    columns << Eigen::VectorXd::Ones(curve.x.size()),
        (1 - ((curve.term.low - curve.x.array()) / (ofLength * curve.length)).exp()).matrix();
    const double fit = curve.fit(columns, c);
    if (fit > own.fit) own = {"drift", fit, 0, 0, (columns * c)[curve.x.size() - 1] - (columns * c)[0]};
  }
  keep(best, score, own, 2);
}

}  // namespace

LawShape shapeOf(const LawTerm& term, const std::vector<double>& values, const std::vector<double>& error) {
  const auto n = static_cast<Eigen::Index>(values.size());
  Curve curve{term, Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n), term.high - term.low};
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    curve.x[i] = term.knot(static_cast<int>(i));
    curve.y[i] = values[k];
    curve.weight[i] = std::isfinite(error[k]) ? 1 / std::hypot(error[k], tolerated * most) : 0;
  }
  LawShape best;
  double score = -INFINITY;
  if (!(most > 0) || curve.weight.squaredNorm() <= 0 || term.kind == LawTerm::Kind::friction) return best;
  if (term.on == LawTerm::On::position || term.on == LawTerm::On::angle) {
    tryHardening(curve, best, score);
    tryDeadZones(curve, best, score);
    tryDetents(curve, best, score);
    tryCams(curve, best, score);
  } else if (term.on == LawTerm::On::time) {
    tryDrift(curve, best, score);
  }
  return best;
}

}  // namespace btr
