#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/sim/engine/articulation.h"

namespace btr {

/// What joints that follow another one in ODE weigh at it. ODE has no rows between more than two bodies: the follower
/// is moved by a row of its own, and the leader feels a step later what that took. What the accelerations took of it is
/// known beforehand: the leader gets an inertia J instead, and that part is not felt late.
///
/// Of the mass matrix M with the followers' multipliers m, let K = Σ Σ m_f·m_g·M_fg be what hangs at the followers and
/// c = Σ m_f·M_f,leader what couples them to a leader that carries them (a finger's phalanges). A follower's row takes
/// its leader's rate from two steps before: its acceleration is 2a₁ − a₂. With J = c + K a step's equation is
///   (M_leader + c + K)·z² + 2c·z − c = 0,
/// with J = K, the coupling being felt late, (M_leader + K)·z² + 3c·z − c = 0. The roots of the first lie within the
/// unit circle for every positive definite M, those of the second where c ≤ 0, where c + K may be no inertia at all.
class CoupledInertia {
 public:
  /// Where the robot is now.
  void prepare(const Articulation& robot);
  /// J of a leader; 0 for a joint that leads none.
  double ofLeader(std::size_t leader) const { return leaders_[leader].inertia; }
  /// What that stands for of the torque that makes a joint follow, in a step in which joints had these accelerations.
  template <class Accelerations>
  double taken(const Articulation& robot, std::size_t follower, const Accelerations& accelerationOf) const {
    const int leader = robot.joints[follower].leader;
    double sum = 0;
    for (std::size_t j = 0; j < leaders_.size(); ++j)
      if (robot.joints[j].leader == leader || (static_cast<int>(j) == leader && leaders_[j].carries))
        sum += between(follower, j) * accelerationOf(j);
    return sum;
  }

 private:
  /// All that hangs at a body, itself included.
  struct Carried {
    double mass = 0;
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();   ///< mass times place
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the origin
  };
  struct Leader {
    double inertia = 0;
    bool carries = false;  ///< c counts
  };
  double between(std::size_t follower, std::size_t joint) const { return mass_[follower * leaders_.size() + joint]; }
  void carry(const Articulation& robot);
  double massBetween(const Articulation& robot, const RobotJoint& a, const RobotJoint& b) const;

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();  ///< in the world: somewhere in the robot
  std::vector<Carried> carried_;                      ///< by body
  std::vector<Leader> leaders_;                       ///< by joint
  std::vector<double> mass_;                          ///< of each joint that follows, with its leader's others
};

}  // namespace btr
