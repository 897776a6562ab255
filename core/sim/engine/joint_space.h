#pragma once
#include <Eigen/Core>
#include <vector>

#include "core/sim/drive_law.h"
#include "core/sim/engine/articulation.h"
#include "core/sim/engine/lcp_box.h"

namespace btr {

/// What acts at one joint in a step, all of it linear in the joint's rate at the end of the step.
struct JointRows {
  DriveRow drive;    ///< within its limit
  DriveRow passive;  ///< no limit
  DryFriction dry;
  /// The rate that it opposes: 0, or, of a joint at rest whose motion is prescribed, the rate that the prescription has
  /// [rad/s or m/s]. What friction can carry is then no part of the drive's torque.
  double heldRate = 0;
};

/// The motion of a robot whose base is fixed and that can touch nothing, in joint coordinates: as many unknowns as
/// joints, no joint that could drift, a fraction of the time that ODE takes. The same leapfrog and the same rows as
/// there, so that the drive laws do not know the difference:
///   M(q)·(v' − v)/h = kick·(weight(q) − bias(q, v)) + Σ rows(v')
/// Joints that follow another one are no unknowns: with v = T·u the equations become TᵀMT·u' and so on.
/// M by composite rigid bodies, weight and bias (centrifugal, Coriolis and gyroscopic moments) by recursive
/// Newton–Euler (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapters 5 and 6), all in world axes about the
/// world's origin. The bias is taken at the rates of the step's beginning, from those of the last two middles; limits
/// and dry friction are a mixed complementarity problem (BoxSolver).
class JointSpace {
 public:
  /// True if the robot can move without ODE: base fixed, no colliders, fixed parts merged, and not more joints than
  /// BoxSolver has rows for.
  static bool suits(const SceneRobot& robot);

  /// Takes tree, poses, positions and rates from the robot, whose bodies are as Articulation::set left them.
  void begin(const Articulation& robot);
  /// Mass matrix, weight and bias where the robot is now; gravity in m/s². Before each step().
  void prepare(const Articulation& robot, const Eigen::Vector3d& gravity);
  /// Rates of the last step's middle, and at its end.
  const Eigen::VectorXd& middleRates() const { return rate_; }
  const Eigen::VectorXd& endRates() const { return beginRate_; }
  void setRates(const Eigen::VectorXd& middle, const Eigen::VectorXd& end);
  /// Moment of the weight of all that a joint carries, about its axis [N·m or N].
  double weight(std::size_t joint) const { return weight_[static_cast<Eigen::Index>(joint)]; }
  /// One step of h seconds: positions and rates of the robot's joints. `kick` is the share of the forces that acts in
  /// it (rows come with it). False if there is no solution that is finite.
  bool step(Articulation& robot, const std::vector<JointRows>& rows, double kick, double h);
  /// Poses of its bodies, where its joints are now.
  void place(Articulation& robot);
  /// And their velocities; nothing here reads them.
  void placeVelocities(Articulation& robot) const;
  /// Whether prepare() reads poses; a single joint's mass and weight are known without them.
  bool needsPoses() const { return moving_.size() != 1; }

 private:
  struct Moving {
    int child = 0;     ///< body
    int carrier = -1;  ///< the joint that moves what this one stands on, −1 the base
    /// Child's axes in the parent's frame at position q: still + cosine·cos q + sine·sin q (Rodrigues).
    Eigen::Matrix3d still, cosine, sine;
    Eigen::Vector3d anchor;  ///< in the world
  };
  /// A body, and from the end of the tree on all that it carries.
  struct Moved {
    double mass = 0;
    Eigen::Vector3d moment;                      ///< mass times place
    Eigen::Matrix3d inertia;                     ///< about the world's origin
    Eigen::Vector3d spin, velocity;              ///< velocity of its point at the world's origin
    Eigen::Vector3d spinChange, velocityChange;  ///< at zero joint accelerations
    Eigen::Vector3d force, turning;              ///< that these take; turning about the world's origin
  };
  /// rate of `joint` = multiplier · rate of `leader`
  struct Coupled {
    Eigen::Index joint, leader;
    double multiplier;
  };
  /// A torque within ±limit, and within it such that factor·rate + softness·torque = target. `factor` is 1 but for a
  /// joint that follows `joint`.
  struct Bounded {
    Eigen::Index joint;
    double factor, target, softness, limit;
  };
  /// Weight of a single joint at position q: cosine·cos q + sine·sin q, or a constant where it slides.
  struct Weighing {
    double constant = 0, cosine = 0, sine = 0;
  };
  void prepareSingle(const Articulation& robot, const Eigen::Vector3d& gravity);
  bool solve(const std::vector<JointRows>& rows, double h);
  void coupleEquations();
  void factor();
  void solveFor(Eigen::Ref<Eigen::VectorXd> right) const;

  std::vector<Moving> moving_;        ///< by moving joint; what carries stands before what it carries
  std::vector<Coupled> coupled_;      ///< joints that follow another one
  Eigen::VectorXd rate_, beginRate_;  ///< of the last step's middle; and at its end
  Eigen::VectorXd weight_, bias_;
  Eigen::MatrixXd mass_;  ///< lower triangle
  Weighing single_;
  bool singleKnown_ = false;  ///< its mass as well: neither changes

  // Scratch of a step.
  std::vector<Moved> moved_;                  ///< by body
  std::vector<Eigen::Vector3d> turn_, push_;  ///< by joint: a unit rate's spin, and velocity at the world's origin
  Eigen::MatrixXd matrix_;                    ///< lower triangle; factor() makes L of it, and D on its diagonal
  Eigen::MatrixXd inverse_;                   ///< columns of joints that have bounded rows
  Eigen::VectorXd right_, next_;
  std::vector<Bounded> bounded_;
  std::vector<double> a_, bx_, loHi_;
  BoxSolver box_;
};

}  // namespace btr
