/// Friction of a joint in proportion to its speed (Newton): τ = −b·ω      b in N·m·s/rad (N·s/m on a slide joint)
/// Lubricant, and the back electromotive force of a motor with shorted or constant voltage. Below saturation it cannot
/// be told from a servo's derivative gain. Neutral: b = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class ViscousFriction final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {
        {"coefficient_nm_s_rad", "N·m·s/rad", "friction torque per speed, N·s/m on a slide joint", 0, 2000, 0.02, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::joint, "friction in proportion to speed", "τ = −b·ω",
            "b: coefficient_nm_s_rad; ω: joint speed", "Newton"};
  }
  Place place() const override { return Place::joint; }
  bool dissipative() const override { return true; }
  double damping(const btr::JointState&, std::span<const double> values) const override { return values[0]; }
};

}  // namespace

BTR_EFFECT(ViscousFriction, "viscous_friction")
