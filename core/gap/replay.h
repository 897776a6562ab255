#pragma once
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/gap/recording.h"
#include "core/sim/scene.h"

namespace btr {

/// Which columns of a recording drive a scene, and which can be compared with it.
struct Binding {
  struct Input {
    enum class What { command, enabled, supply, duty, volts, motion };
    What what = What::command;
    std::size_t robot = 0, joint = 0;
    std::size_t column = 0;
  };
  struct Measured {
    enum class What { position, rate, torque, basePosition, baseOrientation, ballPosition };
    What what = What::position;
    std::size_t object = 0;  ///< robot or ball
    std::size_t part = 0;    ///< joint, axis 0 … 2, or w, x, y, z as 0 … 3
    std::size_t column = 0;
  };
  std::vector<Input> inputs;
  std::vector<Measured> measured;
  std::vector<Measured> startOnly;  ///< give the start but are not compared (Recording::notCompared)
  std::vector<std::string> notes;   ///< columns that the simulator has no counterpart of, joints without a command
};

/// Finds robot, joint or ball of every channel. Throws InputError for a channel that the scene does not have, and for a
/// command in the wrong unit (a slide joint's in rad).
Binding bind(const Scene& scene, const Recording& recording);

/// Where and how fast everything is when the recording begins, by the scene's robots and balls. What was not recorded
/// starts as the scene says.
struct StartState {
  struct Robot {
    Eigen::Isometry3d base = Eigen::Isometry3d::Identity();
    Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero(), spin_rad_s = Eigen::Vector3d::Zero();
    std::vector<double> positions, rates;
    bool rests = false;  ///< on a fixed base, since before the recording began
  };
  std::vector<Robot> robots;
  std::vector<BallState> balls;
};
/// From the samples that follow `row` (see initial_state.h). A joint that moves takes its rate, and the bend of its
/// path, from the samples of its velocity where there are some. A servo that leaves its place within the first samples
/// of a recording begins at rest if the scene, so driven, then comes nearer to them.
StartState startState(const Scene& scene, const Recording& recording, const Binding& binding, std::size_t row = 0);

/// Thrown where somebody who was asked whether to go on said no.
struct Cancelled {};

/// Simulated values at the recorded times.
struct ReplayedRecording {
  std::vector<std::vector<double>> values;  ///< by Binding::measured, one a row; NaN after a fault
  std::string fault;                        ///< empty, or why and when the simulation was ended
};

/// Builds a World and drives it with the recorded inputs: each is held from its sample to the next (an empty cell holds
/// the last one), changes happen exactly at the recorded times, the state is read at the recorded times. Steps are the
/// scene's step_s or, between samples, equal and slightly smaller. Rows `first` … `last` − 1; a pure function of its
/// arguments.
/// Joints whose motion is prescribed start where the recording has them, with the central difference as their rate; one
/// step then covers the time between two samples, so that the torque of a row is that of the path's second difference
/// there. (In the last row there is none: that of the row before.)
/// `goesOn` is asked now and then; when it says no, this throws Cancelled.
ReplayedRecording replayRecording(const Scene& scene, const Recording& recording, const Binding& binding,
                                  const StartState& start, std::size_t first = 0,
                                  std::size_t last = std::numeric_limits<std::size_t>::max(),
                                  const std::function<bool()>& goesOn = {});

}  // namespace btr
