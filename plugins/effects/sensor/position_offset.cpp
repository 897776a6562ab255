/// The position sensor's zero is wrong by e: it says q + e. With `closes_loop` 1 the sensor also closes the servo's
/// loop, so the joint itself settles e below its command: the law acts on c − (q + e). With 0 it is the recorder's own
/// (a camera, a second encoder), and the servo has another. A definition (the joint offset of Mooring, Roth and Driels
/// 1991, Fundamentals of Manipulator Calibration). With a level base a sensor in the loop resembles a turn of gravity.
/// Neutral: e = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class PositionOffset final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"offset_rad", "rad", "what the sensor says at position 0, m on a slide joint", -0.3, 0.3, 0.03, 0.0},
            btr::closesLoopParameter(1)};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::sensor, "a sensor whose zero is wrong",
            "y = q + e, and with closes_loop 1 the servo acts on c − y", "e: offset_rad",
            "Mooring, Roth and Driels 1991"};
  }
  Place place() const override { return Place::joint; }
  Stage stage() const override { return Stage::sensor; }

  btr::CommandAround command(btr::CommandAround command, const btr::JointState& joint, std::span<const double> values,
                             std::span<double>, double) const override {
    return values[1] == 0 ? command : btr::seenThrough(command, joint, values[0]);
  }
  double measured(double position, const btr::JointState&, std::span<const double> values, std::span<double>,
                  double) const override {
    return position + values[0];
  }
};

}  // namespace

BTR_EFFECT(PositionOffset, "position_offset")
