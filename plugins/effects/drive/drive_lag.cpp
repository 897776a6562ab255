/// The drive does not give a torque at once: its current rises with the winding's inductance, or the driver limits how
/// fast it may rise.
///   T·τ̇' = τ − τ',  |τ̇'| ≤ 1/k      T in s; k in s/(N·m) (s/N)
/// exact for a torque that is constant within the step; τ' = τ when a trial begins. (Leonhard 2001, Control of
/// Electrical Drives, ch. 7: the current loop as a first-order lag; a driver's slew rate in its data sheet.) Neutral:
/// T = k = 0. State: whether it has begun, τ'.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class DriveLag final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {
        {"time_constant_s", "s", "in which the torque follows what the servo asks for", 0, 0.2, 0.01, 0.0},
        {"inverse_slope_s_nm", "s/(N·m)", "least time per change of torque, s/N on a slide joint", 0, 2, 0.02, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a drive whose torque takes its time", "T·τ̇’ = τ − τ’,  |τ̇’| ≤ 1/k",
            "T: time_constant_s; k: inverse_slope_s_nm", "Leonhard 2001"};
  }
  Place place() const override { return Place::joint; }
  int stateSize() const override { return 2; }

  bool changesDrive() const override { return true; }
  double driveTorque(double torque, const btr::JointState&, std::span<const double> values, std::span<double> state,
                     double dt) const override {
    const double lag = values[0], inverseSlope = values[1];
    if ((lag == 0 && inverseSlope == 0) || dt <= 0) return torque;
    const double before = state[0] != 0 ? state[1] : torque;
    const double share = lag > 0 ? -std::expm1(-dt / lag) : 1;  // of the way that is left
    double change = share * (torque - before), mean = lag > 0 ? torque + (before - torque) * share * lag / dt : torque;
    if (const double most = inverseSlope > 0 ? dt / inverseSlope : INFINITY; std::abs(change) > most) {
      change = std::copysign(most, change);
      mean = before + change / 2;
    }
    state[0] = 1;
    state[1] = before + change;
    return mean;
  }
};

}  // namespace

BTR_EFFECT(DriveLag, "drive_lag")
