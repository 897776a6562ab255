/// Friction of a joint that differs between its two directions: worn flanks, a brush on one side, a cable.
///   ω > 0: τ = −T₊ − b₊·ω      ω < 0: τ = T₋ − b₋·ω      at rest −T₊ ≤ τ ≤ T₋, holding
/// (Armstrong-Hélouvry 1991, Control of Machines with Friction: levels of their own by direction.) As a mean that the
/// solver holds with, (T₊ + T₋)/2, and a constant (T₋ − T₊)/2, which is exactly this law also at rest. Only both
/// together take energy away, so it does not call itself dissipative. Neutral: all four 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class AsymmetricFriction final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"torque_positive_nm", "N·m", "dry friction against positive speed, N on a slide joint", 0, 200, 0.05, 0.0},
            {"torque_negative_nm", "N·m", "dry friction against negative speed, N on a slide joint", 0, 200, 0.02, 0.0},
            {"viscous_positive_nm_s_rad", "N·m·s/rad", "friction per positive speed, N·s/m on a slide joint", 0, 2000,
             0.02, 0.0},
            {"viscous_negative_nm_s_rad", "N·m·s/rad", "friction per negative speed, N·s/m on a slide joint", 0, 2000,
             0.01, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::joint, "friction that differs between the two directions of a joint",
            "τ = −T_+ − b_+·ω for ω > 0,  τ = T_− − b_−·ω for ω < 0",
            "T: torque_…_nm; b: viscous_…_nm_s_rad; ω: joint speed", "Armstrong-Hélouvry 1991"};
  }
  Place place() const override { return Place::joint; }
  std::vector<std::string> contains() const override { return {"coulomb_friction", "viscous_friction"}; }
  std::vector<std::string> togetherWith() const override { return {"coulomb_friction", "force_offset"}; }
  double torque(const btr::JointState&, std::span<const double> values) const override {
    return (values[1] - values[0]) / 2;
  }
  double frictionLimit(const btr::JointState&, std::span<const double> values) const override {
    return (values[0] + values[1]) / 2;
  }
  double damping(const btr::JointState& joint, std::span<const double> values) const override {
    return joint.rate > 0 ? values[2] : joint.rate < 0 ? values[3] : (values[2] + values[3]) / 2;
  }
};

}  // namespace

BTR_EFFECT(AsymmetricFriction, "asymmetric_friction")
