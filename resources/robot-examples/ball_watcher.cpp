/// Looks at the ball: turns its head so that what is orange or pink in its camera's picture comes to the middle.
#include <algorithm>
#include <cmath>

#include "core/robot/robot.h"

namespace {

/// Red is much stronger than green: orange and pink, in any light.
bool isOfBall(const std::uint8_t* rgb) { return rgb[0] > 70 && rgb[0] > 2 * rgb[1]; }

class BallWatcher final : public uchilsim::Behaviour {
  std::vector<uchilsim::Parameter> parameters() const override {
    return {{"gain", "", "share of the error by which the head turns after each picture", 0.02, 1, 0.3},
            {"view_rad", "rad", "how wide the camera sees", 0.3, 2, 0.993}};
  }
  bool looks() const override { return true; }

  void start(const uchilsim::Robot& robot, const uchilsim::Values&, std::span<const double> p) override {
    gain_ = p[0];
    view_rad_ = p[1];
    pan_ = robot.joint("HEAD_PAN");
    tilt_ = robot.joint("HEAD_TILT");
    panLimit_ = std::min(-robot.model.joints[pan_].lower, robot.model.joints[pan_].upper);
    lowest_ = robot.model.joints[tilt_].lower;
    highest_ = robot.model.joints[tilt_].upper;
  }

  void act(const uchilsim::Senses& senses, uchilsim::Orders& orders) override {
    if (!senses.picture) return;
    const uchilsim::Picture& picture = *senses.picture;
    double x = 0, y = 0, count = 0;
    for (int row = 0; row < picture.height; ++row)
      for (int column = 0; column < picture.width; ++column)
        if (isOfBall(&picture.rgb[3 * static_cast<std::size_t>(row * picture.width + column)])) {
          x += column;
          y += row;
          ++count;
        }
    orders.lamps["face_1"] = count > 0 ? 1 : 0;
    if (count == 0) return;
    const double radPerPixel = view_rad_ / picture.width;
    const double left = (picture.width / 2.0 - x / count) * radPerPixel;
    const double up = (picture.height / 2.0 - y / count) * radPerPixel;
    orders.targets[pan_] = std::clamp(orders.targets[pan_] + gain_ * left, -panLimit_, panLimit_);
    orders.targets[tilt_] = std::clamp(orders.targets[tilt_] + gain_ * up, lowest_, highest_);
  }

  double gain_ = 0, view_rad_ = 1;
  std::size_t pan_ = 0, tilt_ = 0;
  double panLimit_ = 0, lowest_ = 0, highest_ = 0;
};

}  // namespace

UCHILSIM_ROBOT_CONTROLLER(BallWatcher, "ball_watcher")
