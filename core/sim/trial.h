#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/sim/controller.h"
#include "core/sim/scene.h"
#include "core/sim/trial_result.h"

namespace btr {

/// When a ball lies or rolls freely, so that nothing more is to be seen of it.
namespace rolling_free {
inline constexpr double atRest_m_s = 2e-3;
inline constexpr double slipShare = 0.05;   ///< of the speed: less is rolling
inline constexpr double bounce_m_s = 0.02;  ///< vertical speed of a ball that no longer bounces
}  // namespace rolling_free

struct TrialOptions {
  double maximum_s = 20;  ///< simulated; reaching it is timedOut unless the motion has ended
  double settle_s = 1.0;  ///< after the motion, while the ball is still touched or not rolling
  bool recordTrace = false;
  bool closedFormRoll = true;  ///< end when the ball rolls free and add the closed form
  bool ballsOnly = false;  ///< of the result only outcome and balls matter: robots that no ball can meet any more stop
};

/// A pure function: the same scene, controller, settings, parameters and seed give the same bits, on any worker, at any
/// time. Builds a fresh World. Never throws for what happens in the simulation: that is an outcome.
TrialResult runTrial(const Scene& scene, const Controller& controller, const Values& settings,
                     std::span<const double> parameters, std::uint64_t seed, const TrialOptions& options = {});

}  // namespace btr
