#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/gap/recordings/recording.h"
#include "core/sim/scene.h"

namespace btr {

/// What is analysed: a scene with numbers to calibrate, the simulator as given, and recorded trials of the same thing.
struct GapProblem {
  SceneSpec scene;
  ModelSet models;
  SimulatorSpec simulator;            ///< as given
  std::vector<Recording> recordings;  ///< training and cross-validation
  std::vector<Recording> heldOut;     ///< never used in a fit or a choice; scored at the end
  double firstSteps_s = 0.8;          ///< of a walk, what is compared: later, the landing of a foot decides all
};

/// Effects by name: what the plugin host offers.
struct EffectLibrary {
  EffectFactory make;
  std::vector<std::string> names;
};

/// Says what is being done and how far it is (0 … 1); false cancels.
using AnalysisProgress = std::function<bool(const std::string& stage, double share)>;

}  // namespace btr
