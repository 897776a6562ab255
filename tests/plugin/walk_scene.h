#pragma once
#include "core/model/four_legs.h"
#include "core/model/load_model.h"
#include "tests/plugin/built_plugins.h"

namespace btr::test {

inline const RobotModel& walkingDog() {
  static const RobotModel model = loadModel(SOURCE_DIR "/resources/robots/ers7.wrl");
  return model;
}

/// An ERS-7 without a world, arranged by a controller.
inline Scene walkScene(const std::string& controller, const Values& settings = {}) {
  Scene scene;
  scene.floor = FloorSpec{};
  scene.controlPeriod_s = 0.008;
  SceneRobot robot;
  robot.name = "ers7";
  robot.model = walkingDog();
  robot.drives.resize(robot.model.joints.size());
  scene.robots.push_back(robot);
  host().controller(controller)->arrange(scene, settings);
  return scene;
}

/// The defaults of a controller's genotype, with some replaced by name.
inline std::vector<double> gaitWith(const std::string& controller, const Values& changed = {}) {
  return resolve(host().controller(controller)->genotype(), changed, "test");
}

/// A motion's commands, read period by period, and the feet that they mean.
struct Walking {
  std::string controller;
  Values settings;
  Scene scene;
  std::unique_ptr<Motion> motion;
  FourLegs legs;
  long leadIn;

  Walking(const std::string& name, const Values& parameters, const Values& task = {})
      : controller(name),
        settings(task),
        scene(walkScene(name, task)),
        motion(host().controller(name)->begin(scene, task, gaitWith(name, parameters))),
        legs(FourLegs::of(scene.robots[0].model, "test")),
        leadIn(std::lround((task.contains("lead_in_s") ? task.at("lead_in_s") : 0.5) / scene.controlPeriod_s)) {}

  std::vector<double> commands(long frame) const {
    std::vector<JointInput> inputs(scene.robots[0].model.joints.size());
    motion->command(static_cast<double>(frame) * scene.controlPeriod_s, {}, inputs);
    std::vector<double> result;
    for (const JointInput& input : inputs) result.push_back(input.command);
    return result;
  }

  LegAngles angles(std::size_t leg, long frame) const {
    const auto all = commands(leadIn - 1 + frame);
    LegAngles result;
    for (std::size_t j = 0; j < 3; ++j) result[j] = all[legs.legs[leg].joints[j]];
    return result;
  }

  /// Lowest point of the foot in the hip's frame (y outward), `frame` periods after the gait's first.
  Eigen::Vector3d contact(std::size_t leg, long frame) const {
    return legs.legs[leg].geometry.foot(angles(leg, frame)) - Eigen::Vector3d(0, 0, legs.legs[leg].footRadius_m);
  }

  /// After how many periods all commands repeat, up to `most`.
  long cycle(long most = 400) const {
    for (long period = 1; period < most; ++period) {
      bool same = true;
      for (long frame = 0; same && frame < most; ++frame)
        same = commands(leadIn - 1 + frame) == commands(leadIn - 1 + frame + period);
      if (same) return period;
    }
    return 0;
  }

  /// Where the contact is in the ground's axes, seen from the leg's operating point; that is in the hip's frame, y
  /// outward. The ground is the plane through the operating points of front and rear legs.
  Eigen::Vector3d onGround(std::size_t leg, long frame, const Eigen::Vector3d& front,
                           const Eigen::Vector3d& rear) const {
    const double slope = std::atan2(front.z() - rear.z(), 0.130 + front.x() - rear.x());
    const Eigen::Vector3d away = contact(leg, frame) - (leg < 2 ? front : rear);
    return {std::cos(slope) * away.x() + std::sin(slope) * away.z(), away.y(),
            std::cos(slope) * away.z() - std::sin(slope) * away.x()};
  }

  double infeasible() const { return motion->remarks().at("infeasible_points"); }
};

}  // namespace btr::test
