#pragma once
#include <Eigen/Geometry>
#include <array>
#include <span>

#include "core/gap/recordings/noise_floor.h"

namespace btr {

/// Where a coordinate is and how fast it moves when its recording begins.
struct Start {
  double position = 0;
  double rate = 0;
  bool moving = false;
};

/// The mean of the first samples, at rest; only if they clearly move (a slope beyond eight of its standard errors and
/// several quantisation steps) the line through them, its value and slope at time[from]. Samples of the first
/// `window_s` are used, at least three; NaN is passed over. `acceleration` is one that is known to act (a flying body's
/// gravity): the line is then that parabola. `impacts`: what bounces says nothing of the noise there. At least one
/// finite value is needed (asserted).
Start estimateStart(std::span<const double> time_s, std::span<const double> values, double window_s = 0.03,
                    double acceleration = 0, Impacts impacts = Impacts::none);

/// The same for an orientation from four columns qw, qx, qy, qz: the mean attitude, and its rate as a spin in world
/// axes.
struct StartAttitude {
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d spin_rad_s = Eigen::Vector3d::Zero();
};
StartAttitude estimateAttitude(std::span<const double> time_s, const std::array<std::span<const double>, 4>& wxyz,
                               double window_s = 0.03);

/// Sum of squared deviations of the first samples from the start's line or parabola: which acceleration fits better.
double startMisfit(std::span<const double> time_s, std::span<const double> values, double window_s,
                   double acceleration);

}  // namespace btr
