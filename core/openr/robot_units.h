#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/live/game.h"
#include "core/openr/robot_design.h"
#include "core/openr/robot_link.h"
#include "core/sim/readings.h"
#include "core/sim/scene.h"

namespace btr::openr {

/// The design of a robot of a scene: the one that is wanted, else the one that its model's name says. Throws InputError
/// where that is none of Sony's.
const RobotDesign& designOf(const RobotModel& model, const std::string& wanted, const std::string& place);

/// Between a simulated robot and the link: SI units and the names of its model here, OPEN-R's units and places there.
class RobotUnits {
 public:
  RobotUnits(const RobotDesign& design, const SceneRobot& robot);

  const RobotDesign& design() const { return *design_; }

  /// Joints as they are and as they are told, by joint of the model; a joint that the model does not have, or that is
  /// fixed in it, is at 0.
  std::vector<JointReading> joints(const RobotReadings& now, const std::vector<JointInput>& told) const;
  /// What the sensors say: `si` by names of the design ("distance_near", "paw_LF"); what is not there has its neutral
  /// value: nothing near, nothing touched, at rest on its feet, 25 °C.
  std::vector<std::int32_t> sensors(const std::map<std::string, double>& si) const;

  /// Targets within the joint's range, gains as times the standard ones, lamps by name. Nothing for joints that the
  /// model does not have.
  struct Ordered {
    Values targets{};
    Orders orders{};
    bool empty() const { return targets.empty() && orders.empty(); }
  };
  Ordered ordered(const OrderFrame& frame) const;

 private:
  const RobotDesign* design_;
  std::vector<int> joints_;         ///< of the model, by the design's joints; −1: none that moves
  std::vector<double> maxTorques_;  ///< by joint of the model
};

/// What a program sets on its camera as numbers of our camera's stages: "balance_k", "exposure_s", "gain_db".
Values cameraNumbers(const RobotDesign& design, const CameraOrder& order);

}  // namespace btr::openr
