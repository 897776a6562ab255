#include "core/sim/trial.h"

#include <cmath>
#include <optional>

#include "core/sim/senses.h"
#include "core/sim/world.h"
#include "core/spec/error.h"

namespace btr {
namespace {
using Eigen::Vector3d;

using namespace rolling_free;

Vector3d horizontal(const Vector3d& v) { return {v.x(), v.y(), 0}; }

/// One trial while it runs.
class Trial {
 public:
  Trial(const Scene& scene, std::uint64_t seed, const TrialOptions& options)
      : scene_(scene), options_(options), seed_(seed), world_(scene, seed), inputs_(scene.robots.size()) {
    for (std::size_t i = 0; i < scene.robots.size(); ++i) {
      const SceneRobot& robot = scene.robots[i];
      inputs_[i].resize(robot.model.joints.size());
      // Robots that nobody drives hold their starting position.
      for (std::size_t j = 0; j < robot.jointStart.size(); ++j)
        if (robot.drives[j].kind != Drive::Kind::torque) inputs_[i][j].command = robot.jointStart[j];
    }
  }

  TrialResult run(const Controller& controller, const Values& settings, std::span<const double> parameters) {
    TrialResult result;
    if (options_.recordTrace) result.trace.channels = world_.channels();
    std::unique_ptr<Motion> motion;
    if (!scene_.robots.empty()) {
      if (controller.looks())
        throw InputError("controller", "one that looks through the robot's camera",
                         "one without a camera: trials have no pictures, games and the open interface have");
      senseFor(controller);
      motion = controller.begin(scene_, settings, parameters);
      result.baseStart_m = world_.robot(0).base.translation();
    }
    for (std::size_t i = 0; i < scene_.balls.size(); ++i) {
      const Vector3d start = world_.ball(i).position_m;
      result.balls.push_back({start, start});
    }
    record(result);

    const double motionEnd = motion ? motion->duration() : 0;
    const double half = scene_.controlPeriod_s / 2;
    for (;;) {
      if (!world_.fault().empty()) {
        result.outcome = TrialResult::Outcome::exploded;
        result.detail = world_.fault() + " at " + toText(world_.time()) + " s";
        break;
      }
      const bool moving = world_.time() < motionEnd - half;
      if (!moving && settled(motionEnd)) break;
      if (world_.time() > options_.maximum_s - half) {
        if (moving) {
          result.outcome = TrialResult::Outcome::timedOut;
          result.detail = "the motion was not over after " + toText(options_.maximum_s) + " simulated seconds";
        }
        break;
      }
      if (options_.ballsOnly && !robotsStopped_ && world_.ballsOutrun(motionEnd + afterMotion_s - world_.time())) {
        world_.stopRobots();
        robotsStopped_ = true;
      }
      // After its end a motion's last commands are held.
      if (moving && !robotsStopped_) {
        if (senses_) motion->sense(sensed());
        motion->command(world_.time(), readings_, inputs_[0]);
      }
      world_.advance(inputs_, scene_.controlPeriod_s);
      ++period_;
      record(result);
    }
    if (motion) result.remarks = motion->remarks();
    conclude(result);
    return result;
  }

 private:
  /// What the controller asks for is sensed from the start on; nothing else is.
  void senseFor(const Controller& controller) {
    const std::vector<SenseSpec> wanted = controller.senses();
    if (wanted.empty()) return;
    senses_.emplace(wanted, scene_.robots.front(), seed_, "the controller's senses");
    world_.measureAcceleration(0);
  }

  /// Nobody's hand is in a trial.
  MotionSenses sensed() {
    senses_->sense(world_, 0, {}, period_, scene_.controlPeriod_s);
    row_.clear();
    senses_->sample(row_);
    return {seed_, period_, senses_->channels(), row_};
  }

  /// Reads the first robot, too.
  void record(TrialResult& result) {
    if (options_.recordTrace) world_.sample(result.trace.values);
    if (scene_.robots.empty() || robotsStopped_) return;
    world_.read(0, readings_);
    const auto& axes = readings_.base.linear();
    result.basePath.push_back({readings_.base.translation(), std::atan2(axes(1, 0), axes(0, 0)), axes(2, 2)});
  }

  /// True if nothing more is to be seen after the motion.
  bool settled(double motionEnd) const {
    if (options_.closedFormRoll && world_.time() > motionEnd + options_.settle_s - scene_.controlPeriod_s / 2)
      return true;
    for (std::size_t i = 0; i < scene_.balls.size(); ++i)
      if (!(options_.closedFormRoll ? rollsOut(i) : rests(i))) return false;
    return true;
  }

  bool rests(std::size_t i) const {
    const BallState ball = world_.ball(i);
    return ball.onFloor && ball.velocity_m_s.norm() < atRest_m_s && !world_.ballTouched(i);
  }

  /// Rolls freely on the floor, away from the robot, under nothing but its uniform deceleration: its rest point is
  /// known.
  bool rollsOut(std::size_t i) const {
    if (rests(i)) return true;
    const BallState ball = world_.ball(i);
    if (!rollsFreely(i) || scene_.balls[i].rollingDeceleration_m_s2 <= 0) return false;
    for (std::size_t robot = 0; robot < scene_.robots.size(); ++robot) {
      const Vector3d away = horizontal(ball.position_m - world_.robot(robot).base.translation());
      if (away.dot(ball.velocity_m_s) <= 0) return false;
    }
    return scene_.balls.size() == 1 || !mayMeet(i);
  }

  bool rollsFreely(std::size_t i) const {
    const BallState ball = world_.ball(i);
    if (!ball.onFloor || world_.ballTouched(i) || std::abs(ball.velocity_m_s.z()) > bounce_m_s) return false;
    if (horizontal(scene_.gravity_m_s2).norm() > 1e-9) return false;
    for (const auto& placed : scene_.effects)
      if (placed.effect->ballForce(ball, placed.values).norm() > 0) return false;
    const Vector3d slip = horizontal(ball.velocity_m_s - ball.spin_rad_s.cross(Vector3d(0, 0, ball.radius_m)));
    return slip.norm() <= slipShare * horizontal(ball.velocity_m_s).norm();
  }

  bool mayMeet(std::size_t i) const {
    const BallState ball = world_.ball(i);
    const double way = rollingWay(i).norm();
    for (std::size_t j = 0; j < scene_.balls.size(); ++j)
      if (j != i && (world_.ball(j).position_m - ball.position_m).norm() <
                        way + rollingWay(j).norm() + ball.radius_m + scene_.balls[j].radius_m)
        return true;
    return false;
  }

  /// v²/(2a) along the speed that the ball has when it no longer slips: of v and the speed u of its underside, friction
  /// leaves v − u·f/(1+f) (the 5/7 rule for a solid ball, 3/5 for a shell, f = I/(m·r²)).
  Vector3d rollingWay(std::size_t i) const {
    const double deceleration = scene_.balls[i].rollingDeceleration_m_s2;
    if (deceleration <= 0) return Vector3d::Zero();
    const BallState ball = world_.ball(i);
    const double f = scene_.balls[i].inertiaFactor;
    const Vector3d slip = horizontal(ball.velocity_m_s - ball.spin_rad_s.cross(Vector3d(0, 0, ball.radius_m)));
    const Vector3d rolling = horizontal(ball.velocity_m_s) - slip * f / (1 + f);
    return rolling * rolling.norm() / (2 * deceleration);
  }

  void conclude(TrialResult& result) const {
    result.simulated_s = world_.time();
    result.controlPeriod_s = scene_.controlPeriod_s;
    for (std::size_t i = 0; i < result.balls.size(); ++i) {
      result.balls[i].rest_m = world_.ball(i).position_m;
      if (options_.closedFormRoll && result.outcome == TrialResult::Outcome::finished && rollsFreely(i))
        result.balls[i].rest_m += rollingWay(i);
    }
    if (scene_.robots.empty()) return;
    const auto base = world_.robot(0).base;
    result.baseEnd_m = base.translation();
    result.fell = base.linear()(2, 2) < 0.5;
  }

  /// A ball that rolls lets a trial end with the motion, or soon after it.
  static constexpr double afterMotion_s = 0.1;

  const Scene& scene_;
  const TrialOptions& options_;
  std::uint64_t seed_;
  World world_;
  std::vector<std::vector<JointInput>> inputs_;
  RobotReadings readings_;  ///< of the first robot, as last recorded
  std::optional<Senses> senses_;
  std::vector<double> row_;  ///< of the senses, as last sampled
  long period_ = 0;
  bool robotsStopped_ = false;
};

}  // namespace

const char* toText(TrialResult::Outcome outcome) {
  switch (outcome) {
    case TrialResult::Outcome::finished:
      return "finished";
    case TrialResult::Outcome::exploded:
      return "exploded";
    case TrialResult::Outcome::timedOut:
      return "timed out";
    case TrialResult::Outcome::workerDied:
      break;
  }
  return "worker died";
}

bool isFinished(const std::string& outcome) { return outcome == toText(TrialResult::Outcome::finished); }

TrialResult runTrial(const Scene& scene, const Controller& controller, const Values& settings,
                     std::span<const double> parameters, std::uint64_t seed, const TrialOptions& options) {
  return Trial(scene, seed, options).run(controller, settings, parameters);
}

}  // namespace btr
