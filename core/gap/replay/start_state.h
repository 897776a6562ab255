#pragma once
#include <Eigen/Geometry>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/sim/scene.h"

namespace btr {

/// Where and how fast everything is when the recording begins, by the scene's robots and balls. What was not recorded
/// starts as the scene says.
struct StartState {
  struct Robot {
    Eigen::Isometry3d base = Eigen::Isometry3d::Identity();
    Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero(), spin_rad_s = Eigen::Vector3d::Zero();
    std::vector<double> positions, rates;
    bool rests = false;  ///< on a fixed base, since before the recording began
  };
  std::vector<Robot> robots;
  std::vector<BallState> balls;
};
/// From the samples that follow `row` (see initial_state.h). A joint that moves takes its rate, and the bend of its
/// path, from the samples of its velocity where there are some; where only that was measured, it is where the scene
/// says and moves as they say. A servo that leaves its place within the first samples of a recording begins at rest if
/// the scene, so driven, then comes nearer to them.
StartState startState(const Scene& scene, const Recording& recording, const Binding& binding, std::size_t row = 0);

/// Whether the position of a joint is among what is known of it.
bool isPositionKnown(const std::vector<Binding::Measured>& known, const Binding::Measured& joint);

struct TrialScenes;
/// A better way than the first samples to say where a trial begins (fitted_start.h has one), or nothing of one that it
/// cannot say it of. May ask goesOn() meanwhile, and throw Cancelled.
using StartEstimator =
    std::function<std::optional<StartState>(const TrialScenes& scenes, const EffectFactory& effects,
                                            const Recording& trial, const std::function<bool()>& goesOn)>;

}  // namespace btr
