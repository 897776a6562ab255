/// A motor gives less torque the faster it turns (Ohm's law with back electromotive force at full voltage):
///   |τ| ≤ min(1/a, T)·max(0, 1 − b·|ω|)      while τ drives the motion (τ·ω > 0); braking keeps its limit
/// 1/a: stall torque [N·m or N], never above the drive's own limit T; 1/b: speed without load [rad/s or m/s]. For
/// servos that the scene gives a constant limit. Neutral: a = b = 0.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class TorqueSpeedLimit final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"inverse_stall_torque_1_nm", "1/(N·m)", "one over the torque at standstill, 1/N on a slide joint", 0, 20,
             2.5, 0.0},
            {"inverse_free_speed_s_rad", "s/rad", "one over the speed without load, s/m on a slide joint", 0, 10, 0.1,
             0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a drive that gives less torque the faster it turns",
            "|τ| ≤ min(1/a, T)·max(0, 1 − b·|ω|) while it drives",
            "a: inverse_stall_torque_1_nm; b: inverse_free_speed_s_rad", "Ohm’s law with back electromotive force"};
  }
  Place place() const override { return Place::joint; }
  bool dissipative() const override { return true; }

  bool changesDrive() const override { return true; }
  double driveTorque(double torque, const btr::JointState& joint, std::span<const double> values, std::span<double>,
                     double) const override {
    if (values[0] == 0 && values[1] == 0) return torque;
    const double stall = values[0] > 0 ? std::min(1 / values[0], joint.limit) : joint.limit;
    const double fade = torque * joint.rate > 0 ? std::max(0.0, 1 - values[1] * std::abs(joint.rate)) : 1;
    return std::clamp(torque, -stall * fade, stall * fade);
  }
};

}  // namespace

BTR_EFFECT(TorqueSpeedLimit, "torque_speed_limit")
