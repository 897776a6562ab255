#include "core/gap/replay/trial_scenes.h"

#include <algorithm>
#include <iterator>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/doctor/hands.h"
#include "core/gap/recordings/doctor/lost_rows.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/recordings/table/row_order.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/residual.h"
#include "core/sim/engine/ode_session.h"
#include "core/sim/model_losses.h"
#include "core/spec/system/cancelled.h"

namespace btr {

SimulatorSpec withSettings(SimulatorSpec simulator, const Recording& trial) {
  for (const auto& [path, value] : trial.settings) simulator.values[path] = value;
  return simulator;
}

Scene TrialScenes::of(const Recording& trial, const EffectFactory& effects) const {
  return makeScene(spec, models, withSettings(simulator, trial), effects);
}

void TrialScenes::prepare(std::vector<Recording>& trials) const {
  const Scene scene = makeScene(spec, models, SimulatorSpec{}, EffectFactory{});
  for (Recording& trial : trials) {
    const Binding binding = bind(scene, trial);
    std::vector<std::size_t> driving;
    for (const Binding::Input& input : binding.inputs)
      if (!isInputChannel(trial.channels[input.column])) driving.push_back(input.column);
    if (!driving.empty() && !trial.lostRowsHold) fillLostRows(trial, driving);
    leaveOutHands(trial, scene, binding);
  }
}

TrialScenes loadTrialScenes(const std::string& scene, const std::string& simulator) {
  requireOde();
  TrialScenes loaded;
  loaded.spec = loadScene(scene);
  loaded.models = loadModels(loaded.spec);
  if (!simulator.empty()) loaded.simulator = loadSimulator(simulator);
  return loaded;
}

bool forEachTrial(
    const ResidualRequest& request, const std::function<bool(std::size_t, std::size_t)>& progress,
    std::vector<std::string>& losses,
    const std::function<void(const TrialScenes&, const Recording&, const std::function<bool()>&)>& use) try {
  const TrialScenes scenes = loadTrialScenes(request.scene, request.simulator);
  std::ranges::move(modelLosses(scenes.spec, scenes.models), std::back_inserter(losses));
  for (std::size_t i = 0; i < request.recordings.size(); ++i) {
    const auto goesOn = [&] { return !progress || progress(i, request.recordings.size()); };
    if (!goesOn()) return false;
    std::vector<Recording> trials = loadTrialsFor(request.recordings[i], request.mapping, request.scene);
    scenes.prepare(trials);
    for (const Recording& trial : trials) use(scenes, trial, goesOn);
  }
  return true;
} catch (const Cancelled&) {
  return false;
}

}  // namespace btr
