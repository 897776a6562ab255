/// The position sensor's zero creeps in the course of a trial (a warm potentiometer, a strain gauge, a belt that slips
/// under its encoder): it says
///   y = q + r·t      t: time of the trial [s]; r in rad/s (m/s)
/// With `closes_loop` 1 the servo's law acts on c − y and the joint creeps the other way; with 0 the sensor is the
/// recorder's own, and the servo has another. (A zero that changes at a constant rate, a definition; JCGM 200:2012,
/// International vocabulary of metrology, 4.21: instrumental drift.) Neutral: r = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class SensorDrift final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"rate_rad_s", "rad/s", "by which its zero creeps, m/s on a slide joint", -0.2, 0.2, 0.01, 0.0},
            btr::closesLoopParameter()};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::sensor, "a sensor whose zero creeps",
            "y = q + r·t, and with closes_loop 1 the servo acts on c − y", "r: rate_rad_s; t: time of the trial",
            "JCGM 200:2012"};
  }
  Place place() const override { return Place::joint; }
  Stage stage() const override { return Stage::sensor; }

  btr::CommandAround command(btr::CommandAround command, const btr::JointState& joint, std::span<const double> values,
                             std::span<double>, double) const override {
    return values[1] == 0 ? command : btr::seenThrough(command, joint, values[0] * joint.time);
  }
  double measured(double position, const btr::JointState& joint, std::span<const double> values, std::span<double>,
                  double) const override {
    return position + values[0] * joint.time;
  }
};

}  // namespace

BTR_EFFECT(SensorDrift, "sensor_drift")
