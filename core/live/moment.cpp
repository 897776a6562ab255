#include "core/live/moment.h"

#include <algorithm>

#include "core/live/session.h"
#include "core/model/joint_range.h"

namespace btr {
namespace {

std::array<double, 3> arrayOf(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Of a robot or an obstacle.
template <class Spec>
void place(Spec& spec, const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  spec.position_m = arrayOf(pose.translation());
  spec.orientation_wxyz = {q.w(), q.x(), q.y(), q.z()};
}

/// Angles and velocities of the joints that follow no other one, and of the base where it is free.
void bend(RobotSpec& spec, const RobotModel& model, const RobotMemory& memory, const RobotReadings& now) {
  spec.jointStart.clear();
  spec.jointRate.clear();
  std::size_t moving = 0;
  for (const Joint& joint : model.joints) {
    if (joint.type == Joint::Type::fixed) continue;
    // Not what its sensors say.
    const JointMemory& at = memory.joints.at(moving++);
    if (joint.mimic) continue;
    // A stop that is pressed yields; a scene begins at it.
    const auto [lower, upper] = stopsOf(joint);
    spec.jointStart[joint.name] = std::clamp(at.position, lower, upper);
    if (at.driveRate != 0) spec.jointRate[joint.name] = at.driveRate;
  }
  if (spec.base != "free") return;
  spec.velocity_m_s = arrayOf(now.baseVelocity_m_s);
  spec.spin_rad_s = arrayOf(now.baseSpin_rad_s);
}

}  // namespace

SceneSpec momentOf(const Session& session) {
  const World& world = session.world();
  const WorldMemory memory = world.memory();
  SceneSpec scene = session.game().scene;
  for (std::size_t i = 0; i < scene.robots.size(); ++i) {
    place(scene.robots[i], world.linkPoses(i).front());
    bend(scene.robots[i], session.scene().robots[i].model, memory.robots.at(i), world.robot(i));
  }
  for (std::size_t i = 0; i < scene.balls.size(); ++i) {
    const BallState state = world.ball(i);
    scene.balls[i].position_m = arrayOf(state.position_m);
    scene.balls[i].velocity_m_s = arrayOf(state.velocity_m_s);
    scene.balls[i].spin_rad_s = arrayOf(state.spin_rad_s);
  }
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    const ObstacleState& state = world.obstacle(i);
    place(scene.obstacles[i], state.pose);
    scene.obstacles[i].velocity_m_s = arrayOf(state.velocity_m_s);
    scene.obstacles[i].spin_rad_s = arrayOf(state.spin_rad_s);
  }
  return scene;
}

}  // namespace btr
