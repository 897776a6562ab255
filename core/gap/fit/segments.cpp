// Trials cut into segments, blocks and folds; states estimated where a segment begins.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/gap/fit/alignment.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/interruptible.h"
#include "core/gap/fit/segments.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/doctor/even_grid.h"
#include "core/gap/replay/initial_state.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"

namespace btr {
namespace {

using Measured = Binding::Measured;

struct Local {
  double value = 0, slope = 0, valueError = 0, slopeError = 0;
  double spread = 0;  ///< of the samples about the parabola, at least the noise
  bool known = false;
};

/// What is longer than this between two samples of a channel is a pause, of which its samples say nothing [s].
double pauseOf(std::span<const double> time, std::span<const double> values) {
  constexpr double usually = 4;  // times the usual time between samples: lost rows make two or three of it
  std::vector<double> between;
  double last = NAN;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    if (std::isfinite(last)) between.push_back(time[i] - last);
    last = time[i];
  }
  return usually * median(std::move(between));
}

/// Rows of a channel's samples around `row`: all within ±`reach_s` and, of a slow channel, the nearest ones until there
/// are four. Never across a pause.
std::vector<std::size_t> samplesAround(std::span<const double> time, std::span<const double> values, std::size_t row,
                                       double reach_s, double pause_s) {
  constexpr std::size_t least = 4;
  std::vector<std::size_t> rows;
  if (std::isfinite(values[row])) rows.push_back(row);
  std::size_t before = row, after = row;  // the last ones looked at, and the last samples' times on either side
  double earliest = time[row], latest = time[row];
  // The next sample on a side, or no row where a pause or the recording's end comes first.
  const auto back = [&]() -> std::size_t {
    for (std::size_t i = before; i-- > 0 && earliest - time[i] <= pause_s;)
      if (std::isfinite(values[i])) return i;
    return time.size();
  };
  const auto ahead = [&]() -> std::size_t {
    for (std::size_t i = after + 1; i < time.size() && time[i] - latest <= pause_s; ++i)
      if (std::isfinite(values[i])) return i;
    return time.size();
  };
  for (std::size_t left = back(), right = ahead(); left < time.size() || right < time.size();) {
    const double toLeft = left < time.size() ? time[row] - time[left] : INFINITY;
    const double toRight = right < time.size() ? time[right] - time[row] : INFINITY;
    if (std::min(toLeft, toRight) > reach_s && rows.size() >= least) break;
    if (toRight <= toLeft) {
      rows.push_back(right);
      after = right;
      latest = time[right];
      right = ahead();
    } else {
      rows.push_back(left);
      before = left;
      earliest = time[left];
      left = back();
    }
  }
  return rows;
}

/// Least-squares parabola through the samples around `row` (samplesAround): value and slope there, with standard errors
/// for the given noise.
Local localParabola(std::span<const double> time, std::span<const double> values, std::size_t row, double reach_s,
                    double noise, double pause_s) {
  const std::vector<std::size_t> rows = samplesAround(time, values, row, reach_s, pause_s);
  if (rows.size() < 4) return {};
  Eigen::MatrixXd a(static_cast<Eigen::Index>(rows.size()), 3);
  Eigen::VectorXd b(a.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    const double t = time[rows[static_cast<std::size_t>(i)]] - time[row];
    a.row(i) << 1, t, t * t;
    b[i] = values[rows[static_cast<std::size_t>(i)]];
  }
  const Eigen::Matrix3d normal = a.transpose() * a;
  const Eigen::Matrix3d inverse = normal.inverse();
  if (!inverse.allFinite()) return {};
  const Eigen::Vector3d fit = inverse * (a.transpose() * b);
  const double spread = std::max(noise, std::sqrt((a * fit - b).squaredNorm() / static_cast<double>(a.rows() - 3 + 1)));
  return {fit[0], fit[1], spread * std::sqrt(inverse(0, 0)), spread * std::sqrt(inverse(1, 1)), spread, true};
}

constexpr double reach_s = 0.02;

/// How far a free body's samples around a row are from smooth motion, in noise floors: large across an impact.
double roughness(const FitTrial& trial, std::size_t row) {
  double sum = 0;
  for (std::size_t i = 0; i < trial.binding.measured.size(); ++i) {
    const Measured& measured = trial.binding.measured[i];
    if (trial.noiseFloor[i] <= 0 ||
        (measured.what != Measured::What::basePosition && measured.what != Measured::What::baseOrientation))
      continue;
    const Local local = localParabola(trial.recording.columns[0], trial.recording.columns[measured.column], row,
                                      reach_s, trial.noiseFloor[i], trial.pause_s[i]);
    if (local.known) sum += local.spread / trial.noiseFloor[i];
  }
  return sum;
}

/// The smoothest row within a third of a window of `row`.
std::size_t smoothestNear(const FitTrial& trial, std::size_t row, double window_s) {
  const std::vector<double>& time = trial.recording.columns[0];
  std::size_t best = row;
  double least = roughness(trial, row);
  for (const int way : {-1, 1})
    for (std::size_t k = row; k > 0 && k + 1 < time.size() && std::abs(time[k] - time[row]) < window_s / 3;) {
      k = way < 0 ? k - 1 : k + 1;
      if (const double here = roughness(trial, k); here < least) {
        best = k;
        least = here;
      }
    }
  return best;
}

/// One value only: what moves less than its counts, or not at all.
bool isConstant(const std::vector<double>& values) {
  const auto first = std::ranges::find_if(values, [](double value) { return std::isfinite(value); });
  return first != values.end() &&
         std::all_of(first, values.end(), [&](double value) { return !std::isfinite(value) || value == *first; });
}

/// All rows of a constant column are off by the same part of a count: that is one error, not one a row.
void addRoundings(const FitTrial& trial, std::vector<Nuisance>& nuisances) {
  for (std::size_t i = 0; i < trial.binding.measured.size(); ++i)
    if (trial.noiseFloor[i] > 0 && isConstant(trial.recording.columns[trial.binding.measured[i].column]))
      nuisances.push_back({Nuisance::What::rounding, i, 0, trial.noiseFloor[i]});
}

bool isVelocity(Nuisance::What what) {
  using enum Nuisance::What;
  return what == jointRate || what == baseVelocity || what == baseSpin || what == ballVelocity;
}

std::span<const double> heightOf(const FitTrial& trial, std::size_t ball) {
  for (const Measured& measured : trial.binding.measured)
    if (measured.what == Measured::What::ballPosition && measured.object == ball && measured.part == 2)
      return trial.recording.columns[measured.column];
  return {};
}

/// Of a ball in a trial, over stretches that outlast its noise [m/s].
double fastest(const FitTrial& trial, std::size_t ball) {
  constexpr double stretch_s = 0.05;
  const std::vector<double>& time = trial.recording.columns[0];
  double most = 0;
  for (std::size_t from = 0, to = 0; from < time.size(); ++from) {
    while (to < time.size() && time[to] < time[from] + stretch_s) ++to;
    if (to == time.size()) break;
    double square = 0;
    for (const Measured& measured : trial.binding.measured) {
      if (measured.what != Measured::What::ballPosition || measured.object != ball) continue;
      const std::vector<double>& values = trial.recording.columns[measured.column];
      const double way = values[to] - values[from];
      if (std::isfinite(way)) square += way * way;
    }
    most = std::max(most, std::sqrt(square) / (time[to] - time[from]));
  }
  return most;
}

/// Whether a ball in the air comes so near to the floor in some row that it may touch it before or after.
bool comesDown(const Scene& scene, const FitTrial& trial, std::size_t ball) {
  const std::span<const double> height = heightOf(trial, ball);
  if (!scene.floor || height.empty()) return false;
  const double near = 2 * scene.balls[ball].radius_m + fastest(trial, ball) * trial.recording.samplePeriod();
  return std::ranges::any_of(height, [&](double z) { return z < near; });
}

bool anyComesDown(const Scene& scene, const FitTrial& trial) {
  for (std::size_t ball = 0; ball < scene.balls.size(); ++ball)
    if (comesDown(scene, trial, ball)) return true;
  return false;
}

/// A ball's spin is seen where it bounces, and in the air by what lifts it. What the trial or the scene says of it was
/// measured, too; where nothing is said of it, it may be any, up to that of rolling at the ball's speed.
void addSpin(const Scene& scene, const FitTrial& trial, std::size_t ball, bool begins,
             std::vector<Nuisance>& nuisances) {
  constexpr double share = 0.1, least_rad_s = 2;  // of what was measured
  const BallSpec& spec = scene.balls[ball];
  const std::string path = "balls." + spec.name + ".spin_";
  const bool known =
      spec.spin_rad_s != std::array<double, 3>{} ||
      std::ranges::any_of(trial.recording.settings, [&](const auto& entry) { return entry.first.starts_with(path); });
  const bool bounces = comesDown(scene, trial, ball);
  if (!known && !bounces) return;
  const double spin = std::hypot(spec.spin_rad_s[0], spec.spin_rad_s[1], spec.spin_rad_s[2]);
  const double any = std::max(least_rad_s, fastest(trial, ball) / spec.radius_m);
  const double spread = known && (begins || !bounces) ? least_rad_s + share * spin : any;
  for (std::size_t axis = 0; axis < 3; ++axis)
    nuisances.push_back({Nuisance::What::ballSpin, ball, axis, least_rad_s, least_rad_s / spread});
}

}  // namespace

StartState stateAt(const FitProblem& problem, std::size_t index, std::size_t row, std::vector<Nuisance>& nuisances) {
  const FitTrial& trial = problem.trials[index];
  const Scene scene = problem.sceneOf(problem.given, index);
  StartState state = startState(scene, trial.recording, trial.binding, row);
  const bool rests = trial.recording.beginsAtRest && row == 0;  // which is known, and no question to a fit
  const std::span<const double> time(trial.recording.columns[0]);
  nuisances.clear();
  // How a tossed body began, all samples up to its first impact say.
  const double loose = row == 0 && problem.impacts ? 10 : 1;

  for (std::size_t i = 0; i < trial.binding.measured.size(); ++i) {
    const Measured& measured = trial.binding.measured[i];
    const std::span<const double> values(trial.recording.columns[measured.column]);
    const double noise = trial.noiseFloor[i];
    /// `spread`: of the prior, where it is wider than the samples' error.
    const auto add = [&](Nuisance::What what, std::size_t part, double unit, double spread = 0) {
      if (!rests || !isVelocity(what))
        nuisances.push_back({what, measured.object, part, unit, unit / std::max(unit, spread)});
    };
    if (measured.what == Measured::What::position) {
      const Drive& drive = scene.robots[measured.object].drives[measured.part];
      Local local = localParabola(time, values, row, reach_s, noise, trial.pause_s[i]);
      double& position = state.robots[measured.object].positions[measured.part];
      double& rate = state.robots[measured.object].rates[measured.part];
      if (row > 0 && local.known) {
        position = local.value;
        rate = local.slope;
      }
      // A servo of a walking robot forgets; where few joints move, each beginning is worth a fit.
      if (scene.robots[measured.object].freeBase && drive.kind == Drive::Kind::servo) continue;
      add(Nuisance::What::jointPosition, measured.part, std::max(noise, local.known ? local.valueError : noise));
      // A line through the first samples says "at rest" of all that is slower than its noise: a servo with a heavy
      // rotor may still swing then.
      if (local.known || rate != 0 || drive.kind != Drive::Kind::servo)
        add(Nuisance::What::jointRate, measured.part, local.known ? std::max(local.slopeError, noise / reach_s) : 1);
    } else if (measured.what == Measured::What::rate && !isPositionKnown(trial.binding.measured, measured) &&
               !isPositionKnown(trial.binding.startOnly, measured)) {
      const Local local = localParabola(time, values, row, reach_s, noise, trial.pause_s[i]);
      if (row > 0 && local.known) state.robots[measured.object].rates[measured.part] = local.value;
      add(Nuisance::What::jointRate, measured.part, std::max(noise, local.known ? local.valueError : noise));
    } else if (measured.what == Measured::What::basePosition && scene.robots[measured.object].freeBase) {
      const Local local = localParabola(time, values, row, reach_s, noise, trial.pause_s[i]);
      const auto axis = static_cast<Eigen::Index>(measured.part);
      const double wide = local.known ? loose : 10;  // nearly alone beside a pause: the samples that follow must tell
      if (row > 0 && local.known) {
        state.robots[measured.object].base.translation()[axis] = local.value;
        state.robots[measured.object].velocity_m_s[axis] = local.slope;
      }
      add(Nuisance::What::basePosition, measured.part, std::max(noise, local.valueError), wide * noise);
      add(Nuisance::What::baseVelocity, measured.part, std::max(noise / reach_s, local.slopeError),
          wide * noise / reach_s);
    } else if (measured.what == Measured::What::baseOrientation && measured.part > 0 &&
               scene.robots[measured.object].freeBase) {
      // A quaternion's noise is half an angle's.
      add(Nuisance::What::baseTurn, measured.part - 1, 2 * noise, 2 * loose * noise);
      add(Nuisance::What::baseSpin, measured.part - 1, 2 * noise / reach_s, 2 * loose * noise / reach_s);
    } else if (measured.what == Measured::What::ballPosition) {
      const Local local = localParabola(time, values, row, reach_s, noise, trial.pause_s[i]);
      const auto axis = static_cast<Eigen::Index>(measured.part);
      BallState& ball = state.balls[measured.object];
      if (row > 0 && local.known) {
        ball.position_m[axis] = local.value;
        ball.velocity_m_s[axis] = local.slope;
      }
      if (ball.onFloor && axis == 2) continue;
      // Nearly alone beside a pause: the samples that follow must tell.
      const double speed = row == 0 || !local.known ? fastest(trial, measured.object) : 0;
      add(Nuisance::What::ballPosition, measured.part, std::max(noise, local.valueError), speed * reach_s);
      add(Nuisance::What::ballVelocity, measured.part, std::max(noise / reach_s, local.slopeError), speed);
    }
  }
  for (std::size_t r = 0; r < state.robots.size() && row > 0; ++r) {
    // Spin over the samples on both sides of the row.
    std::array<std::span<const double>, 4> attitude;
    std::size_t from = row;
    while (from > 0 && time[row] - time[from - 1] <= reach_s) --from;
    for (const Measured& measured : trial.binding.measured)
      if (measured.what == Measured::What::baseOrientation && measured.object == r)
        attitude[measured.part] = std::span(trial.recording.columns[measured.column]).subspan(from);
    if (!scene.robots[r].freeBase || attitude[0].empty() || attitude[1].empty() || attitude[2].empty() ||
        attitude[3].empty())
      continue;
    const StartAttitude around = estimateAttitude(time.subspan(from), attitude, 2 * reach_s);
    const double ahead = time[row] - time[from], angle = around.spin_rad_s.norm() * ahead;
    state.robots[r].base.linear() =
        ((angle > 0 ? Eigen::AngleAxisd(angle, around.spin_rad_s.normalized()) : Eigen::AngleAxisd::Identity()) *
         around.orientation)
            .toRotationMatrix();
    state.robots[r].spin_rad_s = around.spin_rad_s;
  }
  for (BallState& ball : state.balls)
    if (ball.onFloor) ball.spin_rad_s = Eigen::Vector3d::UnitZ().cross(ball.velocity_m_s) / ball.radius_m;
  for (std::size_t b = 0; b < state.balls.size(); ++b)
    if (!state.balls[b].onFloor && !rests && !heightOf(trial, b).empty()) addSpin(scene, trial, b, row == 0, nuisances);
  addRoundings(trial, nuisances);
  return state;
}

void cutSegments(FitProblem& problem, double window_s) {
  problem.window_s = window_s;
  problem.segments.clear();
  double total = 0, shortest = INFINITY;
  for (FitTrial& trial : problem.trials) {
    const auto& time = trial.recording.columns[0];
    trial.pause_s.clear();
    for (const Measured& measured : trial.binding.measured)
      trial.pause_s.push_back(pauseOf(time, trial.recording.columns[measured.column]));
    const double length_s = time[trial.rows() - 1] - time.front();
    total += length_s;
    shortest = std::min(shortest, length_s);
  }
  // Half-second blocks where there are enough of them for a test.
  problem.block_s = std::clamp(total / 60, std::min(0.05, shortest / 2), 0.5);
  problem.blocks = 0;

  for (std::size_t t = 0; t < problem.trials.size(); ++t) {
    const FitTrial& trial = problem.trials[t];
    const auto& time = trial.recording.columns[0];
    const std::size_t rows = trial.rows();
    const bool bounces = anyComesDown(problem.sceneOf(problem.given, t), trial);
    const auto blockOf = [&](std::size_t row) { return static_cast<int>((time[row] - time[0]) / problem.block_s); };
    for (std::size_t first = 0; first + 4 < rows;) {
      std::size_t last = rows;
      if (window_s > 0) {
        last = first;
        while (last < rows && time[last] < time[first] + window_s) ++last;
        if (last < rows && time[rows - 1] - time[last] < window_s / 2) last = rows;
        if (last < rows && problem.impacts) last = smoothestNear(trial, last, window_s);
      }
      if (last - first < 5) break;
      Segment segment;
      segment.trial = t;
      segment.first = segment.scored = first;
      segment.last = last;
      segment.start = stateAt(problem, t, first, segment.nuisances);
      segment.bounces = bounces;
      for (std::size_t c = 0; c < trial.noiseFloor.size(); ++c) {
        if (trial.noiseFloor[c] <= 0) continue;
        const auto& values = trial.recording.columns[trial.binding.measured[c].column];
        const bool constant = isConstant(values);
        for (std::size_t row = segment.scored; row < last; ++row) {
          // What never changes says no more in a hundred rows than in one; a look into each block sees who leaves it.
          if (constant && row + 1 < last && blockOf(row + 1) == blockOf(row)) continue;
          if (!std::isfinite(values[row])) continue;
          segment.channel.push_back(c);
          segment.row.push_back(row);
          segment.block.push_back(problem.blocks + blockOf(row));
          // Two blocks to a fold, trials shifted against each other; a window stays whole.
          const double at = window_s > 0 ? time[first] - time[0] + 1e-9 : time[row] - time[0];
          const double stretch = window_s > 0 ? window_s : 2 * problem.block_s;
          segment.fold.push_back(static_cast<char>((static_cast<std::size_t>(at / stretch) + t) % 2));
        }
      }
      if (!segment.row.empty()) problem.segments.push_back(std::move(segment));
      first = last;
    }
    problem.blocks += blockOf(rows - 1) + 1;
  }
}

StartState shiftedStart(const Segment& segment, const std::vector<double>& shift) {
  StartState start = segment.start;
  for (std::size_t i = 0; i < shift.size(); ++i) {
    const Nuisance& nuisance = segment.nuisances[i];
    const double by = shift[i] * nuisance.unit;
    const auto axis = static_cast<Eigen::Index>(nuisance.part);
    switch (nuisance.what) {
      case Nuisance::What::jointPosition:
        start.robots[nuisance.object].positions[nuisance.part] += by;
        break;
      case Nuisance::What::jointRate:
        start.robots[nuisance.object].rates[nuisance.part] += by;
        break;
      case Nuisance::What::basePosition:
        start.robots[nuisance.object].base.translation()[axis] += by;
        break;
      case Nuisance::What::baseVelocity:
        start.robots[nuisance.object].velocity_m_s[axis] += by;
        break;
      case Nuisance::What::baseTurn:
        start.robots[nuisance.object].base.linear() =
            Eigen::AngleAxisd(by, Eigen::Vector3d::Unit(axis)).toRotationMatrix() *
            start.robots[nuisance.object].base.linear();
        break;
      case Nuisance::What::baseSpin:
        start.robots[nuisance.object].spin_rad_s[axis] += by;
        break;
      case Nuisance::What::ballPosition:
        start.balls[nuisance.object].position_m[axis] += by;
        break;
      case Nuisance::What::ballVelocity:
        start.balls[nuisance.object].velocity_m_s[axis] += by;
        break;
      case Nuisance::What::ballSpin:
        start.balls[nuisance.object].spin_rad_s[axis] += by;
        break;
      case Nuisance::What::rounding:
        break;
    }
  }
  for (BallState& ball : start.balls)
    if (ball.onFloor) ball.spin_rad_s = Eigen::Vector3d::UnitZ().cross(ball.velocity_m_s) / ball.radius_m;
  return start;
}

bool isFelt(const Segment& segment, const Nuisance& nuisance, const Scene& scene) {
  if (nuisance.what != Nuisance::What::ballSpin || (segment.bounces && scene.floor)) return true;
  const std::string& name = scene.balls[nuisance.object].name;
  BallState still = segment.start.balls[nuisance.object], spun = still;
  // Any velocity that has a part across each axis.
  still.velocity_m_s = spun.velocity_m_s = Eigen::Vector3d(1, 2, 3);
  spun.spin_rad_s[static_cast<Eigen::Index>(nuisance.part)] += 1;
  return std::ranges::any_of(scene.effects, [&](const SceneEffect& placed) {
    return (placed.at == name || placed.at == "floor" || placed.at == "world") &&
           placed.effect->ballForce(still, placed.values) != placed.effect->ballForce(spun, placed.values);
  });
}

namespace {

/// Residuals of the rows before `last`; the others are afterFault.
std::vector<double> residualsUntil(const FitProblem& problem, const Segment& segment, const Scene& scene,
                                   const std::vector<double>& shift, std::size_t last) {
  Interruptible::ask();
  const FitTrial& trial = problem.trials[segment.trial];
  std::vector<double> rounding(trial.noiseFloor.size(), 0);
  for (std::size_t i = 0; i < shift.size(); ++i)
    if (segment.nuisances[i].what == Nuisance::What::rounding)
      rounding[segment.nuisances[i].object] = shift[i] * segment.nuisances[i].unit;
  StartState start = shiftedStart(segment, shift);
  // A spin that the fit changes as a number of the scene.
  for (std::size_t b = 0; b < start.balls.size() && segment.first == 0; ++b)
    if (!start.balls[b].onFloor)
      start.balls[b].spin_rad_s +=
          Eigen::Vector3d::Map(scene.balls[b].spin_rad_s.data()) - segment.start.balls[b].spin_rad_s;
  const ReplayedRecording replayed = replayRecording(scene, trial.recording, trial.binding, start, segment.first, last);
  std::vector<double> residuals(segment.row.size(), afterFault);
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    const std::size_t c = segment.channel[k], row = segment.row[k];
    const double recorded = trial.recording.columns[trial.binding.measured[c].column][row];
    const double value = (replayed.values[c][row] + rounding[c] - recorded) / trial.floorAt(c, row);
    if (std::isfinite(value)) residuals[k] = value;
  }
  if (problem.shift_s != 0) {
    const std::vector<double> column = clockColumn(problem, segment, scene, residuals);
    for (std::size_t k = 0; k < residuals.size(); ++k) residuals[k] += problem.shift_s * column[k];
  }
  return residuals;
}

/// What a prescribed motion is at one row depends on later ones.
bool prescribes(const FitTrial& trial) {
  return std::ranges::any_of(trial.binding.inputs,
                             [](const Binding::Input& input) { return input.what == Binding::Input::What::motion; });
}

}  // namespace

std::vector<double> residualsOf(const FitProblem& problem, const Segment& segment, const Scene& scene,
                                const std::vector<double>& shift) {
  return residualsUntil(problem, segment, scene, shift, segment.last);
}

std::vector<double> residualsBeside(const FitProblem& problem, const Segment& segment, const Scene& scene,
                                    const std::vector<double>& shift, std::span<const double> here) {
  constexpr double forgets_s = 1, atOne_s = 0.3, atOne = 1e-4;  // the last: noise floors
  const FitTrial& trial = problem.trials[segment.trial];
  const std::vector<double>& time = trial.recording.columns[0];
  const auto rowAfter = [&](double after_s) {
    const auto from = time.begin() + static_cast<std::ptrdiff_t>(segment.first);
    const auto to = time.begin() + static_cast<std::ptrdiff_t>(segment.last);
    return static_cast<std::size_t>(std::lower_bound(from, to, time[segment.first] + after_s) - time.begin());
  };
  const std::size_t last = rowAfter(forgets_s), apart = rowAfter(forgets_s - atOne_s);
  // Where little would be left out, or too few samples say that both are one, all of it is simulated.
  if (rowAfter(2 * forgets_s) >= segment.last || last < apart + 4 || !scene.balls.empty() || problem.walks ||
      problem.impacts || prescribes(trial))
    return residualsOf(problem, segment, scene, shift);
  std::vector<double> residuals = residualsUntil(problem, segment, scene, shift, last);
  const std::size_t known = last - 1;  // what is shifted in time needs the row after it
  std::size_t compared = 0;
  for (std::size_t k = 0; k < residuals.size(); ++k) {
    const std::size_t row = segment.row[k];
    if (row >= apart && row < known) {
      if (!(std::abs(residuals[k] - here[k]) < atOne)) return residualsOf(problem, segment, scene, shift);
      ++compared;
    }
    if (row >= known) residuals[k] = here[k];
  }
  return compared > 0 ? residuals : residualsOf(problem, segment, scene, shift);
}

FitProblem only(const FitProblem& problem, const std::vector<std::size_t>& trials) {
  FitProblem part = problem;
  std::erase_if(part.segments,
                [&](const Segment& segment) { return std::ranges::find(trials, segment.trial) == trials.end(); });
  return part;
}

std::vector<std::vector<double>> only(const FitProblem& problem, const std::vector<std::vector<double>>& shifts,
                                      const std::vector<std::size_t>& trials) {
  std::vector<std::vector<double>> part;
  for (std::size_t s = 0; s < problem.segments.size(); ++s)
    if (std::ranges::find(trials, problem.segments[s].trial) != trials.end()) part.push_back(shifts[s]);
  return part;
}

}  // namespace btr
