#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/gap/recordings/recording.h"
#include "core/gap/replay/start_state.h"
#include "core/sim/scene.h"

namespace btr {

/// What the scene says would be recorded under a recording's commands: the same times and inputs, and simulated values
/// of every channel that was recorded, of all joint positions, free bases' poses and balls' positions. It begins where
/// `start` says, else where the recording's first samples do, or as the scene says where they say nothing. After a
/// fault cells are NaN, and a note says why. Throws InputError as bind() does, Cancelled when `goesOn` says no.
Recording predict(const Scene& scene, const Recording& recording, const std::function<bool()>& goesOn = {},
                  const std::optional<StartState>& start = {});

/// What `btr gap predict` was asked for: paths.
struct PredictRequest {
  std::string scene, recording;
  std::string mapping;        ///< "": as for a residual
  std::string simulator;      ///< "": the scene as given
  std::string out;            ///< a .csv; of a file with several trials NAME-1.csv, NAME-2.csv …
  StartEstimator start = {};  ///< where each trial begins; none: where its first samples say
};
/// Loads, predicts, then writes; returns what was written, with their notes. Throws InputError, also where a file would
/// replace one that was read, and Cancelled when `goesOn` says no: then nothing was written.
std::vector<Recording> runPredict(const PredictRequest& request, const EffectFactory& effects,
                                  const std::function<bool()>& goesOn = {});

}  // namespace btr
