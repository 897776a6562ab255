#include "core/gap/search/laws/learned_force.h"
#include "core/gap/fit/gap_problem.h"

#include <algorithm>
#include <cmath>

namespace btr {
namespace {

class LearnedForceEffect final : public Effect {
 public:
  explicit LearnedForceEffect(const LearnedForce& force) : force_(force) {}

  std::vector<Parameter> parameters() const override {
    std::vector<Parameter> list;
    for (int i = 0; i < LearnedForce::knots; ++i)
      list.push_back({"force_" + std::to_string(i), force_.along == LearnedForce::Along::joint ? "N·m" : "N",
                      "force at a knot of the curve, N on a slide joint", -1e3 * force_.scale, 1e3 * force_.scale,
                      force_.scale, 0.0});
    return list;
  }
  Place place() const override { return force_.along == LearnedForce::Along::joint ? Place::joint : Place::ball; }

  double torque(const JointState& joint, std::span<const double> values) const override {
    using enum LearnedForce::Over;
    const double x = force_.over == position   ? joint.position
                     : force_.over == velocity ? joint.rate
                     : force_.over == load     ? joint.drive
                                               : joint.time;
    return curve(x, values);
  }
  Eigen::Vector3d ballForce(const BallState& ball, std::span<const double> values) const override {
    const Eigen::Vector3d flat(ball.velocity_m_s.x(), ball.velocity_m_s.y(), 0);
    const double speed = flat.norm();
    const bool alongX = force_.along == LearnedForce::Along::x;
    const double x = force_.over == LearnedForce::Over::velocity   ? speed
                     : force_.over == LearnedForce::Over::position ? ball.position_m[alongX ? 0 : 1]
                                                                   : ball.time;
    const double force = curve(x, values);
    if (force_.along == LearnedForce::Along::motion)
      return speed > 1e-6 ? Eigen::Vector3d(force / speed * flat) : Eigen::Vector3d::Zero();
    return alongX ? Eigen::Vector3d(force, 0, 0) : Eigen::Vector3d(0, force, 0);
  }

 private:
  double curve(double x, std::span<const double> values) const {
    constexpr int last = LearnedForce::knots - 1;
    const double place = std::clamp((x - force_.low) / (force_.high - force_.low), 0.0, 1.0) * last;
    const int left = std::min(static_cast<int>(place), last - 1);
    const double share = place - left;
    return (1 - share) * values[static_cast<std::size_t>(left)] + share * values[static_cast<std::size_t>(left + 1)];
  }
  LearnedForce force_;
};

}  // namespace

const char* toText(LearnedForce::Over over) {
  switch (over) {
    case LearnedForce::Over::position:
      return "position";
    case LearnedForce::Over::velocity:
      return "velocity";
    case LearnedForce::Over::load:
      return "load";
    case LearnedForce::Over::time:
      return "time";
  }
  return "";
}

std::string LearnedForce::name() const { return "learned_force"; }

EffectLibrary withLearnedForce(const EffectLibrary& library, const LearnedForce& force) {
  const auto effect = std::make_shared<const LearnedForceEffect>(force);
  return {[make = library.make, effect, name = force.name()](const std::string& wanted) {
            return wanted == name ? std::shared_ptr<const Effect>(effect) : make(wanted);
          },
          library.names};
}

}  // namespace btr
