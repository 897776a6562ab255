#include "core/live/moment.h"

#include "core/live/session.h"

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

void bend(RobotSpec& spec, const RobotModel& model, const std::vector<double>& positions) {
  spec.jointStart.clear();
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    if (model.joints[j].type != Joint::Type::fixed) spec.jointStart[model.joints[j].name] = positions[j];
}

}  // namespace

SceneSpec momentOf(const Session& session) {
  const World& world = session.world();
  SceneSpec scene = session.game().scene;
  for (std::size_t i = 0; i < scene.robots.size(); ++i) {
    place(scene.robots[i], world.linkPoses(i).front());
    bend(scene.robots[i], session.scene().robots[i].model, world.jointPositions(i));
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
