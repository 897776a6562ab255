#pragma once
#include <string>
#include <vector>

#include "core/model/leg.h"
#include "core/model/robot_model.h"

namespace btr {

/// The ball of a leg's foot in the world.
struct FootBall {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

/// The legs of a four-legged robot: joints LF_J1 … RR_J3 of its model, and what inverse kinematics needs of them.
/// Left front, right front, left rear, right rear.
struct FourLegs {
  struct Leg {
    bool front = true, left = true;
    std::array<std::size_t, 3> joints{};              ///< of the model
    Eigen::Vector3d hip_m = Eigen::Vector3d::Zero();  ///< in the root link's frame
    LegGeometry geometry;                             ///< its foot is the centre of the foot's ball
    LegLimits limits;
    double footRadius_m = 0;

    /// Hip's frame (y outward) ↔ root's axes (y left): mirrors right legs.
    Eigen::Vector3d turned(const Eigen::Vector3d& v) const { return {v.x(), left ? v.y() : -v.y(), v.z()}; }
  };
  static constexpr std::array names{"LF", "RF", "LR", "RR"};
  std::array<Leg, 4> legs;

  /// Reads the legs from a model. Throws InputError, beginning with `who`, for a robot without such legs: a joint is
  /// missing, a last link has no sphere as its foot, or the axes are not those of LegGeometry.
  static FourLegs of(const RobotModel& model, const std::string& who);
};

/// The foot of leg "LF" … with the model's links at `poses`: the lowest colliding sphere of its last link. Throws
/// InputError, beginning with `who`, if there is none.
FootBall footOf(const RobotModel& model, const std::vector<Eigen::Isometry3d>& poses, const std::string& leg,
                const std::string& who);

/// Every joint as near to zero as it can be: neck upright, head level, mouth shut. By joint of the model.
std::vector<double> restPositions(const RobotModel& model);

/// Pose of the root over the world's origin, looking along x, pitched so that the feet of front and rear legs just
/// touch z = 0.
Eigen::Isometry3d standing(const RobotModel& model, const std::vector<double>& positions, const std::string& who);

}  // namespace btr
