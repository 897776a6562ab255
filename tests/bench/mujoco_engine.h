#pragma once
#include <memory>
#include <span>
#include <string>

#include "core/sim/bench/bench.h"

namespace btr::bench {

/// How the rival is run.
struct MujocoWay {
  std::string name;
  bool implicitServo = false;  ///< below its limit the servo is d + h·p/2 of MuJoCo's implicit joint damping
  double step_s = 0.001;
  double nearStep_s = 0;  ///< smaller step near the ball (by our own loop's criterion), 0 none
};

/// What one motion gave: the way of the ball (with the closed form of its roll) or of the robot; not a number if it
/// failed.
struct MujocoOutcome {
  double way_m = 0;
  double simulated_s = 0;
};

class MujocoEngine {
 public:
  /// Compiles the model. Throws std::runtime_error with MuJoCo's message.
  explicit MujocoEngine(const BenchTask& task);
  ~MujocoEngine();
  MujocoOutcome run(std::span<const double> parameters, const MujocoWay& way);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr::bench
