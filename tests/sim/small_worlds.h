#pragma once
// The smallest robots and scenes that a test needs, built in memory.
#include <cmath>
#include <string>
#include <vector>

#include "core/sim/scene.h"
#include "core/sim/world.h"

namespace btr::test {

inline constexpr double g = 9.81;

inline Shape sphere(double radius, const Eigen::Vector3d& at = Eigen::Vector3d::Zero()) {
  Shape shape;
  shape.kind = Shape::Kind::sphere;
  shape.size_m.x() = radius;
  shape.pose.translation() = at;
  return shape;
}

inline Shape box(const Eigen::Vector3d& size, const Eigen::Vector3d& at = Eigen::Vector3d::Zero()) {
  Shape shape;
  shape.size_m = size;
  shape.pose.translation() = at;
  return shape;
}

inline Link link(const std::string& name, double mass, const Eigen::Vector3d& centre, const Eigen::Vector3d& inertia,
                 std::vector<Shape> shapes = {}) {
  Link result;
  result.name = name;
  result.inertial = {mass, centre, inertia.asDiagonal()};
  result.shapes = std::move(shapes);
  return result;
}

inline Joint joint(const std::string& name, int parent, const Eigen::Vector3d& axis,
                   const Eigen::Vector3d& at = Eigen::Vector3d::Zero(), Joint::Type type = Joint::Type::rotate) {
  Joint result;
  result.name = name;
  result.parentLink = parent;
  result.axis = axis;
  result.origin.translation() = at;
  result.type = type;
  return result;
}

inline SceneRobot robot(RobotModel model, bool freeBase, const Drive& drive = {.kind = Drive::Kind::none}) {
  SceneRobot result;
  result.name = model.name;
  result.freeBase = freeBase;
  result.drives.assign(model.joints.size(), drive);
  result.jointStart.assign(model.joints.size(), 0);
  result.jointStartRate.assign(model.joints.size(), 0);
  result.model = std::move(model);
  return result;
}

/// A body that hangs from a fixed base: joint "hinge" about y at the origin, centre of mass `length` below.
inline RobotModel pendulumModel(double mass, double length, double inertia) {
  RobotModel model;
  model.name = "rig";
  model.links = {link("stand", 1, {0, 0, 0}, {1, 1, 1}),
                 link("arm", mass, {0, 0, -length}, {inertia, inertia, inertia})};
  model.joints = {joint("hinge", 0, {0, 1, 0})};
  return model;
}

/// A wheel on a fixed base without gravity's moment: only its inertia about y counts.
inline RobotModel wheelModel(double inertia) { return pendulumModel(1, 0, inertia); }

/// A carriage of that mass which slides along x.
inline RobotModel carriageModel(double mass) {
  RobotModel model = pendulumModel(mass, 0, 1);
  model.joints[0] = joint("rail", 0, {1, 0, 0}, {0, 0, 0}, Joint::Type::slide);
  return model;
}

/// One free body.
inline RobotModel bodyModel(double mass, const Eigen::Vector3d& inertia, std::vector<Shape> shapes) {
  RobotModel model;
  model.name = "body";
  model.links = {link("trunk", mass, {0, 0, 0}, inertia, std::move(shapes))};
  return model;
}

inline Scene sceneOf(SceneRobot robot, double step, double period = 0.008) {
  Scene scene;
  scene.step_s = step;
  scene.controlPeriod_s = period;
  scene.robots = {std::move(robot)};
  return scene;
}

inline Scene ballScene(const BallSpec& ball, double step) {
  Scene scene;
  scene.step_s = step;
  scene.floor = FloorSpec{};
  scene.balls = {ball};
  return scene;
}

/// Inputs that give every joint of the scene the same command.
inline std::vector<std::vector<JointInput>> commands(const Scene& scene, double command) {
  std::vector<std::vector<JointInput>> inputs;
  for (const auto& each : scene.robots) inputs.emplace_back(each.model.joints.size(), JointInput{command});
  return inputs;
}

/// Gravity only along −z or none.
inline Scene weightless(Scene scene) {
  scene.gravity_m_s2.setZero();
  return scene;
}

}  // namespace btr::test
