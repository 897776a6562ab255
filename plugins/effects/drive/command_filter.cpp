/// The firmware smooths commands before it follows them: a first-order low-pass,
///   T·ẏ = c − y      y: what the servo follows, the first command at the start; T in s
/// exact for commands that are held, its means over the half steps before and after an instant. (Widespread in servo
/// firmware as "input filter"; Ellis 2012, Control System Design Guide, ch. 9.) Neutral: T = 0. State: whether it has
/// begun, y.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class CommandFilter final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"time_constant_s", "s", "time constant of the command's filter", 0, 1, 0.03, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::command, "commands that the firmware smooths", "T·ẏ = c − y, and the servo follows y",
            "T: time_constant_s; c: command", "Ellis 2012"};
  }
  Place place() const override { return Place::joint; }
  /// In the servo: after the way of the command to it, with its delay.
  Stage stage() const override { return Stage::motor; }
  int stateSize() const override { return 2; }

  btr::CommandAround command(btr::CommandAround command, const btr::JointState&, std::span<const double> values,
                             std::span<double> state, double dt) const override {
    if (values[0] == 0 || dt <= 0) return command;
    if (state[0] == 0) state[1] = command.before;
    state[0] = 1;
    const double half = dt / 2 / values[0], left = std::exp(-half), mean = (1 - left) / half;
    const auto follow = [&](double target) {
      const double behind = state[1] - target;
      state[1] = target + left * behind;
      return target + mean * behind;
    };
    const double before = follow(command.before);
    return {before, follow(command.after)};
  }
};

}  // namespace

BTR_EFFECT(CommandFilter, "command_filter")
