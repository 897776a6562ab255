#pragma once
#include <span>

#include "core/model/four_legs.h"
#include "core/sim/scene.h"

namespace btr {

/// One point of a foot's path.
struct FootPoint {
  double frame = 0;                                     ///< control periods since the leg's cycle began
  Eigen::Vector3d contact_m = Eigen::Vector3d::Zero();  ///< the foot's lowest point in the hip's frame, y outward
};

/// A cycle of four feet, solved by inverse kinematics at the given points; between them joint angles go straight.
/// A point that a leg cannot reach within its joints' limits is replaced (LegSolution says by what), and counted.
class Gait {
 public:
  /// `paths[i]` of leg i: frames increase from 0 and stay below `period`; the path closes. Leg i is `late[i]` control
  /// periods behind.
  Gait(const FourLegs& dog, const std::array<std::vector<FootPoint>, 4>& paths, const std::array<long, 4>& late,
       long period);

  long period() const { return static_cast<long>(frames_.size()); }  ///< control periods of a cycle
  /// Joint angles of the four legs at a frame of the cycle, 0 … period − 1.
  const std::array<LegAngles, 4>& angles(long frame) const { return frames_[static_cast<std::size_t>(frame)]; }
  int points() const { return points_; }          ///< of all four paths
  int infeasible() const { return infeasible_; }  ///< how many of them were out of reach or broke a joint's limit

 private:
  std::vector<std::array<LegAngles, 4>> frames_;
  int points_ = 0, infeasible_ = 0;
};

/// Share of a gait's points that no leg could take, from the remarks of its motion; 0 of other motions.
double infeasibleShare(const Values& remarks);
/// A speed that loses `penalty` times that share of itself, down to nothing. One the wrong way (0 or less) stays: it
/// must not gain.
double withInfeasiblePenalty(double speed, double penalty, const Values& remarks);

/// How a gait moves over the ground and how long: what all walking controllers let the user fix.
///   duration_s   time of the trial, the first step included
///   lead_in_s    of it, time from the stance to the first point of the gait
///   direction_rad, turn_rad_s   where the feet push the body, in its own frame
const std::vector<Parameter>& gaitSettings();
struct GaitTask {
  double duration_s = 20, leadIn_s = 0.5, direction_rad = 0, turn_rad_s = 0;
};
/// Throws InputError, beginning with `who`.
GaitTask gaitTask(const Values& settings, const std::string& who);

/// Where the feet meet the ground: the middles of their ways, in the hips' frames (y outward). The ground is the plane
/// through them, so front legs shorter than rear ones walk nose down.
class FootPlaces {
 public:
  FootPlaces(const FourLegs& dog, const Eigen::Vector3d& front_m, const Eigen::Vector3d& rear_m);

  /// Backward way of a foot on the ground, in the ground's axes (x forward, y left): −(v + ω × r)·time, v of
  /// `speed_m_s` into the task's direction, ω the task's turn, r the foot's place seen from the root. Turned by
  /// `skew_rad`: front legs to the left, rear legs to the right, so that a positive skew turns the robot to the left.
  Eigen::Vector3d stroke(const FourLegs::Leg& leg, const GaitTask& task, double speed_m_s, double time_s,
                         double skew_rad) const;
  /// The point `away_m` (ground's axes, z up) from the foot's place, in the hip's frame (y outward).
  Eigen::Vector3d at(const FourLegs::Leg& leg, const Eigen::Vector3d& away_m) const;

 private:
  const Eigen::Vector3d& middle(const FourLegs::Leg& leg) const { return leg.front ? front_ : rear_; }
  Eigen::Vector3d front_, rear_, forward_, up_;  ///< forward and up: the ground's axes in the root's frame
};

/// The posture in which walking begins, by joint of the model: the feet under the body, other joints at rest. Throws
/// InputError, beginning with `who`, for a robot without such legs.
std::vector<double> stanceOf(const RobotModel& model, const std::string& who);
/// Puts a robot on its feet over the origin with these joints, at rest, looking along x. Throws InputError, beginning
/// with `who`, for one that cannot stand.
void standStill(SceneRobot& robot, std::vector<double> joints, const std::string& who);
/// Puts the scene's first robot over the origin in that stance, looking along x. Throws InputError, beginning with
/// `who`, for a scene without a robot too.
void arrangeStance(Scene& scene, const std::string& who);

/// Goes from the stance to the gait's first frame and through its cycles.
class GaitSteps {
 public:
  /// `start`: the stance, by joint of the model.
  GaitSteps(double controlPeriod_s, std::vector<double> start, const FourLegs& dog, const GaitTask& task, Gait gait);
  /// What each joint of the model is told for the control period that begins at `time` [s].
  void targets(double time, std::span<double> targets) const;
  double duration() const { return static_cast<double>(end_) * period_s_; }  ///< [s]
  Values remarks() const;                                                    ///< infeasible_points, points

 private:
  double period_s_;  ///< control period
  std::vector<double> start_;
  std::array<std::array<std::size_t, 3>, 4> joints_{};
  Gait gait_;
  long leadIn_, end_;  ///< in control periods
};

}  // namespace btr
