/// A servo's firmware that adds up its error, which the scene does not know:
///   z' = k·(c − q), |z| ≤ Z;   τ' = clamp(p·(c − q) − d·q̇ + z, ±limit)      k in N·m/(rad·s), Z in N·m: clamp against
///   wind-up
/// With `waits` 1 nothing is added up while the drive gave all that it can in the step before and the error asks for
/// more. z is zero when a trial begins; with `settled` 1 it holds the weight of a joint that rests then, since its
/// servo was on long before. (Åström and Hägglund 1995, PID Controllers, ch. 3.5: a limited integral, conditional
/// integration.) Drives that follow a position only. Neutral: k = 0. State: z.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class IntegralAction final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    btr::Parameter settled{"settled", "", "at the start: 0 nothing is added up, 1 the weight is held", 0, 1, 0};
    settled.integer = true;
    btr::Parameter waits{"waits", "", "0 always adds up, 1 not while the drive is at its limit", 0, 1, 0};
    waits.integer = true;
    return {{"gain_nm_rad_s", "N·m/(rad·s)", "torque per error and second, N/(m·s) on a slide joint", 0, 1000, 2, 0.0},
            {"clamp_nm", "N·m", "largest torque that it adds up to, N on a slide joint", 1e-3, 100, 0.3},
            settled,
            waits};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a servo that adds up its error",
            "ż = k·(c − q),  |z| ≤ Z,  τ’ = τ + z;  with waits 1 ż = 0 at the drive’s limit",
            "k: gain_nm_rad_s; Z: clamp_nm; c: command, q: joint", "Åström and Hägglund 1995"};
  }
  Place place() const override { return Place::joint; }
  /// Part of the servo's law: before what the output stage and the motor make of the torque.
  Stage stage() const override { return Stage::command; }
  int stateSize() const override { return 1; }

  void rest(const btr::JointState& joint, std::span<const double> values, std::span<double> state) const override {
    if (values[0] != 0 && values[2] != 0) state[0] = std::clamp(-joint.load, -values[1], values[1]);
  }

  bool hasServoTerm() const override { return true; }
  double servoTerm(const btr::JointState& joint, std::span<const double> values, std::span<double> state,
                   double dt) const override {
    if (values[0] == 0 || !joint.followsPosition) return 0;
    const double before = state[0], error = joint.command - joint.position;
    if (values[3] != 0 && std::abs(joint.drive) >= joint.limit && joint.drive * error > 0) return before;
    state[0] = std::clamp(before + values[0] * error * dt, -values[1], values[1]);
    return (before + state[0]) / 2;  // the mean over the step
  }
};

}  // namespace

BTR_EFFECT(IntegralAction, "integral_action")
