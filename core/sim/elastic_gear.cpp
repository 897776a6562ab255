#include "core/sim/elastic_gear.h"

namespace btr {

GearRow::GearRow(const Drive& drive, double ahead, double motorRate, double jointRate, const DriveRow& motor, double b,
                 double jointInertia, double h)
    : h_(h), inertia_(drive.rotorInertia_kg_m2), b_(b), motor_(motor) {
  // The spring within the step: s = k·φ + θ·h·k·((w' − r') − a·(w − r)). θ goes from the trapezoid rule's 1/4 (between
  // velocities of the steps' middles) to 1, a from 1 to 0, as x = (h·frequency)² grows. Stable as θ·(1 + a) ≥ 1/2.
  const double k = 1 / drive.gearCompliance;
  const double reduced = inertia_ > 0 ? inertia_ * jointInertia / (inertia_ + jointInertia) : 0;
  const double late = reduced > 0 ? 1 / (1 + h * h * k / reduced) : 0;  // 1/(1 + x)
  const double share = (1 - 0.75 * late) * h * k;
  spring_ = k * ahead - late * share * (motorRate - jointRate);
  stiffness_ = share + drive.gearDamping;

  // Eliminating the rotor's new rate.
  const double all = inertia_ + h * b + h * stiffness_;
  const double passed = h * stiffness_ / all;
  driven_ = {passed * motor.p, passed * motor.d, passed * motor.limit};
  held_ = {spring_ * (1 - passed) + stiffness_ * inertia_ * motorRate / all, stiffness_ * (inertia_ + h * b) / all};
}

double GearRow::turn(double& ahead, double& motorRate, double jointRate) const {
  const double torque = motor_.torqueAt(jointRate);
  motorRate = (inertia_ * motorRate + h_ * (torque - spring_ + stiffness_ * jointRate)) /
              (inertia_ + h_ * b_ + h_ * stiffness_);
  ahead += h_ * (motorRate - jointRate);
  return torque - b_ * motorRate;
}

}  // namespace btr
