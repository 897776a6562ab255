#pragma once
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/residual.h"

namespace btr {

/// How the recorded motion and torque are prepared for inverse scoring.
struct InverseOptions {
  double lowpass_hz = 100;  ///< of the positions: zero-phase Butterworth of fourth order
  int every = 10;  ///< torques are compared at every tenth sample, after a low-pass at 0.9 times what that carries
};

/// Recorded torque of one joint against the one that the simulator needs for the recorded motion.
struct InverseError {
  ChannelError error;  ///< filtered torques; simulated: what is needed
  double rootMeanSquare_recorded = 0;
  double relative = 0;  ///< 100·|needed − recorded|/|recorded| over all samples [%]
};
struct InverseReport {
  std::vector<InverseError> joints;
  std::vector<std::string> notes;
};

/// Prescribes the recorded motion of every joint (Drive::Kind::motion in place of its drive; rotor inertia, friction
/// and effects stay) and compares the torque that this takes with the recorded one. What acts on commands and inside
/// drives plays no part. Positions are filtered before they are followed; both torques are filtered and thinned alike.
/// Throws InputError for a recording without a joint whose position and torque were measured.
InverseReport inverse(const Scene& scene, const std::vector<Recording>& recordings, const InverseOptions& options);

/// Loads everything as runResidual does, and writes inverse.json, inverse.txt and a plot a joint into `out`.
InverseReport runInverse(const ResidualRequest& request, const EffectFactory& effects, const InverseOptions& options,
                         const std::function<bool(std::size_t, std::size_t)>& progress = {});

}  // namespace btr
