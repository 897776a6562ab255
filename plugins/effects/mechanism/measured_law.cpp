/// A force that nobody named, as it was measured: the sum of up to two curves, each over one quantity.
///   τ = f₁(x₁) + f₂(x₂)          τ in N·m (N on a slide joint)
/// A curve is linear between its knots, which stand at equal distances from `low` to `high`; outside them the ends'
/// values hold. Its x is the joint's position (rad or m), its velocity (rad/s or m/s), the drive's torque in the last
/// step (load), the time since the start of the trial (s), or the position modulo high − low (angle). A curve of kind
/// friction is no torque but the largest dry friction there, |τ| ≤ f(x), which the solver holds or brakes the joint
/// with. Analyses measure the curves (core/gap/search/measured_law.h); nothing is offered under this name before.
/// Neutral: all knots 0.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "core/plugin/plugin.h"

namespace {

class MeasuredLaw final : public btr::Effect {
  enum Variable { nothing, position, velocity, load, time, angle };
  enum Kind { force, friction };
  static constexpr int curves = 2, knots = 25;
  static constexpr std::size_t numbers = 5 + knots;  ///< of a curve: what stands before its knots, and these

  std::vector<btr::Parameter> parameters() const override {
    std::vector<btr::Parameter> list;
    for (int c = 1; c <= curves; ++c) {
      const std::string curve = "curve" + std::to_string(c) + "_";
      btr::Parameter on{curve + "on", "", "what it depends on", 0, 5, 0, 0.0, true};
      on.choices = {"nothing", "position", "velocity", "load", "time", "angle"};
      btr::Parameter kind{curve + "kind", "", "a torque, or the largest dry friction", 0, 1, 0, 0.0, true};
      kind.choices = {"force", "friction"};
      list.push_back(on);
      list.push_back(kind);
      list.push_back({curve + "low", "", "first knot, in the unit of what it depends on", -1e6, 1e6, 0, 0.0});
      list.push_back({curve + "high", "", "last knot, the same", -1e6, 1e6, 1, 1.0});
      list.push_back({curve + "knots", "", "number of knots", 2, knots, 2, 2.0, true});
      for (int i = 0; i < knots; ++i)
        list.push_back({curve + (i < 10 ? "0" : "") + std::to_string(i) + "_nm", "N·m",
                        "value at this knot, N on a slide joint", -1e4, 1e4, 0, 0.0});
    }
    return list;
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::joint, "a force that nobody named, as it was measured",
            "τ = f_1(x_1) + f_2(x_2), each through its knots", "x: curve1_on, curve2_on; knots from low to high",
            "measured"};
  }
  Place place() const override { return Place::joint; }

  double torque(const btr::JointState& joint, std::span<const double> values) const override {
    return sum(force, joint, values);
  }
  double frictionLimit(const btr::JointState& joint, std::span<const double> values) const override {
    return std::max(0.0, sum(friction, joint, values));
  }

  static double sum(Kind kind, const btr::JointState& joint, std::span<const double> values) {
    double total = 0;
    for (std::size_t c = 0; c < curves; ++c) {
      const std::span<const double> curve = values.subspan(c * numbers, numbers);
      if (std::lround(curve[0]) != nothing && std::lround(curve[1]) == kind) total += at(curve, joint);
    }
    return total;
  }

  static double at(std::span<const double> curve, const btr::JointState& joint) {
    const auto on = static_cast<Variable>(std::lround(curve[0]));
    const double low = curve[2], length = curve[3] - low;
    if (!(length > 0)) return curve[5];
    double x = on == position || on == angle ? joint.position
               : on == velocity              ? joint.rate
               : on == load                  ? joint.drive
                                             : joint.time;
    if (on == angle) x -= length * std::floor((x - low) / length);
    const auto last = static_cast<int>(std::lround(curve[4])) - 1;
    const double place = std::clamp((x - low) / length, 0.0, 1.0) * last;
    const int left = std::min(static_cast<int>(place), last - 1);
    const double share = place - left;
    const auto value = [&](int knot) { return curve[5 + static_cast<std::size_t>(knot)]; };
    return (1 - share) * value(left) + share * value(left + 1);
  }
};

}  // namespace

BTR_EFFECT(MeasuredLaw, "measured_law")
