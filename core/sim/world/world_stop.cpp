// When robots need not be simulated any more: a ball that was kicked is out of their reach.
#include <algorithm>

#include "core/sim/world/world_impl.h"

namespace btr {
namespace {
using Eigen::Vector3d;

constexpr double faster_m_s = 0.25;  ///< than a part is now, it may become
constexpr double apart_m = 0.03;     ///< within which steps are divided, and some room

Vector3d horizontal(const Vector3d& v) { return {v.x(), v.y(), 0}; }

/// Its velocity once it no longer slips: of v and the speed u of its underside friction leaves v − u·f/(1+f).
Vector3d rollingVelocity(const BallState& ball, double inertiaFactor) {
  const Vector3d slip = horizontal(ball.velocity_m_s - ball.spin_rad_s.cross(Vector3d(0, 0, ball.radius_m)));
  return horizontal(ball.velocity_m_s) - slip * inertiaFactor / (1 + inertiaFactor);
}

bool isPushed(const WorldBall& ball) {
  return ball.spec->directedRolling_m_s2 != std::array<double, 3>{} ||
         std::any_of(ball.effects.begin(), ball.effects.end(), [&](const SceneEffect* placed) {
           return placed->effect->ballForce(ball.state, placed->values).norm() > 0;
         });
}

}  // namespace

/// Of each solid of the body, which lies within a sphere. The gap between that and the ball is a concave function of
/// time: where it is open now and at the end, it stays open.
bool World::Impl::outruns(const WorldBall& ball, const RobotBody& body, double horizon_s) const {
  const Vector3d rolling = rollingVelocity(ball.state, ball.spec->inertiaFactor);
  const double fastest = body.velocity_m_s.norm() + body.spin_rad_s.norm() * body.reach_m + faster_m_s;
  const double deceleration = ball.spec->rollingDeceleration_m_s2;
  return std::all_of(body.colliders.begin(), body.colliders.end(), [&](const Collider& collider) {
    const Vector3d way = ball.state.position_m - body.pose * collider.pose.translation();
    const double gap = way.norm() - collider.bound_m - ball.spec->radius_m - apart_m;
    if (gap <= 0) return false;
    const Vector3d direction = way.normalized();
    const double slowest = std::min(rolling.dot(direction), ball.state.velocity_m_s.dot(direction));
    if (slowest <= 0) return false;
    const double rolls_s = deceleration > 0 ? std::min(horizon_s, slowest / deceleration) : horizon_s;
    return gap + (slowest - deceleration / 2 * rolls_s) * rolls_s - fastest * horizon_s > 0;
  });
}

bool World::ballsOutrun(double horizon_s) const {
  const Impl& world = *impl_;
  if (world.balls.size() != 1 || !world.obstacles.empty() || !world.pulls.empty() || world.scene.robotsCollide ||
      !world.scene.floor || horizontal(world.scene.gravity_m_s2).norm() > 0)
    return false;
  const WorldBall& ball = world.balls.front();
  if (!ball.state.onFloor || ball.touched || isPushed(ball)) return false;
  return std::all_of(world.robots.begin(), world.robots.end(), [&](const WorldRobot& robot) {
    return !robot.body->fixedBase() &&
           std::all_of(robot.body->bodies.begin(), robot.body->bodies.end(),
                       [&](const RobotBody& body) { return world.outruns(ball, body, horizon_s); });
  });
}

void World::stopRobots() {
  impl_->robotsStopped = true;
  for (auto& robot : impl_->robots)
    for (const auto& body : robot.body->bodies) dBodyDisable(body.id);
}

}  // namespace btr
