#pragma once
#include <Eigen/Geometry>
#include <limits>
#include <vector>

namespace btr {

/// What a controller or a recording puts in for one joint over one control period.
struct JointInput {
  double command = 0;    ///< rad or m (servo, DC motor), N·m or N (torque)
  bool enabled = true;   ///< false: the drive is switched off, the joint swings
  double supply_v = -1;  ///< DC motor: measured supply voltage, negative: the scene's
  /// DC motor: the share of the supply that a recording says was applied (−1 … 1); not a number: the firmware computes
  /// it, duty = gain·(command − q)/(the scene's supply), clamped to ±maxDuty. Volts = duty × measured supply.
  double duty = std::numeric_limits<double>::quiet_NaN();
  double pTimes = 1, iTimes = 1, dTimes = 1;  ///< servo: its gains now, times those of the scene
};

/// What the robot's sensors say now.
struct RobotReadings {
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();      ///< root link's frame in the world
  Eigen::Vector3d baseVelocity_m_s = Eigen::Vector3d::Zero();  ///< of the root frame's origin, world axes
  Eigen::Vector3d baseSpin_rad_s = Eigen::Vector3d::Zero();    ///< world axes
  std::vector<double> position, rate, torque;  ///< by joint of the model; position through sensor effects
  std::vector<char> contact;                   ///< by link of the model: touches floor or ball
  Eigen::Vector3d accelerometer_m_s2 = Eigen::Vector3d::Zero();  ///< specific force, axes of the model's accelerometer
};

}  // namespace btr
