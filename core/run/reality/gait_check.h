#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/plugin_host.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/gait_spec.h"

namespace btr {

/// A check of the simulator on reality: published gaits, each with the speed that a real robot reached, simulated
/// before and after the simulator's parameters were adapted to some of them.
struct GaitCheckOptions {
  std::vector<std::string>
      adapted;  ///< names of simulatorParameters(); empty: all but the masses, which belong to one robot
  int generations = 10, population = 30;
  int jobs = 0;  ///< worker processes, 0: as many as processors
  std::uint64_t seed = 1;
  std::function<void(int generation, double error)> progress;
};

struct GaitResult {
  std::string name, robot, unit;
  double real = 0, before = 0, after = 0;
  bool measured = true, heldOut = false;
  std::string detailBefore, detailAfter;  ///< what the fitness tells besides
  double relative(double simulated) const { return simulated / real - 1; }
};

struct GaitCheck {
  std::vector<GaitResult> gaits;               ///< in the order given
  SimulatorSpec before, after;                 ///< the robots' and scenes' own numbers; the adapted values
  double errorBefore = 0, errorAfter = 0;      ///< root mean square of simulated/real − 1 over the gaits shown
  double heldOutBefore = 0, heldOutAfter = 0;  ///< over those measured and held out; 0 if none
};

/// The experiment that a gait stands for, its parameters as a vector of the genotype. Throws InputError naming the
/// gait if anything of it is not allowed.
struct PreparedGait {
  GaitSpec spec;
  PreparedExperiment experiment;
  std::vector<double> parameters;
};
PreparedGait prepareGait(const GaitSpec& gait, const PluginHost& host);

/// Adapts the simulator with the genetic algorithm of L3 so that the gaits that are not held out (and were measured)
/// come out as they did in reality: minimises the root mean square of simulated/real − 1. `heldOut[i]` belongs to
/// `gaits[i]`; gaits whose speed was only commanded are simulated and never fitted. Keeps the starting values if no
/// candidate is better. Deterministic: the same arguments give the same bits on any number of workers. Nothing if
/// `stop` was raised. Throws InputError if no gait is left to fit.
std::optional<GaitCheck> checkGaits(const std::vector<GaitSpec>& gaits, const std::vector<bool>& heldOut,
                                    const PluginHost& host, const GaitCheckOptions& options,
                                    const std::atomic<bool>& stop);

}  // namespace btr
