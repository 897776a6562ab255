/// A spring across a joint (Hooke): τ = −k·(q − q0)      k in N·m/rad (N/m on a slide joint)
/// Cables, skins and return springs. Energy ½·k·(q − q0)². Neutral: k = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class JointSpring final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"stiffness_nm_rad", "N·m/rad", "torque per turn, N/m on a slide joint", 0, 10000, 0.1, 0.0},
            {"rest_rad", "rad", "position without torque, m on a slide joint", -3.2, 3.2, 0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::joint, "a spring across the joint", "τ = −k·(q − q_0)",
            "k: stiffness_nm_rad; q_0: rest_rad", "Hooke"};
  }
  Place place() const override { return Place::joint; }
  double torque(const btr::JointState& joint, std::span<const double> values) const override {
    return values[0] == 0 ? 0 : -values[0] * (joint.position - values[1]);
  }
};

}  // namespace

BTR_EFFECT(JointSpring, "joint_spring")
