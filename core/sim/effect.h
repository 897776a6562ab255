#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/spec/parameter.h"

namespace btr {

struct Scene;

/// A driven joint at one instant, as an effect sees it. Right-hand rule about the axis of the model file.
struct JointState {
  double time = 0;              ///< since the start of the trial [s]
  double position = 0;          ///< rad or m
  double rate = 0;              ///< rad/s or m/s
  double command = 0;           ///< what the servo law follows now (after command effects)
  double drive = 0;             ///< torque of the drive in the last step [N·m or N]
  bool followsPosition = true;  ///< the command is a position (servo, DC motor), not a torque
  double limit = 1e9;           ///< largest torque of the drive [N·m or N]
  double load = 0;  ///< moment of the weight of all that the joint carries, about its axis [N·m or N]; contacts and
                    ///< accelerations are not in it
  double allDrives = 0;  ///< sum of |torque| of all drives of the robot in the last step
  double damping = 0;    ///< torque that the drive's own law loses per rate [N·m·s/rad or N·s/m]
  double beyond = 0;     ///< what that law asks for beyond its limit: all of it less what it gives [N·m or N]
  bool isTry = false;    ///< asked only how the torque of this step depends on position and rate, which are shifted a
                         ///< little: what is held over the step stays as it is
};

/// What a drive's law gives within its limit, and what it asks for beyond.
struct LimitedTorque {
  double given = 0, beyond = 0;
};

/// `asked` within `share` (1: all) of what limits the drive: its largest torque and, on the side on which its law asks
/// for more than `torque`, that.
inline double withinLimits(double asked, double torque, const JointState& joint, double share = 1) {
  const double least = joint.beyond < 0 ? torque : -joint.limit, most = joint.beyond > 0 ? torque : joint.limit;
  return std::clamp(asked, share * least, share * most);
}

/// With `added` in the sum that is limited.
inline LimitedTorque withTerm(double torque, const JointState& joint, double added) {
  if (added == 0) return {torque, joint.beyond};
  const double asked = torque + joint.beyond + added, given = withinLimits(asked, torque, joint);
  return {given, asked - given};
}

/// A ball at one instant, world frame.
struct BallState {
  double time = 0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d spin_rad_s = Eigen::Vector3d::Zero();
  double radius_m = 0, mass_kg = 0;
  bool onFloor = false;
};

/// A command on both sides of an instant: held over the half step before it, and over the half step after it [rad or
/// m].
struct CommandAround {
  double before = 0, after = 0;
  double mean() const { return (before + after) / 2; }
};

/// What an effect is, for readers of reports.
struct EffectLaw {
  /// The link of the way from a command to a measurement at which it acts.
  enum class Acts { notSaid, command, drive, gear, joint, link, gravity, air, contact, sensor };
  Acts acts = Acts::notSaid;
  std::string says;      ///< a noun phrase: "dry friction that does not depend on speed"
  std::string equation;  ///< one line; the letters after _ are below the line, those after ^ above it
  std::string symbols;   ///< which parameter is which letter: "T: torque_nm; ω: joint speed"
  std::string source;    ///< who says so: "Coulomb 1785"
};

/// A piece of physics that a simulator may have or lack. One class is both the hypothesis that is fitted to recordings
/// and the term that then runs in the simulator. Each hook is empty unless the effect fills it. Hooks are functions of
/// their arguments; whatever must be remembered lies in `state` (stateSize() numbers, zero at the start of a trial), so
/// that a trial can be copied, stored and replayed.
class Effect {
 public:
  enum class Place { joint, link, ball, floor, world };
  /// Where on the way from a command to what is measured of it.
  enum class Stage { command, motor, supply, gear, sensor };

  virtual ~Effect() = default;
  /// Name, unit, meaning, bounds, default and neutral value of each parameter; `values` below follow this order.
  virtual std::vector<Parameter> parameters() const = 0;
  virtual Place place() const = 0;
  /// Nothing is said by default.
  virtual EffectLaw law() const { return {}; }
  /// The effects at a joint change its command and its drive torque in this order, in whichever they are listed: what
  /// the sensor says closes the loop at once, however late commands arrive.
  virtual Stage stage() const { return Stage::motor; }
  /// Names of simpler effects that this one becomes for some of its values: never its rivals.
  virtual std::vector<std::string> contains() const { return {}; }
  /// Names of simpler effects that at the same place together are the same law for some of its values: no recording of
  /// these tells one from the other. Empty if there are none.
  virtual std::vector<std::string> togetherWith() const { return {}; }
  /// Names of effects of which one comes first: a wind that pushes also brakes. Where recordings are sensitive to one
  /// of those, this one is only looked for beside it. Empty if it stands for itself.
  virtual std::vector<std::string> needs() const { return {}; }
  /// Name of a whole number of periods in a turn (2π) of the joint's position; empty if it has none. Recordings show
  /// such an effect where they pass several periods: over less any curve of the position looks the same.
  virtual std::string periodsPerTurn() const { return {}; }
  /// Names of the lower and of the upper end of a range of the joint's position within which it does nothing, neither
  /// with a neutral value; empty if there is none. Recordings show such an effect where they pass an end.
  virtual std::vector<std::string> freeRange() const { return {}; }
  /// True if it never adds mechanical energy.
  virtual bool dissipative() const { return false; }
  virtual int stateSize() const { return 0; }
  /// What it remembers of a joint that has rested where it is, its drive holding `JointState::load`.
  virtual void rest(const JointState&, std::span<const double> /*values*/, std::span<double> /*state*/) const {}
  /// The joint, and what its sensor says, were moved by so much without a step [rad or m]: what it remembers of
  /// positions moves with them.
  virtual void moved(double /*by*/, std::span<double> /*state*/) const {}
  /// An effect of the world whose joint hooks act at every joint of every robot.
  virtual bool onEveryJoint() const { return false; }

  /// Changes masses, gravity, floor, servo numbers … before the world is built.
  virtual void changeScene(Scene&, const std::string& /*at*/, std::span<const double> /*values*/) const {}
  /// Command that the servo follows, from the one it was given. Called once a step of `dt` seconds.
  virtual CommandAround command(CommandAround command, const JointState&, std::span<const double> /*values*/,
                                std::span<double> /*state*/, double /*dt*/) const {
    return command;
  }
  /// True if servoTerm() is part of the servo's law.
  virtual bool hasServoTerm() const { return false; }
  /// What is added to the sum of the servo's law before that is limited [N·m or N].
  virtual double servoTerm(const JointState&, std::span<const double> /*values*/, std::span<double> /*state*/,
                           double /*dt*/) const {
    return 0;
  }
  /// True if driveTorque() changes anything; else it is never called.
  virtual bool changesDrive() const { return hasServoTerm(); }
  /// Drive torque after the servo law and its limit [N·m or N].
  virtual double driveTorque(double torque, const JointState& joint, std::span<const double> values,
                             std::span<double> state, double dt) const {
    return hasServoTerm() ? withTerm(torque, joint, servoTerm(joint, values, state, dt)).given : torque;
  }
  /// Torque added at the joint [N·m or N].
  virtual double torque(const JointState&, std::span<const double> /*values*/) const { return 0; }
  /// Largest dry friction torque at the joint [N·m or N], ≥ 0; the solver holds or opposes motion with at most that
  /// much.
  virtual double frictionLimit(const JointState&, std::span<const double> /*values*/) const { return 0; }
  /// Speed from which that is whole [rad/s or m/s], ≥ 0: below it the joint creeps under a torque in proportion, as
  /// where an integrator smooths the friction's sign. 0: it holds.
  virtual double frictionTransition(const JointState&, std::span<const double> /*values*/) const { return 0; }
  /// Implicit viscous coefficient [N·m·s/rad or N·s/m], ≥ 0.
  virtual double damping(const JointState&, std::span<const double> /*values*/) const { return 0; }
  /// What the sensor says of a position. Called once a sample; `dt` is the time since the last.
  virtual double measured(double position, const JointState&, std::span<const double> /*values*/,
                          std::span<double> /*state*/, double /*dt*/) const {
    return position;
  }
  /// The scene's frame in that of what tracks the balls: a ball at p is said to be at frame·p.
  virtual Eigen::Isometry3d trackedFrame(std::span<const double> /*values*/) const {
    return Eigen::Isometry3d::Identity();
  }
  /// Force on a ball [N], world frame.
  virtual Eigen::Vector3d ballForce(const BallState&, std::span<const double> /*values*/) const {
    return Eigen::Vector3d::Zero();
  }
};

}  // namespace btr
