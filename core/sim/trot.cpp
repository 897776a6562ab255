#include "core/sim/trot.h"

#include <cmath>

#include "core/model/four_legs.h"
#include "core/model/kinematics.h"
#include "core/spec/error.h"

namespace btr {
namespace {
using Eigen::Vector3d;

// The phases of FourLegs::names.
constexpr std::array<double, 4> phases{0, 0.5, 0.5, 0};

// Where the feet go, in the hips' frames: ERS-7 gaits stand about here.
constexpr double frontX_m = 0.045, rearX_m = -0.04, outward_m = 0.005, frontZ_m = -0.105, rearZ_m = -0.11;
constexpr LegAngles bentFront{0, 0, 1.2}, bentRear{0, 0, 1.4};

/// A leg whose foot is the lowest point of its ball with all angles at zero.
LegGeometry withSole(const FourLegs::Leg& leg) {
  LegGeometry geometry = leg.geometry;
  geometry.shank.z() -= leg.footRadius_m;
  return geometry;
}

class TrotMotion final : public Motion {
 public:
  TrotMotion(const RobotModel& model, const std::vector<double>& setting)
      : cycle_(setting[0]),
        stride_(setting[1]),
        lift_(setting[2]),
        duration_(setting[3]),
        rest_(restPositions(model)),
        dog_(FourLegs::of(model, "trot")) {
    for (std::size_t i = 0; i < 4; ++i) last_[i] = dog_.legs[i].front ? bentFront : bentRear;
  }

  std::vector<double> positions(double time) {
    std::vector<double> result = rest_;
    for (std::size_t i = 0; i < 4; ++i) {
      const FourLegs::Leg& leg = dog_.legs[i];
      const double phase = std::fmod(time / cycle_ + phases[i], 1.0);
      // Half of the cycle on the ground, straight back; half in the air, an ellipse forward.
      const bool air = phase >= 0.5;
      const double s = air ? 2 * phase - 1 : 2 * phase;
      const double x = air ? -stride_ / 2 * std::cos(M_PI * s) : stride_ * (0.5 - s);
      const double z = air ? lift_ * std::sin(M_PI * s) : 0;
      const Vector3d foot((leg.front ? frontX_m : rearX_m) + x, outward_m, (leg.front ? frontZ_m : rearZ_m) + z);
      last_[i] = withSole(leg).solve(foot, last_[i]).angles;
      for (std::size_t j = 0; j < 3; ++j) result[leg.joints[j]] = last_[i][j];
    }
    return result;
  }

  void command(double time, const RobotReadings&, std::span<JointInput> inputs) override {
    const auto wanted = positions(time);
    for (std::size_t j = 0; j < inputs.size(); ++j) inputs[j].command = wanted[j];
  }
  double duration() const override { return duration_; }

 private:
  double cycle_, stride_, lift_, duration_;
  std::vector<double> rest_;
  FourLegs dog_;
  std::array<LegAngles, 4> last_{};
};

SceneRobot& dog(Scene& scene) {
  if (scene.robots.empty()) throw InputError("trot: the scene has no robot");
  return scene.robots.front();
}

}  // namespace

std::vector<Parameter> Trot::settings() const {
  return {{"cycle_s", "s", "time of one cycle", 0.1, 5, 0.48},
          {"stride_m", "m", "way of a foot on the ground", 0, 0.15, 0.06},
          {"lift_m", "m", "height of a foot in the air", 0, 0.08, 0.025},
          {"duration_s", "s", "time of the walk", 0.01, 1000, 10}};
}

void Trot::arrange(Scene& scene, const Values& settings) const {
  SceneRobot& robot = dog(scene);
  TrotMotion motion(robot.model, resolve(this->settings(), settings, "trot"));
  robot.jointStart = motion.positions(0);
  robot.jointStartRate.assign(robot.model.joints.size(), 0);
  robot.start.setIdentity();
  robot.startVelocity_m_s.setZero();
  robot.startSpin_rad_s.setZero();
  // As high as the lowest foot wants.
  const auto poses = forwardKinematics(robot.model, robot.start, robot.jointStart);
  double lowest = 1e9;
  for (const FourLegs::Leg& leg : FourLegs::of(robot.model, "trot").legs)
    lowest = std::min(lowest, (poses[leg.joints[2] + 1] * leg.turned(withSole(leg).shank)).z());
  robot.start.translation().z() = -lowest;
}

std::unique_ptr<Motion> Trot::begin(const Scene& scene, const Values& settings, std::span<const double>) const {
  if (scene.robots.empty()) throw InputError("trot: the scene has no robot");
  return std::make_unique<TrotMotion>(scene.robots.front().model, resolve(this->settings(), settings, "trot"));
}

}  // namespace btr
