#pragma once
#include <string>
#include <vector>

#include "core/gap/recording.h"
#include "core/sim/scene.h"

namespace btr {

/// Recorded against simulated, one measured channel of one trial.
struct ChannelError {
  std::string recording, channel;
  std::size_t samples = 0;
  double meanAbsolute = 0, rootMeanSquare = 0, maximum = 0, bias = 0;  ///< in the channel's unit
  std::vector<double> time_s, recorded, simulated;
};

struct ResidualReport {
  std::vector<ChannelError> channels;
  std::vector<std::string> notes;
};

/// Replays the recorded commands of each recording in the scene, free-running from the initial state that its first
/// samples give, and compares at the recorded times. Throws InputError for a channel that the scene does not have.
ResidualReport residual(const Scene& scene, const std::vector<Recording>& recordings);

/// Self-contained SVG: recorded and simulated over time, and their difference below.
std::string overlaySvg(const ChannelError& error);

}  // namespace btr
