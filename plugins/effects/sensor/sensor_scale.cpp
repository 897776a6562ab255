/// The position sensor's gain is wrong (another gear ratio, counts per turn, a potentiometer's reference voltage): it
/// says
///   y = (1 + s)·q      s: share by which it says too much
/// about the position 0 of the joint. With `closes_loop` 1 the servo's law acts on c − y, with 0 the sensor is the
/// recorder's own, and the servo has another. (Mooring, Roth and Driels 1991, Fundamentals of Manipulator Calibration:
/// the joint transducer's gain.) Neutral: s = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class SensorScale final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"excess", "", "share by which it says too much", -0.5, 0.5, 0.03, 0.0}, btr::closesLoopParameter()};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::sensor, "a sensor whose gain is wrong",
            "y = (1 + s)·q, and with closes_loop 1 the servo acts on c − y", "s: excess; q: joint",
            "Mooring, Roth and Driels 1991"};
  }
  Place place() const override { return Place::joint; }
  Stage stage() const override { return Stage::sensor; }

  btr::CommandAround command(btr::CommandAround command, const btr::JointState& joint, std::span<const double> values,
                             std::span<double>, double) const override {
    return values[1] == 0 ? command : btr::seenThrough(command, joint, values[0] * joint.position);
  }
  double measured(double position, const btr::JointState& joint, std::span<const double> values, std::span<double>,
                  double) const override {
    // Other effects may have changed what is measured; the gain is of the joint's own way.
    return position + values[0] * joint.position;
  }
};

}  // namespace

BTR_EFFECT(SensorScale, "sensor_scale")
