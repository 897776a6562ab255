// Who touches whom, and what balls feel beside contact forces.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/sim/contact/ball_impact.h"
#include "core/sim/world/world_impl.h"

namespace btr {
namespace {
using Eigen::Isometry3d;
using Eigen::Vector3d;
}  // namespace

ContactSurface floorSurface(const FloorSpec& floor, double restitution) {
  ContactSurface surface{floor.friction,      restitution + (1 - restitution) * floor.bounce,
                         floor.stiffness_n_m, floor.damping_n_s_m,
                         floor.slip1_m_s_n,   floor.slip2_m_s_n};
  surface.bounceLoss_s_m = floor.bounceLoss_s_m;
  if (floor.slipXY_m_s_n != 0) {
    // The axes in which slip is two numbers.
    Eigen::Matrix2d slip;
    slip << floor.slip1_m_s_n, floor.slipXY_m_s_n, floor.slipXY_m_s_n, floor.slip2_m_s_n;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(slip);
    surface.slip1_m_s_n = std::max(0.0, axes.eigenvalues()[1]);
    surface.slip2_m_s_n = std::max(0.0, axes.eigenvalues()[0]);
    surface.slip1Along << axes.eigenvectors().col(1), 0;
  }
  return surface;
}

void World::Impl::touchFloor(WorldRobot& robot, RobotBody& body, double h) {
  const double margin = contacts.margin(body.velocity_m_s.norm() + body.spin_rad_s.norm() * body.reach_m, h);
  if (body.pose.translation().z() >= body.reach_m + margin) return;
  for (const auto& collider : body.colliders) {
    floorContacts(collider, body.pose, margin, points);
    for (const auto& point : points) {
      if (!contacts.add(point, body.id, nullptr, robotFloor)) continue;
      robot.contact[static_cast<std::size_t>(collider.link)] = 1;
      robot.touches = true;
    }
  }
}

void World::Impl::touchBalls(WorldRobot& robot, const RobotBody* body, double h) {
  const auto& colliders = body ? body->colliders : robot.body->baseColliders;
  const Isometry3d& pose = body ? body->pose : robot.body->poseOf(-1);
  for (auto& ball : balls) {
    double speed = ball.state.velocity_m_s.norm();
    if (body) speed += body->velocity_m_s.norm() + body->spin_rad_s.norm() * body->reach_m;
    const double margin = contacts.margin(speed, h);
    const double reach = ball.spec->radius_m + margin + (body ? body->reach_m : 0);
    if (body && (ball.state.position_m - pose.translation()).squaredNorm() >= reach * reach) continue;
    for (const auto& collider : colliders) {
      ContactPoint point;
      if (!sphereContact(collider, pose, ball.state.position_m, ball.spec->radius_m, margin, point)) continue;
      if (!contacts.add(point, ball.id, body ? body->id : nullptr, {shellFriction, ball.spec->restitution})) continue;
      robot.contact[static_cast<std::size_t>(collider.link)] = 1;
      robot.touches = true;
      ball.touched = true;
    }
  }
}

void World::Impl::touchOthers(std::size_t index, double h) {
  WorldBall& ball = balls[index];
  const double speed = ball.state.velocity_m_s.norm();
  if (scene.floor && ball.state.position_m.z() < ball.spec->radius_m + contacts.margin(speed, h)) {
    const Vector3d lowest = ball.state.position_m - Vector3d(0, 0, ball.spec->radius_m);
    ball.state.onFloor =
        contacts.add({lowest, Vector3d::UnitZ(), -lowest.z()}, ball.id, nullptr,
                     floorSurface(*scene.floor, std::max(scene.floor->restitution, ball.spec->restitution)));
  }
  for (std::size_t j = 0; j < index; ++j) {
    WorldBall& other = balls[j];
    const Vector3d between = ball.state.position_m - other.state.position_m;
    const double distance = between.norm(), reach = ball.spec->radius_m + other.spec->radius_m;
    if (distance < 1e-12 || distance >= reach + contacts.margin(speed + other.state.velocity_m_s.norm(), h)) continue;
    const Vector3d normal = between / distance;
    if (contacts.add({ball.state.position_m - normal * ball.spec->radius_m, normal, reach - distance}, ball.id,
                     other.id, {shellFriction, std::max(ball.spec->restitution, other.spec->restitution)}))
      ball.touched = other.touched = true;
  }
}

void World::Impl::makeContacts(double h) {
  contacts.begin(h, scene.gravity_m_s2.norm(), scene.slidingFriction);
  if (scene.floor) robotFloor = floorSurface(*scene.floor, scene.floor->restitution);
  for (auto& ball : balls) {
    ball.touched = false;
    ball.state.onFloor = false;
  }
  for (auto& robot : robots) {
    if (robotsStopped) break;
    std::fill(robot.contact.begin(), robot.contact.end(), 0);
    robot.touches = false;
    for (auto& body : robot.body->bodies) {
      if (scene.floor) touchFloor(robot, body, h);
      touchBalls(robot, &body, h);
    }
    touchBalls(robot, nullptr, h);
  }
  for (std::size_t i = 0; i < balls.size(); ++i) touchOthers(i, h);
  touchSolids(h);
}

// Rolling resistance: a moment M against horizontal spin. A ball that rolls freely (I = f·m·r²) loses a =
// M/((1+f)·m·r).
void World::Impl::brakeRolling(WorldBall& ball, double h) {
  const BallSpec& spec = *ball.spec;
  const double perDeceleration = ball.state.onFloor ? (1 + spec.inertiaFactor) * spec.mass_kg * spec.radius_m : 0;
  double most = spec.rollingDeceleration_m_s2 * perDeceleration;
  Vector3d along(ball.state.spin_rad_s.x(), ball.state.spin_rad_s.y(), 0);
  const double spin = along.norm();
  along = spin > 1e-9 ? Vector3d(along / spin) : Vector3d::UnitX();
  const double inertia = (1 + spec.inertiaFactor) * spec.mass_kg * spec.radius_m * spec.radius_m;
  if (const auto& [xx, xy, yy] = spec.directedRolling_m_s2; xx != 0 || xy != 0 || yy != 0) {
    // The ball rolls along v = spin × up; the moment that slows it by A²·v/|A·v| has a part across its spin.
    Eigen::Matrix2d matrix;
    matrix << xx, xy, xy, yy;
    matrix += spec.rollingDeceleration_m_s2 * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d rolling(along.y(), -along.x());
    const Eigen::Vector2d pulled = matrix * rolling;
    const double strength = pulled.norm();
    const Eigen::Vector2d deceleration = strength > 0 ? Eigen::Vector2d(matrix * pulled / strength) : pulled;
    most = deceleration.dot(rolling) * perDeceleration;
    if (spin * inertia > 3 * h * most) {
      const Eigen::Vector2d aside = (deceleration - deceleration.dot(rolling) * rolling) * -perDeceleration;
      // A moment M turns the spin; the velocity changes along M × up.
      dBodyAddTorque(ball.id, -aside.y(), aside.x(), 0);
    }
  }
  // It turns only against the motion: what pushes aside bends the way. A ball that stops within a few steps is held.
  const double across = spin * inertia > 3 * h * most ? 0 : most;
  dJointSetAMotorAxis(ball.rolling, 0, 0, along.x(), along.y(), 0);
  dJointSetAMotorAxis(ball.rolling, 1, 0, -along.y(), along.x(), 0);
  dJointSetAMotorParam(ball.rolling, dParamFMax, most);
  dJointSetAMotorParam(ball.rolling, dParamFMax2, across);
}

void World::Impl::driveBall(WorldBall& ball, double now, double h) {
  if (ball.rolling) brakeRolling(ball, h);
  if (ball.effects.empty()) return;

  BallState state = ball.state;
  state.time = now;
  const double speed = state.velocity_m_s.norm();
  for (const SceneEffect* placed : ball.effects) {
    Vector3d force = placed->effect->ballForce(state, placed->values);
    // A force of a dissipative effect that brakes fades with the speed that it takes away: it cannot turn the ball
    // round.
    if (const double braking = -force.dot(state.velocity_m_s); placed->effect->dissipative() && braking > 0)
      force /= 1 + h * braking / (speed * speed * ball.spec->mass_kg);
    dBodyAddForce(ball.id, force.x(), force.y(), force.z());
  }
}

void World::Impl::placeBall(WorldBall& ball, const BallState& state) {
  dBodySetPosition(ball.id, state.position_m.x(), state.position_m.y(), state.position_m.z());
  dBodySetLinearVel(ball.id, state.velocity_m_s.x(), state.velocity_m_s.y(), state.velocity_m_s.z());
  dBodySetAngularVel(ball.id, state.spin_rad_s.x(), state.spin_rad_s.y(), state.spin_rad_s.z());
  readBall(ball, state.time);
  ball.state.onFloor = scene.floor && state.position_m.z() <= ball.spec->radius_m + 1e-9;
}

void World::Impl::readBall(WorldBall& ball, double now) {
  const dReal* p = dBodyGetPosition(ball.id);
  const dReal* v = dBodyGetLinearVel(ball.id);
  const dReal* w = dBodyGetAngularVel(ball.id);
  const dReal* q = dBodyGetQuaternion(ball.id);
  ball.state.time = now;
  ball.state.position_m << p[0], p[1], p[2];
  ball.state.velocity_m_s << v[0], v[1], v[2];
  ball.state.spin_rad_s << w[0], w[1], w[2];
  ball.state.radius_m = ball.spec->radius_m;
  ball.state.mass_kg = ball.spec->mass_kg;
  ball.pose = Eigen::Translation3d(ball.state.position_m) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
}

/// A ball that flew through this step and would have come to lie below the floor hits it on the way. (ODE's contacts
/// know whole steps alone: a hit would wait for the next one, up to a step's way too deep and too late.)
void World::Impl::bounce(WorldBall& ball, const BallState& before, double h) {
  const BallSpec& spec = *ball.spec;
  if (!scene.floor || ball.state.position_m.z() >= spec.radius_m || before.position_m.z() < spec.radius_m) return;
  const ContactSurface surface = floorSurface(*scene.floor, std::max(scene.floor->restitution, spec.restitution));
  BallMotion motion{before.position_m, before.velocity_m_s, before.spin_rad_s};
  const Vector3d acceleration = (ball.state.velocity_m_s - before.velocity_m_s) / h;
  if (!(surface.restitution > 0) || !flyAndHit(motion, acceleration, {spec.radius_m, spec.mass_kg, spec.inertiaFactor},
                                               surface, contacts.bounceAbove_m_s(), h))
    return;
  ball.state.position_m = motion.position_m;
  ball.state.velocity_m_s = motion.velocity_m_s;
  ball.state.spin_rad_s = motion.spin_rad_s;
  dBodySetLinearVel(ball.id, motion.velocity_m_s.x(), motion.velocity_m_s.y(), motion.velocity_m_s.z());
  dBodySetAngularVel(ball.id, motion.spin_rad_s.x(), motion.spin_rad_s.y(), motion.spin_rad_s.z());
}

bool World::Impl::strains(std::size_t index, const std::vector<JointInput>& inputs) const {
  const WorldRobot& robot = robots[index];
  for (const auto& joint : robot.body->joints) {
    const auto model = static_cast<std::size_t>(joint.modelJoint);
    const Drive& drive = robot.scene->drives[model];
    if (drive.kind == Drive::Kind::servo && inputs[model].enabled &&
        drive.p * inputs[model].pTimes * std::abs(inputs[model].command - joint.position) > drive.maxTorque)
      return true;
  }
  return false;
}

bool World::Impl::nearBall(const std::vector<std::vector<JointInput>>& inputs, double h) const {
  // A limb that strains near a ball is about to hit it: then all of its swing is taken in small steps, not its end
  // alone. Else what counts is the way that both can go in the next 50 ms.
  // Scenes with isotropic friction, which came later, measure from surface to surface, so that a fifth of the reach
  // does: the others keep the spheres about their solids, and with them the bits of what is stored.
  const bool bySurface = scene.slidingFriction == SlidingFriction::isotropic;
  const double reach_m = bySurface ? 0.01 : 0.05;
  constexpr double ahead_s = 0.05;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const bool straining = strains(i, inputs[i]);
    for (const auto& ball : balls)
      for (const auto& body : robots[i].body->bodies) {
        const double speed =
            (ball.state.velocity_m_s - body.velocity_m_s).norm() + body.reach_m * body.spin_rad_s.norm();
        double way = straining ? reach_m : std::max(std::min(ahead_s * speed, reach_m), h * speed);
        if (bySurface) way = std::max(way, h * speed);
        const double apart = 0.005 + way, gap = apart + ball.spec->radius_m;
        if ((ball.state.position_m - body.pose.translation()).norm() > gap + body.reach_m) continue;
        ContactPoint nearest;
        for (const auto& collider : body.colliders) {
          if ((body.pose * collider.pose.translation() - ball.state.position_m).norm() >= gap + collider.bound_m)
            continue;
          if (!bySurface ||
              sphereContact(collider, body.pose, ball.state.position_m, ball.spec->radius_m, apart, nearest))
            return true;
        }
      }
  }
  return false;
}

}  // namespace btr
