// What stands inside something else.
#include <algorithm>
#include <cmath>

#include "core/sim/world/world_impl.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

/// Of each pair the deepest place.
class Overlaps {
 public:
  explicit Overlaps(double least_m) : least_m_(least_m) {}
  void add(const std::string& first, const std::string& second, double depth_m) {
    if (!(depth_m >= least_m_)) return;
    const auto known = std::ranges::find_if(
        found_, [&](const Overlap& overlap) { return overlap.first == first && overlap.second == second; });
    if (known == found_.end())
      found_.push_back({first, second, depth_m});
    else
      known->depth_m = std::max(known->depth_m, depth_m);
  }
  void add(const std::string& first, const std::string& second, const std::vector<ContactPoint>& points) {
    for (const ContactPoint& point : points) add(first, second, point.depth_m);
  }
  std::vector<Overlap> found() && { return std::move(found_); }

 private:
  double least_m_;
  std::vector<Overlap> found_;
};

}  // namespace

std::string Overlap::text() const {
  const std::string how_mm = digits(1000 * depth_m, 2);
  return second.empty()
             ? first + " stands " + how_mm + " mm in the floor: it will be pushed out"
             : first + " and " + second + " are " + how_mm + " mm inside one another: they will be pushed apart";
}

std::vector<Overlap> World::overlaps(double least_m) const {
  Impl& world = *impl_;
  Overlaps found(least_m);
  std::vector<ContactPoint> points;
  /// Calls action(collider, where its body is) for each collider of a robot.
  const auto forColliders = [](const WorldRobot& robot, const auto& action) {
    for (const RobotBody& body : robot.body->bodies)
      for (const Collider& collider : body.colliders) action(collider, body.pose);
    for (const Collider& collider : robot.body->baseColliders) action(collider, robot.body->poseOf(-1));
  };
  /// Calls action(solid, whether it moves) for each of a robot's solids, where they are now.
  const auto forSolids = [&world](WorldRobot& robot, const auto& action) {
    for (std::size_t b = 0; b < robot.solids.size(); ++b)
      for (const SolidGeom& part : world.solidsOf(robot, b)) action(part, b < robot.body->bodies.size());
  };
  const auto ballInside = [&](const Collider& collider, const Eigen::Isometry3d& pose, const WorldBall& ball) {
    ContactPoint point;
    return sphereContact(collider, pose, ball.state.position_m, ball.spec->radius_m, 0, point) ? point.depth_m : 0;
  };

  for (std::size_t i = 0; i < world.robots.size(); ++i) {
    WorldRobot& robot = world.robots[i];
    const std::string& name = robot.scene->name;
    std::ranges::fill(robot.placed, 0);  // solids are put where the bodies are now
    if (world.scene.floor && robot.scene->freeBase)
      for (const RobotBody& body : robot.body->bodies)
        for (const Collider& collider : body.colliders) {
          floorContacts(collider, body.pose, 0, points);
          found.add(name, "", points);
        }
    for (const WorldBall& ball : world.balls)
      forColliders(robot, [&](const Collider& collider, const Eigen::Isometry3d& pose) {
        found.add(name, ball.spec->name, ballInside(collider, pose, ball));
      });
    const auto meet = [&](const SolidGeom& part, const std::string& other, const SolidGeom& facing) {
      const double reach = part.collider().bound_m + facing.collider().bound_m;
      if ((part.pose().translation() - facing.pose().translation()).squaredNorm() > reach * reach) return;
      if (solidContacts(part, facing, points)) found.add(name, other, points);
    };
    forSolids(robot, [&](const SolidGeom& part, bool moves) {
      for (const WorldObstacle& obstacle : world.obstacles)
        if (moves || obstacle.id) meet(part, obstacle.spec->name, *obstacle.solid);
      for (std::size_t j = 0; world.scene.robotsCollide && j < i; ++j)
        forSolids(world.robots[j], [&](const SolidGeom& facing, bool alsoMoves) {
          if (moves || alsoMoves) meet(part, world.robots[j].scene->name, facing);
        });
    });
  }
  for (std::size_t i = 0; i < world.obstacles.size(); ++i) {
    const WorldObstacle& obstacle = world.obstacles[i];
    for (std::size_t j = 0; j < i; ++j)
      if ((obstacle.id || world.obstacles[j].id) && solidContacts(*obstacle.solid, *world.obstacles[j].solid, points))
        found.add(obstacle.spec->name, world.obstacles[j].spec->name, points);
    const SolidGeom& solid = *obstacle.solid;
    for (const WorldBall& ball : world.balls)
      found.add(ball.spec->name, obstacle.spec->name,
                ballInside(solid.collider(), solid.pose() * solid.collider().pose.inverse(), ball));
  }
  for (std::size_t i = 0; i < world.balls.size(); ++i) {
    const WorldBall& ball = world.balls[i];
    if (world.scene.floor) found.add(ball.spec->name, "", ball.spec->radius_m - ball.state.position_m.z());
    for (std::size_t j = 0; j < i; ++j) {
      const WorldBall& other = world.balls[j];
      found.add(ball.spec->name, other.spec->name,
                ball.spec->radius_m + other.spec->radius_m - (ball.state.position_m - other.state.position_m).norm());
    }
  }
  return std::move(found).found();
}

}  // namespace btr
