/// The firmware does not jump to a new command, it travels there with a bounded speed and acceleration (trapezoid
/// profile; "profile velocity" and "profile acceleration" of a Dynamixel):
///   v → sign(c − y)·min(V, √(2·A·|c − y|)) at no more than A per second;   ẏ = v      y: what the servo follows
/// V = 1/p in rad/s, A = 1/s in rad/s². With s = 0 speeds change at once (a slew rate), with p = 0 speed has no bound.
/// (Biagiotti and Melchiorri 2008, Trajectory Planning for Automatic Machines and Robots, ch. 3; replanned at every
/// instant.) Neutral: p = s = 0. State: whether it has begun, y, v.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class CommandProfile final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"inverse_speed_s_rad", "s/rad", "one over the largest speed, s/m on a slide joint", 0, 20, 0.5, 0.0},
            {"inverse_acceleration_s2_rad", "s²/rad", "one over the largest acceleration, s²/m on a slide joint", 0, 5,
             0.02, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::command, "commands that the firmware approaches with bounded speed and acceleration",
            "|ẏ| ≤ V,  |ÿ| ≤ A, and the servo follows y", "V: 1/inverse_speed_s_rad; A: 1/inverse_acceleration_s2_rad",
            "Biagiotti and Melchiorri 2008"};
  }
  Place place() const override { return Place::joint; }
  Stage stage() const override { return Stage::command; }
  int stateSize() const override { return 3; }

  btr::CommandAround command(btr::CommandAround command, const btr::JointState&, std::span<const double> values,
                             std::span<double> state, double dt) const override {
    if ((values[0] == 0 && values[1] == 0) || dt <= 0) return command;
    if (state[0] == 0) state[1] = command.before;
    state[0] = 1;
    const double before = travel(command.before, values, state, dt / 2);
    return {before, travel(command.after, values, state, dt / 2)};
  }

  /// The mean of y over a time in which the command is held.
  static double travel(double target, std::span<const double> values, std::span<double> state, double time) {
    constexpr double fine_s = 1e-4;
    const double infinity = std::numeric_limits<double>::infinity();
    const double fastest = values[0] > 0 ? 1 / values[0] : infinity, most = values[1] > 0 ? 1 / values[1] : infinity;
    const int parts = std::max(1, static_cast<int>(std::ceil(time / fine_s)));
    const double h = time / parts;
    double sum = 0;
    for (int i = 0; i < parts; ++i) {
      const double begin = state[1], way = target - begin;
      // The speed at which it can still stop there, taken half a part ahead so that it does not overshoot.
      const double stopping =
          most < infinity ? std::sqrt(2 * most * std::abs(way) + most * most * h * h / 4) - most * h / 2 : infinity;
      const double wanted = std::copysign(std::min({fastest, stopping, std::abs(way) / h}), way);
      state[2] = most < infinity ? std::clamp(wanted, state[2] - most * h, state[2] + most * h) : wanted;
      state[1] += h * state[2];
      sum += (begin + state[1]) / 2;
    }
    return sum / parts;
  }
};

}  // namespace

BTR_EFFECT(CommandProfile, "command_profile")
