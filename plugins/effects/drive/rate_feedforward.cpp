/// A servo that damps the rate of its error, not of its joint alone: the command's rate, through a low-pass, is added.
///   T·ẏ = c − y;   τ' = clamp(p·(c − q) − d·q̇ + k·ẏ, ±limit)      k in N·m·s/rad, T in s; with k = d it is d·(ċ − q̇)
/// y begins at the first command. (Åström and Hägglund 1995, PID Controllers, ch. 3.4: the derivative acts on the
/// error, filtered.) Drives that follow a position only. Neutral: k = 0. State: whether it has begun, y.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class RateFeedforward final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"gain_nm_s_rad", "N·m·s/rad", "torque per rate of the command, N·s/m on a slide joint", 0, 100, 0.1, 0.0},
            {"filter_s", "s", "time constant of the rate's filter", 2e-3, 0.2, 0.005}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a servo that damps the rate of its error, not of the joint",
            "T·ẏ = c − y,  τ’ = τ + k·ẏ", "k: gain_nm_s_rad; T: filter_s; c: command", "Åström and Hägglund 1995"};
  }
  Place place() const override { return Place::joint; }
  /// Part of the servo's law: before what the output stage and the motor make of the torque.
  Stage stage() const override { return Stage::command; }
  int stateSize() const override { return 2; }

  bool hasServoTerm() const override { return true; }
  double servoTerm(const btr::JointState& joint, std::span<const double> values, std::span<double> state,
                   double dt) const override {
    if (values[0] == 0 || dt <= 0 || !joint.followsPosition) return 0;
    if (state[0] == 0) state[1] = joint.command;
    state[0] = 1;
    const double change = (joint.command - state[1]) * -std::expm1(-dt / values[1]);
    state[1] += change;
    return values[0] * change / dt;
  }
};

}  // namespace

BTR_EFFECT(RateFeedforward, "rate_feedforward")
