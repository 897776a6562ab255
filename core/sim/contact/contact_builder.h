#pragma once
#include <ode/ode.h>

#include <Eigen/Core>
#include <deque>
#include <vector>

#include "core/sim/contact/collision.h"
#include "core/sim/contact/contact_force.h"
#include "core/sim/engine/ode_session.h"
#include "core/spec/scene_spec.h"

namespace btr {

/// What two touching surfaces do to each other. Stiffness and damping are physical: what ODE needs for them is worked
/// out for each step, so that a contact does not change with the step.
struct ContactSurface {
  double friction = 0.3;
  double restitution = 0;
  double stiffness_n_m = 2e4, damping_n_s_m = 100;
  double slip1_m_s_n = 0, slip2_m_s_n = 0;                ///< along the direction below and across
  Eigen::Vector3d slip1Along = Eigen::Vector3d::UnitX();  ///< world
  double bounceLoss_s_m = 0;  ///< restitution falls with the speed of a hit, e/(1 + loss·v)
};

/// A ball and a robot's shell, both smooth plastic.
inline constexpr double shellFriction = 0.3;

/// The floor against something of this restitution, at least.
ContactSurface floorSurface(const FloorSpec& floor, double restitution);

/// How long a hit lasts whose momentum is given over within one step, however short: half a period of 0.1 kg on the
/// floor's spring of 2·10⁴ N/m is 7 ms; it is the standard worlds' step.
inline constexpr double hitDuration_s = 0.008;

/// Makes ODE's contact joints of one step.
class ContactBuilder {
 public:
  explicit ContactBuilder(const OdeSession& session) : session_(session) {}

  void begin(double step, double gravity_m_s2, SlidingFriction sliding);
  /// Contact of `first` (the normal points to it) with `second` (nullptr: what never moves). Force on the first body:
  ///   normal    max(0, k·depth − d·v)  implicit: ERP = hk/(hk+d), CFM = 1/(hk+d);  a hit with restitution e: v' = −e·v
  ///   exactly friction  at most μ times the normal force along each of two directions. With slip both are those
  ///   of slip and the surface creeps by slip·force (in a hit: by slip·momentum/hitDuration_s, whatever the step);
  ///   without slip the first one is the direction of sliding. Isotropic friction leaves the second one free as soon
  ///   as the sliding is faster than what a step can turn; Coulomb's law is its limit for small steps.
  /// A point that is still apart but will touch within the step takes part: it may approach until it touches, not
  /// further, so that fast parts do not dive in by a step's way. Returns true if the point touches or will.
  bool add(const ContactPoint& point, dBodyID first, dBodyID second, const ContactSurface& surface);
  /// Slower hits are resting contact [m/s].
  double bounceAbove_m_s() const { return bounceAbove_; }
  /// How far apart surfaces matter whose points are this fast.
  static double margin(double speed, double step) { return 1.5 * step * speed + 1e-4; }
  /// Removes the step's contacts.
  void clear();
  /// Keeps the forces of all contacts; costs a little and changes no bit of the motion.
  void measureForces(bool on) { measure_ = on; }
  /// Sum of those with what never moves in the last step [N].
  const Eigen::Vector3d& floorForce_n() const { return floorForce_; }
  const std::vector<ContactForce>& forces() const { return forces_; }

 private:
  const OdeSession& session_;
  double step_ = 0;
  SlidingFriction sliding_ = SlidingFriction::box;
  bool measure_ = false;
  struct Feedback {
    dJointFeedback forces{};
    Eigen::Vector3d place_m;
    bool floor;  ///< the second one never moves
  };
  std::deque<Feedback> feedback_;  ///< of each contact; places in a deque stay where ODE writes to
  std::vector<ContactForce> forces_;
  Eigen::Vector3d floorForce_ = Eigen::Vector3d::Zero();
  double bounceAbove_ = 0;
};

}  // namespace btr
