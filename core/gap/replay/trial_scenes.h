#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/gap/recordings/recording.h"
#include "core/gap/replay/residual.h"
#include "core/sim/scene.h"
#include "core/spec/scene_spec.h"

namespace btr {

/// The simulator with the numbers that are known of the trial in place of those that were fitted.
SimulatorSpec withSettings(SimulatorSpec simulator, const Recording& trial);

/// What the scene of every trial is made from.
struct TrialScenes {
  SceneSpec spec;
  ModelSet models;
  SimulatorSpec simulator;

  Scene of(const Recording& trial, const EffectFactory& effects) const;
  /// What of recordings can only be mended by who knows what drives the joints: rows that were lost (fillLostRows()),
  /// and hands (leaveOutHands()), of the scene without effects.
  void prepare(std::vector<Recording>& trials) const;
};
/// From a scene file and a simulator.json ("" for the scene as given). Throws InputError.
TrialScenes loadTrialScenes(const std::string& scene, const std::string& simulator);

/// Loads what is asked for and gives each trial with what its scene is made from to `use`, in the order of the files.
/// `progress(done, all)` counts files before each one; when it returns false, so does this, and the rest is left. `use`
/// may ask goesOn() meanwhile, and throw Cancelled for the same end. What the scene's robots lack of their files is
/// appended to `losses`. Throws InputError.
bool forEachTrial(
    const ResidualRequest& request, const std::function<bool(std::size_t, std::size_t)>& progress,
    std::vector<std::string>& losses,
    const std::function<void(const TrialScenes&, const Recording&, const std::function<bool()>& goesOn)>& use);

}  // namespace btr
