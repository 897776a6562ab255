#include "core/openr/trivial_robot.h"

#include <algorithm>
#include <cmath>

namespace btr::openr {
namespace {

constexpr std::int32_t gravity_um_s2 = 9806650;
constexpr std::int64_t frame_us = 8000;

}  // namespace

TrivialRobot::TrivialRobot(const RobotDesign& design) : sensors(design.sensors.size()), lamps_(design.lamps.size()) {
  for (const Primitive& joint : design.joints) {
    joints_.push_back(std::clamp(0, joint.low, joint.high));
    enabled_.push_back(joint.kind == Primitive::Kind::ear);  // it has a plunger, no servo
  }
  for (std::size_t i = 0; i < lamps_.size(); ++i) lamps_[i].lamp = static_cast<std::uint16_t>(i);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    const std::string& name = design.sensors[i].name;
    if (name == "acceleration_up") sensors[i] = -gravity_um_s2;
    if (name.find("distance") == 0) sensors[i] = 500000;
    if (name == "temperature") sensors[i] = 298150000;
  }
}

SensorFrame TrivialRobot::sense() {
  SensorFrame frame;
  frame.time_us = frame_ * frame_us;
  frame.number = ++frame_;
  for (const std::int32_t joint : joints_) frame.joints.push_back({joint, joint, 0});
  frame.sensors = sensors;
  frame.power = power;
  if (image && imageEvery > 0 && frame_ % static_cast<std::uint32_t>(imageEvery) == 0) frame.image = image;
  frame.typed.swap(typed);
  frame.shutdown = shutdown;
  return frame;
}

void TrivialRobot::obey(const OrderFrame& orders) {
  if (orders.motorPower) motors_ = *orders.motorPower;
  for (std::size_t i = 0; i < std::min(orders.joints.size(), joints_.size()); ++i) {
    if (orders.joints[i].gainEnabled) enabled_[i] = *orders.joints[i].gainEnabled;
    if (orders.joints[i].target_urad && motors_ && enabled_[i]) joints_[i] = *orders.joints[i].target_urad;
  }
  for (const LampOrder& lamp : orders.lamps)
    if (lamp.lamp < lamps_.size()) lamps_[lamp.lamp] = lamp;
}

CameraImage TrivialRobot::roomWithBall(const RobotDesign& design, double time_s) {
  const int width = 2 * design.imageWidth, height = 2 * design.imageHeight;
  CameraImage image{static_cast<std::uint16_t>(width), static_cast<std::uint16_t>(height), {}};
  image.rows.resize(std::size_t{3} * image.width * image.height);
  const double angle = 2 * M_PI * time_s / 5, radius = 0.12 * width;
  const double ballX = width * (0.5 + 0.3 * std::cos(angle)), ballY = height * (0.5 + 0.25 * std::sin(angle));
  // Y, Cr, Cb; bytes of Cr and Cb are offset by 128.
  const std::uint8_t wall = 150, floor = 90, grey = 128;
  const std::uint8_t ball[] = {120, 210, 120};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const bool isBall = std::hypot(x - ballX, y - ballY) < radius;
      const std::size_t at = (static_cast<std::size_t>(y) * 3) * image.width + static_cast<std::size_t>(x);
      image.rows[at] = isBall ? ball[0] : (y < height / 2 ? wall : floor);
      image.rows[at + image.width] = isBall ? ball[1] : grey;
      image.rows[at + std::size_t{2} * image.width] = isBall ? ball[2] : grey;
    }
  return image;
}

}  // namespace btr::openr
