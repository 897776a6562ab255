#include "core/gap/replay/initial_state.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/gap/recordings/noise_floor.h"
#include "core/spec/require.h"

namespace btr {
namespace {

struct Line {
  double value = 0, slope = 0;  ///< at the first time
  double mean = 0, slopeUncertainty = 0, travel = 0, misfit = 0;
};

/// Finite samples of the first `window_s`, at least three where there are so many.
std::vector<std::size_t> firstSamples(std::span<const double> time, std::span<const double> values, double window) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] > time[0] + window && rows.size() >= 3) break;
    if (std::isfinite(values[i])) rows.push_back(i);
  }
  return rows;
}

/// Least squares x = value + slope·t + acceleration·t²/2 with the acceleration given.
Line lineThrough(std::span<const double> time, std::span<const double> values, double window, double acceleration,
                 Impacts impacts) {
  const auto rows = firstSamples(time, values, window);
  require(!rows.empty(), "an initial state from at least one row");
  const auto count = static_cast<double>(rows.size());
  std::vector<double> t, x;
  double meanT = 0, meanX = 0;
  for (const std::size_t row : rows) {
    t.push_back(time[row] - time[0]);
    x.push_back(values[row] - acceleration * t.back() * t.back() / 2);
    meanT += t.back() / count;
    meanX += x.back() / count;
  }
  double spread = 0, joint = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    spread += (t[i] - meanT) * (t[i] - meanT);
    joint += (t[i] - meanT) * (x[i] - meanX);
  }
  Line line;
  line.mean = meanX;
  line.slope = spread > 0 ? joint / spread : 0;
  line.value = meanX - line.slope * meanT;
  for (std::size_t i = 0; i < t.size(); ++i) line.misfit += std::pow(x[i] - line.value - line.slope * t[i], 2);
  // The noise of the whole beginning knows more than the few deviations from this line.
  const auto beginning = values.first(std::min<std::size_t>(values.size(), 200));
  const double noise = std::max(resolution(beginning, impacts), std::sqrt(line.misfit / std::max(1.0, count - 2)));
  line.slopeUncertainty = spread > 0 ? noise / std::sqrt(spread) : 0;
  line.travel = std::abs(line.slope) * (t.back() - t.front());
  return line;
}

}  // namespace

Start estimateStart(std::span<const double> time, std::span<const double> values, double window, double acceleration,
                    Impacts impacts) {
  const Line line = lineThrough(time, values, window, acceleration, impacts);
  const double quantum = quantisationStep(values.first(std::min<std::size_t>(values.size(), 200)));
  const bool moving = std::abs(line.slope) > 8 * line.slopeUncertainty && line.travel > 3 * quantum;
  if (!moving) return {line.mean, 0, false};
  return {line.value, line.slope, true};
}

double startMisfit(std::span<const double> time, std::span<const double> values, double window, double acceleration) {
  return lineThrough(time, values, window, acceleration, Impacts::none).misfit;
}

StartAttitude estimateAttitude(std::span<const double> time, const std::array<std::span<const double>, 4>& wxyz,
                               double window) {
  // Every attitude as a small rotation from the first one: its vector then behaves like three coordinates.
  std::vector<double> times;
  std::array<std::vector<double>, 3> turned;
  Eigen::Quaterniond first = Eigen::Quaterniond::Identity();
  for (std::size_t i = 0; i < time.size() && (times.size() < 3 || time[i] <= time[0] + window); ++i) {
    Eigen::Quaterniond now(wxyz[0][i], wxyz[1][i], wxyz[2][i], wxyz[3][i]);
    if (!now.coeffs().allFinite() || now.norm() < 1e-6) continue;
    now.normalize();
    if (times.empty()) first = now;
    const Eigen::AngleAxisd rotation(now * first.conjugate());
    const double angle = std::remainder(rotation.angle(), 2 * M_PI);
    times.push_back(time[i]);
    for (int axis = 0; axis < 3; ++axis)
      turned[static_cast<std::size_t>(axis)].push_back(angle * rotation.axis()[axis]);
  }
  StartAttitude start;
  if (times.empty()) return start;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const Start coordinate = estimateStart(times, turned[static_cast<std::size_t>(axis)], window);
    offset[axis] = coordinate.position;
    start.spin_rad_s[axis] = coordinate.rate;
  }
  const double angle = offset.norm();
  start.orientation = angle > 0 ? Eigen::AngleAxisd(angle, offset / angle) * first : first;
  return start;
}

}  // namespace btr
