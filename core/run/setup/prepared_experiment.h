#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/plugin_host.h"
#include "core/sim/scene.h"
#include "core/sim/trial.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/scene_spec.h"
#include "core/store/records.h"

namespace btr {

/// An experiment with everything that a trial needs in memory: plugins made, scene and models read. The same object is
/// made from files (a new run) or from the database (resume, replay), so both see the same bytes. The plugin host must
/// outlive it.
struct PreparedExperiment {
  ExperimentSpec spec;         ///< all settings as numbers
  ExperimentSpec specInWords;  ///< the same with choices as words: what is stored
  SceneSpec sceneSpec;
  ModelSet models;
  std::vector<StoredFile> files;  ///< the models' texts
  std::shared_ptr<const Controller> controller;
  std::shared_ptr<const Fitness> fitness;
  std::shared_ptr<const Reality> reality;
  EffectFactory effects;
  std::vector<Parameter> genotype;    ///< of the controller
  std::vector<Parameter> parameters;  ///< simulator parameters that mean something in the scene
  std::vector<Parameter> adapted;     ///< those that L3 may change

  std::vector<double> start;  ///< the genotype's vector that L1 begins around; empty if it begins anywhere

  /// The simulator with the adapted parameters replaced by `values`, in their order.
  SimulatorSpec adaptedTo(SimulatorSpec simulator, std::span<const double> values) const;
  /// The scene of one simulator version, arranged for the task.
  Scene scene(const SimulatorSpec& simulator) const;
  TrialResult trial(const Scene& arranged, std::span<const double> parameters, std::uint64_t seed,
                    bool recordTrace) const;
  /// The same for fitnessOf() alone, which gets the same value: no trace, and robots are simulated only as long as the
  /// fitness may depend on them (see BallFitness).
  TrialResult trialForFitness(const Scene& arranged, std::span<const double> parameters, std::uint64_t seed) const;
  /// The fitness plugin's value, ofFailure() for a trial that did not finish; nothing where the value is no finite
  /// number.
  std::optional<double> numberOf(const TrialResult& result) const;
  /// The same, ofFailure() where it is no number.
  double fitnessOf(const TrialResult& result) const;
  /// Why a trial failed; of a finished one what else the fitness plugin tells, "falls 0, straightness 0.97".
  std::string detailOf(const TrialResult& result) const;
  /// The same as numbers; none of a trial that failed.
  Values figuresOf(const TrialResult& result) const;
  /// The same experiment with another task: these settings of the controller in place of its own.
  PreparedExperiment withTask(const Values& settings) const;

 private:
  Values task() const;  ///< all of the controller's settings, defaults filled in
  TrialResult trial(const Scene& arranged, std::span<const double> parameters, std::uint64_t seed,
                    TrialOptions options) const;
};

/// Checks everything that can be checked before a run: plugins, settings, scene, models, that a scene can be built, and
/// that a trial is long enough for the motion. Throws InputError.
PreparedExperiment prepareFromFiles(const ExperimentSpec& spec, const PluginHost& host);
PreparedExperiment prepareFromRun(const RunRecord& run, const PluginHost& host);

/// What the run's robots lack of what their files say; see modelLosses().
std::vector<std::string> runLosses(const RunRecord& run, const PluginHost& host);

/// Those of simulatorParameters() that mean something for the robots of a scene file or a stored run. Throw InputError.
std::vector<Parameter> parametersOfScene(const std::string& path);
std::vector<Parameter> parametersOfRun(const RunRecord& run);

/// The simulator version 0 of a run: what the experiment says, start values for the rest of the scene's parameters.
SimulatorRecord firstSimulator(const PreparedExperiment& prepared);

/// The record that stores a prepared experiment as a run, ready to start.
RunRecord makeRunRecord(const PreparedExperiment& prepared, Id experiment, std::uint64_t seed);

}  // namespace btr
