/// The firmware leads the joint to each command along a profile: it speeds up, travels and slows down within limits of
/// its own, a trapezoid of speed, and the servo follows y:
///   |ẏ| ≤ 1/a,  |ÿ| ≤ 1/b,  in the shortest time to rest at the command      a in s/rad, b in s²/rad (m on a slide
///   joint)
/// Exact for commands that are held. With b = 0 it is a limit of speed alone. (Biagiotti and Melchiorri 2008,
/// Trajectory Planning for Automatic Machines and Robots, ch. 3.) Neutral: a = b = 0. State: whether it has begun, y,
/// ẏ.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

/// On its way to rest at `target` within limits of speed and acceleration.
struct Profile {
  double at, speed;

  void advance(double target, double fastest, double steepest, double time_s) {
    const double away = target - at;
    if (std::isinf(steepest)) {
      const double reach = fastest * time_s;
      at = std::abs(away) <= reach ? target : at + std::copysign(reach, away);
      return;
    }
    // Speed up (or turn round) to the peak, travel, slow down.
    const double stopsAfter = speed * std::abs(speed) / (2 * steepest);
    const double side = away > stopsAfter || (away == stopsAfter && speed <= 0) ? 1 : -1;
    const double peak = std::min(fastest, std::sqrt(std::max(0.0, steepest * side * away + speed * speed / 2)));
    const double first = std::max(0.0, (peak - side * speed) / steepest), last = peak / steepest;
    const double during = first * (side * speed + peak) / 2;
    const double travel = peak > 0 ? std::max(0.0, (side * away - during - peak * last / 2) / peak) : 0;
    for (const auto& [lasts, acceleration] : {std::pair{first, side}, {travel, 0.0}, {last, -side}}) {
      const double part = std::min(lasts, time_s);
      at += part * (speed + acceleration * steepest * part / 2);
      speed += acceleration * steepest * part;
      time_s -= part;
      if (part < lasts) return;
    }
    at = target;
    speed = 0;
  }
};

class CommandProfile final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {
        {"inverse_speed_s_rad", "s/rad", "one over the profile's largest speed, s/m on a slide joint", 0, 10, 0.3, 0.0},
        {"inverse_acceleration_s2_rad", "s²/rad", "one over its largest acceleration, s²/m on a slide joint", 0, 1,
         0.03, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::command, "commands that the firmware approaches with limited speed and acceleration",
            "|ẏ| ≤ 1/a,  |ÿ| ≤ 1/b,  and the servo follows y", "a: inverse_speed_s_rad; b: inverse_acceleration_s2_rad",
            "Biagiotti and Melchiorri 2008"};
  }
  Place place() const override { return Place::joint; }
  /// In the servo: after the way of the command to it, with its delay.
  Stage stage() const override { return Stage::motor; }
  int stateSize() const override { return 3; }

  btr::CommandAround command(btr::CommandAround command, const btr::JointState& joint, std::span<const double> values,
                             std::span<double> state, double dt) const override {
    if ((values[0] == 0 && values[1] == 0) || dt <= 0 || !joint.followsPosition) return command;
    constexpr double none = std::numeric_limits<double>::infinity();
    const double fastest = values[0] > 0 ? 1 / values[0] : none, steepest = values[1] > 0 ? 1 / values[1] : none;
    if (state[0] == 0) state[1] = command.before;
    state[0] = 1;
    Profile profile{state[1], state[2]};
    // The mean over a half step, by Simpson's rule.
    const auto follow = [&](double target) {
      const double begins = profile.at;
      profile.advance(target, fastest, steepest, dt / 4);
      const double middle = profile.at;
      profile.advance(target, fastest, steepest, dt / 4);
      return (begins + 4 * middle + profile.at) / 6;
    };
    const double before = follow(command.before), after = follow(command.after);
    state[1] = profile.at;
    state[2] = profile.speed;
    return {before, after};
  }
};

}  // namespace

BTR_EFFECT(CommandProfile, "command_profile")
