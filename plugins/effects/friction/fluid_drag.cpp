/// What moves in air, oil or water is braked with the square of its speed:
///   τ = −c·|ω|·ω      c in N·m·s²/rad² (N·s²/m² on a slide joint)
/// A vane or paddle on the link, a churning gear, a hydraulic orifice. (Newton's drag; Hoerner 1965, Fluid-Dynamic
/// Drag.) Neutral: c = 0.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class FluidDrag final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"coefficient_nm_s2_rad2", "N·m·s²/rad²", "torque per square of the speed, N·s²/m² on a slide joint", 0, 50,
             0.01, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::joint, "a fluid that brakes with the square of the speed", "τ = −c·|ω|·ω",
            "c: coefficient_nm_s2_rad2; ω: joint speed", "Newton; Hoerner 1965"};
  }
  Place place() const override { return Place::joint; }
  bool dissipative() const override { return true; }
  double damping(const btr::JointState& joint, std::span<const double> values) const override {
    return values[0] * std::abs(joint.rate);
  }
};

}  // namespace

BTR_EFFECT(FluidDrag, "fluid_drag")
