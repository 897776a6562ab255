/// A servo's firmware that lets small errors be.
///   e' = 0 for |e| ≤ w, else e (kind 0) or e − w·sign(e) (kind 1)      e = c − q: command less position, w: half of
///   the band
/// Servos of models and of robots have it against humming: "dead band" or "compliance margin" in their data sheets
/// (Robotis, AX-12 manual: compliance margin and slope). Damping goes on inside the band.
/// Drives that follow a position only. Neutral: w = 0.
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class ErrorDeadBand final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    btr::Parameter kind{"kind", "", "outside the band: 0 the whole error counts, 1 what is beyond its edge", 0, 1, 1};
    kind.integer = true;
    return {{"half_width_rad", "rad", "largest error that is let be, m on a slide joint", 0, 0.3, 0.02, 0.0}, kind};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::drive, "a servo that lets small errors be",
            "e’ = 0 for |e| ≤ w, else e or e − w·sign(e)", "w: half_width_rad; e: command less position",
            "Robotis, AX-12 manual"};
  }
  Place place() const override { return Place::joint; }
  /// After what delays and filters make of the command, as its name says.
  Stage stage() const override { return Stage::command; }

  btr::CommandAround command(btr::CommandAround command, const btr::JointState& joint, std::span<const double> values,
                             std::span<double>, double) const override {
    if (values[0] == 0 || !joint.followsPosition) return command;
    const auto seen = [&](double followed) {
      const double error = followed - joint.position;
      if (std::abs(error) <= values[0]) return joint.position;
      return values[1] != 0 ? followed - std::copysign(values[0], error) : followed;
    };
    return {seen(command.before), seen(command.after)};
  }
};

}  // namespace

BTR_EFFECT(ErrorDeadBand, "error_dead_band")
