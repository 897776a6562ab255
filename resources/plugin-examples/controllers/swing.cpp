/// Every driven joint of one group swings about its start:
///   q(t) = q0 + A·sin(2π·f·t)      q, A in rad; f in Hz; t in s
/// The group is all joints whose name begins with a front leg's (LF, RF) or a rear leg's (LR, RR).
#include <cmath>
#include <numbers>

#include "core/plugin/plugin.h"

namespace {

class Swing final : public btr::Motion {
 public:
  Swing(const btr::Scene& scene, double duration, double front, double rear, double frequency)
      : duration_(duration), frequency_(frequency), start_(scene.robots.front().jointStart) {
    for (const btr::Joint& joint : scene.robots.front().model.joints) {
      const std::string leg = joint.name.substr(0, 2);
      amplitude_.push_back(leg == "LF" || leg == "RF" ? front : leg == "LR" || leg == "RR" ? rear : 0.0);
    }
  }

  void command(double time, const btr::RobotReadings&, std::span<btr::JointInput> inputs) override {
    const double phase = std::sin(2 * std::numbers::pi * frequency_ * time);
    for (std::size_t j = 0; j < inputs.size(); ++j) inputs[j].command = start_[j] + amplitude_[j] * phase;
  }

  double duration() const override { return duration_; }

 private:
  double duration_, frequency_;
  std::vector<double> start_, amplitude_;  ///< by joint of the model [rad]
};

class SwingController final : public btr::Controller {
  std::vector<btr::Parameter> genotype() const override {
    return {{"front_rad", "rad", "amplitude of the front legs", -0.5, 0.5, 0.2},
            {"rear_rad", "rad", "amplitude of the rear legs", -0.5, 0.5, -0.2},
            {"frequency_hz", "Hz", "swings in a second", 0.5, 3, 1}};
  }

  std::vector<btr::Parameter> settings() const override {
    return {{"duration_s", "s", "how long it swings", 0.1, 20, 1}};
  }

  // Robot and ball stay where the scene puts them.
  void arrange(btr::Scene& scene, const btr::Values&) const override {
    if (scene.robots.empty()) throw btr::InputError("swing: the scene has no robot");
  }

  std::unique_ptr<btr::Motion> begin(const btr::Scene& scene, const btr::Values& settings,
                                     std::span<const double> parameters) const override {
    const double duration = btr::valueOf(this->settings(), settings, "duration_s");
    return std::make_unique<Swing>(scene, duration, parameters[0], parameters[1], parameters[2]);
  }
};

}  // namespace

BTR_CONTROLLER(SwingController, "swing")
