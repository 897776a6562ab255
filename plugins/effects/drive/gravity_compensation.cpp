/// A servo's firmware that holds a share of the weight beforehand, which the scene does not know:
///   τ' = clamp(p·(c − q) − d·q̇ − g·τl, ±limit)      τl [N·m or N]: moment of the weight that the joint carries; g: 1
///   where the weight is held as it is, less or more where the firmware's masses are wrong
/// It is part of what the drive's limit limits, which is how it differs from a body that weighs less. (Siciliano,
/// Sciavicco et al. 2009, Robotics, ch. 8.5.1: PD control with gravity compensation.)
/// Drives that follow a position only. Neutral: g = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class GravityCompensation final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"share", "", "of the weight's moment that the firmware holds beforehand", 0, 2, 0.4, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a servo that holds a share of the weight beforehand", "τ’ = τ − g·τ_l",
            "g: share; τ_l: moment of the carried weight", "Siciliano, Sciavicco et al. 2009"};
  }
  Place place() const override { return Place::joint; }
  /// Part of the servo's law: before what the output stage and the motor make of the torque.
  Stage stage() const override { return Stage::command; }

  bool hasServoTerm() const override { return true; }
  double servoTerm(const btr::JointState& joint, std::span<const double> values, std::span<double>,
                   double) const override {
    return joint.followsPosition ? -values[0] * joint.load : 0;
  }
};

}  // namespace

BTR_EFFECT(GravityCompensation, "gravity_compensation")
