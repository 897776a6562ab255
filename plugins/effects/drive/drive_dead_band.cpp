/// A drive that does nothing with little: a dead band about its zero, or a least pulse width of its output stage.
///   kind 0   τ' = τ − clamp(τ, ±z)           what is lost is lost everywhere (a voltage drop, a dead zone)
///   kind 1   τ' = 0 where |τ| < z, else τ    what is enough passes whole (a least pulse width)
/// z in N·m. (Tao and Kokotović 1994, Adaptive control of plants with unknown dead-zones.) Unlike dry friction it holds
/// nothing: a joint without drive falls. Neutral: z = 0.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class DriveDeadBand final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    btr::Parameter kind{"kind", "", "0: taken from all torques, 1: from those alone that are smaller", 0, 1, 0};
    kind.integer = true;
    return {{"torque_nm", "N·m", "least torque that the drive gives, N on a slide joint", 0, 50, 0.03, 0.0}, kind};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a drive that does nothing with little",
            "τ’ = τ − clamp(τ, ±z), or 0 for |τ| < z, else τ", "z: torque_nm; which of them: kind",
            "Tao and Kokotović 1994"};
  }
  Place place() const override { return Place::joint; }
  bool dissipative() const override { return true; }

  bool changesDrive() const override { return true; }
  double driveTorque(double torque, const btr::JointState&, std::span<const double> values, std::span<double>,
                     double) const override {
    if (values[1] != 0) return std::abs(torque) < values[0] ? 0 : torque;
    return torque - std::clamp(torque, -values[0], values[0]);
  }
};

}  // namespace

BTR_EFFECT(DriveDeadBand, "drive_dead_band")
