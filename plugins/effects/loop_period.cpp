/// The servo's loop runs by a clock of its own: it looks at the joint every T seconds and holds its torque until then
/// (Åström and Wittenmark 1997, Computer-Controlled Systems, ch. 2: zero-order hold).
///   τ'(t) = τ(n·T)      for n·T ≤ t < (n + 1)·T, n·T counted from the start of the trial
/// In a step in which it looks, both torques act for their share, so motion is continuous in T. Acts like half a period
/// of delay in the loop. Neutral: T = 0. State: when it looks next, the torque that it holds.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class LoopPeriod final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"period_s", "s", "between two looks of the servo's loop", 0, 0.1, 0.01, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a servo loop with a clock of its own, which holds its torque in between",
            "τ’(t) = τ(n·T) for n·T ≤ t < (n + 1)·T", "T: period_s", "Åström and Wittenmark 1997"};
  }
  Place place() const override { return Place::joint; }
  int stateSize() const override { return 2; }

  bool changesDrive() const override { return true; }
  double driveTorque(double torque, const btr::JointState& joint, std::span<const double> values,
                     std::span<double> state, double dt) const override {
    const double period = values[0], end = joint.time + dt;
    if (period == 0 || dt <= 0) return torque;
    // A trial, or a part of one, that has just begun: the look is now.
    if (state[0] == 0) state[0] = std::floor(joint.time / period) * period, state[1] = torque;
    if (end <= state[0]) return state[1];
    const double late = std::clamp((state[0] - joint.time) / dt, 0.0, 1.0);
    const double given = late * state[1] + (1 - late) * torque;
    state[1] = torque;
    state[0] = (std::floor(end / period * (1 - 1e-12)) + 1) * period;
    return given;
  }
};

}  // namespace

BTR_EFFECT(LoopPeriod, "loop_period")
