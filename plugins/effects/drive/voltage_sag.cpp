/// One battery feeds all drives of a robot; its voltage falls with what they draw together; a drive's torque falls
/// with the voltage:
///   τ' = τ/(1 + s·Σ|τ_j|)      Σ over the robot's drives in the last step [N·m]; s in 1/(N·m)
/// which is V = V0 − R·I with a current in proportion to the torques and V/V0 = 1/(1 + s·Σ) as its fixed point for
/// drives whose torque is proportional to the voltage. (Shepherd 1965, Design of primary and secondary cells II: its
/// ohmic term alone.) No more than a step late. Neutral: s = 0.
/// With `damping_stays` 1 the damping by the motors' own motion, which is no voltage of the battery's, does not fall.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class VoltageSag final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"per_torque_1_nm", "1/(N·m)", "loss of voltage per torque of all drives together", 0, 5, 0.1, 0.0},
            btr::dampingStaysParameter()};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a battery whose voltage falls with what the drives draw",
            "τ’ = τ/(1 + s·Σ|τ_j|)", "s: per_torque_1_nm", "Shepherd 1965"};
  }
  Place place() const override { return Place::world; }
  Stage stage() const override { return Stage::supply; }
  bool onEveryJoint() const override { return true; }
  bool dissipative() const override { return true; }

  bool changesDrive() const override { return true; }
  double driveTorque(double torque, const btr::JointState& joint, std::span<const double> values, std::span<double>,
                     double) const override {
    if (values[1] == 0) return torque / (1 + values[0] * joint.allDrives);
    return btr::weakened(torque, joint, 1 / (1 + values[0] * joint.allDrives), true);
  }
};

}  // namespace

BTR_EFFECT(VoltageSag, "voltage_sag")
