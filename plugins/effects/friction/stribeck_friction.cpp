/// Dry friction of a joint that is highest at rest and fades as the joint starts to move (Stribeck 1902; in this form
/// Bo and Pavelescu 1982):
///   T(ω) = Tc + Ts·exp(−(|ω|/ωs)^δ)      |τ| ≤ T(0) at rest, τ = −T(ω)·sign(ω) in motion; N·m (N), rad/s (m/s)
/// δ = 2 is usual; 0.5 to 1 falls at once and long, a large one is a step from one friction to another at ωs
/// (Armstrong-Hélouvry, Dupont and Canudas de Wit 1994). Shows up as sticking and jumping at slow reversals. Below
/// the transition speed it fades, as coulomb_friction does. Neutral: Tc = Ts = 0; with Ts = 0 it is Coulomb's friction,
/// and ωs and δ then say nothing.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class StribeckFriction final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {
        {"sliding_nm", "N·m", "friction in fast motion, N on a slide joint", 0, 200, 0.03, 0.0},
        {"extra_at_rest_nm", "N·m", "added at rest, N on a slide joint", 0, 200, 0.03, 0.0},
        {"fading_rad_s", "rad/s", "speed at which the extra has fallen to 1/e, m/s on a slide joint", 0.001, 20, 0.3},
        {"exponent", "", "how suddenly it falls", 0.5, 12, 2},
        btr::transitionParameter()};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::joint, "dry friction that is highest at rest and fades with speed",
            "τ = −(T_c + T_s·exp(−(|ω|/ω_s)^δ))·sign(ω)",
            "T_c: sliding_nm; T_s: extra_at_rest_nm; ω_s: fading_rad_s; δ: exponent",
            "Stribeck 1902; Bo and Pavelescu 1982; Armstrong-Hélouvry et al. 1994"};
  }
  Place place() const override { return Place::joint; }
  std::vector<std::string> contains() const override { return {"coulomb_friction"}; }
  bool dissipative() const override { return true; }
  double frictionLimit(const btr::JointState& joint, std::span<const double> values) const override {
    const double speed = std::abs(joint.rate) / values[2];
    return values[0] + values[1] * std::exp(values[3] == 2 ? -speed * speed : -std::pow(speed, values[3]));
  }
  double frictionTransition(const btr::JointState&, std::span<const double> values) const override { return values[4]; }
};

}  // namespace

BTR_EFFECT(StribeckFriction, "stribeck_friction")
