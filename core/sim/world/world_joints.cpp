// Servos, friction, stops: everything that acts at a joint becomes rows of ODE's solver.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/sim/rest.h"
#include "core/sim/world/world_impl.h"

namespace btr {
namespace {

// Parameters of one of a joint's own motor rows.
void setJointRow(const RobotJoint& joint, double velocity, double softness, double most) {
  const int g = joint.group;
  if (joint.slides) {
    dJointSetSliderParam(joint.id, dParamVel, velocity);
    dJointSetSliderParam(joint.id, dParamCFM, softness);
    dJointSetSliderParam(joint.id, dParamFMax, most);
  } else if (g == 0 && !joint.axisFollowsChild) {
    dJointSetHingeParam(joint.id, dParamVel, velocity);
    dJointSetHingeParam(joint.id, dParamCFM, softness);
    dJointSetHingeParam(joint.id, dParamFMax, most);
  } else {
    dJointSetUniversalParam(joint.id, dParamVel + g, velocity);
    dJointSetUniversalParam(joint.id, dParamCFM + g, softness);
    dJointSetUniversalParam(joint.id, dParamFMax + g, most);
  }
}

void setExtraRow(const RobotJoint& joint, int row, double velocity, double softness, double most) {
  const int g = row == 0 ? 0 : dParamGroup2;
  const auto set = joint.slides ? dJointSetLMotorParam : dJointSetAMotorParam;
  set(joint.extra, dParamVel + g, velocity);
  set(joint.extra, dParamCFM + g, softness);
  set(joint.extra, dParamFMax + g, most);
}

/// A drive as firmware sets it while it runs.
Drive withGains(Drive drive, const JointInput& input) {
  drive.p *= input.pTimes;
  drive.i *= input.iTimes;
  drive.d *= input.dTimes;
  return drive;
}

bool otherGains(const JointInput& input) { return input.pTimes != 1 || input.iTimes != 1 || input.dTimes != 1; }

/// On the winding of a DC motor; no number where the firmware chooses its duty.
double voltsGiven(const Drive& drive, const JointInput& input) { return supplyOf(drive, input) * input.duty; }

/// The duty of a step whose kick lies half before and half after the instant at which a recorded voltage changes. A
/// drive that is switched on or off just then has one half alone.
double dutyAround(const Drive& drive, const JointInput& input, double before_v, bool switched) {
  const double supply = supplyOf(drive, input), after_v = voltsGiven(drive, input);
  if (!std::isfinite(after_v) || supply <= 0 || before_v == after_v) return input.duty;
  return (switched ? (input.enabled ? after_v : before_v) : (before_v + after_v) / 2) / supply;
}

/// What a motor turns that has its law to itself: its rotor, and the joint once a gap is closed.
double turnedByMotor(const Drive& spec, const JointDrive& drive, const RobotJoint& joint) {
  constexpr double least = 1e-9;
  const bool touches = spec.gearCompliance == 0 && std::abs(drive.motorAhead) >= spec.gearPlay / 2;
  return std::max(least, spec.rotorInertia_kg_m2 + (touches ? joint.heldInertia : 0));
}

}  // namespace

JointState World::Impl::stateOf(const WorldRobot& robot, std::size_t joint, double now) const {
  const RobotJoint& moving = robot.body->joints[joint];
  const JointDrive& drive = robot.drives[joint];
  const Drive& spec = robot.scene->drives[static_cast<std::size_t>(moving.modelJoint)];
  const bool followsPosition = spec.kind == Drive::Kind::servo || spec.kind == Drive::Kind::dcMotor;
  return {now,        moving.position, moving.rate, drive.command, drive.torque, followsPosition, spec.maxTorque,
          drive.load, robot.allDrives};
}

JointState World::Impl::loopStateOf(const WorldRobot& robot, std::size_t joint, JointState state) const {
  const Drive& spec = robot.scene->drives[static_cast<std::size_t>(robot.body->joints[joint].modelJoint)];
  if (!spec.loopAtMotor || !spec.hasGear() || spec.kind == Drive::Kind::motion) return state;
  state.position += robot.drives[joint].motorAhead;
  state.rate = robot.drives[joint].motorRate;
  return state;
}

// What each joint carries is the tree of bodies beyond it: a body comes after the one that carries it.
void World::Impl::weighLoads(WorldRobot& robot) const {
  weighOwnLoads(robot);
  for (std::size_t j = 0; j < robot.drives.size(); ++j)
    if (const RobotJoint& joint = robot.body->joints[j]; joint.leader >= 0)
      robot.drives[static_cast<std::size_t>(joint.leader)].load += joint.multiplier * robot.drives[j].load;
}

void World::Impl::weighOwnLoads(WorldRobot& robot) const {
  if (robot.alone) {
    robot.alone->prepare(*robot.body, scene.gravity_m_s2);
    for (std::size_t j = 0; j < robot.drives.size(); ++j) robot.drives[j].load = robot.alone->weight(j);
    return;
  }
  const auto& bodies = robot.body->bodies;
  std::vector<Carried>& carried = robot.carried;
  carried.resize(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    carried[i] = {bodies[i].mass_kg, bodies[i].mass_kg * bodies[i].pose.translation(), -1};
  for (const RobotJoint& joint : robot.body->joints) carried[static_cast<std::size_t>(joint.child)].by = joint.parent;
  for (std::size_t i = bodies.size(); i-- > 0;)
    if (carried[i].by >= 0) {
      carried[static_cast<std::size_t>(carried[i].by)].mass_kg += carried[i].mass_kg;
      carried[static_cast<std::size_t>(carried[i].by)].moment_kg_m += carried[i].moment_kg_m;
    }
  for (std::size_t j = 0; j < robot.drives.size(); ++j) {
    const RobotJoint& joint = robot.body->joints[j];
    const Carried& all = carried[static_cast<std::size_t>(joint.child)];
    const Eigen::Vector3d anchor = robot.body->poseOf(joint.child) * joint.anchorInChild;
    const Eigen::Vector3d arm = all.moment_kg_m - all.mass_kg * anchor;
    robot.drives[j].load = joint.axis.dot(joint.slides ? Eigen::Vector3d(all.mass_kg * scene.gravity_m_s2)
                                                       : arm.cross(scene.gravity_m_s2));
  }
}

// A stop is a spring that has yielded by the end of the step, with a damper against being pushed in further.
void World::Impl::addStop(DriveRow& passive, const RobotJoint& joint, double h) const {
  const double beyond = joint.position < joint.lowStop    ? joint.position - joint.lowStop
                        : joint.position > joint.highStop ? joint.position - joint.highStop
                                                          : 0;
  if (beyond == 0) return;
  const double stiffness = joint.heldInertia * stopFrequency_rad_s * stopFrequency_rad_s;
  passive.p -= stiffness * beyond;
  passive.d += h * stiffness;
  if (beyond * joint.rate > 0) passive.d += 2 * joint.heldInertia * stopFrequency_rad_s;
}

namespace {

/// A joint that is moved as it was recorded never stands quite still: it follows the sensor's noise. Where it moves no
/// faster than that it rests, and its drive need not give what dry friction can carry: friction that opposed every
/// noise would be a torque that nobody recorded. 0: it moves.
double restingRate(const DriveRow& motion, const RobotJoint& joint) {
  const double rate = motion.d > 0 ? motion.p / motion.d : 0;
  // Before the step as well: a joint that only turns round does not rest.
  return std::max(std::abs(rate), std::abs(joint.rate)) < restsBelow(joint.slides) ? rate : 0;
}

}  // namespace

void World::Impl::driveJoint(WorldRobot& robot, std::size_t index, const JointInput& input, double now, double h) {
  RobotJoint& joint = robot.body->joints[index];
  JointDrive& drive = robot.drives[index];
  const Drive& given = robot.scene->drives[static_cast<std::size_t>(joint.modelJoint)];
  const std::optional<Drive> changed = otherGains(input) ? std::optional<Drive>(withGains(given, input)) : std::nullopt;
  const Drive& spec = changed ? *changed : given;
  const StepOf step{h, joint.heldInertia + spec.rotorInertia_kg_m2, std::max(h, until - now)};
  const bool prescribed = spec.kind == Drive::Kind::motion;

  // Command, servo law, drive torque. A kick acts for half a step before and after its instant: where the command
  // changes just then, half of it follows the old one.
  CommandAround command{drive.fresh ? input.command : drive.command, input.command};
  // Switched on or off just then: half of the kick, for the same reason, under the command of that half.
  const bool switched = !drive.fresh && drive.enabled != input.enabled;
  if (switched && input.enabled) command.before = command.after;
  JointInput acting = input;
  acting.enabled = input.enabled || switched;
  const double before_v = std::exchange(drive.volts, voltsGiven(spec, input));
  if (!drive.fresh && std::isfinite(before_v)) acting.duty = dutyAround(spec, input, before_v, switched);
  drive.command = input.command;
  drive.enabled = input.enabled;
  drive.fresh = false;
  const bool geared = spec.hasGear() && !prescribed;
  const JointState atJoint = stateOf(robot, index, now);
  JointState state = loopStateOf(robot, index, atJoint);
  StepOf driven = step;
  if (geared && spec.loopAtMotor) driven.inertia = turnedByMotor(spec, drive, joint);
  if (prescribed) {
    command.before = command.after;
  } else if (!drive.effects.empty()) {
    command = drive.effects.command(command, state, h);
  }
  if (switched && !input.enabled) command.after = command.before;
  state.command = command.mean();
  if (given.i > 0)
    drive.integral = spec.i > 0 && input.enabled ? drive.integral + (state.command - state.position) * h : 0;
  DriveRow row = driveRow(spec, state, command, drive.integral, acting, driven);
  if (drive.effects.changeDrive() && acting.enabled && !prescribed && spec.kind != Drive::Kind::none)
    row = drive.effects.drive(row, spec, state, command, drive.integral, acting, driven);
  if (switched && !prescribed)
    for (double* force : {&row.p, &row.d, &row.limit}) *force /= 2;
  drive.row = row;

  // What acts at the joint itself: viscous friction, effects, stops. Dry friction is a row of its own: it holds, or
  // opposes motion, with at most its limit.
  JointState following = atJoint;
  following.command = state.command;
  DriveRow passive;
  step.add(passive, 0, spec.viscousFriction, joint.rate);
  if (!drive.effects.empty()) drive.effects.addPassive(passive, following, step);
  addStop(passive, joint, h);
  DryFriction dry{spec.coulombFriction};
  if (!drive.effects.empty()) dry.add(drive.effects.dryFriction(following));

  // The very first kick from a given state covers half a step only.
  for (double* force : {&row.p, &row.d, &row.limit, &passive.p, &passive.d, &dry.limit}) *force *= robot.kick;

  // A rotor behind an elastic gear or a gap moves on its own; what reaches the joint comes through the gear's spring.
  drive.gear = {};
  if (geared) {
    // The back electromotive force is the rotor's, not the joint's; a law at the motor has it already.
    double b = spec.kind == Drive::Kind::dcMotor && !spec.loopAtMotor ? backEmfDamping(spec, acting) : 0;
    DriveRow braking;
    step.add(braking, 0, b, joint.rate);
    if (row.d < braking.d) b = 0;  // an effect has let go of the motor
    const double share = robot.kick * (switched ? 0.5 : 1);
    if (b > 0) row = {row.p - braking.p * share, row.d - braking.d * share, row.limit};
    drive.gear = GearRow(spec, drive.motorAhead, drive.motorRate, joint.rate, row, b * share, joint.heldInertia, h);
    row = drive.gear.driven();
    passive.p += drive.gear.held().p;
    passive.d += drive.gear.held().d;
  }
  // The rotor behind a rigid gear: kinetic energy ½·J·rate², the limit of a large gear ratio (the rotor's own share in
  // the spin of its body is left out).
  if (spec.rotorInertia_kg_m2 > 0 && !geared) {
    passive.d += spec.rotorInertia_kg_m2 / h;
    passive.p += spec.rotorInertia_kg_m2 / h * joint.rate;
  }

  if (robot.couples && !robot.alone) {
    leadOthers(passive, robot, index, h);
    if (joint.leader >= 0) row = followLeader(robot, index, h);
  }
  if (robot.alone)
    robot.rows[index] = {row, passive, dry, prescribed ? restingRate(row, joint) : 0};
  else
    setRows(robot, index, {row, passive, dry});
}

// ODE has no rows between more than two bodies. A joint that follows another one is moved there by a row of its own,
// where its leader will be at its present rate; the leader feels what that took in the step before, and, in this step,
// the inertia that hangs at it: see CoupledInertia.
DriveRow World::Impl::followLeader(WorldRobot& robot, std::size_t index, double h) {
  const RobotJoint& joint = robot.body->joints[index];
  const RobotJoint& leader = robot.body->joints[static_cast<std::size_t>(joint.leader)];
  const StepOf step{h, joint.heldInertia, h};
  JointState state = stateOf(robot, index, 0);
  state.command = joint.multiplier * (leader.position + h * leader.rate) + joint.offset;
  Drive motion;
  motion.kind = Drive::Kind::motion;
  return robot.drives[index].coupling = driveRow(motion, state, 0, {}, step);
}

void World::Impl::leadOthers(DriveRow& passive, const WorldRobot& robot, std::size_t index, double h) const {
  const double inertia = robot.coupled.ofLeader(index);
  passive.d += inertia / h;
  passive.p += inertia / h * robot.body->joints[index].rate;
  for (std::size_t j = 0; j < robot.drives.size(); ++j)
    if (const RobotJoint& joint = robot.body->joints[j]; joint.leader == static_cast<int>(index))
      passive.p -= joint.multiplier * robot.drives[j].couplingLoad;
}

/// After a step.
void World::Impl::loadLeaders(WorldRobot& robot, double h) const {
  const auto accelerationOf = [&](std::size_t j) {
    return (robot.body->joints[j].solvedRate - robot.drives[j].rateBefore) / h;
  };
  for (std::size_t j = 0; j < robot.drives.size(); ++j)
    if (const RobotJoint& joint = robot.body->joints[j]; joint.leader >= 0)
      robot.drives[j].couplingLoad =
          robot.drives[j].coupling.torqueAt(joint.solvedRate) - robot.coupled.taken(*robot.body, j, accelerationOf);
}

/// As rows of ODE's solver. A limited servo and passive terms do not fit into one.
void World::Impl::setRows(WorldRobot& robot, std::size_t index, const JointRows& rows) {
  RobotJoint& joint = robot.body->joints[index];
  JointDrive& drive = robot.drives[index];
  DriveRow row = rows.drive, passive = rows.passive;
  const DryFriction& dry = rows.dry;
  const bool apart = row.limited() && passive.d > noDamping;
  if (!joint.extra && (dry.limit > 0 || apart)) robot.body->makeExtraRows(joint);
  if (dry.limit > 0 || drive.dryRow) setExtraRow(joint, 0, 0, dry.softness(), dry.limit);
  drive.dryRow = dry.limit > 0;
  if (apart) setExtraRow(joint, 1, passive.p / passive.d, 1 / passive.d, dInfinity);
  if (!apart && drive.passiveRow) setExtraRow(joint, 1, 0, 0, 0);
  drive.passiveRow = apart;
  if (!apart) {
    if (row.limited()) {
      robot.body->addTorque(joint, passive.p);
    } else {
      row.p += passive.p;
      row.d += passive.d;
    }
  }
  if (row.d > noDamping) {
    setJointRow(joint, row.p / row.d, 1 / row.d, row.limited() ? row.limit : dInfinity);
  } else {
    setJointRow(joint, 0, 0, 0);
    if (const double torque = row.torqueAt(0); torque != 0) robot.body->addTorque(joint, torque);
  }
}

}  // namespace btr
