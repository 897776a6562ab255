#pragma once
#include <limits>
#include <span>
#include <vector>

#include "core/sim/effect.h"
#include "core/sim/scene.h"
#include "core/sim/world.h"

namespace btr {

/// A torque that is linear in the joint's rate at the END of the step, within a limit:
///   torque = clamp(p − d·rate, ±limit)     p in N·m (or N), d ≥ 0 in N·m·s/rad (or N·s/m)
/// ODE solves it together with everything else (a motor row with target p/d and softness 1/d), so that a stiff servo
/// needs no small step and damping never creates energy.
struct DriveRow {
  double p = 0, d = 0;
  double limit = std::numeric_limits<double>::infinity();

  double torqueAt(double rate) const;
  bool limited() const { return limit < std::numeric_limits<double>::infinity(); }
};

/// The law of a drive over one step of `h` seconds. Position terms are taken at the middle of the step (d gains h/2
/// times the stiffness), which is stable at every step and becomes the contract's law as h → 0. A servo far from its
/// torque limit gets no limit in its row (such rows are cheaper to solve). `state.position`, `.rate`, `.command` are
/// those of now.
///   servo     clamp(p·(command − q) + i·∫ − d·rate, ±max)
///   DC motor  kt·u/R − kt²·rate/R,  u = supply·clamp(gain·(command − q)/nominal supply, ±maxDuty) or supply·duty as
///   given torque    clamp(command, ±max)
/// A drive that is switched off gives nothing (a DC motor: open circuit, no braking by its own voltage).
DriveRow driveRow(const Drive& drive, const JointState& state, double integral, const JointInput& input, double h);

/// The same law at this instant, as a number.
double driveTorque(const Drive& drive, const JointState& state, double integral, const JointInput& input);

/// Effects that were placed at one joint, with the state that the world keeps for them.
class JointEffects {
 public:
  void add(const SceneEffect& effect);
  bool empty() const { return placed_.empty(); }
  /// Back to the start of a trial: all states zero.
  void reset();

  double command(double command, const JointState& state, double dt);
  /// The drive's row after the effects on drive torque. An effect that changes the torque is linearised about this
  /// instant.
  DriveRow drive(const DriveRow& law, const Drive& drive, const JointState& state, double integral,
                 const JointInput& input, double h);
  /// Adds torque() and damping() to a row. A torque that opposes motion of a dissipative effect fades with the rate at
  /// the end of the step (secant), so that it cannot reverse it; other torques are linearised in position.
  void addPassive(DriveRow& row, const JointState& state, double h) const;
  double frictionLimit(const JointState& state) const;
  double measured(double position, const JointState& state, double dt);

 private:
  struct Placed {
    const Effect* effect;
    const std::vector<double>* values;
    std::vector<double> state;
  };
  double throughEffects(double torque, const JointState& state, double h, bool keepState);

  std::vector<Placed> placed_;
  std::vector<double> scratch_;
};

}  // namespace btr
