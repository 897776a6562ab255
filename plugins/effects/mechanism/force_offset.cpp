/// A constant torque at a joint: τ = T      T in N·m (N on a slide joint), right-hand rule about the joint's axis
/// A definition. Offset of a current sensor or amplifier, a hanging weight, friction that differs by direction.
/// Neutral: T = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class ForceOffset final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"torque_nm", "N·m", "constant torque, N on a slide joint", -200, 200, 0.05, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a constant torque", "τ = T", "T: torque_nm", "a definition"};
  }
  Place place() const override { return Place::joint; }
  double torque(const btr::JointState&, std::span<const double> values) const override { return values[0]; }
};

}  // namespace

BTR_EFFECT(ForceOffset, "force_offset")
