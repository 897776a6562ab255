/// A servo that damps a filtered rate of its joint: firmware differences counts and smooths what comes out.
///   T·ẏ = q̇ − y;   τ' = clamp(p·(c − q) − d·y, ±limit)      T in s
/// exact for a rate that is constant within a step; y = q̇ when a trial begins. (Åström and Hägglund 1995, PID
/// Controllers, ch. 3.3: the derivative's filter.) A servo that has no damping of its own shows nothing. Drives that
/// follow a position only. Neutral: T = 0. State: whether it has begun, y.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class RateFilter final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"time_constant_s", "s", "in which the rate that is damped follows the joint's", 0, 0.3, 0.01, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a servo that damps a filtered rate of its joint",
            "T·ẏ = ω − y,  τ’ = τ + d·(ω − y)", "T: time_constant_s; d: the servo’s damping; ω: joint speed",
            "Åström and Hägglund 1995"};
  }
  Place place() const override { return Place::joint; }
  /// Part of the servo's law: before what the output stage and the motor make of the torque.
  Stage stage() const override { return Stage::command; }
  int stateSize() const override { return 2; }

  bool hasServoTerm() const override { return true; }
  double servoTerm(const btr::JointState& joint, std::span<const double> values, std::span<double> state,
                   double dt) const override {
    if (values[0] == 0 || dt <= 0 || !joint.followsPosition) return 0;
    const double before = state[0] != 0 ? state[1] : joint.rate, share = -std::expm1(-dt / values[0]);
    // What a step asks for holds on average over it.
    const double mean = joint.rate + (before - joint.rate) * share * values[0] / dt;
    if (!joint.isTry) {
      state[0] = 1;
      state[1] = before + share * (joint.rate - before);
    }
    return joint.damping * (joint.rate - mean);
  }
};

}  // namespace

BTR_EFFECT(RateFilter, "rate_filter")
