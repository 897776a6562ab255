#pragma once
#include <Eigen/Core>

#include "core/sim/contact/contact_builder.h"

namespace btr {

/// Where a ball is and how it moves, world frame.
struct BallMotion {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero(), spin_rad_s = Eigen::Vector3d::Zero();
};

/// What decides a ball's hit.
struct BallBody {
  double radius_m = 0, mass_kg = 0;
  double inertiaFactor = 0;  ///< I = factor·m·r²
};

/// A hit on the level floor in no time, the same law as a contact's that bounces (ContactBuilder::add): v' = −e·v along
/// the normal, e falling with the speed; along the floor an impulse of at most μ times the normal one against the
/// sliding of the ball's lowest point, as large as it takes to end that (with creep: to bring it to
/// slip·impulse/hitDuration_s along either axis).
void hitFloor(BallMotion& ball, const BallBody& body, const ContactSurface& surface);

/// The motion `step` seconds later of a ball that flies under a constant acceleration and meets the floor (z = 0) on
/// the way, at the instant at which its parabola does: how a bounce ends is a smooth function of how it began, whatever
/// the steps. Nothing is changed, and false returned, where it does not meet the floor or is not faster then than
/// `slowest_m_s`.
bool flyAndHit(BallMotion& ball, const Eigen::Vector3d& acceleration_m_s2, const BallBody& body,
               const ContactSurface& surface, double slowest_m_s, double step);

}  // namespace btr
