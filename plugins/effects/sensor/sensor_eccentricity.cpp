/// The disc of a turning sensor sits off its axis, or its magnet does: once in a turn it says too much and too little,
///   y = q + a·cos q + b·sin q      √(a² + b²) in rad: the disc's offset over its radius
/// On a slide joint q in metres stands for radians.
/// With `closes_loop` 1 the servo's law acts on c − y, with 0 the sensor is the recorder's own, and the servo has
/// another.
/// (Single-turn error of an eccentric scale: Slocum 1992, Precision Machine Design, ch. 4.) Neutral: a = b = 0.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class SensorEccentricity final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"cosine_rad", "rad", "a of a·cos q, m on a slide joint", -0.3, 0.3, 0.02, 0.0},
            {"sine_rad", "rad", "b of b·sin q, m on a slide joint", -0.3, 0.3, 0.02, 0.0},
            btr::closesLoopParameter()};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::sensor, "a sensor whose disc sits off its axis", "y = q + a·cos q + b·sin q",
            "a: cosine_rad; b: sine_rad; q: joint", "Slocum 1992"};
  }
  Place place() const override { return Place::joint; }
  Stage stage() const override { return Stage::sensor; }

  btr::CommandAround command(btr::CommandAround command, const btr::JointState& joint, std::span<const double> values,
                             std::span<double>, double) const override {
    return values[2] == 0 ? command : btr::seenThrough(command, joint, error(joint.position, values));
  }
  double measured(double position, const btr::JointState& joint, std::span<const double> values, std::span<double>,
                  double) const override {
    return position + error(joint.position, values);
  }

  static double error(double position, std::span<const double> values) {
    return values[0] * std::cos(position) + values[1] * std::sin(position);
  }
};

}  // namespace

BTR_EFFECT(SensorEccentricity, "sensor_eccentricity")
