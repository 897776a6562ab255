#pragma once
// Small worlds in which every effect has something to do, run with one effect placed in them.
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/sim/tracked_frame.h"
#include "core/sim/world.h"
#include "tests/plugin/built_plugins.h"
#include "tests/sim/small_worlds.h"

namespace btr::test {

/// A scene and what is commanded in it.
struct Trial {
  Scene scene;
  double duration_s = 1;
  bool driven = true;  ///< the servo follows a signal; else it is off
};

/// Two servos on one arm, weights beyond each, a little damping of their own.
inline Scene armScene() {
  RobotModel model;
  model.name = "rig";
  model.links = {link("stand", 1, {0, 0, 0}, {1, 1, 1}), link("arm", 0.3, {0.01, 0, -0.08}, {1e-3, 1e-3, 1e-3}),
                 link("hand", 0.05, {0, 0, -0.05}, {2e-4, 2e-4, 2e-4})};
  model.joints = {joint("hinge", 0, {0, 1, 0}), joint("wrist", 1, {0, 1, 0}, {0, 0, -0.12})};
  const Drive servo{.p = 3, .d = 0.06, .maxTorque = 0.6, .rotorInertia_kg_m2 = 5e-4};
  return sceneOf(robot(model, false, servo), 0.001);
}

/// Sines of 0.4, 1.1 and 2.7 Hz, then steps.
inline double signal(double time) {
  const double turn = 2 * M_PI * time;
  if (time < 1.5) return 0.6 * std::sin(0.4 * turn) + 0.3 * std::sin(1.1 * turn) + 0.1 * std::sin(2.7 * turn);
  return std::fmod(time, 0.8) < 0.4 ? 0.9 : -0.7;
}

inline Trial rolling(double x_m_s, double y_m_s) {
  BallSpec ball{.name = "ball", .velocity_m_s = {x_m_s, y_m_s, 0}};
  ball.spin_rad_s = {-y_m_s / ball.radius_m, x_m_s / ball.radius_m, 0};
  return {ballScene(ball, 0.001), 1.5};
}

/// Thrown so that it spins, and bounces once or twice.
inline Trial flying() {
  const BallSpec ball{
      .name = "ball", .position_m = {0, 0, 0.3}, .velocity_m_s = {2, 1, 1}, .spin_rad_s = {-20, 30, 60}};
  return {ballScene(ball, 0.001), 0.8};
}

/// Let fall from that height, onto a floor that it bounces from.
inline Trial bouncing(double height_m) {
  BallSpec ball{.name = "ball", .position_m = {0, 0, 0.0425 + height_m}, .velocity_m_s = {0.5, 0.2, 0}};
  ball.restitution = 0.7;
  return {ballScene(ball, 0.001), 0.8};
}

/// A box on the floor whose weight pulls it along the floor too.
inline Trial creeping(double x_m_s2, double y_m_s2, double height_m) {
  const Eigen::Vector3d size(0.2, 0.2, 0.1);
  SceneRobot body = robot(bodyModel(0.4, {2e-3, 2e-3, 3e-3}, {box(size)}), true);
  body.start.translation().z() = size.z() / 2 + height_m;
  Scene scene = sceneOf(std::move(body), 0.001);
  scene.floor = FloorSpec{};
  scene.gravity_m_s2 << x_m_s2, y_m_s2, -9.81;
  return {std::move(scene), 0.6};
}

inline std::vector<Trial> trialsFor(Effect::Place place, const std::string& name) {
  if (place == Effect::Place::joint || place == Effect::Place::link || name == "voltage_sag")
    return {{armScene(), 3}, {armScene(), 1.5, false}};
  if (name == "restitution_by_speed") return {bouncing(0.1), bouncing(0.6)};
  if (place == Effect::Place::floor)
    return {creeping(2, 0, 0), creeping(0.5, 1.5, 0), creeping(0.5, 0.3, 0.05), rolling(0.8, 0.4), flying()};
  return {rolling(0.8, 0.4), rolling(0.3, -0.9), flying()};
}

/// `values` in the order of the effect's parameters; those after the last that is given are what they usually are.
inline Scene withEffect(Scene scene, std::shared_ptr<const Effect> effect, const std::string& name,
                        std::vector<double> values, std::string at = "") {
  const auto parameters = effect->parameters();
  if (values.size() > parameters.size()) throw std::invalid_argument(name + " has fewer parameters");
  for (std::size_t i = values.size(); i < parameters.size(); ++i) values.push_back(parameters[i].byDefault);
  if (at.empty()) at = placeFor(effect->place(), "rig.hinge", "rig.arm");
  effect->changeScene(scene, at, values);
  scene.effects.push_back({std::move(effect), name, at, values});
  return scene;
}

struct Recorded {
  std::vector<double> values;  ///< positions of everything, every 8 ms
  std::vector<double> energy;  ///< at the same times [J]
  std::string fault;
};

inline Recorded run(const Scene& scene, const Trial& trial) {
  World world(scene, 1);
  if (!trial.driven)
    for (std::size_t i = 0; i < scene.robots.size(); ++i)
      world.setRobot(i, scene.robots[i].start, {0, 0, 0}, {0, 0, 0}, std::vector{1.2, 0.4}, std::vector{0.0, 0.0});
  Recorded recorded;
  const auto look = [&] {
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
      const RobotReadings now = world.robot(i);
      recorded.values.insert(recorded.values.end(), now.position.begin(), now.position.end());
      if (!scene.robots[i].freeBase) continue;
      const Eigen::Vector3d at = now.base.translation();
      recorded.values.insert(recorded.values.end(), at.begin(), at.end());
    }
    for (std::size_t i = 0; i < scene.balls.size(); ++i) {
      const Eigen::Vector3d at = trackedFrame(scene) * world.ball(i).position_m;
      recorded.values.insert(recorded.values.end(), at.begin(), at.end());
    }
    recorded.energy.push_back(world.energy());
  };
  look();
  const double period = scene.controlPeriod_s;
  for (int i = 0; i < std::lround(trial.duration_s / period) && world.fault().empty(); ++i) {
    auto inputs = commands(scene, signal(i * period));
    for (auto& ofRobot : inputs)
      for (auto& input : ofRobot) input.enabled = trial.driven;
    world.advance(inputs, period);
    if (world.fault().empty()) look();
  }
  recorded.fault = world.fault();
  return recorded;
}

/// All trials of an effect one after the other.
inline std::vector<double> recordingOf(const std::shared_ptr<const Effect>& effect, const std::string& name,
                                       const std::vector<double>& values) {
  std::vector<double> all;
  for (const Trial& trial : trialsFor(effect->place(), name)) {
    const auto recorded = run(withEffect(trial.scene, effect, name, values), trial).values;
    all.insert(all.end(), recorded.begin(), recorded.end());
  }
  return all;
}

}  // namespace btr::test
