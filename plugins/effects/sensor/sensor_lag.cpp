/// The position sensor is slow (a filtered potentiometer, firmware that averages): it says y instead of q,
///   T·ẏ = q − y      y = q at the start of a trial; T in s
/// exact for a position that moves evenly within a step. The log has y. With `closes_loop` 1 the servo's law acts on
/// it, too: c − y in place of c − q, by moving its command (its damping keeps the true rate); with 0 the sensor is the
/// recorder's own (a filtered log), and the servo has another. In a window that begins later, the joint has moved
/// evenly until then: y = q − T·ω. Neutral: T = 0. State: whether it has begun, y, the q that y belongs to, the step.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class SensorLag final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"time_constant_s", "s", "time constant of the position sensor", 0, 0.2, 0.01, 0.0},
            btr::closesLoopParameter(1)};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::sensor, "a slow position sensor",
            "T·ẏ = q − y, and with closes_loop 1 the servo acts on c − y", "T: time_constant_s",
            "first-order lag, a definition"};
  }
  Place place() const override { return Place::joint; }
  Stage stage() const override { return Stage::sensor; }
  int stateSize() const override { return 4; }
  void moved(double by, std::span<double> state) const override {
    for (const std::size_t position : {1, 2}) state[position] += by;
  }

  btr::CommandAround command(btr::CommandAround command, const btr::JointState& joint, std::span<const double> values,
                             std::span<double> state, double dt) const override {
    if (values[0] == 0) return command;
    const double lagged = follow(joint, values[0], state);
    state[0] = 1;
    state[1] = lagged;
    state[2] = joint.position;
    state[3] = dt;
    if (!joint.followsPosition || values[1] == 0) return command;
    const double behind = joint.position - lagged;
    return {command.before + behind, command.after + behind};
  }
  double measured(double position, const btr::JointState& joint, std::span<const double> values,
                  std::span<double> state, double) const override {
    if (values[0] == 0) return position;
    // Other effects may have changed what is measured; the lag is the joint's.
    return position + follow(joint, values[0], state) - joint.position;
  }

  /// y a step after that in the state.
  static double follow(const btr::JointState& joint, double lag, std::span<const double> state) {
    const double position = joint.position;
    if (state[0] == 0 || state[3] <= 0) return joint.time > 0 ? position - lag * joint.rate : position;
    const double rate = (position - state[2]) / state[3];
    return position - lag * rate + (state[1] - state[2] + lag * rate) * std::exp(-state[3] / lag);
  }
};

}  // namespace

BTR_EFFECT(SensorLag, "sensor_lag")
