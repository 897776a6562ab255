#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/sim/trace.h"
#include "core/spec/parameter.h"

namespace btr {

/// Where a ball will lie when it has rolled out; from the last state by the closed form of uniform deceleration where
/// the trial ended while the ball rolled freely.
struct BallRest {
  Eigen::Vector3d start_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rest_m = Eigen::Vector3d::Zero();
};

/// Where a robot's root frame was.
struct BasePose {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0;  ///< of its x axis in the world, −π … π
  double up = 1;       ///< cosine of the angle between its z axis and the vertical
};

struct TrialResult {
  enum class Outcome { finished, exploded, timedOut, workerDied };
  Outcome outcome = Outcome::finished;
  std::string detail;  ///< for people, empty if finished
  double simulated_s = 0;
  std::vector<BallRest> balls;                                                                 ///< by ball of the scene
  Eigen::Vector3d baseStart_m = Eigen::Vector3d::Zero(), baseEnd_m = Eigen::Vector3d::Zero();  ///< first robot
  std::vector<BasePose> basePath;  ///< first robot: at the start and after each control period
  double controlPeriod_s = 0;
  Values remarks;     ///< of the motion
  bool fell = false;  ///< first robot: the body's up axis ended more than 60° from vertical
  Trace trace;        ///< empty unless asked for; a failed trial keeps its last states
};

const char* toText(TrialResult::Outcome outcome);
/// Of an outcome as it is stored and sent: toText(Outcome::finished).
bool isFinished(const std::string& outcome);

}  // namespace btr
