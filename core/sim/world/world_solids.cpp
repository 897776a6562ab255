// Obstacles, and robots that run into them and into each other.
#include <algorithm>
#include <cmath>

#include "core/sim/contact/obstacle_shape.h"
#include "core/sim/engine/ode_body.h"
#include "core/sim/world/world_impl.h"

namespace btr {
namespace {
using Eigen::Isometry3d;
using Eigen::Vector3d;

Isometry3d poseOf(const ObstacleSpec& spec) {
  const auto& q = spec.orientation_wxyz;
  return Eigen::Translation3d(spec.position_m[0], spec.position_m[1], spec.position_m[2]) *
         Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
}

/// Half of the edges of a box that holds the obstacle, in the frame of its collider.
Vector3d halfOf(const ObstacleSpec& spec) {
  if (spec.shape == "sphere") return Vector3d::Constant(spec.radius_m);
  if (spec.shape == "cylinder") return {spec.radius_m, spec.size_m[2] / 2, spec.radius_m};
  return Vector3d(spec.size_m[0], spec.size_m[1], spec.size_m[2]) / 2;
}

/// Whether a sphere is so far from the obstacle that nothing within it can touch: long walls have large spheres.
bool isAway(const WorldObstacle& obstacle, const Vector3d& centre, double radius) {
  constexpr double rounding_m = 1e-6;
  const Isometry3d& pose = obstacle.solid->pose();
  const Vector3d at = pose.linear().transpose() * (centre - pose.translation());
  const double far = radius + rounding_m;
  return (at.cwiseAbs() - obstacle.half_m).cwiseMax(0).squaredNorm() > far * far;
}

}  // namespace

void World::Impl::makeObstacles() {
  for (const ObstacleSpec& spec : scene.obstacles) {
    WorldObstacle obstacle;
    obstacle.spec = &spec;
    obstacle.half_m = halfOf(spec);
    Isometry3d place = Isometry3d::Identity();
    if (spec.mass_kg > 0) {
      const Inertial inertial = obstacleInertial(spec);
      obstacle.centre_m = inertial.centreOfMass_m;
      place = Eigen::Translation3d(-inertial.centreOfMass_m);
      obstacle.id = dBodyCreate(session.world());
      dBodySetFiniteRotationMode(obstacle.id, 1);
      setMass(obstacle.id, inertial.mass_kg, inertial.inertia_kg_m2);
    }
    obstacle.solid = std::make_unique<SolidGeom>(makeCollider(obstacleShape(spec), place, -1));
    ObstacleState state;
    state.pose = poseOf(spec);
    state.velocity_m_s << spec.velocity_m_s[0], spec.velocity_m_s[1], spec.velocity_m_s[2];
    state.spin_rad_s << spec.spin_rad_s[0], spec.spin_rad_s[1], spec.spin_rad_s[2];
    placeObstacle(obstacle, state);
    obstacles.push_back(std::move(obstacle));
  }
}

void World::Impl::makeSolids() {
  if (obstacles.empty() && !(scene.robotsCollide && robots.size() > 1)) return;
  for (auto& robot : robots) {
    robot.solids.resize(robot.body->bodies.size() + 1);
    robot.placed.assign(robot.solids.size(), 0);
    for (std::size_t b = 0; b < robot.body->bodies.size(); ++b)
      for (const Collider& collider : robot.body->bodies[b].colliders) robot.solids[b].emplace_back(collider);
    for (const Collider& collider : robot.body->baseColliders) robot.solids.back().emplace_back(collider);
  }
}

// The body stands at the middle of mass, the obstacle's frame at its middle.
void World::Impl::placeObstacle(WorldObstacle& obstacle, const ObstacleState& state) {
  obstacle.state = state;
  if (!obstacle.id) {
    obstacle.state.velocity_m_s.setZero();
    obstacle.state.spin_rad_s.setZero();
    obstacle.solid->place(state.pose);
    return;
  }
  const Vector3d centre = state.pose * obstacle.centre_m;
  const Vector3d velocity = state.velocity_m_s + state.spin_rad_s.cross(centre - state.pose.translation());
  Isometry3d body = state.pose;
  body.translation() = centre;
  setPose(obstacle.id, body);
  dBodySetLinearVel(obstacle.id, velocity.x(), velocity.y(), velocity.z());
  dBodySetAngularVel(obstacle.id, state.spin_rad_s.x(), state.spin_rad_s.y(), state.spin_rad_s.z());
  readObstacle(obstacle);
}

void World::Impl::readObstacle(WorldObstacle& obstacle) {
  const dReal* p = dBodyGetPosition(obstacle.id);
  const dReal* r = dBodyGetRotation(obstacle.id);
  const dReal* v = dBodyGetLinearVel(obstacle.id);
  const dReal* w = dBodyGetAngularVel(obstacle.id);
  ObstacleState& state = obstacle.state;
  state.pose.linear() << r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10];
  const Vector3d centre = state.pose.linear() * obstacle.centre_m;
  state.spin_rad_s << w[0], w[1], w[2];
  state.pose.translation() = Vector3d(p[0], p[1], p[2]) - centre;
  state.velocity_m_s = Vector3d(v[0], v[1], v[2]) - state.spin_rad_s.cross(centre);
  Isometry3d body = state.pose;
  body.translation() << p[0], p[1], p[2];
  obstacle.solid->place(body);
}

// After ODE's step. Where only gravity acted the mean of both velocities is the exact parabola, as for robots.
void World::Impl::settleObstacles(double h) {
  for (auto& obstacle : obstacles) {
    if (!obstacle.id) continue;
    if (!obstacle.touched) {
      const dReal* p = dBodyGetPosition(obstacle.id);
      const Vector3d moved = Vector3d(p[0], p[1], p[2]) - h * h / 2 * scene.gravity_m_s2;
      dBodySetPosition(obstacle.id, moved.x(), moved.y(), moved.z());
    }
    readObstacle(obstacle);
  }
}

void World::Impl::touchObstacle(std::size_t index, double h) {
  WorldObstacle& obstacle = obstacles[index];
  const SolidGeom& solid = *obstacle.solid;
  const ObstacleSpec& spec = *obstacle.spec;
  const auto with = [&](double friction, double restitution) {
    return ContactSurface{friction, std::max(restitution, spec.restitution)};
  };
  const auto speedOf = [](const ObstacleState& state, double reach) {
    return state.velocity_m_s.norm() + reach * state.spin_rad_s.norm();
  };

  if (obstacle.id && scene.floor) {
    ContactSurface surface = floorSurface(*scene.floor, std::max(scene.floor->restitution, spec.restitution));
    surface.friction = std::min(surface.friction, spec.friction);
    const double margin = contacts.margin(speedOf(obstacle.state, solid.collider().bound_m), h);
    floorContacts({solid.collider().kind, Isometry3d::Identity(), solid.collider().size_m, solid.collider().bound_m,
                   solid.collider().hull, -1},
                  solid.pose(), margin, points);
    for (const auto& point : points) obstacle.touched |= contacts.add(point, obstacle.id, nullptr, surface);
  }
  for (auto& ball : balls) {
    const double speed = ball.state.velocity_m_s.norm() + speedOf(obstacle.state, solid.collider().bound_m);
    ContactPoint point;
    if (!sphereContact(solid.collider(), solid.pose() * solid.collider().pose.inverse(), ball.state.position_m,
                       ball.spec->radius_m, contacts.margin(speed, h), point))
      continue;
    if (!contacts.add(point, ball.id, obstacle.id, with(spec.friction, ball.spec->restitution))) continue;
    ball.touched = obstacle.touched = true;
  }
  touchRobots(obstacle);
  for (std::size_t j = 0; j < index; ++j) {
    WorldObstacle& other = obstacles[j];
    if (!obstacle.id && !other.id) continue;
    const bool turned = !obstacle.id;
    if (!(turned ? solidContacts(*other.solid, solid, points) : solidContacts(solid, *other.solid, points))) continue;
    const ContactSurface surface = with(std::min(spec.friction, other.spec->friction), other.spec->restitution);
    for (const auto& point : points)
      contacts.add(point, turned ? other.id : obstacle.id, turned ? nullptr : other.id, surface);
    obstacle.touched = other.touched = true;
  }
}

void World::Impl::touchRobots(WorldObstacle& obstacle) {
  for (auto& robot : robots) {
    const bool away = isAway(obstacle, robot.middle_m, robot.reach_m);
    for (std::size_t b = 0; b < robot.solids.size(); ++b) {
      const bool base = b == robot.body->bodies.size();
      if (base && !obstacle.id) continue;  // neither of them moves
      if (!base && away) continue;
      if (!base && isAway(obstacle, robot.body->bodies[b].pose.translation(), robot.body->bodies[b].reach_m)) continue;
      for (const SolidGeom& part : solidsOf(robot, b)) {
        if (!solidContacts(part, *obstacle.solid, points)) continue;
        for (const auto& point : points)
          contacts.add(point, base ? nullptr : robot.body->bodies[b].id, obstacle.id,
                       {obstacle.spec->friction, std::max(0.0, obstacle.spec->restitution)});
        robot.contact[static_cast<std::size_t>(part.collider().link)] = 1;
        robot.touches = obstacle.touched = true;
      }
    }
  }
}

/// Two robots: shells of smooth plastic.
void World::Impl::meet(WorldRobot& robot, WorldRobot& other) {
  if (!robot.body->fixedBase() && !other.body->fixedBase()) {
    const double apart = robot.reach_m + other.reach_m;
    if ((robot.middle_m - other.middle_m).squaredNorm() > apart * apart) return;
  }
  for (std::size_t a = 0; a < robot.solids.size(); ++a)
    for (std::size_t b = 0; b < other.solids.size(); ++b) {
      const bool still = a == robot.body->bodies.size(), otherStill = b == other.body->bodies.size();
      if (still && otherStill) continue;
      if (!still && !otherStill) {
        const RobotBody &mine = robot.body->bodies[a], &its = other.body->bodies[b];
        const double reach = mine.reach_m + its.reach_m;
        if ((mine.pose.translation() - its.pose.translation()).squaredNorm() > reach * reach) continue;
      }
      for (const SolidGeom& part : solidsOf(robot, a))
        for (const SolidGeom& facing : solidsOf(other, b)) {
          if (!(still ? solidContacts(facing, part, points) : solidContacts(part, facing, points))) continue;
          const dBodyID mine = still ? nullptr : robot.body->bodies[a].id;
          const dBodyID its = otherStill ? nullptr : other.body->bodies[b].id;
          for (const auto& point : points)
            contacts.add(point, still ? its : mine, still ? nullptr : its, {shellFriction, 0});
          robot.contact[static_cast<std::size_t>(part.collider().link)] = 1;
          other.contact[static_cast<std::size_t>(facing.collider().link)] = 1;
          robot.touches = other.touches = true;
        }
    }
}

/// A body's solids, where it is now.
const std::vector<SolidGeom>& World::Impl::solidsOf(WorldRobot& robot, std::size_t body) const {
  std::vector<SolidGeom>& solids = robot.solids[body];
  if (robot.placed[body]) return solids;
  robot.placed[body] = 1;
  const bool base = body == robot.body->bodies.size();
  for (SolidGeom& part : solids) part.place(base ? robot.body->poseOf(-1) : robot.body->bodies[body].pose);
  return solids;
}

void World::Impl::touchSolids(double h) {
  for (auto& obstacle : obstacles) obstacle.touched = false;
  for (auto& robot : robots) {
    std::fill(robot.placed.begin(), robot.placed.end(), 0);
    if (robot.solids.empty() || robot.body->bodies.empty()) continue;
    robot.middle_m = robot.body->bodies[0].pose.translation();
    robot.reach_m = 0;
    for (const RobotBody& body : robot.body->bodies)
      robot.reach_m = std::max(robot.reach_m, (body.pose.translation() - robot.middle_m).norm() + body.reach_m);
  }
  for (std::size_t i = 0; i < obstacles.size(); ++i) touchObstacle(i, h);
  if (!scene.robotsCollide) return;
  for (std::size_t i = 0; i < robots.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) meet(robots[i], robots[j]);
}

}  // namespace btr
