#pragma once
#include <span>

#include "core/run/reality/stand_in.h"
#include "core/sim/trial.h"

namespace btr::rival {

/// A trial of the scene's first robot in MuJoCo, with the same motion, the same end and the same closed form of a
/// rolling ball as runTrial(). A trace has the time, each joint's position and command, and the balls' places. Only
/// joint effects act. MuJoCo draws nothing by chance: the same arguments give the same result.
TrialResult runMujocoTrial(const Scene& scene, const Controller& controller, const Values& settings,
                           std::span<const double> parameters, const TrialOptions& options = {});

/// MuJoCo as the world of a stand-in robot.
RealWorld mujocoWorld();

}  // namespace btr::rival
