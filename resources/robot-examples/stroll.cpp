/// Walks straight ahead as long as nothing is near: the ERS-7's infrared eye looks between its forelegs' reach and the
/// wall. A trot of diagonal pairs, each foot half of the time on the ground; it stops where it is in its cycle.
#include <array>
#include <cmath>
#include <numbers>

#include "core/robot/robot.h"

namespace {

class Stroll final : public uchilsim::Behaviour {
  std::vector<uchilsim::Parameter> parameters() const override {
    return {{"step_m", "m", "way of a foot on the ground", 0.01, 0.08, 0.05},
            {"cycle_s", "s", "time of two steps", 0.3, 1.5, 0.8},
            {"stop_m", "m", "nearer than this it stands still", 0.06, 0.45, 0.25}};
  }
  std::vector<uchilsim::Parameter> settings() const override {
    return {{"duration_s", "s", "how long it strolls", 1, 600, 20}};
  }
  std::vector<uchilsim::SenseSpec> senses() const override { return {{"infrared_near"}}; }

  void start(const uchilsim::Robot& robot, const uchilsim::Values& settings, std::span<const double> p) override {
    duration_s_ = btr::valueOf(this->settings(), settings, "duration_s");
    stop_m_ = p[2];
    const btr::FourLegs dog = btr::FourLegs::of(robot.model, "stroll");
    const long cycle = 2 * std::lround(p[1] / robot.period_s / 2), half = cycle / 2;
    std::array<std::vector<btr::FootPoint>, 4> paths;
    for (std::size_t i = 0; i < 4; ++i) {
      joints_[i] = dog.legs[i].joints;
      const Eigen::Vector3d middle =
          dog.legs[i].front ? Eigen::Vector3d(0.055, 0.007, -0.105) : Eigen::Vector3d(-0.050, 0.005, -0.115);
      for (long frame = 0; frame < cycle; ++frame) {
        const double share = static_cast<double>(frame % half) / static_cast<double>(half);
        const bool onGround = frame < half;
        const double x = onGround ? 0.5 - share : -0.5 * std::cos(std::numbers::pi * share);
        const double z = onGround ? 0 : 0.025 * std::sin(std::numbers::pi * share);
        paths[i].push_back({static_cast<double>(frame), middle + Eigen::Vector3d(x * p[0], 0, z)});
      }
    }
    gait_.emplace(dog, paths, std::array<long, 4>{0, half, half, 0}, cycle);
  }

  void act(const uchilsim::Senses& senses, uchilsim::Orders& orders) override {
    if (senses.infrared.near_m.value() > stop_m_) ++steps_;
    orders.lamps["face_1"] = senses.infrared.near_m.value() > stop_m_ ? 0 : 1;
    for (std::size_t leg = 0; leg < 4; ++leg)
      for (std::size_t j = 0; j < 3; ++j)
        orders.targets[joints_[leg][j]] = gait_->angles(steps_ % gait_->period())[leg][j];
  }

  double duration_s() const override { return duration_s_; }
  std::vector<double> memory() const override { return {static_cast<double>(steps_)}; }
  void remember(std::span<const double> memory) override { steps_ = std::lround(memory[0]); }

  double duration_s_ = 0, stop_m_ = 0;
  std::array<std::array<std::size_t, 3>, 4> joints_{};  ///< by leg, of the model
  std::optional<btr::Gait> gait_;
  long steps_ = 0;  ///< frames of the gait that it went on
};

}  // namespace

UCHILSIM_ROBOT_CONTROLLER(Stroll, "stroll")
