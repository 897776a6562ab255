#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/gap/gap_report.h"
#include "core/gap/recording.h"
#include "core/gap/replay.h"
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

struct AnalysisOptions {
  int jobs = 1;  ///< worker processes; the result does not depend on it
  std::uint64_t seed = 1;
  int maximumEffects = 3;
  std::vector<std::string> effects;  ///< which to consider; empty: all
  bool designNext = true;
  /// Step 9: what named effects leave as a curve. It takes longer than all else on a floor; without it no verdict knows
  /// whether the rest has a shape.
  bool learnRest = true;
  bool asRecorded = false;  ///< goes on where the doctor is certain that a column is not what its name says
};

/// Effects by name: what the plugin host offers.
struct EffectLibrary {
  EffectFactory make;
  std::vector<std::string> names;
};

/// Says what is being done and how far it is (0 … 1); false cancels.
using AnalysisProgress = std::function<bool(const std::string& stage, double share)>;

/// Steps 1 to 9 of gap analysis: doctor, noise floor, replay, calibrate, locate, screen, confirm, rivals, remainder.
/// Deterministic for a seed, whatever the number of jobs. What the doctor has to say leads the sentence and the notes.
/// Throws InputError for recordings that the scene cannot replay, for those that the doctor refuses (see
/// consultation.h), for an effect that the library does not have; throws Cancelled when progress says so.
GapReport analyse(const GapProblem& problem, const EffectLibrary& library, const AnalysisOptions& options,
                  const AnalysisProgress& progress = {});

/// What `btr gap analyse` was asked for: paths.
struct AnalysisRequest {
  std::string scene;
  std::vector<std::string> recordings, heldOut;
  std::string mapping, simulator, out;
  AnalysisOptions options;
};
GapProblem loadProblem(const AnalysisRequest& request);
/// Loads, analyses, writes the report into `out` (nothing if it is cancelled).
GapReport runAnalysis(const AnalysisRequest& request, const EffectLibrary& library,
                      const AnalysisProgress& progress = {});

}  // namespace btr
