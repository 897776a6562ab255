/// Viscous friction that fades as the joint gets faster: a grease that thins when it is sheared, a brake of eddy
/// currents beyond the speed of its largest torque, a speed above which another friction takes over.
///   τ = −k·ω/(1 + (|ω|/ω_c)^n)      k in N·m·s/rad (N·s/m), ω_c in rad/s (m/s)
/// n = 1: the torque tends to a constant k·ω_c; n = 2: it is largest at ω_c and falls beyond (Smythe 1942, On eddy
/// currents in a rotating disk; for grease Cross 1965, J. Colloid Sci. 20, 417). Neutral: k = 0; far below ω_c it is
/// viscous friction.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class ThinningFriction final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"coefficient_nm_s_rad", "N·m·s/rad", "friction torque per speed at rest, N·s/m on a slide joint", 0, 2000,
             0.1, 0.0},
            {"fading_rad_s", "rad/s", "speed at which half of that is left, m/s on a slide joint", 0.01, 100, 2},
            {"exponent", "", "how fast it fades beyond", 0.5, 6, 2}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::joint, "viscous friction that fades with speed", "τ = −k·ω/(1 + (|ω|/ω_c)^n)",
            "k: coefficient_nm_s_rad; ω_c: fading_rad_s; n: exponent; ω: joint speed", "Cross 1965; Smythe 1942"};
  }
  Place place() const override { return Place::joint; }
  std::vector<std::string> contains() const override { return {"viscous_friction"}; }
  bool dissipative() const override { return true; }
  double damping(const btr::JointState& joint, std::span<const double> values) const override {
    return values[0] / (1 + std::pow(std::abs(joint.rate) / values[1], values[2]));
  }
};

}  // namespace

BTR_EFFECT(ThinningFriction, "thinning_friction")
