/// Wags its tail while a hand touches its head or back, with its face alight; nods when it is lifted: no paw on the
/// ground. Its neck is soft, so that a hand can move it. How it wags is a little different each time.
#include <algorithm>
#include <cmath>

#include "core/robot/robot.h"

namespace {

class Petted final : public uchilsim::Behaviour {
  std::vector<uchilsim::Parameter> parameters() const override {
    return {{"wag_rad", "rad", "how far the tail wags", 0, 1, 0.6},
            {"softness", "", "gain of the neck, times its own", 0.1, 1, 0.5}};
  }
  std::vector<uchilsim::SenseSpec> senses() const override { return {{"touch"}, {"paws"}, {"accelerometer"}}; }

  void start(const uchilsim::Robot& robot, const uchilsim::Values&, std::span<const double> p) override {
    wag_rad_ = p[0];
    softness_ = p[1];
    tail_ = robot.joint("TAIL_PAN");
    neck_ = robot.joint("NECK_TILT");
    head_ = robot.joint("HEAD_TILT");
  }

  void act(const uchilsim::Senses& senses, uchilsim::Orders& orders) override {
    orders.gains[neck_] = {softness_, 1, 1};
    if (senses.touch->head || senses.touch->back) happy_s_ = 1;
    happy_s_ = std::max(0.0, happy_s_ - senses.period_s);
    if (happy_s_ == 0) swing_ = 1 + 0.2 * senses.random().uniform(-1, 1);
    orders.targets[tail_] = happy_s_ > 0 ? wag_rad_ * swing_ * std::sin(15 * senses.time_s) : 0;
    orders.lamps.clear();
    if (happy_s_ > 0) orders.lamps = {{"face_1", happy_s_}, {"face_2", happy_s_}};
    const bool lifted = std::ranges::none_of(*senses.paws, [](bool paw) { return paw; });
    orders.targets[head_] = lifted ? 0.2 * std::sin(6 * senses.time_s) : 0;
  }

  std::vector<double> memory() const override { return {happy_s_, swing_}; }
  void remember(std::span<const double> memory) override {
    happy_s_ = memory[0];
    swing_ = memory[1];
  }

  double wag_rad_ = 0, softness_ = 1;
  std::size_t tail_ = 0, neck_ = 0, head_ = 0;
  double happy_s_ = 0, swing_ = 1;
};

}  // namespace

UCHILSIM_ROBOT_CONTROLLER(Petted, "petted")
