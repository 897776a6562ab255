#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/gap/fit/fit_problem.h"

namespace btr {

/// A joint's motion in time. An integrator of first order is half a step ahead of the motion or behind it, and which
/// end of a step a sample belongs to is each program's own choice; so where the steps are as long as the scene's,
/// commands that act half a step earlier or later say nothing of the physics. A servo follows its command with
/// p·(command − q) = d·q′ + load, so that this changes q by (q′ + d/p·q″) times the shift. (An arm of six joints that
/// another engine integrated in steps of 0.5 ms was 0.25 ms ahead at each of them: 1.5 noise floors at 1 rad/s.) The
/// torque of a joint that follows its recorded motion belongs to a row, and may have been recorded as what was asked
/// for from that row to the next: half a row later.
struct Alignment {
  double shift_s = 0;  ///< what is recorded is what is simulated so much later; at most mostShift_s()
  double took = 0;     ///< mean squared residual that this takes away [noise floors²]
  double ofMost = 0;   ///< of mostShift_s(): near 1 it may stand for something else

  /// What else an integration is wrong by that is off so much in time, a share of what the shift takes: what takes less
  /// is no physics.
  double numericalFloor(double share) const { return took > 0 ? share * took : 0; }
};

/// The farthest shift that is no physics: half a step of the scene as given, or of a followed motion half a row.
double mostShift_s(const FitProblem& problem);

/// By how much a residual changes where all joints are a second further on, by what is simulated before and after it;
/// 0 for what is not the position or the rate of a joint of a robot whose base is fixed or the torque of one that
/// follows its recorded motion, for other than torques beside the ends of a segment,
/// and where a fault ended the simulation.
Eigen::VectorXd clockColumn(const FitProblem& problem, const Eigen::VectorXd& residuals);
/// Of one segment, whose gains `scene` tells.
std::vector<double> clockColumn(const FitProblem& problem, const Segment& segment, const Scene& scene,
                                std::span<const double> residuals);

/// The best further shift (beside FitProblem::shift_s) of the residuals for which `counts` is 1 (those for which it is
/// 0 say nothing), as its share of the squared error is then; at most mostShift_s(). 0 for a problem
/// with contacts.
double bestShift_s(const FitProblem& problem, const Eigen::VectorXd& residuals, const Eigen::VectorXd& column,
                   const Eigen::VectorXd& counts);

/// Shifts all residuals by what suits them best.
Alignment align(const FitProblem& problem, Eigen::VectorXd& residuals);

}  // namespace btr
