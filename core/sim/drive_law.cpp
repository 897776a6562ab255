#include "core/sim/drive_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace btr {

double DriveRow::torqueAt(double rate) const {
  const double torque = p - d * rate;
  return limited() ? std::clamp(torque, -limit, limit) : torque;
}

void StepOf::add(DriveRow& row, double k, double c, double rate) const {
  if (k > 0) {
    const double phi = 1 / (1 + h * h * k / inertia);
    const double share = h * k / (2 * (1 + phi));
    row.d += share;
    row.p += phi * share * rate;
  }
  if (c > 0) {
    const double y = h * c / inertia;
    const double late = y < 1e-3 ? 0.5 + y / 12 : 1 / (1 - std::exp(-y)) - 1 / y;
    row.d += late * c;
    row.p -= (1 - late) * c * rate;
  }
}

namespace {

/// The row of the torque-speed line where the servo's own row asks for more. Both fall with the rate, so for a joint
/// that turns freely the smaller torque is that of the row which leaves it slower. Taken at the rate of the step's end
/// alone: then no inertia, however wrongly known, lets the motor exceed its no-load speed.
std::optional<DriveRow> lineRow(const Drive& drive, const DriveRow& servo, double wanted, double rate,
                                const StepOf& step) {
  const double most = drive.maxTorque, noLoad = drive.noLoadSpeed_rad_s;
  const auto end = [&](double p, double d) { return (step.inertia * rate + step.h * p) / (step.inertia + step.h * d); };
  const double slope = most / noLoad, free = end(servo.p, servo.d);
  for (const double side : {1.0, -1.0}) {
    if (side * free <= side * end(side * most, slope)) continue;
    DriveRow line{side * most, slope, std::min(most, wanted)};
    // Well under way the line itself stays within the limit, unless the joint is thrown back.
    const double along = side * rate / noLoad;
    if (along > 0.25 && along < 1 && most * (1 - along) <= wanted) line.limit = DriveRow{}.limit;
    return line;
  }
  return std::nullopt;
}

DriveRow servoRow(const Drive& drive, const JointState& state, double integral, const StepOf& step) {
  DriveRow row;
  row.p = drive.p * (state.command - state.position) + drive.i * integral;
  const double withoutDamping = row.p;
  step.add(row, drive.p, drive.d, state.rate);
  const double now = row.p - row.d * state.rate;
  const double wanted = std::max(std::abs(withoutDamping), std::abs(now));
  if (drive.noLoadSpeed_rad_s > 0)
    if (const auto line = lineRow(drive, row, wanted, state.rate, step)) return *line;
  if (wanted > drive.maxTorque) row.limit = drive.maxTorque;
  return row;
}

/// A DC motor's law in one step: what does not depend on where the joint is.
struct MotorNow {
  MotorNow(const Drive& drive, const JointInput& input)
      : perVolt(drive.torqueConstant_nm_a / drive.resistance_ohm),
        constant(drive.torqueConstant_nm_a),
        supply(supplyOf(drive, input)),
        given(input.duty),
        gain(drive.supply_v > 0 ? drive.firmwareGain_v_rad / drive.supply_v : 0),
        maxDuty(drive.maxDuty) {}

  struct Volts {
    double given, slope;  ///< voltage on the winding and its fall with position [V, V/rad]
  };
  Volts volts(double command, double position) const {
    if (std::isfinite(given)) return {supply * given, 0};
    const double duty = gain * (command - position);
    if (std::abs(duty) > maxDuty) return {supply * std::copysign(maxDuty, duty), 0};
    return {supply * duty, supply * gain};
  }
  double torque(double command, double position, double rate) const {
    return perVolt * (volts(command, position).given - constant * rate);
  }

  double perVolt, constant, supply;
  double given;          ///< duty that the recording has, or not finite
  double gain, maxDuty;  ///< the firmware knows the supply that it was made for: a sagging one weakens its gain
};

DriveRow dcMotorRow(const Drive& drive, const JointState& state, const JointInput& input, const StepOf& step) {
  const MotorNow motor(drive, input);
  const MotorNow::Volts volts = motor.volts(state.command, state.position);
  DriveRow row;
  row.p = motor.perVolt * volts.given;
  step.add(row, motor.perVolt * volts.slope, motor.perVolt * drive.torqueConstant_nm_a, state.rate);
  return row;
}

/// What remains between the wanted and the made rate is a millionth of the change of rate, and is made good one step
/// later.
DriveRow motionRow(const JointState& state, const StepOf& step) {
  constexpr double stiff = 1e6;
  DriveRow row;
  row.d = stiff * step.inertia / step.h;
  row.p = row.d * (state.command - state.position) / step.left;
  return row;
}

}  // namespace

double backEmfDamping(const Drive& drive, const JointInput& input) {
  const double shorted = drive.torqueConstant_nm_a * drive.torqueConstant_nm_a / drive.resistance_ohm;
  return input.enabled ? shorted : drive.offBraking * shorted;
}

DriveRow driveRow(const Drive& drive, const JointState& state, double integral, const JointInput& input,
                  const StepOf& step) {
  if (!input.enabled) {
    DriveRow row;
    if (drive.kind == Drive::Kind::dcMotor) step.add(row, 0, backEmfDamping(drive, input), state.rate);
    return row;
  }
  switch (drive.kind) {
    case Drive::Kind::servo:
      return servoRow(drive, state, integral, step);
    case Drive::Kind::dcMotor:
      return dcMotorRow(drive, state, input, step);
    case Drive::Kind::torque:
      return {std::clamp(state.command, -drive.maxTorque, drive.maxTorque), 0};
    case Drive::Kind::motion:
      return motionRow(state, step);
    case Drive::Kind::none:
      break;
  }
  return {};
}

DriveRow driveRow(const Drive& drive, const JointState& state, const CommandAround& command, double integral,
                  const JointInput& input, const StepOf& step) {
  const auto rowOf = [&](double followed) {
    JointState following = state;
    following.command = followed;
    return driveRow(drive, following, integral, input, step);
  };
  const DriveRow mean = rowOf(command.mean());
  if (command.before == command.after) return mean;
  const std::array<DriveRow, 2> rows{rowOf(command.before), rowOf(command.after)};
  // Alike on both sides: linear, or at the same limit.
  const auto side = [&](const DriveRow& row) {
    const double torque = row.p - row.d * state.rate;
    return row.limited() && std::abs(torque) >= row.limit ? std::copysign(1.0, torque) : 0.0;
  };
  if (side(rows[0]) == side(rows[1]) && rows[0].d == rows[1].d) return mean;
  DriveRow row;
  for (const DriveRow& each : rows) {
    const double held = side(each);
    row.p += (held != 0 ? held * each.limit : each.p) / 2;
    row.d += (held != 0 ? 0 : each.d) / 2;
    // As cautious as the more cautious of both.
    row.limit = std::min(row.limit, each.limit);
  }
  return row;
}

double largestTorque(const Drive& drive, double rate) {
  if (!(drive.noLoadSpeed_rad_s > 0)) return drive.maxTorque;
  return drive.maxTorque * std::clamp(1 - rate / drive.noLoadSpeed_rad_s, -1.0, 1.0);
}

double ownDamping(const Drive& drive, const JointInput& input) {
  if (drive.kind == Drive::Kind::dcMotor) return backEmfDamping(drive, input);
  return drive.kind == Drive::Kind::servo && input.enabled ? drive.d : 0;
}

namespace {

/// A servo's torque before its limits.
double askedTorque(const Drive& drive, const JointState& state, double integral) {
  return drive.p * (state.command - state.position) + drive.i * integral - drive.d * state.rate;
}

}  // namespace

double driveTorque(const Drive& drive, const JointState& state, double integral, const JointInput& input) {
  if (!input.enabled) return drive.kind == Drive::Kind::dcMotor ? -backEmfDamping(drive, input) * state.rate : 0;
  switch (drive.kind) {
    case Drive::Kind::servo:
      return std::clamp(askedTorque(drive, state, integral), -largestTorque(drive, -state.rate),
                        largestTorque(drive, state.rate));
    case Drive::Kind::dcMotor:
      return MotorNow(drive, input).torque(state.command, state.position, state.rate);
    case Drive::Kind::torque:
      return std::clamp(state.command, -drive.maxTorque, drive.maxTorque);
    case Drive::Kind::motion:
    case Drive::Kind::none:
      break;
  }
  return 0;
}

void JointEffects::add(const SceneEffect& effect) {
  placed_.push_back({effect.effect.get(), &effect.values,
                     std::vector<double>(static_cast<std::size_t>(effect.effect->stateSize()), 0.0), effect.name,
                     effect.effect->stage() == Effect::Stage::command, effect.effect->hasServoTerm()});
  const auto placeOf = [&](std::size_t i) { return std::pair(placed_[i].effect->stage(), placed_[i].name); };
  const std::size_t last = placed_.size() - 1;
  const auto insertInto = [&](std::vector<std::size_t>& chain) {
    chain.insert(std::ranges::upper_bound(chain, placeOf(last), {}, placeOf), last);
  };
  insertInto(chain_);
  if (effect.effect->changesDrive()) insertInto(onDrive_);
}

void JointEffects::reset() {
  for (auto& placed : placed_) std::fill(placed.state.begin(), placed.state.end(), 0.0);
}

std::vector<std::vector<double>> JointEffects::memory() const {
  std::vector<std::vector<double>> memory;
  for (const auto& placed : placed_) memory.push_back(placed.state);
  return memory;
}

void JointEffects::remember(const std::vector<std::vector<double>>& memory) {
  for (std::size_t i = 0; i < placed_.size() && i < memory.size(); ++i)
    if (memory[i].size() == placed_[i].state.size()) placed_[i].state = memory[i];
}

void JointEffects::moved(double by) {
  for (auto& placed : placed_) placed.effect->moved(by, placed.state);
}

void JointEffects::rest(const JointState& state) {
  for (auto& placed : placed_) placed.effect->rest(state, *placed.values, placed.state);
}

CommandAround JointEffects::command(CommandAround command, const JointState& state, double dt) {
  for (const std::size_t i : chain_) {
    Placed& placed = placed_[i];
    command = placed.effect->command(command, state, *placed.values, placed.state, dt);
  }
  return command;
}

double JointEffects::throughEffects(Torques torques, const JointState& given, double h, bool keepState) {
  JointState state = given;
  for (const std::size_t i : onDrive_) {
    Placed& placed = placed_[i];
    const bool isTry = !keepState && !placed.state.empty();
    if (isTry) scratch_ = placed.state;
    std::vector<double>& memory = isTry ? scratch_ : placed.state;
    const auto through = [&](double torque, double& beyond, double dt) {
      state.beyond = beyond;
      if (!placed.hasServoTerm) return placed.effect->driveTorque(torque, state, *placed.values, memory, dt);
      const LimitedTorque sum = withTerm(torque, state, placed.effect->servoTerm(state, *placed.values, memory, dt));
      beyond = sum.beyond;
      return sum.given;
    };
    const bool jumps = placed.isLaw ? torques.commandBefore != torques.commandAfter : torques.before != torques.after;
    if (!jumps || (!memory.empty() && !placed.isLaw)) {
      double beyond = (torques.beyondBefore + torques.beyondAfter) / 2;
      torques.before = torques.after = through(torques.mean(), beyond, h);
      torques.beyondBefore = torques.beyondAfter = beyond;
    } else {
      state.command = torques.commandBefore;
      torques.before = through(torques.before, torques.beyondBefore, h / 2);
      state.command = torques.commandAfter;
      torques.after = through(torques.after, torques.beyondAfter, h / 2);
      state.command = given.command;
    }
  }
  return torques.mean();
}

DriveRow JointEffects::drive(const DriveRow& lawRow, const Drive& drive, const JointState& state,
                             const CommandAround& command, double integral, const JointInput& input,
                             const StepOf& step) {
  const double damps = ownDamping(drive, input);
  // Torque of law and effects as a function of position and rate, the effects' states held; and of the law alone.
  JointState moved = state;
  moved.damping = damps;
  const auto moveTo = [&](double position, double rate) {
    moved.position = state.position + position;
    moved.rate = state.rate + rate;
  };
  const bool isMotor = drive.kind == Drive::Kind::dcMotor && input.enabled;
  const std::optional<MotorNow> motor = isMotor ? std::optional<MotorNow>({drive, input}) : std::nullopt;
  const auto torqueUnder = [&](double followed, double& torque, double& beyond) {
    if (motor) {
      torque = motor->torque(followed, moved.position, moved.rate);
      return;
    }
    moved.command = followed;
    torque = driveTorque(drive, moved, integral, input);
    if (drive.kind == Drive::Kind::servo && input.enabled) beyond = askedTorque(drive, moved, integral) - torque;
    moved.command = state.command;
  };
  const auto law = [&] {
    Torques torques{0, 0, 0, 0, command.before, command.after};
    torqueUnder(command.before, torques.before, torques.beyondBefore);
    torques.after = torques.before;
    torques.beyondAfter = torques.beyondBefore;
    if (command.before != command.after) torqueUnder(command.after, torques.after, torques.beyondAfter);
    return torques;
  };
  struct Slopes {
    double all, law;
  };
  const auto slopesAlong = [&](double position, double rate) {
    constexpr double small = 1e-6;  // rad, rad/s, m or m/s
    moved.isTry = true;
    moveTo(-small * position, -small * rate);
    const Torques before = law();
    const double behind = throughEffects(before, moved, step.h, false);
    moveTo(small * position, small * rate);
    const Torques after = law();
    const double ahead = throughEffects(after, moved, step.h, false);
    moved.isTry = state.isTry;
    return Slopes{(ahead - behind) / (2 * small), (after.mean() - before.mean()) / (2 * small)};
  };
  const auto [byRate, lawByRate] = slopesAlong(0, 1);
  const auto [byPosition, lawByPosition] = slopesAlong(1, 0);

  moveTo(0, 0);
  const Torques given = law();
  const double torque = throughEffects(given, moved, step.h, true);
  // Effects that leave the torque alone leave the exact law alone.
  if (torque == given.mean() && byRate == lawByRate && byPosition == lawByPosition) return lawRow;
  const double damping = std::max(0.0, -byRate);
  DriveRow row;
  row.p = torque + damping * state.rate;
  step.add(row, std::max(0.0, -byPosition), damping, state.rate);
  return row;
}

void JointEffects::addPassive(DriveRow& row, const JointState& state, const StepOf& step) const {
  constexpr double small = 1e-6;
  for (const auto& placed : placed_) {
    step.add(row, 0, std::max(0.0, placed.effect->damping(state, *placed.values)), state.rate);
    const double torque = placed.effect->torque(state, *placed.values);
    if (placed.effect->dissipative() && torque * state.rate < 0) {
      row.d += -torque / state.rate;
      continue;
    }
    JointState ahead = state, behind = state;
    ahead.position += small;
    behind.position -= small;
    const double stiffness =
        (placed.effect->torque(behind, *placed.values) - placed.effect->torque(ahead, *placed.values)) / (2 * small);
    row.p += torque;
    step.add(row, std::max(0.0, stiffness), 0, state.rate);
  }
}

DryFriction JointEffects::dryFriction(const JointState& state) const {
  DryFriction all;
  for (const auto& placed : placed_)
    all.add({std::max(0.0, placed.effect->frictionLimit(state, *placed.values)),
             std::max(0.0, placed.effect->frictionTransition(state, *placed.values))});
  return all;
}

double JointEffects::measured(double position, const JointState& state, double dt) {
  for (auto& placed : placed_) position = placed.effect->measured(position, state, *placed.values, placed.state, dt);
  return position;
}

}  // namespace btr
