#pragma once
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "core/plugin/plugin_host.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/store/records.h"

namespace btr {

// Stand-in reality: a process of its own that plays the real robot where none is there, for demonstrations and tests.
// It is a simulator with concealed parameter values and concealed effects, drawn from a seed, plus measurement noise.
// Whatever it answers is marked "stand_in" in the database, on screen and in exports. Nobody but this process ever sees
// what it conceals.

/// What a stand-in conceals.
struct Concealed {
  SimulatorSpec simulator;
  double noise = 0;  ///< standard deviation of a measured fitness, in the fitness' unit
  std::uint64_t seed = 0;
};

/// The experiment as the stand-in sees it: its own integration step, and its own seed where each seed of a run meets
/// another robot ("drawn_by": "run_seed").
PreparedExperiment asReality(PreparedExperiment prepared, std::uint64_t runSeed);

/// Draws it: each of the 12 parameters deviates by a normal factor of the stand-in's `parameter_error` (of its range
/// where the starting value is 0), within its bounds; `hidden_effects` effects at places of the scene's first robot,
/// floor or ball, each parameter of half to one and a half times `effect_size` times the typical size that its effect
/// declares as default; the experiment's block "concealed" says which effects and places are drawn from. A function of
/// only the experiment's stand-in settings. Redraws while the arranged scene cannot be built.
Concealed drawConcealed(const PreparedExperiment& prepared, const PluginHost& host);

/// Where a recording goes, "" for none.
struct RecordTo {
  std::string file = {};
  RobotPose pose = RobotPose::hungUp;
};

/// Who moves the robot: another engine, for one. A trial as PreparedExperiment::trial(); empty is our own simulator.
struct RealWorld {
  std::string name;  ///< stands in the note of each answer
  std::function<TrialResult(const PreparedExperiment& prepared, const Scene& arranged,
                            std::span<const double> parameters, bool recordTrace)>
      trial;
};

/// Measures one individual for the n-th time (0, 1, …): the concealed trial plus noise. The same arguments give the
/// same bits. With `record` naming a file, the individual is also recorded into it, in that pose (recordedScene()).
RealAnswer measureStandIn(const PreparedExperiment& prepared, const Concealed& concealed,
                          std::span<const double> parameters, int repeat, const RecordTo& record = {},
                          const RealWorld& world = {});

/// The process' loop: one JSON request a line {"parameters": […], "repeat": 0, "record": "FILE", "robot": "hung_up"} on
/// `in`, one answer a line
/// {"fitness": 0.5, "void": false, "note": ""} on `out`, until `in` ends.
void serveStandIn(const PreparedExperiment& prepared, const PluginHost& host, std::istream& in, std::ostream& out,
                  const RealWorld& world = {});

}  // namespace btr
