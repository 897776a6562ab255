#include "core/sim/elastic_gear.h"

#include <cmath>

namespace btr {
namespace {

constexpr double flankFrequency_rad_s =
    3000;  // of the joint on a rigid flank: a newton metre presses 1e-3 kg·m² in by 0.1 mrad

}  // namespace

GearRow::GearRow(const Drive& drive, double ahead, double motorRate, double jointRate, const DriveRow& motor, double b,
                 double jointInertia, double h)
    : h_(h), inertia_(drive.rotorInertia_kg_m2), b_(b), motor_(motor) {
  if (drive.loopAtMotor) {
    // As a row of the rotor's rate: a brake beside b, or a constant where that would exceed its limit.
    b_ = b + motor.d;
    motor_ = {motor.p, 0};
    meet(drive, ahead, motorRate, jointRate, jointInertia);
    const double torque = motor.p - motor.d * rotorRate(motorRate, jointRate);
    if (std::abs(torque) > motor.limit) {
      b_ = b;
      motor_ = {std::copysign(motor.limit, torque), 0};
    }
  }
  meet(drive, ahead, motorRate, jointRate, jointInertia);
  // Eliminating the rotor's new rate.
  if (stiffness_ == 0) return;
  const double passed = h * stiffness_ / all();
  driven_ = {passed * motor_.p, passed * motor_.d, passed * motor_.limit};
  held_ = {spring_ * (1 - passed) + stiffness_ * inertia_ * motorRate / all(),
           stiffness_ * (inertia_ + h * b_) / all()};
}

/// Whether the gear's spring, or which flank of its gap, is touched in this step.
void GearRow::meet(const Drive& drive, double ahead, double motorRate, double jointRate, double jointInertia) {
  if (drive.gearPlay == 0) return touch(drive, ahead, motorRate, jointRate, jointInertia);
  spring_ = stiffness_ = 0;
  drag_ = drive.gearDrag;
  // Where the rotor would be without flanks; one without inertia that nothing brakes is at once at one of them.
  const double half = drive.gearPlay / 2, moved = rotorRate(motorRate, jointRate) - jointRate;
  const double free = std::isfinite(moved) ? ahead + h_ * moved : std::copysign(2 * half, motor_.p);
  if (std::abs(free) <= half) return;
  const double side = std::copysign(1.0, free);
  drag_ = 0;
  touch(drive, ahead - side * half, motorRate, jointRate, jointInertia);
  if (side * (spring_ + stiffness_ * (rotorRate(motorRate, jointRate) - jointRate)) >= 0) return;
  spring_ = stiffness_ = 0;
  drag_ = drive.gearDrag;
}

double GearRow::rotorRate(double motorRate, double jointRate) const {
  const double torque = motor_.torqueAt(jointRate);
  return (inertia_ * motorRate + h_ * (torque - spring_ + (stiffness_ + drag_) * jointRate)) / all();
}

/// The spring within the step, from φ of its own rest: s = k·φ + θ·h·k·((w' − r') − a·(w − r)). θ goes from the
/// trapezoid rule's 1/4 (between velocities of the steps' middles) to 1, a from 1 to 0, as x = (h·frequency)² grows.
/// Stable as θ·(1 + a) ≥ 1/2.
void GearRow::touch(const Drive& drive, double ahead, double motorRate, double jointRate, double jointInertia) {
  const double reduced = inertia_ > 0 ? inertia_ * jointInertia / (inertia_ + jointInertia) : 0;
  const bool rigid = drive.gearCompliance == 0;
  const double k = rigid ? jointInertia * flankFrequency_rad_s * flankFrequency_rad_s : 1 / drive.gearCompliance;
  const double late = reduced > 0 && drive.gearPlay == 0 ? 1 / (1 + h_ * h_ * k / reduced) : 0;  // 1/(1 + x)
  const double share = (1 - 0.75 * late) * h_ * k;
  spring_ = k * ahead - late * share * (motorRate - jointRate);
  stiffness_ = share + (rigid ? 2 * std::sqrt(k * (reduced > 0 ? reduced : jointInertia)) : drive.gearDamping);
}

double GearRow::turn(double& ahead, double& motorRate, double jointRate) const {
  const double torque = motor_.torqueAt(jointRate);
  motorRate = all() > 0 ? rotorRate(motorRate, jointRate) : jointRate;
  ahead += h_ * (motorRate - jointRate);
  return torque - b_ * motorRate;
}

}  // namespace btr
