/// A servo that is stronger in one direction than in the other: unequal half bridges, a brush that is worn on one side,
/// a one-sided cylinder, a gain of its own for each sign of the error.
///   kind 0   e' = e·(1 + a·sign(e))      e = c − q: the gain differs, the largest torque does not
///   kind 1   τ' = τ·(1 + a·sign(τ))      all that the drive gives differs, its largest torque too
/// a: half of the difference between the directions, over their mean. (Two levels of gain, as Tao and Kokotović 1996,
/// Adaptive Control of Systems with Actuator and Sensor Nonlinearities, write an actuator's slopes by sign.)
/// Of kind 0 in drives that follow a position only. Neutral: a = 0.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class DirectionGain final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    btr::Parameter kind{"kind", "", "what differs: 0 the gain of the servo's error, 1 the drive's torque", 0, 1, 0};
    kind.integer = true;
    return {{"difference", "", "half of the difference between the directions, over their mean", -0.9, 0.9, 0.15, 0.0},
            kind};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a servo that is stronger in one direction than in the other",
            "e’ = e·(1 + a·sign(e)) or τ’ = τ·(1 + a·sign(τ))",
            "a: difference; e: command less position, τ: drive; which of them: kind", "Tao and Kokotović 1996"};
  }
  Place place() const override { return Place::joint; }
  /// The error is what the firmware sees after delays and filters of the command.
  Stage stage() const override { return Stage::command; }

  btr::CommandAround command(btr::CommandAround command, const btr::JointState& joint, std::span<const double> values,
                             std::span<double>, double) const override {
    if (values[1] != 0 || !joint.followsPosition) return command;
    const auto seen = [&](double followed) {
      const double error = followed - joint.position;
      return followed + values[0] * std::abs(error);
    };
    return {seen(command.before), seen(command.after)};
  }

  bool changesDrive() const override { return true; }
  double driveTorque(double torque, const btr::JointState&, std::span<const double> values, std::span<double>,
                     double) const override {
    return values[1] != 0 ? torque + values[0] * std::abs(torque) : torque;
  }
};

}  // namespace

BTR_EFFECT(DirectionGain, "direction_gain")
