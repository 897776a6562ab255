#pragma once
#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/sim/effect.h"

namespace btr {

/// All that decides how a world goes on, as plain values: where everything is, how it moves, and what drives, effects
/// and sensors remember. A world that is built from the same scene and given the same memory goes on with the same
/// bits; with the bits of the one whose memory it is only if that has the bodies' attitudes. World frame, SI units.
struct BodyMemory {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero(), spin_rad_s = Eigen::Vector3d::Zero();
  /// The engine's own quaternion (4) and matrix (12), of which the axes are all but the last bits; not in files.
  std::optional<std::array<double, 16>> attitude{};
};

/// How the rows came to be that a joint in the engine has for friction: their axis is kept in the frame of a body as
/// that stood then, to the last bit.
struct ExtraRowsMemory {
  unsigned long order = 0;  ///< those that were made earlier come first
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  std::optional<std::array<double, 16>> attitude{};  ///< of that body, see BodyMemory; none: the world
};

struct JointMemory {
  double position = 0, rate = 0, solvedRate = 0;  ///< of the joint, see RobotJoint
  double command = 0, integral = 0, driveRate = 0, rateBefore = 0, torque = 0, measured = 0, load = 0;
  double motorAhead = 0, motorRate = 0, couplingLoad = 0;
  double middleRate = 0, endRate = 0;  ///< of a robot in joint coordinates
  bool fresh = true, enabled = true;
  std::optional<ExtraRowsMemory> extraRows{};  ///< not in files
  bool dryRow = false, passiveRow = false;     ///< see JointDrive; not in files
  std::vector<std::vector<double>> effects{};  ///< states, in the order of the simulator's list
};

struct RobotMemory {
  std::string name;
  Eigen::Isometry3d base = Eigen::Isometry3d::Identity();
  std::vector<BodyMemory> bodies;
  std::vector<Eigen::Vector3d> ringAxes;  ///< by body
  std::vector<JointMemory> joints;        ///< the moving ones
  std::vector<int> contact;               ///< by link
  bool first = true, touches = false;
  double allDrives = 0;
  Eigen::Vector3d accelerometerVelocity_m_s = Eigen::Vector3d::Zero(), specificForce_m_s2 = Eigen::Vector3d::Zero();
};

struct ThingMemory {
  std::string name;
  BodyMemory body;
  bool touched = false, onFloor = false;
};

struct WorldMemory {
  double start_s = 0;  ///< time = start + steps · the scene's step
  long steps = 0;
  unsigned long odeSeed = 0;  ///< of ODE's own random numbers
  std::vector<RobotMemory> robots{};
  std::vector<ThingMemory> balls{}, obstacles{};
};

}  // namespace btr
