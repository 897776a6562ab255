/// Fitness of a joint that shall follow a sine: minus the root mean square of its distance from the path, in degrees.
///   path(t) = amplitude_rad·sin(2π·frequency_hz·t)    t from the trial's start; counted from skip_s on
/// 0 is a joint that is exactly on its path. A trial that failed is worth −180.
#include <cmath>
#include <memory>
#include <numbers>

#include "core/plugin/plugin.h"

namespace {

const std::vector<std::string> joints{"HEAD_PAN", "NECK_TILT", "HEAD_TILT"};

class JointPath final : public btr::Fitness {
  std::string unit() const override { return "°"; }

  std::string meaning() const override {
    return "Minus the root mean square of how far the joint is from its path, a sine from the trial's start";
  }

  std::vector<btr::Parameter> settings() const override {
    return {{"joint", "", "which joint", 0, 2, 0, {}, false, joints},
            {"amplitude_rad", "rad", "of the path", 0, 3.1416, 0.5},
            {"frequency_hz", "Hz", "of the path", 0.01, 20, 1},
            {"skip_s", "s", "time at the start that is not counted", 0, 600, 1}};
  }

  void check(const btr::Scene& scene) const override {
    if (scene.robots.empty() || scene.robots[0].model.findJoint(joints[0]) < 0)
      throw btr::InputError("fitness joint_path", "a robot without " + joints[0], "a robot with a head that pans");
  }

  double evaluate(const btr::TrialResult& result, const btr::Values& settings, const btr::Values&) const override {
    if (result.outcome != btr::TrialResult::Outcome::finished) return ofFailure();
    const auto value = btr::resolve(this->settings(), settings, "joint_path");
    const std::string ending = "." + joints[static_cast<std::size_t>(value[0])] + ".position_rad";
    const auto& channels = result.trace.channels;
    const auto found = std::find_if(channels.begin(), channels.end(),
                                    [&](const std::string& channel) { return channel.ends_with(ending); });
    if (found == channels.end()) return ofFailure();
    const auto column = static_cast<std::size_t>(found - channels.begin());
    double sum = 0;
    long count = 0;
    for (std::size_t row = 0; row < result.trace.rows(); ++row) {
      const double t = result.trace.at(row, 0);
      if (t < value[3]) continue;
      const double path = value[1] * std::sin(2 * std::numbers::pi * value[2] * t);
      const double off = result.trace.at(row, column) - path;
      sum += off * off;
      ++count;
    }
    if (count == 0) return ofFailure();
    constexpr double inDegrees = 180 / std::numbers::pi;
    return -inDegrees * std::sqrt(sum / static_cast<double>(count));
  }

  double ofFailure() const override { return -180; }
};

}  // namespace

BTR_FITNESS(JointPath, "joint_path")
