/// Dry friction that gives way before it slides, as bristles do (belts, seals, harmonic drives, cables in sheaths):
///   ż = ω − |ω|·z/s,   τ = −T·z/s      T: friction in motion [N·m or N]; z: how far the bristles are bent, at most s
///   [rad or m]: what the joint travels after a reversal until the friction is there again
/// (Dahl 1968, A solid friction model, with exponent 1; LuGre friction of Canudas de Wit et al. 1995 has this in it.)
/// The torque after a reversal depends on the way since then: a loop of hysteresis over the position. With s near
/// nothing it is Coulomb's friction. It is reckoned at the drive; a joint without one has none. Neutral: T = 0; s then
/// says nothing. State: z/s; of what stands still at the beginning, what drive and weight leave for it to carry.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class BristleFriction final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"torque_nm", "N·m", "friction in motion, N on a slide joint", 0, 200, 0.05, 0.0},
            {"give_rad", "rad", "way after a reversal in which it builds up, m on a slide joint", 1e-4, 1, 0.03}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::gear, "dry friction that gives way before it slides", "ż = ω − |ω|·z/s,  τ = −T·z/s",
            "T: torque_nm; s: give_rad; ω: joint speed", "Dahl 1968"};
  }
  Place place() const override { return Place::joint; }
  std::vector<std::string> contains() const override { return {"coulomb_friction"}; }
  /// What is left after all that the drive does.
  Stage stage() const override { return Stage::gear; }
  int stateSize() const override { return 1; }

  bool changesDrive() const override { return true; }
  double driveTorque(double torque, const btr::JointState& joint, std::span<const double> values,
                     std::span<double> state, double dt) const override {
    if (values[0] == 0) return torque;
    // Exact for a rate that is constant within the step; the mean of its ends over it.
    double& bent = state[0];
    constexpr double still = 0.1;  // of s in a second
    if (bent == 0 && std::abs(joint.rate) < still * values[1])
      bent = std::clamp((torque + joint.load) / values[0], -1.0, 1.0);
    const double before = bent, way = std::abs(joint.rate) * dt / values[1];
    const double end = std::copysign(1.0, joint.rate);
    bent = end + (before - end) * std::exp(-way);
    return torque - values[0] * (before + bent) / 2;
  }
};

}  // namespace

BTR_EFFECT(BristleFriction, "bristle_friction")
