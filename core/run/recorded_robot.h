#pragma once
#include <string>
#include <vector>

#include "core/gap/analysis.h"
#include "core/run/prepared_experiment.h"
#include "core/spec/random.h"

namespace btr {

// How measured individuals are recorded for gap analysis. Hung up by its body with the legs in the air, a robot shows
// what its servos and gears do, whatever the ground does, and its joints can be simulated without contacts. On the
// floor it shows everything at once.

/// The arranged scene in which an individual is recorded: as in the trial, or with the robot's body held 1 m higher.
Scene recordedScene(const PreparedExperiment& prepared, const SimulatorSpec& simulator);

/// What gap analysis is given: the experiment's scene as it is recorded, the recordings, and which numbers it may fit
/// (by default the servos' p, d and largest torque) within a share of their present values. Positions of joints that
/// the experiment does not name say where these joints begin and are not compared.
GapProblem recordedProblem(const PreparedExperiment& prepared, const SimulatorSpec& simulator,
                           std::vector<Recording> recordings);

/// Effects that the analysis considers: those that the experiment names, else of a hung robot all that act on joints,
/// on the floor all.
std::vector<std::string> consideredEffects(const PreparedExperiment& prepared, const PluginHost& host);

/// Writes a trace as a robot's log would have it: time, commands as they are sent, joint positions (noise and
/// resolution 1 mrad), where the ball is (noise 2 mm, resolution 1 mm).
void writeRecording(const Trace& trace, const std::string& path, Random& random);

}  // namespace btr
