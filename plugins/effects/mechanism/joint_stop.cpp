/// Elastic stops at the ends of a joint's range, one or both of which a recording may reach:
///   τ = −k·(q − u + T·ω)   where q > u, never positive       k in N·m/rad (N/m on a slide joint)
///   τ = −k·(q − l + T·ω)   where q < l, never negative
/// Rubber, a hood, a cable that goes taut: they push back and do not hold. Kelvin and Voigt's element on either side,
/// damping k·T. Neutral: k = 0. Where the ends cross both are where they meet: a spring to that place.
#include <algorithm>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class JointStop final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    btr::Parameter relaxation{"relaxation_s", "s", "damping by stiffness while it touches", 0, 0.2, 0};
    relaxation.refines = true;
    return {{"stiffness_nm_rad", "N·m/rad", "torque per turn beyond an end, N/m on a slide joint", 0, 1e6, 5, 0.0},
            {"lower_rad", "rad", "position below which it pushes up, m on a slide joint", -1000, 1000, -0.5},
            {"upper_rad", "rad", "position above which it pushes down, m on a slide joint", -1000, 1000, 0.5},
            relaxation};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::joint, "elastic stops at the ends of the joint's range",
            "τ = −k·(q − u + T·ω) above u, −k·(q − l + T·ω) below l; never toward the end",
            "k: stiffness_nm_rad; l: lower_rad; u: upper_rad; T: relaxation_s; ω: joint speed",
            "Kelvin 1865, Voigt 1892"};
  }
  std::vector<std::string> contains() const override { return {"joint_spring"}; }
  std::vector<std::string> freeRange() const override { return {"lower_rad", "upper_rad"}; }
  Place place() const override { return Place::joint; }
  double torque(const btr::JointState& joint, std::span<const double> values) const override {
    if (values[0] == 0) return 0;
    const double middle = (values[1] + values[2]) / 2;
    const double lower = std::min(values[1], middle), upper = std::max(values[2], middle);
    const double lag = values[3] * joint.rate;
    if (joint.position > upper) return std::min(0.0, -values[0] * (joint.position - upper + lag));
    if (joint.position < lower) return std::max(0.0, -values[0] * (joint.position - lower + lag));
    return 0;
  }
};

}  // namespace

BTR_EFFECT(JointStop, "joint_stop")
