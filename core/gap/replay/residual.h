#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/gap/recordings/recording.h"
#include "core/gap/replay/start_state.h"
#include "core/sim/scene.h"

namespace btr {

/// Recorded against simulated, one measured channel of one trial. Error = simulated − recorded, in the channel's unit.
struct ChannelError {
  std::string recording, channel;
  std::size_t samples = 0;  ///< rows where both are finite
  double meanAbsolute = 0, rootMeanSquare = 0, maximum = 0, bias = 0;
  double resolution = 0;  ///< what the recording cannot tell: its noise floor or rounding (noise_floor.h)
  double last = 0;        ///< at the last sample where both are finite
  double stepError = 0;   ///< root mean square error of the integration itself, from a replay with half the step
  std::vector<double> time_s, recorded, simulated;
};

struct ResidualReport {
  std::vector<ChannelError> channels;
  std::vector<std::string> notes;
};

/// Replays the recorded commands of each recording in the scene, free-running from the initial state that its first
/// samples give, and compares at the recorded times. The scene is used as it is: a recording's own settings must
/// already be in it. Throws InputError for a channel that the scene does not have, for a recording with nothing to
/// compare and, unless `asRecorded`, for milliseconds that are taken for seconds: a replay would take very long.
ResidualReport residual(const Scene& scene, const std::vector<Recording>& recordings, bool asRecorded = false);

/// What `btr gap residual` was asked for.
struct ResidualRequest {
  std::string scene;                    ///< path of the scene file
  std::vector<std::string> recordings;  ///< paths
  /// Path of a mapping for all recordings; "": the one beside the recording, else SCENE.mapping.json beside the scene
  /// (for recordings that have no column time_s of their own).
  std::string mapping;
  std::string simulator;      ///< path of a simulator.json, "": the scene as given
  bool asRecorded = false;    ///< goes on where the doctor is certain that the time is not in seconds
  StartEstimator start = {};  ///< where each trial begins; none: where its first samples say
  std::string out;  ///< folder for residual.json, residual.txt and one SVG a channel; made if absent; "": none
};
/// Loads everything, applies each recording's settings, replays, writes. `progress(done, all)` counts recordings,
/// and is asked again in the middle of each; when it returns false the work ends early with what is done, and nothing
/// is written. Throws InputError.
ResidualReport runResidual(const ResidualRequest& request, const EffectFactory& effects,
                           const std::function<bool(std::size_t, std::size_t)>& progress = {});

}  // namespace btr
