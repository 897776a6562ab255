#include "core/sim/drive_law.h"

#include <algorithm>
#include <cmath>

namespace btr {

double DriveRow::torqueAt(double rate) const {
  const double torque = p - d * rate;
  return limited() ? std::clamp(torque, -limit, limit) : torque;
}

namespace {

DriveRow servoRow(const Drive& drive, const JointState& state, double integral, double h) {
  DriveRow row;
  row.p = drive.p * (state.command - state.position) + drive.i * integral;
  row.d = drive.d + h / 2 * drive.p;
  const double now = row.p - row.d * state.rate;
  if (std::max(std::abs(row.p), std::abs(now)) > drive.maxTorque) row.limit = drive.maxTorque;
  return row;
}

DriveRow dcMotorRow(const Drive& drive, const JointState& state, const JointInput& input, double h) {
  const double supply = input.supply_v >= 0 ? input.supply_v : drive.supply_v;
  const double perVolt = drive.torqueConstant_nm_a / drive.resistance_ohm;
  const bool given = std::isfinite(input.duty);
  // The firmware knows the supply that it was made for: a sagging one weakens its gain.
  const double gain = !given && drive.supply_v > 0 ? drive.firmwareGain_v_rad / drive.supply_v : 0;
  const double wanted = given ? input.duty : gain * (state.command - state.position);
  const bool limited = !given && std::abs(wanted) > drive.maxDuty;
  DriveRow row;
  row.p = perVolt * supply * (limited ? std::copysign(drive.maxDuty, wanted) : wanted);
  row.d = perVolt * drive.torqueConstant_nm_a;
  if (!limited) row.d += h / 2 * perVolt * supply * gain;
  return row;
}

}  // namespace

DriveRow driveRow(const Drive& drive, const JointState& state, double integral, const JointInput& input, double h) {
  if (!input.enabled) return {};
  switch (drive.kind) {
    case Drive::Kind::servo:
      return servoRow(drive, state, integral, h);
    case Drive::Kind::dcMotor:
      return dcMotorRow(drive, state, input, h);
    case Drive::Kind::torque:
      return {std::clamp(state.command, -drive.maxTorque, drive.maxTorque), 0};
    case Drive::Kind::none:
      break;
  }
  return {};
}

double driveTorque(const Drive& drive, const JointState& state, double integral, const JointInput& input) {
  return driveRow(drive, state, integral, input, 0).torqueAt(state.rate);
}

void JointEffects::add(const SceneEffect& effect) {
  placed_.push_back({effect.effect.get(), &effect.values,
                     std::vector<double>(static_cast<std::size_t>(effect.effect->stateSize()), 0.0)});
}

void JointEffects::reset() {
  for (auto& placed : placed_) std::fill(placed.state.begin(), placed.state.end(), 0.0);
}

double JointEffects::command(double command, const JointState& state, double dt) {
  for (auto& placed : placed_) command = placed.effect->command(command, state, *placed.values, placed.state, dt);
  return command;
}

double JointEffects::throughEffects(double torque, const JointState& state, double h, bool keepState) {
  for (auto& placed : placed_) {
    if (keepState) {
      torque = placed.effect->driveTorque(torque, state, *placed.values, placed.state, h);
    } else {
      scratch_ = placed.state;
      torque = placed.effect->driveTorque(torque, state, *placed.values, scratch_, h);
    }
  }
  return torque;
}

DriveRow JointEffects::drive(const DriveRow& law, const Drive& drive, const JointState& state, double integral,
                             const JointInput& input, double h) {
  // Torque after the effects as a function of position and rate, the state held.
  const auto probe = [&](double position, double rate) {
    JointState moved = state;
    moved.position = position;
    moved.rate = rate;
    return throughEffects(driveTorque(drive, moved, integral, input), moved, h, false);
  };
  constexpr double small = 1e-6;  // rad, rad/s, m or m/s
  const double byRate =
      (probe(state.position, state.rate + small) - probe(state.position, state.rate - small)) / (2 * small);
  const double byPosition =
      (probe(state.position + small, state.rate) - probe(state.position - small, state.rate)) / (2 * small);

  const double before = driveTorque(drive, state, integral, input);
  const double after = throughEffects(before, state, h, true);
  const double lawByRate =
      (driveTorque(drive, {state.time, state.position, state.rate + small, state.command, state.drive}, integral,
                   input) -
       driveTorque(drive, {state.time, state.position, state.rate - small, state.command, state.drive}, integral,
                   input)) /
      (2 * small);
  // Effects that leave the torque alone leave the exact law alone.
  if (after == before && byRate == lawByRate) return law;
  DriveRow row;
  const double damping = std::max(0.0, -byRate);
  row.p = after + damping * state.rate;
  row.d = damping + h / 2 * std::max(0.0, -byPosition);
  return row;
}

void JointEffects::addPassive(DriveRow& row, const JointState& state, double h) const {
  constexpr double small = 1e-6;
  for (const auto& placed : placed_) {
    row.d += std::max(0.0, placed.effect->damping(state, *placed.values));
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
    row.d += h / 2 * std::max(0.0, stiffness);
  }
}

double JointEffects::frictionLimit(const JointState& state) const {
  double limit = 0;
  for (const auto& placed : placed_) limit += std::max(0.0, placed.effect->frictionLimit(state, *placed.values));
  return limit;
}

double JointEffects::measured(double position, const JointState& state, double dt) {
  for (auto& placed : placed_) position = placed.effect->measured(position, state, *placed.values, placed.state, dt);
  return position;
}

}  // namespace btr
