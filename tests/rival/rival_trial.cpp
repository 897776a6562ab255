#include "tests/rival/rival_trial.h"

#include <cmath>

#include "tests/rival/mujoco_world.h"

namespace btr::rival {
namespace {
using Eigen::Vector3d;

constexpr double atRest_m_s = 2e-3;

/// One trial while it runs.
class RivalTrial {
 public:
  RivalTrial(const Scene& scene, const TrialOptions& options)
      : scene_(scene), robot_(scene.robots.at(0)), options_(options), world_(scene), inputs_(joints()) {
    for (std::size_t j = 0; j < joints(); ++j) inputs_[j].command = robot_.jointStart[j];
  }

  TrialResult run(const Controller& controller, const Values& settings, std::span<const double> parameters) {
    TrialResult result;
    if (options_.recordTrace) nameChannels(result.trace);
    const auto motion = controller.begin(scene_, settings, parameters);
    world_.start(robot_.jointStart);
    result.baseStart_m = world_.base().translation();
    for (std::size_t i = 0; i < scene_.balls.size(); ++i)
      result.balls.push_back({world_.ball(i).position_m, world_.ball(i).position_m});
    record(result);

    const double end = motion->duration(), half = scene_.controlPeriod_s / 2;
    for (;;) {
      if (world_.failed()) {
        result.outcome = TrialResult::Outcome::exploded;
        result.detail = "MuJoCo: a bad acceleration, speed or position at " + toText(world_.time()) + " s";
        break;
      }
      const bool moving = world_.time() < end - half;
      if (!moving && (ballsRollFree() || world_.time() > end + options_.settle_s - half)) break;
      if (world_.time() > options_.maximum_s - half) {
        if (moving) {
          result.outcome = TrialResult::Outcome::timedOut;
          result.detail = "the motion was not over after " + toText(options_.maximum_s) + " simulated seconds";
        }
        break;
      }
      if (moving) motion->command(world_.time(), readings(), inputs_);
      world_.advance(inputs_, scene_.controlPeriod_s);
      if (!world_.failed()) record(result);  // a failed world begins anew, its clock too
    }
    result.remarks = motion->remarks();
    conclude(result);
    return result;
  }

 private:
  std::size_t joints() const { return robot_.model.joints.size(); }
  bool moves(std::size_t joint) const { return robot_.model.joints[joint].type != Joint::Type::fixed; }

  RobotReadings readings() const {
    RobotReadings readings;
    readings.base = world_.base();
    readings.torque.assign(joints(), 0);
    readings.contact.assign(robot_.model.links.size(), 0);
    for (std::size_t j = 0; j < joints(); ++j) {
      readings.position.push_back(world_.position(j));
      readings.rate.push_back(world_.rate(j));
    }
    return readings;
  }

  void nameChannels(Trace& trace) const {
    trace.channels = {"time_s"};
    for (const char* axis : {"x_m", "y_m", "z_m"}) trace.channels.push_back(robot_.name + ".base." + axis);
    for (std::size_t j = 0; j < joints(); ++j) {
      if (!moves(j)) continue;
      const std::string name = robot_.name + "." + robot_.model.joints[j].name;
      trace.channels.push_back(name + ".position_rad");
      trace.channels.push_back(name + ".command_rad");
    }
    for (const BallSpec& ball : scene_.balls)
      for (const char* axis : {".x_m", ".y_m", ".z_m"}) trace.channels.push_back(ball.name + axis);
  }

  void record(TrialResult& result) {
    const Eigen::Isometry3d base = world_.base();
    const auto& axes = base.linear();
    result.basePath.push_back({base.translation(), std::atan2(axes(1, 0), axes(0, 0)), axes(2, 2)});
    if (!options_.recordTrace) return;
    auto& values = result.trace.values;
    const double dt = values.empty() ? 0 : scene_.controlPeriod_s;
    values.push_back(world_.time());
    values.insert(values.end(), base.translation().begin(), base.translation().end());
    for (std::size_t j = 0; j < joints(); ++j) {
      if (!moves(j)) continue;
      values.push_back(world_.measured(j, dt));
      values.push_back(inputs_[j].command);
    }
    for (std::size_t i = 0; i < scene_.balls.size(); ++i) {
      const Vector3d place = world_.ball(i).position_m;
      values.insert(values.end(), place.begin(), place.end());
    }
  }

  /// On the floor, touched by nothing else, and at rest or under way.
  bool ballsRollFree() const {
    for (std::size_t i = 0; i < scene_.balls.size(); ++i)
      if (!rollsFree(i)) return false;
    return true;
  }
  bool rollsFree(std::size_t i) const {
    const BallState ball = world_.ball(i);
    return ball.onFloor && !world_.ballTouched(i) && std::abs(ball.velocity_m_s.z()) < 0.02;
  }

  void conclude(TrialResult& result) const {
    result.simulated_s = world_.time();
    result.controlPeriod_s = scene_.controlPeriod_s;
    for (std::size_t i = 0; i < result.balls.size(); ++i) {
      const BallState ball = world_.ball(i);
      const Vector3d v(ball.velocity_m_s.x(), ball.velocity_m_s.y(), 0);
      const double deceleration = scene_.balls[i].rollingDeceleration_m_s2;
      result.balls[i].rest_m = ball.position_m;
      if (options_.closedFormRoll && rollsFree(i) && deceleration > 0 && v.norm() > atRest_m_s)
        result.balls[i].rest_m += v * v.norm() / (2 * deceleration);
    }
    const Eigen::Isometry3d base = world_.base();
    result.baseEnd_m = base.translation();
    result.fell = base.linear()(2, 2) < 0.5;
  }

  const Scene& scene_;
  const SceneRobot& robot_;
  const TrialOptions& options_;
  MujocoWorld world_;
  std::vector<JointInput> inputs_;
};

}  // namespace

TrialResult runMujocoTrial(const Scene& scene, const Controller& controller, const Values& settings,
                           std::span<const double> parameters, const TrialOptions& options) {
  return RivalTrial(scene, options).run(controller, settings, parameters);
}

RealWorld mujocoWorld() {
  return {"MuJoCo", [](const PreparedExperiment& prepared, const Scene& arranged, std::span<const double> parameters,
                       bool recordTrace) {
            TrialOptions options;
            options.maximum_s = valueOf(stageParameters(), prepared.spec.stages, "trial_maximum_s");
            options.recordTrace = recordTrace;
            return runMujocoTrial(arranged, *prepared.controller, prepared.spec.controller.settings, parameters,
                                  options);
          }};
}

}  // namespace btr::rival
