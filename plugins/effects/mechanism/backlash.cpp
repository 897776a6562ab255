/// Play between motor and joint: a gap of width w. Motor torque reaches the joint only while the tooth lies on the
/// flank that the torque pushes; otherwise the motor first runs through the gap.
///   −w/2 ≤ φ ≤ w/2            φ: motor ahead of joint [rad]
///   φ' = τ·s − min(ω·σ, 0)·σ  in the gap, σ = sign of τ, s in rad/(s·N·m)
///   τ_joint = τ               while φ = ±w/2 on the side of τ's sign, else 0
///
/// A motor of negligible inertia turns at s per torque. A joint that comes towards it closes the gap sooner; with one
/// that runs ahead it has moved along until then, and gains on it at s per torque. (Were its speed s·τ against the
/// ground, a gap of no width at all would let fast joints go.) In a step in which the gap closes, τ acts for the rest
/// of the step, so the torque is continuous in w.
///
/// Neutral: w = 0. After Nordin and Gutman 2002 (Controlling mechanical systems with backlash: a survey), without
/// elastic flanks. State: φ, in the middle of the gap at the start, or on the flank that holds the load of a joint that
/// has rested.
///
/// `sensors` says what the servo's loop follows and what is recorded:
///   0  the joint, the joint    as an AIBO's potentiometers do: the law above
///   1  the motor, the joint    a servo's encoder before the gear, the joint seen from outside
///   2  the joint, the motor    a second encoder closes the loop, the log is the motor's
///   3  the motor, the motor    a servo that says what it follows
///   4  the joint, the joint    as 0, with the motor's own inertia
/// In 1 to 4 the motor is there between the flanks (core/sim/elastic_gear.h): J·θ̈ = τ − (θ̇ − q̇)/s in the gap, J what
/// the drive has or the effect rotor_inertia gives it, rigid flanks that take the energy of a hit.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class Backlash final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"width_rad", "rad", "width of the gap, m on a slide joint", 0, 0.2, 0.02, 0.0},
            {"free_speed_rad_s_nm", "rad/(s·N·m)",
             "speed of the motor per torque while it crosses the gap, m/(s·N) on a slide joint", 1, 100, 6},
            btr::sensorsParameter(4, ", 4 joint and joint with the motor's own inertia")};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::gear, "gear play: the drive reaches the joint only after crossing a gap",
            "τ_joint = τ on the flank that τ pushes, 0 inside the gap of width w", "w: width_rad",
            "Nordin and Gutman 2002"};
  }
  Place place() const override { return Place::joint; }
  Stage stage() const override { return Stage::gear; }
  int stateSize() const override { return 1; }
  void rest(const btr::JointState& joint, std::span<const double> values, std::span<double> state) const override {
    if (values[2] == 0 && joint.load != 0) state[0] = std::copysign(values[0] / 2, -joint.load);
  }

  void changeScene(btr::Scene& scene, const std::string& at, std::span<const double> values) const override {
    btr::Drive& drive = btr::driveAt(scene, at, "backlash");
    if (values[0] == 0 || values[2] == 0) return;
    drive.gearPlay += values[0];
    drive.gearDrag += 1 / values[1];
    btr::placeSensors(drive, values[2]);
  }

  bool changesDrive() const override { return true; }
  double driveTorque(double torque, const btr::JointState& joint, std::span<const double> values,
                     std::span<double> state, double dt) const override {
    const double half = values[0] / 2;
    if (half == 0 || values[2] != 0) return torque;
    double& ahead = state[0];
    const double closing = torque * joint.rate < 0 ? joint.rate : 0;
    const double travel = (torque * values[1] - closing) * dt;
    const double wall = std::copysign(half, torque);
    const double distance = wall - ahead;
    ahead = std::clamp(ahead + travel, -half, half);
    // The flank is not reached, or only after a part of the step.
    if (ahead != wall) return 0;
    return distance == 0 ? torque : torque * (1 - distance / travel);
  }
};

}  // namespace

BTR_EFFECT(Backlash, "backlash")
