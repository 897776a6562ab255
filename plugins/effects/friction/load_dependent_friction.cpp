/// Dry friction of a gear that grows with the torque through it: teeth that are pressed together rub more.
///   T = T0 + |cm·τm − cl·τl|      |τ| ≤ T at rest, τ = −T·sign(ω) in motion
/// τm [N·m or N]: torque of the drive; τl: moment of the weight that the joint carries, both about the joint's axis, so
/// that they add up where the drive holds the weight. Load comes from both sides with shares of their own because a
/// gear is not equally good in both directions (Duclusaud, Passault et al. 2025, arXiv 2410.08650, who find it to
/// matter most of all in hobby servos). τm is that of the last step. Forces of contacts and accelerations are not part
/// of τl. Below the transition speed it fades, as coulomb_friction does. Neutral: T0 = cm = cl = 0.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class LoadDependentFriction final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"torque_nm", "N·m", "friction without load, N on a slide joint", 0, 200, 0.02, 0.0},
            {"per_motor_torque", "", "friction per torque of the drive", 0, 2, 0.1, 0.0},
            {"per_load_torque", "", "friction per moment of the carried weight", 0, 2, 0.1, 0.0},
            btr::transitionParameter()};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::gear, "dry friction of a gear that grows with the torque through it",
            "|τ| = T_0 + |c_m·τ_m − c_l·τ_l|, against the motion",
            "T_0: torque_nm; c_m: per_motor_torque; c_l: per_load_torque; τ_m: drive, τ_l: carried weight",
            "Duclusaud, Passault et al. 2025"};
  }
  Place place() const override { return Place::joint; }
  std::vector<std::string> contains() const override { return {"coulomb_friction"}; }
  bool dissipative() const override { return true; }
  double frictionLimit(const btr::JointState& joint, std::span<const double> values) const override {
    return values[0] + std::abs(values[1] * joint.drive - values[2] * joint.load);
  }
  double frictionTransition(const btr::JointState&, std::span<const double> values) const override { return values[3]; }
};

}  // namespace

BTR_EFFECT(LoadDependentFriction, "load_dependent_friction")
