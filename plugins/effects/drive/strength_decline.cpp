/// A drive that grows weaker in the course of a trial: a winding that heats up, a battery that runs down.
///   τ' = τ·max(0, 1 − r·T·(1 − e^(−t/T)))      t: time of the trial, r: loss per second at its start [1/s], T: time
/// constant [s]. It ends at 1 − r·T; with T far above the trial's length the loss is linear, r·t. The exponential is a
/// body that heats up under even losses (Boglietti et al. 2009, Evolution and modern approaches for thermal analysis of
/// electrical machines: one thermal capacity), its resistance in proportion to its temperature. Neutral: r = 0.
/// What a battery loses is voltage: with `damping_stays` 1 the damping by the motor's own motion does not weaken.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class StrengthDecline final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"loss_1_s", "1/s", "share of the torque that is lost per second at the start", 0, 1, 0.05, 0.0},
            {"time_constant_s", "s", "in which the loss comes to its end", 0.3, 1000, 5},
            btr::dampingStaysParameter()};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a drive that grows weaker in the course of a trial",
            "τ’ = τ·max(0, 1 − r·T·(1 − exp(−t/T)))", "r: loss_1_s; T: time_constant_s; t: time of the trial",
            "Boglietti et al. 2009"};
  }
  Place place() const override { return Place::joint; }
  Stage stage() const override { return Stage::supply; }
  bool dissipative() const override { return true; }

  bool changesDrive() const override { return true; }
  double driveTorque(double torque, const btr::JointState& joint, std::span<const double> values, std::span<double>,
                     double) const override {
    const double left = std::max(0.0, 1 + values[0] * values[1] * std::expm1(-joint.time / values[1]));
    return btr::weakened(torque, joint, left, values[2] != 0);
  }
};

}  // namespace

BTR_EFFECT(StrengthDecline, "strength_decline")
