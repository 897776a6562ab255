/// Drag of a fluid on what a joint turns: τ = −c·|ω|·ω      τ in N·m, ω in rad/s, c in N·m·s²/rad²
/// A coefficient b = c·|ω| of damping, which the solver treats implicitly, so that it never adds energy. Neutral: c =
/// 0.
#include <cmath>

#include "core/plugin/plugin.h"

namespace {

class QuadraticDrag final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"coefficient_nm_s2_rad2", "N·m·s²/rad²", "drag torque per squared speed", 0, 1, 0.001, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::joint, "drag of a fluid, in proportion to the square of the speed", "τ = −c·|ω|·ω",
            "c: coefficient_nm_s2_rad2; ω: joint speed", "Newton"};
  }
  Place place() const override { return Place::joint; }
  bool dissipative() const override { return true; }
  double damping(const btr::JointState& joint, std::span<const double> values) const override {
    return values[0] * std::abs(joint.rate);
  }
};

}  // namespace

BTR_EFFECT(QuadraticDrag, "quadratic_drag")
