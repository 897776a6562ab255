/// Viscous friction that fades as the joint gets faster: a grease that thins when it is sheared, a brake of eddy
/// currents beyond the speed of its largest torque, another slope above some speed.
///   τ = −k·ω·(1 + (|ω|/ω_c)^a)^(−m/a)      k in N·m·s/rad (N·s/m), ω_c in rad/s (m/s)
/// m = 1: the torque tends to a constant k·ω_c, with a large a at once (beside the damping of a drive these are two
/// slopes); m = a = 2: it is largest at ω_c and falls beyond, as that of eddy currents. (Carreau 1972, Trans. Soc.
/// Rheol. 16, 99 and Yasuda 1979 for grease; Smythe 1942, On eddy currents in a rotating disk.) Neutral: k = 0; far
/// below ω_c it is viscous friction, and far beyond it with m = 1 dry friction.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class ThinningFriction final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"coefficient_nm_s_rad", "N·m·s/rad", "friction torque per speed at rest, N·s/m on a slide joint", 0, 2000,
             0.1, 0.0},
            {"fading_rad_s", "rad/s", "speed at which it begins to fade, m/s on a slide joint", 0.01, 100, 2},
            {"fading", "", "power of the speed with which it fades far beyond", 0.2, 3, 1.5},
            {"suddenness", "", "how suddenly it begins to fade", 0.5, 12, 2}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::joint, "viscous friction that fades with speed",
            "τ = −k·ω/(1 + (|ω|/ω_c)^a)^q,  q = m/a",
            "k: coefficient_nm_s_rad; ω_c: fading_rad_s; m: fading; a: suddenness; ω: joint speed",
            "Carreau 1972; Yasuda 1979; Smythe 1942"};
  }
  Place place() const override { return Place::joint; }
  std::vector<std::string> contains() const override { return {"viscous_friction", "coulomb_friction"}; }
  bool dissipative() const override { return true; }
  double damping(const btr::JointState& joint, std::span<const double> values) const override {
    const double beyond = std::pow(std::abs(joint.rate) / values[1], values[3]);
    return values[0] * std::pow(1 + beyond, -values[2] / values[3]);
  }
};

}  // namespace

BTR_EFFECT(ThinningFriction, "thinning_friction")
