/// Dry friction of a joint that does not depend on speed (Coulomb 1785):
///   |τ| ≤ T at rest, holding;   τ = −T·sign(ω) in motion        T in N·m (N on a slide joint), ω in rad/s (m/s)
/// The solver holds or brakes the joint with at most T, so no smoothing of sign() is needed. Other integrators smooth
/// it (Threlfall 1978; Andersson, Söderberg and Björklund 2007), and greased joints creep: with a transition speed ωs >
/// 0
///   τ = −T·ω/ωs for |ω| < ωs
/// Neutral: T = 0; ωs then says nothing.
/// Shows up as flat tops at reversals and as a standing error of a servo without integral part.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class CoulombFriction final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"torque_nm", "N·m", "dry friction, N on a slide joint", 0, 200, 0.03, 0.0}, btr::transitionParameter()};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::joint, "dry friction that does not depend on speed",
            "τ = −T·sign(ω),  |τ| ≤ T at rest;  −T·ω/ω_s where |ω| < ω_s",
            "T: torque_nm; ω: joint speed; ω_s: transition_rad_s", "Coulomb 1785; Threlfall 1978"};
  }
  Place place() const override { return Place::joint; }
  bool dissipative() const override { return true; }
  double frictionLimit(const btr::JointState&, std::span<const double> values) const override { return values[0]; }
  double frictionTransition(const btr::JointState&, std::span<const double> values) const override { return values[1]; }
};

}  // namespace

BTR_EFFECT(CoulombFriction, "coulomb_friction")
