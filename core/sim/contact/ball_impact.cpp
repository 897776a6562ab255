#include "core/sim/contact/ball_impact.h"

#include <algorithm>
#include <cmath>

namespace btr {
namespace {

using Eigen::Vector3d;

/// Impulse along the floor on a point that slides with `sliding`, that gives way by `yield` [m/s per N·s], and is held
/// by at most `most`.
Vector3d alongFloor(const Vector3d& sliding, double yield, double most, const ContactSurface& surface) {
  if (surface.slip1_m_s_n > 0 || surface.slip2_m_s_n > 0) {
    const Vector3d first = surface.slip1Along, second = Vector3d::UnitZ().cross(first);
    const auto part = [&](const Vector3d& axis, double slip) -> Vector3d {
      return std::clamp(-sliding.dot(axis) / (yield + slip / hitDuration_s), -most, most) * axis;
    };
    return part(first, surface.slip1_m_s_n) + part(second, surface.slip2_m_s_n);
  }
  const double speed = sliding.norm();
  if (speed <= 0) return Vector3d::Zero();
  return -sliding / speed * std::min(speed / yield, most);
}

/// When a parabola that begins above the floor first comes down to it [s], or NaN.
double meets(double height, double rate, double acceleration) {
  const double root = rate * rate - 2 * acceleration * height;
  if (root < 0) return NAN;
  // The way that loses no digits: rate and root add up.
  const double down = -rate + std::sqrt(root);
  if (rate < 0) return 2 * height / down;
  return acceleration < 0 ? (rate + std::sqrt(root)) / -acceleration : NAN;
}

}  // namespace

void hitFloor(BallMotion& ball, const BallBody& body, const ContactSurface& surface) {
  const double inertia = body.inertiaFactor * body.mass_kg * body.radius_m * body.radius_m;
  const Vector3d lowest(0, 0, -body.radius_m);
  Vector3d sliding = ball.velocity_m_s + ball.spin_rad_s.cross(lowest);
  sliding.z() = 0;
  const double approach = -ball.velocity_m_s.z();
  const double restitution = surface.restitution / (1 + surface.bounceLoss_s_m * approach);
  const double upward = (1 + restitution) * body.mass_kg * approach;
  Vector3d impulse = alongFloor(sliding, 1 / body.mass_kg + body.radius_m * body.radius_m / inertia,
                                surface.friction * upward, surface);
  ball.spin_rad_s += lowest.cross(impulse) / inertia;
  impulse.z() = upward;
  ball.velocity_m_s += impulse / body.mass_kg;
}

bool flyAndHit(BallMotion& ball, const Vector3d& acceleration, const BallBody& body, const ContactSurface& surface,
               double slowest_m_s, double step) {
  const double until = meets(ball.position_m.z() - body.radius_m, ball.velocity_m_s.z(), acceleration.z());
  if (!(until <= step)) return false;
  BallMotion flown = ball;
  const auto fly = [&](double time) {
    flown.position_m += time * flown.velocity_m_s + time * time / 2 * acceleration;
    flown.velocity_m_s += time * acceleration;
  };
  fly(until);
  if (!(-flown.velocity_m_s.z() > slowest_m_s)) return false;
  flown.position_m.z() = body.radius_m;
  hitFloor(flown, body, surface);
  fly(step - until);
  ball = flown;
  return true;
}

}  // namespace btr
