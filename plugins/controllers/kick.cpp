/// The kick of the UCHILSIM papers: two configurations of the twelve leg joints evolve, accumulation and release, and
/// the number of points between them. Four phases:
///   1 from the starting configuration to the accumulation, slowly      (accumulate_s)
///   2 there for a moment                                               (hold_s)
///   3 accumulation → release in N points, one each control period      (fast: N · 8 ms)
///   4 release → starting configuration, slowly                         (return_s)
/// All joints move along straight lines in joint space. The starting configuration is the stance of the walk, paws 45
/// mm ahead of the front hips and 38 mm behind the rear ones, hips 120 mm high. Head, tail and mouth hold the position
/// nearest to zero that they can take: neck upright, head level, mouth closed, so above and out of the ball's way.
///
/// Task: the ball lies at distance d from the neck joint's ground projection, in direction β; α is where it should go.
/// Both angles are in the robot's frame, 0 straight ahead, positive to the left (the papers' β is 90° for straight
/// ahead). The robot stands at the world's origin and looks along x, so its frame is the world's.
///
/// Angles as in OPEN-R, rad: J1 positive swings the foot away from the body's middle, J2 outward, J3 folds the knee the
/// way of J1; the same for left and right, so a kick is mirrored by exchanging the numbers of the left and right legs.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "core/robot/robot.h"

namespace {

constexpr std::size_t legJoints = 12;

/// One joint of a leg: how far a kick may move it (inside the ERS-7's software limits: J1 −2.0 … 2.27 front and −2.27
/// … 2.0 rear, J2 −0.17 … 1.53, J3 −0.43 … 2.12) and where the stance has it.
struct Range {
  double lowest, highest, stance;
};
constexpr std::array<Range, 3> front{{{-1.0, 1.9, -0.23}, {-0.17, 0.9, 0.01}, {-0.4, 1.9, 1.35}}};
constexpr std::array<Range, 3> rear{{{-1.2, 1.0, -0.37}, {-0.17, 0.7, 0.01}, {-0.2, 1.9, 1.61}}};

/// Leg joint i = 0 … 11: LF J1, J2, J3, RF …, LR …, RR ….
const Range& rangeOf(std::size_t i) { return (i < 6 ? front : rear)[i % 3]; }
std::string legOf(std::size_t i) { return btr::FourLegs::names[i / 3]; }
std::string jointName(std::size_t i) { return legOf(i) + "_J" + std::to_string(i % 3 + 1); }

std::size_t jointIndex(const btr::RobotModel& model, const std::string& name) {
  const int index = model.findJoint(name);
  if (index < 0)
    throw btr::InputError("kick: robot \"" + model.name + "\" has no joint " + name +
                          "; it needs LF_J1 … RR_J3 and NECK_TILT");
  return static_cast<std::size_t>(index);
}

/// The stance, by joint of the model.
std::vector<double> stanceOf(const btr::RobotModel& model) {
  std::vector<double> stance = btr::restPositions(model);
  for (std::size_t i = 0; i < legJoints; ++i) {
    const std::size_t j = jointIndex(model, jointName(i));
    stance[j] = std::clamp(rangeOf(i).stance, model.joints[j].lower, model.joints[j].upper);
  }
  return stance;
}

class KickPhases {
 public:
  KickPhases(const uchilsim::Robot& robot, double accumulate_s, double hold_s, double return_s,
             std::span<const double> parameters)
      : period_(robot.period_s),
        start_(robot.start.begin(), robot.start.end()),
        accumulation_(start_),
        release_(start_) {
    const btr::RobotModel& model = robot.model;
    for (std::size_t i = 0; i < legJoints; ++i) {
      const std::size_t j = jointIndex(model, jointName(i));
      const btr::Joint& joint = model.joints[j];
      accumulation_[j] = std::clamp(parameters[i], joint.lower, joint.upper);
      release_[j] = std::clamp(parameters[legJoints + i], joint.lower, joint.upper);
    }
    const auto frames = [&](double seconds) { return std::lround(seconds / period_); };
    const long points = std::lround(parameters[2 * legJoints]);
    ends_ = {frames(accumulate_s), 0, 0, 0};
    ends_[1] = ends_[0] + frames(hold_s);
    ends_[2] = ends_[1] + points;
    ends_[3] = ends_[2] + frames(return_s);
  }

  void targets(double time, std::span<double> targets) const {
    // A target is held for the period, so it is the position to be reached at its end.
    const long frame = std::lround(time / period_) + 1;
    for (std::size_t j = 0; j < targets.size(); ++j) targets[j] = position(frame, j);
  }

  double duration() const { return static_cast<double>(ends_[3]) * period_; }

 private:
  double position(long frame, std::size_t joint) const {
    const double start = start_[joint], accumulation = accumulation_[joint], release = release_[joint];
    if (frame <= ends_[0]) return between(start, accumulation, frame, 0, ends_[0]);
    if (frame <= ends_[1]) return accumulation;
    if (frame <= ends_[2]) return between(accumulation, release, frame, ends_[1], ends_[2]);
    if (frame <= ends_[3]) return between(release, start, frame, ends_[2], ends_[3]);
    return start;
  }
  static double between(double from, double to, long frame, long begin, long end) {
    return frame == end ? to
                        : from + (to - from) * static_cast<double>(frame - begin) / static_cast<double>(end - begin);
  }

  double period_;
  std::vector<double> start_, accumulation_, release_;  ///< by joint of the model [rad]
  std::array<long, 4> ends_{};                          ///< of the four phases, in control periods from the start
};

class Kick final : public uchilsim::Behaviour {
  std::vector<btr::Parameter> parameters() const override {
    std::vector<btr::Parameter> all;
    for (const std::string phase : {"accumulation", "release"})
      for (std::size_t i = 0; i < legJoints; ++i) {
        const Range& range = rangeOf(i);
        all.push_back({phase + "_" + jointName(i) + "_rad", "rad", phase + " angle of " + jointName(i), range.lowest,
                       range.highest, range.stance});
      }
    all.push_back({"points", "", "control periods from accumulation to release", 2, 20, 6, {}, true});
    return all;
  }

  std::vector<btr::Parameter> settings() const override {
    return {{"distance_m", "m", "d: from the neck joint's ground projection to the ball's centre", 0.14, 0.18, 0.16},
            {"bearing_rad", "rad", "beta: direction of the ball from the neck, 0 ahead, positive left", -1.2, 1.2, 0},
            {"direction_rad", "rad", "alpha: where the ball should go, 0 ahead, positive left", -3.1416, 3.1416, 0},
            {"accumulate_s", "s", "time from the stance to the accumulation", 0.1, 5, 0.5},
            {"hold_s", "s", "time in the accumulation", 0, 2, 0.1},
            {"return_s", "s", "time from the release back to the stance", 0.1, 5, 0.5}};
  }

  std::vector<double> posture(const btr::RobotModel& model) const override { return stanceOf(model); }

  void setTask(btr::Scene& scene, const btr::Values& settings) const override {
    if (scene.balls.empty()) throw btr::InputError("kick: the scene has no ball");
    const auto task = btr::resolve(this->settings(), settings, "kick");
    const btr::SceneRobot& robot = scene.robots.front();
    const auto poses = btr::forwardKinematics(robot.model, robot.start, robot.jointStart);
    const Eigen::Vector3d neck = poses[jointIndex(robot.model, "NECK_TILT") + 1].translation();
    btr::BallSpec& ball = scene.balls.front();
    ball.position_m = {neck.x() + task[0] * std::cos(task[1]), neck.y() + task[0] * std::sin(task[1]), ball.radius_m};
    ball.velocity_m_s = {0, 0, 0};
  }

  void start(const uchilsim::Robot& robot, const btr::Values& settings, std::span<const double> p) override {
    assert(p.size() == 2 * legJoints + 1);
    const auto task = btr::resolve(this->settings(), settings, "kick");
    phases_.emplace(robot, task[3], task[4], task[5], p);
  }

  void act(const uchilsim::Senses& senses, uchilsim::Orders& orders) override {
    phases_->targets(senses.time_s, orders.targets);
  }

  double duration_s() const override { return phases_->duration(); }

  std::optional<KickPhases> phases_;
};

}  // namespace

UCHILSIM_ROBOT_CONTROLLER(Kick, "kick")
