#pragma once
#include <limits>
#include <span>
#include <string>
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

/// Below this a row's d is none: its torque does not follow the rate.
inline constexpr double noDamping = 1e-12;

/// One step as the laws need it. ODE kicks velocities by the forces of the step's beginning, then moves by the new
/// velocity: positions belong to the steps' ends and velocities to their middles (leapfrog).
struct StepOf {
  double h = 0;        ///< length [s]
  double inertia = 1;  ///< that the joint turns or pushes, roughly [kg·m² or kg]
  double left = 0;     ///< time until the command must be reached, at least h (prescribed motion) [s]

  /// Adds a spring of stiffness k ≥ 0 and a damper c ≥ 0 whose torque at this position and rate is already part of the
  /// row as p (spring, anything else) and NOT yet in it (damper). Second order in h where h resolves them, stable for
  /// any k and c:
  ///   spring  −k·θ·h·(rate' − φ·rate), x = h²k/I, φ = 1/(1+x), θ = 1/(2(1+φ)): the trapezoid rule, damped when x is
  ///   large damper  −c·(ϑ·rate' + (1−ϑ)·rate), y = h·c/I, ϑ = 1/(1−exp(−y)) − 1/y: the exponential decay of I under c
  void add(DriveRow& row, double k, double c, double rate) const;
};

/// The law of a drive over one step. A servo far from its torque limit gets no limit in its row (such rows are cheaper
/// to solve). `state.position`, `.rate`, `.command` are those of now.
///   servo     clamp(p·(command − q) + i·∫ − d·rate, ±max), and with a no-load speed ω0 also within the motor's
///             torque-speed line: at most max·(1 − rate/ω0), at least −max·(1 + rate/ω0). At rest that is ±max, at ω0
///             nothing is left to drive with, beyond it the motor brakes; where it brakes it has its full torque.
///   DC motor  kt·u/R − kt²·rate/R,  u = supply·(duty as given, or clamp(gain·(command − q)/nominal
///             supply, ±maxDuty))
///   torque    clamp(command, ±max)
///   motion    D·((command − q)/time left − rate'), D a million times what the inertia needs
/// A drive that is switched off gives nothing; a DC motor whose winding is then shorted brakes, −offBraking·kt²·rate/R
/// (0, an open circuit, does not).
DriveRow driveRow(const Drive& drive, const JointState& state, double integral, const JointInput& input,
                  const StepOf& step);

/// The mean of both commands' laws: of a step whose kick lies half before and half after the instant at which the
/// command jumps from `before` to `after`. A servo at its limit, or a motor at its full duty, does not follow the mean
/// command.
DriveRow driveRow(const Drive& drive, const JointState& state, const CommandAround& command, double integral,
                  const JointInput& input, const StepOf& step);

/// The largest torque that a servo's motor gives towards positive positions at this rate; towards negative ones it is
/// −largestTorque(drive, −rate).
double largestTorque(const Drive& drive, double rate);

/// What a DC motor's own voltage brakes [N·m·s/rad or N·s/m]: kt²/R, times offBraking when it is switched off.
double backEmfDamping(const Drive& drive, const JointInput& input);

/// Of a DC motor now [V]: measured, or the scene's.
inline double supplyOf(const Drive& drive, const JointInput& input) {
  return input.supply_v >= 0 ? input.supply_v : drive.supply_v;
}

/// What the law loses per rate while it is within its limits [N·m·s/rad or N·s/m].
double ownDamping(const Drive& drive, const JointInput& input);

/// The same law at this instant, as a number.
double driveTorque(const Drive& drive, const JointState& state, double integral, const JointInput& input);

/// Dry friction of a joint, all of it: −limit·rate/transition below that speed, its limit against the motion above.
struct DryFriction {
  double limit = 0;       ///< N·m or N
  double transition = 0;  ///< rad/s or m/s; 0: it holds

  /// With another: together they are whole at the mean of their speeds, weighted by what they are then.
  void add(const DryFriction& other) {
    const double both = limit + other.limit;
    if (both > 0) transition = (limit * transition + other.limit * other.transition) / both;
    limit = both;
  }
  /// Of a row of the solver: rate + softness·torque = 0 within the limit.
  double softness() const { return limit > 0 ? transition / limit : 0; }
};

/// Effects that were placed at one joint, with the state that the world keeps for them.
class JointEffects {
 public:
  void add(const SceneEffect& effect);
  bool empty() const { return placed_.empty(); }
  bool changeDrive() const { return !onDrive_.empty(); }
  /// Back to the start of a trial: all states zero.
  void reset();
  /// As a joint that has rested leaves them.
  void rest(const JointState& state);
  /// The joint was moved by so much without a step [rad or m].
  void moved(double by);

  CommandAround command(CommandAround command, const JointState& state, double dt);
  /// The drive's row after the effects on drive torque. An effect that changes the torque is linearised about this
  /// instant.
  DriveRow drive(const DriveRow& law, const Drive& drive, const JointState& state, const CommandAround& command,
                 double integral, const JointInput& input, const StepOf& step);
  /// Adds torque() and damping() to a row. A torque that opposes motion of a dissipative effect fades with the rate at
  /// the end of the step (secant), so that it cannot reverse it; other torques are linearised in position.
  void addPassive(DriveRow& row, const JointState& state, const StepOf& step) const;
  DryFriction dryFriction(const JointState& state) const;
  /// What they remember, in the order of the simulator's list.
  std::vector<std::vector<double>> memory() const;
  void remember(const std::vector<std::vector<double>>& memory);
  double measured(double position, const JointState& state, double dt);

 private:
  struct Placed {
    const Effect* effect;
    const std::vector<double>* values;
    std::vector<double> state;
    std::string name;
    bool isLaw = false;         ///< of the servo's own law: Effect::stage() is command
    bool hasServoTerm = false;  ///< Effect::hasServoTerm()
  };
  /// Torques before and after a jump of the command. Effects of the servo's own law see each for half a step, others
  /// with a memory their mean.
  struct Torques {
    double before, after;
    double beyondBefore = 0, beyondAfter = 0;    ///< JointState::beyond
    double commandBefore = 0, commandAfter = 0;  ///< JointState::command
    double mean() const { return (before + after) / 2; }
  };
  double throughEffects(Torques torques, const JointState& state, double h, bool keepState);

  std::vector<Placed> placed_;        ///< in the order of the simulator's list
  std::vector<std::size_t> chain_;    ///< of these, by stage; in a stage by name, however they are listed
  std::vector<std::size_t> onDrive_;  ///< of the chain, those that change the drive's torque
  std::vector<double> scratch_;
};

}  // namespace btr
