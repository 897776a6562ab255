#pragma once
#include "core/sim/drive_law.h"

namespace btr {

/// One step of a rotor (inertia J, rate w) that turns a joint (rate r) through a spring 1/k = Drive::gearCompliance and
/// a damper c = Drive::gearDamping beside it; φ is the rotor's angle ahead of the joint:
///   J·w' = τ − b·w − s,   s = k·φ + c·(w − r),   φ' = w − r      s: torque that reaches the joint
/// τ is the drive's row. It follows the joint's rate where the drive's sensor sits there; with Drive::loopAtMotor it
/// follows the rotor's. b is the part that follows the rotor's own in any case (back electromotive force). Solved at
/// the end of the step: the spring by the trapezoid rule where the step resolves it, by backward Euler where it does
/// not, so that any compliance and step are stable and the limit of a stiff spring is the rigid gear (J/h added to the
/// joint's row).
///
/// A gap of width w = Drive::gearPlay: no torque passes while |φ| < w/2, and Drive::gearDrag slows the rotor against
/// the joint; beyond, k·(φ ∓ w/2) instead of k·φ, never pulling back (Nordin and Gutman 2002, the dead zone model).
/// Without a compliance the flanks are as good as rigid and hits lose their energy. Whether a flank is touched is
/// decided once a step, from where the rotor would be without it.
class GearRow {
 public:
  GearRow() = default;
  /// From φ, w and r at the beginning; `motor` is the drive's row without b.
  GearRow(const Drive& drive, double ahead, double motorRate, double jointRate, const DriveRow& motor, double b,
          double jointInertia, double h);

  bool elastic() const { return h_ > 0; }
  /// What of the drive's row reaches the joint, and the rest of the spring's torque, as rows of the joint's new rate.
  DriveRow driven() const { return driven_; }
  DriveRow held() const { return held_; }
  /// The rotor's part of the step once the joint's new rate is known; returns the drive's torque.
  double turn(double& ahead, double& motorRate, double jointRate) const;

 private:
  void meet(const Drive& drive, double ahead, double motorRate, double jointRate, double jointInertia);
  double rotorRate(double motorRate, double jointRate) const;
  void touch(const Drive& drive, double ahead, double motorRate, double jointRate, double jointInertia);
  double all() const { return inertia_ + h_ * b_ + h_ * stiffness_ + h_ * drag_; }

  double h_ = 0, inertia_ = 0, b_ = 0, drag_ = 0;
  double spring_ = 0, stiffness_ = 0;  ///< s = spring + stiffness·(w' − r')
  DriveRow motor_, driven_, held_;
};

}  // namespace btr
