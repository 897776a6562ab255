#pragma once
#include <optional>
#include <vector>

#include "core/openr/robot_design.h"
#include "core/openr/robot_link.h"

namespace btr::openr {

/// A robot without physics, to try programs with: joints stand where they are told at the next frame while motors are
/// on and their gains enabled, sensors rest, the camera sees what `scene` paints, if anything.
class TrivialRobot {
 public:
  explicit TrivialRobot(const RobotDesign& design);

  /// What it senses in the next frame.
  SensorFrame sense();
  /// Does what was ordered.
  void obey(const OrderFrame& orders);

  std::string typed;  ///< goes out with the next frame
  PowerReading power;
  bool shutdown = false;
  std::optional<CameraImage> image;  ///< goes out with every `imageEvery`-th frame
  int imageEvery = 4;

  const std::vector<std::int32_t>& joints() const { return joints_; }
  std::vector<std::int32_t> sensors;
  const std::vector<LampOrder>& lamps() const { return lamps_; }
  std::uint32_t frames() const { return frame_; }

  /// A grey room with a pink ball that goes round before the camera, as it is after `time_s`.
  static CameraImage roomWithBall(const RobotDesign& design, double time_s);

 private:
  std::vector<std::int32_t> joints_;
  std::vector<bool> enabled_;
  std::vector<LampOrder> lamps_;
  bool motors_ = false;
  std::uint32_t frame_ = 0;
};

}  // namespace btr::openr
