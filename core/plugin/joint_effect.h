#pragma once
#include <string>

#include "core/sim/scene.h"
#include "core/spec/error.h"

namespace btr {

/// The drive of the joint `at` (ROBOT.JOINT). Throws InputError that names the effect if the scene has no such joint.
inline Drive& driveAt(Scene& scene, const std::string& at, const std::string& effect) {
  for (SceneRobot& robot : scene.robots)
    for (std::size_t j = 0; j < robot.model.joints.size(); ++j)
      if (at == robot.name + "." + robot.model.joints[j].name) return robot.drives[j];
  throw InputError(effect + ": the scene has no joint \"" + at + "\"; write ROBOT.JOINT");
}

/// What of a drive grows weaker with its supply, a whole number that an analysis tries one by one: 0 all of its torque,
/// 1 what its voltage drives, while the damping by its own motion (back electromotive force) stays.
inline Parameter dampingStaysParameter() {
  Parameter stays{
      "damping_stays", "", "what grows weaker: 0 all of the torque, 1 all but the drive's own damping", 0, 1, 0};
  stays.integer = true;
  return stays;
}

/// A drive's torque with `share` (0 to 1) of its supply. Where its damping stays, and within its limit, it is
///   share·(τ + d·ω) − d·ω      d: JointState::damping, ω: JointState::rate
inline double weakened(double torque, const JointState& joint, double share, bool dampingStays) {
  if (!dampingStays || joint.damping == 0) return share * torque;
  const double own = -joint.damping * joint.rate;
  return withinLimits(share * (torque + joint.beyond - own) + own, torque, joint, share);
}

/// Whether the servo follows a sensor that is off, too, a whole number that an analysis tries one by one.
inline Parameter closesLoopParameter(double byDefault = 0) {
  Parameter loop{"closes_loop", "", "0: recorded only, 1: the servo follows it too", 0, 1, byDefault};
  loop.integer = true;
  return loop;
}

/// Speed from which dry friction is whole (Effect::frictionTransition): no law of its own, but how another integrator,
/// or grease, makes it begin.
inline Parameter transitionParameter() {
  Parameter transition{
      "transition_rad_s", "rad/s", "speed below which it fades (0: it holds), m/s on a slide joint", 0, 1, 0};
  transition.refines = true;
  return transition;
}

/// What a servo's law makes of a command when its sensor says `off` too much [rad or m]: it acts on c − (q + off).
inline CommandAround seenThrough(const CommandAround& command, const JointState& joint, double off) {
  if (!joint.followsPosition) return command;
  return {command.before - off, command.after - off};
}

/// What a servo's loop follows and what is recorded, where motor and joint can part: a whole number that an analysis
/// tries one by one. Further ways to build it follow from 4 on.
inline Parameter sensorsParameter(int most = 3, const std::string& further = "") {
  Parameter sensors{
      "sensors",
      "",
      "loop and recording: 0 joint and joint, 1 motor and joint, 2 joint and motor, 3 motor and motor" + further,
      0,
      static_cast<double>(most),
      0};
  sensors.integer = true;
  return sensors;
}

inline void placeSensors(Drive& drive, double sensors) {
  const int bits = static_cast<int>(sensors);
  drive.loopAtMotor = drive.loopAtMotor || (bits & 1) != 0;
  drive.recordedAtMotor = drive.recordedAtMotor || (bits & 2) != 0;
}

}  // namespace btr
