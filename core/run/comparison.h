#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/run/loop/back_to_reality.h"
#include "core/run/reality/spread.h"
#include "core/spec/comparison_spec.h"
#include "core/spec/experiment_spec.h"

namespace btr {

/// What one measurement stage of a run showed, in the unit of fitness.
struct StageOutcome {
  int stage = 0;
  double gap = 0;       ///< mean |real − simulated| of its individuals, in the simulator that they were learned in:
                        ///< none of them had been measured before, so the simulator cannot have been fitted to them
  double adapted = 0;   ///< the same individuals in the simulator after this stage's update
  double realMean = 0;  ///< mean real fitness of its individuals
  double realBest = 0;  ///< of the best of them
};
/// Of the stages that are finished.
std::vector<StageOutcome> stageOutcomes(const Database& database, Id run);

/// A stage over the seeds of one arm: means with 95 % intervals (Student's t).
struct ComparedStage {
  int stage = 0;
  Spread gap, adapted, realMean, realBest;
  Spread gapDifference, realDifference;  ///< to the first arm, seed by seed; empty in the first arm
};
struct ComparedArm {
  std::string name;
  std::vector<std::vector<StageOutcome>> runs;  ///< by seed
  std::vector<ComparedStage> stages;            ///< as far as all seeds have come
};

/// Adds the stages' means to arms whose `runs` are filled in, seed k of each arm belonging together.
void compareArms(std::vector<ComparedArm>& arms);

struct Comparison {
  std::string name, unit;  ///< unit of fitness
  std::vector<std::uint64_t> seeds;
  std::vector<ComparedArm> arms;
  std::vector<std::vector<Id>> runs;  ///< by arm and seed
  RunEnd end = RunEnd::finished;      ///< of all runs: stopped if one was, else waiting if one waits
};

/// The experiments of the arms, in their order, and the unit of their fitness.
struct ComparedExperiments {
  std::vector<ExperimentSpec> experiments;
  std::string unit;
};
/// Throws InputError with the comparison's file and the arm for an experiment that cannot be read or prepared, or whose
/// fitness has another unit than the first one's.
ComparedExperiments loadArms(const ComparisonSpec& spec, const PluginHost& host);

/// Runs every arm with every seed, or resumes what is stored and not finished, one run after the other; then compares.
/// `loaded` are the spec's arms, from loadArms(). `began(arm, seed)` is called before each. Throws InputError as
/// startRun() does.
Comparison runComparison(Database& database, const PluginHost& host, const ComparisonSpec& spec,
                         const ComparedExperiments& loaded, const StopFlag& stop, const RunOptions& options,
                         const std::function<void(const std::string& arm, std::uint64_t seed)>& began = {});

/// A row for each arm and stage: arm,stage,seeds, then mean and half width of the 95 % interval of each number.
std::string toCsv(const Comparison& comparison);
/// "format": "uchilsim-compared-1": the same with the numbers of each run.
std::string toJsonText(const Comparison& comparison);

}  // namespace btr
