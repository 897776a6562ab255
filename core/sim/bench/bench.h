#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/sim/controller.h"
#include "core/sim/scene.h"

namespace btr {

/// Processor time of this thread [s].
double threadSeconds();

/// A task whose speed is measured: several motions of one controller in one scene.
struct BenchTask {
  std::string name;  ///< "kick", "walk"
  Scene scene;       ///< arranged; step and substeps are replaced
  const Controller* controller = nullptr;
  Values settings = {};
  std::vector<std::vector<double>> parameters = {};  ///< of each motion
};

/// What was measured at one step.
struct BenchStep {
  double step_s = 0;
  int nearSubsteps = 1;
  double outcome_m = 0;        ///< mean over the motions: way of the ball, or of the robot where there is no ball
  double deviation = 0;        ///< median over the motions of |outcome/converged − 1|
  double rmsDeviation = 0;     ///< root mean square of the same: a motion that depends on every hair shows here
  double cpuPerSimulated = 0;  ///< CPU seconds per simulated second
  double trialsPerSecond = 0;  ///< per core, set-up included
};

struct BenchResult {
  std::string name;
  BenchStep converged;           ///< at 0.25 ms
  std::vector<BenchStep> steps;  ///< from the largest
  int chosen = -1;               ///< the fastest of `steps` whose deviation is at most 5 %, −1 none
};

/// Median and root mean square over the motions of |outcome/converged − 1|; not a number if a motion failed.
struct Deviation {
  double median = 0, rms = 0;
};
Deviation deviationOf(const std::vector<double>& outcomes, const std::vector<double>& converged);

/// Measures one task in this thread: thread CPU time, best of `repeats`. `progress` gets a line now and then. Where
/// `goesOn` says no after a trial, what was measured at whole steps until then is returned.
BenchResult benchmark(const BenchTask& task, int repeats = 3,
                      const std::function<void(const std::string&)>& progress = nullptr,
                      const std::function<bool()>& goesOn = nullptr);

/// One table for people: simulated seconds per second and trials per second on one core, at the largest step whose
/// outcome is within 5 % of the converged one, and the steps that were tried.
std::string benchTable(const std::vector<BenchResult>& results);

/// The tasks that `btr bench` measures, from the ERS-7's scene files: a walk (Trot) of 10 s and kicks with `kick`, the
/// plugin of that name.
BenchTask walkTask(const SceneSpec& walkScene, const ModelSet& models);
BenchTask kickTask(const SceneSpec& kickScene, const ModelSet& models, const Controller& kick);

}  // namespace btr
