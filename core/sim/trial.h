#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/sim/controller.h"
#include "core/sim/scene.h"
#include "core/sim/trace.h"

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

struct TrialOptions {
  double maximum_s = 20;  ///< simulated; reaching it is timedOut unless the motion has ended
  double settle_s = 1.0;  ///< after the motion, while the ball is still touched or not rolling
  bool recordTrace = false;
  bool closedFormRoll = true;  ///< end when the ball rolls free and add the closed form
};

/// A pure function: the same scene, controller, settings, parameters and seed give the same bits, on any worker, at any
/// time. Builds a fresh World. Never throws for what happens in the simulation: that is an outcome.
TrialResult runTrial(const Scene& scene, const Controller& controller, const Values& settings,
                     std::span<const double> parameters, std::uint64_t seed, const TrialOptions& options = {});

}  // namespace btr
