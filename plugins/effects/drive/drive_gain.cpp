/// A drive that gives another share of its torque than is believed: a torque constant read off a data sheet, a current
/// sensor out of calibration, a gain of the firmware in other units.
///   kind 0   e' = e·(1 + g)      e = c − q: the servo's gain differs, its damping and largest torque do not
///   kind 1   τ' = τ·(1 + g)      all that the drive gives differs, its largest torque too
/// g: excess. (τ = K·i, an actuator's gain: Spong, Hutchinson and Vidyasagar 2006, Robot Modeling and Control, 6.1.)
/// Of kind 0 in drives that follow a position only. Where a weight hangs at one distance, kind 1 is a payload of the
/// other sign, and only a change of the weight or a torque limit tells them apart. Neutral: g = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class DriveGain final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    btr::Parameter kind{"kind", "", "what differs: 0 the gain of the servo's error, 1 the drive's torque", 0, 1, 0};
    kind.integer = true;
    return {{"excess", "", "share by which the drive gives too much", -0.9, 2, 0.1, 0.0}, kind};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a drive that is stronger or weaker than is believed",
            "e’ = e·(1 + g) or τ’ = τ·(1 + g)", "g: excess; e: command less position, τ: drive; which of them: kind",
            "Spong, Hutchinson and Vidyasagar 2006"};
  }
  Place place() const override { return Place::joint; }
  /// The error is what the firmware sees after delays and filters of the command.
  Stage stage() const override { return Stage::command; }

  btr::CommandAround command(btr::CommandAround command, const btr::JointState& joint, std::span<const double> values,
                             std::span<double>, double) const override {
    if (values[1] != 0 || !joint.followsPosition) return command;
    const auto seen = [&](double followed) { return followed + values[0] * (followed - joint.position); };
    return {seen(command.before), seen(command.after)};
  }

  bool changesDrive() const override { return true; }
  double driveTorque(double torque, const btr::JointState&, std::span<const double> values, std::span<double>,
                     double) const override {
    return values[1] != 0 ? (1 + values[0]) * torque : torque;
  }
};

}  // namespace

BTR_EFFECT(DriveGain, "drive_gain")
