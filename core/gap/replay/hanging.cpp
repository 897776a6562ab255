#include "core/gap/replay/hanging.h"

#include <algorithm>
#include <cmath>

#include "core/model/kinematics.h"

namespace btr {
namespace {

/// Of each link's weight on the joint that carries it, positive where it pushes to larger positions [N·m or N].
std::vector<double> weightsOnJoints(const RobotModel& model, const Eigen::Isometry3d& base,
                                    const std::vector<double>& positions, const Eigen::Vector3d& gravity) {
  const auto links = forwardKinematics(model, base, positions);
  std::vector<double> weights(model.joints.size());
  for (std::size_t link = 1; link < links.size(); ++link) {
    const Inertial& body = model.links[link].inertial;
    const Eigen::Vector3d force = body.mass_kg * gravity, centre = links[link] * body.centreOfMass_m;
    for (std::size_t carrier = link; carrier > 0;) {
      const Joint& joint = model.joints[carrier - 1];
      const Eigen::Vector3d axis = links[carrier].linear() * joint.axis;
      if (joint.type == Joint::Type::rotate)
        weights[carrier - 1] += (centre - links[carrier].translation()).cross(force).dot(axis);
      if (joint.type == Joint::Type::slide) weights[carrier - 1] += force.dot(axis);
      carrier = static_cast<std::size_t>(joint.parentLink);
    }
  }
  return weights;
}

}  // namespace

std::vector<std::vector<bool>> recordedJoints(const Scene& scene, const Binding& binding) {
  std::vector<std::vector<bool>> recorded;
  for (const SceneRobot& robot : scene.robots) recorded.emplace_back(robot.model.joints.size());
  for (const auto* columns : {&binding.measured, &binding.startOnly})
    for (const Binding::Measured& measured : *columns)
      if (measured.what == Binding::Measured::What::position) recorded[measured.object][measured.part] = true;
  for (const Binding::Input& input : binding.inputs) recorded[input.robot][input.joint] = true;
  return recorded;
}

void letUnrecordedServosHang(const Scene& scene, const Binding& binding, StartState& state) {
  // A hanging joint moves its own lever, and those of the joints before it.
  constexpr int turns = 50;
  constexpr double still_rad = 1e-9;
  const auto recorded = recordedJoints(scene, binding);
  for (std::size_t r = 0; r < scene.robots.size(); ++r) {
    const SceneRobot& robot = scene.robots[r];
    if (robot.freeBase && !scene.floor) continue;  // in free fall nothing weighs
    const auto standsStill = [&](std::size_t j) {
      return robot.drives[j].kind == Drive::Kind::servo && robot.drives[j].p > 0 && state.robots[r].rates[j] == 0;
    };
    std::vector<std::size_t> hanging;
    for (std::size_t j = 0; j < robot.model.joints.size(); ++j)
      if (!recorded[r][j] && standsStill(j)) hanging.push_back(j);
    if (hanging.empty()) continue;
    const std::vector<double> told = state.robots[r].positions;
    double moved = 1;
    for (int turn = 0; turn < turns && moved > still_rad; ++turn) {
      moved = 0;
      const auto weights =
          weightsOnJoints(robot.model, state.robots[r].base, state.robots[r].positions, scene.gravity_m_s2);
      for (const std::size_t j : hanging) {
        const Drive& drive = robot.drives[j];
        const Joint& joint = robot.model.joints[j];
        const double held = std::clamp(weights[j], -drive.maxTorque, drive.maxTorque);
        const double hangs = std::clamp(told[j] + held / drive.p, joint.lower, joint.upper);
        moved = std::max(moved, std::abs(hangs - state.robots[r].positions[j]));
        state.robots[r].positions[j] = hangs;
      }
    }
  }
}

}  // namespace btr
