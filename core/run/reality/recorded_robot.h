#pragma once
#include <string>
#include <vector>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/search/analysis.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/random.h"

namespace btr {

// How measured individuals are recorded for gap analysis.

/// The arranged scene in which an individual is recorded: as in the trial, or with the robot's body held 1 m higher.
Scene recordedScene(const PreparedExperiment& prepared, const SimulatorSpec& simulator, RobotPose pose);

/// What gap analysis is given: the experiment's scene as it is recorded, the recordings, and which numbers it may fit
/// (by default the servos' p, d and largest torque) within a share of their present values; see RecordingsSpec for a
/// robot that is recorded in both poses. Positions of joints that the experiment does not name say where these joints
/// begin and are not compared.
GapProblem recordedProblem(const PreparedExperiment& prepared, const SimulatorSpec& simulator,
                           std::vector<Recording> recordings, RobotPose pose);

/// Effects that the analysis considers: those that the experiment names, else of a hung robot all that act on joints,
/// on the floor all, or, if it was hung up before, all others.
std::vector<std::string> consideredEffects(const PreparedExperiment& prepared, const PluginHost& host, RobotPose pose);

/// Writes a trace as a robot's log and a camera above would have it: time, commands as they are sent, joint positions
/// (noise and resolution 1 mrad), where the ball is and, on the floor, the first robot's body (x and y; noise 2 mm,
/// resolution 1 mm).
void writeRecording(const Trace& trace, const std::string& path, RobotPose pose, Random& random);

/// Of an experiment that wants both poses: a recording that says where a robot's body is was made on the floor.
RobotPose poseOf(const Recording& recording);

}  // namespace btr
