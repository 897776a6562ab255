#include "core/sim/trot.h"

#include <cmath>

#include "core/model/kinematics.h"
#include "core/spec/error.h"

namespace btr {
namespace {
using Eigen::Vector3d;

Vector3d turnY(double angle, const Vector3d& v) {
  return {v.x() * std::cos(angle) + v.z() * std::sin(angle), v.y(), v.z() * std::cos(angle) - v.x() * std::sin(angle)};
}

Vector3d turnX(double angle, const Vector3d& v) {
  return {v.x(), v.y() * std::cos(angle) - v.z() * std::sin(angle), v.y() * std::sin(angle) + v.z() * std::cos(angle)};
}

// a·sin t + b·cos t = c, the solution nearer to `last`.
double solve(double a, double b, double c, double last, bool& reached) {
  const double most = std::hypot(a, b);
  if (std::abs(c) > most) reached = false;
  const double middle = std::atan2(a, b), away = std::acos(std::clamp(c / most, -1.0, 1.0));
  const double one = std::remainder(middle + away - last, 2 * M_PI),
               other = std::remainder(middle - away - last, 2 * M_PI);
  return last + (std::abs(one) < std::abs(other) ? one : other);
}

struct Leg {
  const char* name;
  bool front, left;
  double phase;
};
constexpr std::array<Leg, 4> legs{
    {{"LF", true, true, 0}, {"RF", true, false, 0.5}, {"LR", false, true, 0.5}, {"RR", false, false, 0}}};

// Where the feet go, in the hips' frames: ERS-7 gaits stand about here.
constexpr double frontX_m = 0.045, rearX_m = -0.04, outward_m = 0.005, frontZ_m = -0.105, rearZ_m = -0.11;
constexpr LegAngles bentFront{0, 0, 1.2}, bentRear{0, 0, 1.4};

std::size_t jointOf(const RobotModel& model, const std::string& name) {
  const int joint = model.findJoint(name);
  if (joint < 0) throw InputError("trot", model.name, "a robot with the joints LF_J1 … RR_J3");
  return static_cast<std::size_t>(joint);
}

LegGeometry geometryOf(const RobotModel& model, const Leg& leg) {
  LegGeometry geometry;
  geometry.side = leg.front ? 1 : -1;
  const std::size_t knee = jointOf(model, std::string(leg.name) + "_J3");
  geometry.knee = model.joints[knee].origin.translation();
  double lowest = 1e9;
  for (const auto& shape : model.links[knee + 1].shapes) {
    if (shape.kind != Shape::Kind::sphere || !shape.collides) continue;
    const Vector3d bottom = shape.pose.translation() - Vector3d(0, 0, shape.size_m.x());
    if (bottom.z() >= lowest) continue;
    lowest = bottom.z();
    geometry.shank = bottom;
  }
  if (lowest > 1e8) throw InputError("trot", model.links[knee + 1].name, "a link with a sphere as its foot");
  if (!leg.left) {
    geometry.knee.y() *= -1;
    geometry.shank.y() *= -1;
  }
  return geometry;
}

class TrotMotion final : public Motion {
 public:
  TrotMotion(const RobotModel& model, const std::vector<double>& setting)
      : cycle_(setting[0]), stride_(setting[1]), lift_(setting[2]), duration_(setting[3]) {
    for (const Joint& joint : model.joints) rest_.push_back(std::clamp(0.0, joint.lower, joint.upper));
    for (std::size_t i = 0; i < legs.size(); ++i) {
      geometry_[i] = geometryOf(model, legs[i]);
      last_[i] = legs[i].front ? bentFront : bentRear;
      for (int j = 0; j < 3; ++j)
        joints_[i][static_cast<std::size_t>(j)] = jointOf(model, legs[i].name + ("_J" + std::to_string(j + 1)));
    }
  }

  std::vector<double> positions(double time) {
    std::vector<double> result = rest_;
    for (std::size_t i = 0; i < legs.size(); ++i) {
      const double phase = std::fmod(time / cycle_ + legs[i].phase, 1.0);
      // Half of the cycle on the ground, straight back; half in the air, an ellipse forward.
      const bool air = phase >= 0.5;
      const double s = air ? 2 * phase - 1 : 2 * phase;
      const double x = air ? -stride_ / 2 * std::cos(M_PI * s) : stride_ * (0.5 - s);
      const double z = air ? lift_ * std::sin(M_PI * s) : 0;
      const Vector3d foot((legs[i].front ? frontX_m : rearX_m) + x, outward_m,
                          (legs[i].front ? frontZ_m : rearZ_m) + z);
      bool reached = true;
      last_[i] = geometry_[i].angles(foot, last_[i], reached);
      for (std::size_t j = 0; j < 3; ++j) result[joints_[i][j]] = last_[i][j];
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
  std::array<LegGeometry, 4> geometry_;
  std::array<LegAngles, 4> last_{};
  std::array<std::array<std::size_t, 3>, 4> joints_{};
};

SceneRobot& dog(Scene& scene) {
  if (scene.robots.empty()) throw InputError("trot: the scene has no robot");
  return scene.robots.front();
}

}  // namespace

Vector3d LegGeometry::foot(const LegAngles& a) const {
  return turnY(-side * a[0], turnX(a[1], knee + turnY(-side * a[2], shank)));
}

LegAngles LegGeometry::angles(const Vector3d& p, const LegAngles& last, bool& reached) const {
  // The distance from hip to foot gives the knee, the height above the J1–foot plane J2, what is left J1.
  const double k = (p.squaredNorm() - knee.squaredNorm() - shank.squaredNorm()) / 2 - knee.y() * shank.y();
  const double a = -side * (knee.x() * shank.z() - knee.z() * shank.x());
  const double b = knee.x() * shank.x() + knee.z() * shank.z();
  LegAngles result;
  result[2] = solve(a, b, k, last[2], reached);
  const Vector3d q = knee + turnY(-side * result[2], shank);
  result[1] = solve(-q.z(), q.y(), p.y(), last[1], reached);
  const Vector3d w = turnX(result[1], q);
  result[0] = side * std::remainder(std::atan2(p.x(), -p.z()) - std::atan2(w.x(), -w.z()), 2 * M_PI);
  return result;
}

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
  // As high as the lowest foot wants.
  const auto poses = forwardKinematics(robot.model, robot.start, robot.jointStart);
  double lowest = 1e9;
  for (const Leg& leg : legs) {
    Vector3d foot = geometryOf(robot.model, leg).shank;
    if (!leg.left) foot.y() *= -1;
    const std::size_t link = jointOf(robot.model, std::string(leg.name) + "_J3") + 1;
    lowest = std::min(lowest, (poses[link] * foot).z());
  }
  robot.start.translation().z() = -lowest;
}

std::unique_ptr<Motion> Trot::begin(const Scene& scene, const Values& settings, std::span<const double>) const {
  if (scene.robots.empty()) throw InputError("trot: the scene has no robot");
  return std::make_unique<TrotMotion>(scene.robots.front().model, resolve(this->settings(), settings, "trot"));
}

}  // namespace btr
