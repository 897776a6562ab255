// What the first samples of a recording say of where everything is and how it moves.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/hanging.h"
#include "core/gap/replay/initial_state.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"

namespace btr {
namespace {

using Measured = Binding::Measured;
constexpr double flightWindow_s = 0.05, startWindow_s = 0.03;

std::span<const double> tail(const std::vector<double>& column, std::size_t row) {
  return std::span(column).subspan(row);
}

bool anyFinite(std::span<const double> values) {
  for (const double value : values)
    if (std::isfinite(value)) return true;
  return false;
}

/// A coordinate of something that may fly: with gravity where the first samples fit better so.
Start startOfBody(std::span<const double> time, std::span<const double> values, double gravity) {
  const bool falls =
      gravity != 0 && startMisfit(time, values, flightWindow_s, gravity) < startMisfit(time, values, flightWindow_s, 0);
  return estimateStart(time, values, flightWindow_s, falls ? gravity : 0, Impacts::some);
}

/// Of what is known to rest: its first value, as a mean over the next ones would already follow it away.
Start startAtRest(std::span<const double> values) {
  return {*std::ranges::find_if(values, [](double value) { return std::isfinite(value); }), 0, false};
}

/// A joint: where it moves and its velocity was measured too, that is its rate, and the slope of that the bend of its
/// path, which a line through positions would not follow.
Start startOfJoint(std::span<const double> time, std::span<const double> values, std::span<const double> rates) {
  const Start start = estimateStart(time, values);
  if (!start.moving || rates.empty() || !anyFinite(rates)) return start;
  const Start rate = estimateStart(time, rates);
  return {estimateStart(time, values, startWindow_s, rate.rate).position, rate.position, true};
}

/// The velocity's column of the same joint, or nothing.
std::span<const double> rateColumn(const Recording& recording, const std::vector<Measured>& known,
                                   const Measured& joint, std::size_t row) {
  for (const Measured& other : known)
    if (other.what == Measured::What::rate && other.object == joint.object && other.part == joint.part)
      return tail(recording.columns[other.column], row);
  return {};
}

/// Of a joint whose velocity alone was measured; at rest where it is no faster than its noise lets see.
double rateAlone(std::span<const double> time, std::span<const double> rates) {
  constexpr double clearly = 6;
  const double rate = estimateStart(time, rates).position;
  return std::abs(rate) > clearly * resolution(rates) ? rate : 0;
}

/// A line through the first samples cannot tell a servo that jumps off just then from one that moves already, where
/// both happen within a few samples. The simulator can: from rest, or as the line says, whichever is nearer to the
/// samples that follow.
void restWhereThatExplainsMore(const Scene& scene, const Recording& recording, const Binding& binding,
                               StartState& state) {
  Binding all = binding;
  all.measured.insert(all.measured.end(), binding.startOnly.begin(), binding.startOnly.end());
  StartState resting = state;
  std::vector<std::size_t> unsure;
  for (std::size_t i = 0; i < all.measured.size(); ++i) {
    const Measured& joint = all.measured[i];
    if (joint.what != Measured::What::position) continue;
    const double rate = state.robots[joint.object].rates[joint.part];
    const auto& values = recording.columns[joint.column];
    const bool isServo = scene.robots[joint.object].drives[joint.part].kind == Drive::Kind::servo;
    if (rate == 0 || !isServo || !rateColumn(recording, all.measured, joint, 0).empty()) continue;
    resting.robots[joint.object].positions[joint.part] = startAtRest(values).position;
    resting.robots[joint.object].rates[joint.part] = 0;
    unsure.push_back(i);
  }
  if (unsure.empty()) return;

  const auto& time = recording.columns[0];
  std::size_t last = std::min<std::size_t>(6, time.size());
  while (last < time.size() && time[last] < time[0] + 2 * startWindow_s) ++last;
  const auto moved = replayRecording(scene, recording, all, state, 0, last);
  const auto rested = replayRecording(scene, recording, all, resting, 0, last);
  for (const std::size_t i : unsure) {
    const auto misfit = [&](const ReplayedRecording& replayed) {
      double sum = 0;
      for (std::size_t row = 0; row < last; ++row) {
        const double measured = recording.columns[all.measured[i].column][row];
        if (std::isfinite(measured)) sum += std::pow(replayed.values[i][row] - measured, 2);
      }
      return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
    };
    if (misfit(rested) >= misfit(moved)) continue;
    const auto [object, part] = std::pair(all.measured[i].object, all.measured[i].part);
    state.robots[object].positions[part] = resting.robots[object].positions[part];
    state.robots[object].rates[part] = 0;
  }
}

}  // namespace

bool isPositionKnown(const std::vector<Binding::Measured>& known, const Binding::Measured& joint) {
  return std::ranges::any_of(known, [&](const Measured& other) {
    return other.what == Measured::What::position && other.object == joint.object && other.part == joint.part;
  });
}

StartState startState(const Scene& scene, const Recording& recording, const Binding& binding, std::size_t row) {
  StartState state;
  for (const SceneRobot& robot : scene.robots) {
    StartState::Robot start;
    start.base = robot.start;
    start.velocity_m_s = robot.startVelocity_m_s;
    start.spin_rad_s = robot.startSpin_rad_s;
    start.positions = robot.jointStart;
    start.rates = robot.jointStartRate;
    start.positions.resize(robot.model.joints.size(), 0);
    start.rates.resize(robot.model.joints.size(), 0);
    state.robots.push_back(std::move(start));
  }
  for (const BallSpec& ball : scene.balls) {
    BallState start;
    for (int axis = 0; axis < 3; ++axis) {
      start.position_m[axis] = ball.position_m[static_cast<std::size_t>(axis)];
      start.velocity_m_s[axis] = ball.velocity_m_s[static_cast<std::size_t>(axis)];
      start.spin_rad_s[axis] = ball.spin_rad_s[static_cast<std::size_t>(axis)];
    }
    start.radius_m = ball.radius_m;
    start.mass_kg = ball.mass_kg;
    state.balls.push_back(start);
  }

  const auto time = tail(recording.columns[0], row);
  const bool rests = recording.beginsAtRest && row == 0;
  const auto bodyStart = [&](std::span<const double> values, double gravity) {
    Start start = startOfBody(time, values, gravity);
    if (rests) start.rate = 0;
    return start;
  };
  std::vector<std::array<std::span<const double>, 4>> attitudes(scene.robots.size());
  std::vector<Measured> known = binding.measured;
  known.insert(known.end(), binding.startOnly.begin(), binding.startOnly.end());
  for (const Measured& measured : known) {
    const auto values = tail(recording.columns[measured.column], row);
    if (!anyFinite(values)) continue;
    const bool ofBase =
        measured.what == Measured::What::basePosition || measured.what == Measured::What::baseOrientation;
    if (ofBase && !scene.robots[measured.object].freeBase) continue;  // it stands where the scene says
    const int axis = static_cast<int>(measured.part);
    if (measured.what == Measured::What::position) {
      const Start start =
          rests ? startAtRest(values) : startOfJoint(time, values, rateColumn(recording, known, measured, row));
      state.robots[measured.object].positions[measured.part] = start.position;
      state.robots[measured.object].rates[measured.part] = start.rate;
    } else if (measured.what == Measured::What::rate && !isPositionKnown(known, measured)) {
      state.robots[measured.object].rates[measured.part] = rests ? 0 : rateAlone(time, values);
    } else if (measured.what == Measured::What::basePosition) {
      const Start start = bodyStart(values, scene.gravity_m_s2[axis]);
      state.robots[measured.object].base.translation()[axis] = start.position;
      state.robots[measured.object].velocity_m_s[axis] = start.rate;
    } else if (measured.what == Measured::What::baseOrientation) {
      attitudes[measured.object][measured.part] = values;
    } else if (measured.what == Measured::What::ballPosition) {
      const Start start = bodyStart(values, scene.gravity_m_s2[axis]);
      state.balls[measured.object].position_m[axis] = start.position;
      state.balls[measured.object].velocity_m_s[axis] = start.rate;
    }
  }

  for (std::size_t i = 0; i < attitudes.size(); ++i) {
    // An attitude needs all four columns.
    bool complete = true;
    for (const auto& column : attitudes[i]) complete = complete && !column.empty();
    if (!complete) continue;
    const StartAttitude start = estimateAttitude(time, attitudes[i]);
    state.robots[i].base.linear() = start.orientation.toRotationMatrix();
    state.robots[i].spin_rad_s = start.spin_rad_s;
  }
  for (BallState& ball : state.balls) {
    // Spin is not recorded: a ball on the floor rolls, one in the air has the scene's.
    ball.onFloor = scene.floor && ball.position_m.z() < 1.1 * ball.radius_m;
    if (ball.onFloor) ball.spin_rad_s = Eigen::Vector3d::UnitZ().cross(ball.velocity_m_s) / ball.radius_m;
  }
  letUnrecordedServosHang(scene, binding, state);
  if (row > 0) return state;
  if (!rests) restWhereThatExplainsMore(scene, recording, binding, state);
  for (std::size_t i = 0; i < scene.robots.size(); ++i)
    state.robots[i].rests =
        !scene.robots[i].freeBase && std::ranges::all_of(state.robots[i].rates, [](double rate) { return rate == 0; });
  return state;
}

}  // namespace btr
