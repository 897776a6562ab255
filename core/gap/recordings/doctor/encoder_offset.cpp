#include "core/gap/recordings/doctor/encoder_offset.h"

#include <Eigen/Dense>
#include <cmath>

#include "core/model/kinematics.h"

namespace btr {
namespace {

using Eigen::Vector3d;

/// Torque (or force) of gravity at one joint of a robot on a fixed base, positive with the joint's own sign.
double gravityLoad(const Scene& scene, const SceneRobot& robot, std::size_t joint,
                   const std::vector<double>& positions) {
  const RobotModel& model = robot.model;
  const auto poses = forwardKinematics(model, robot.start, positions);
  std::vector<char> carried(model.links.size(), 0);
  carried[joint + 1] = 1;
  const Vector3d axis = poses[joint + 1].linear() * model.joints[joint].axis;
  const bool slides = model.joints[joint].type == Joint::Type::slide;
  double load = 0;
  for (std::size_t link = joint + 1; link < model.links.size(); ++link) {
    if (link > joint + 1) carried[link] = carried[static_cast<std::size_t>(model.joints[link - 1].parentLink)];
    if (!carried[link]) continue;
    const Inertial& part = model.links[link].inertial;
    const Vector3d weight = part.mass_kg * scene.gravity_m_s2;
    const Vector3d arm = poses[link] * part.centreOfMass_m - poses[joint + 1].translation();
    load += axis.dot(slides ? weight : arm.cross(weight));
  }
  return load;
}

/// Lag and friction leave errors that last a while: this long one sample is like the next.
constexpr double memory_s = 0.25;
constexpr std::size_t mostSamples = 2000;

}  // namespace

std::optional<EncoderOffset> encoderOffset(const Scene& scene, const std::vector<JointSeries>& all,
                                           const JointSeries& series, double lag_s, double period_s) {
  const SceneRobot& robot = scene.robots[series.robot];
  const Drive& drive = robot.drives[series.joint];
  const bool slides = robot.model.joints[series.joint].type == Joint::Type::slide;
  const auto lag = static_cast<std::size_t>(std::lround(lag_s / period_s));
  const std::size_t stride = std::max<std::size_t>(1, series.position.size() / mostSamples);

  // Normal equations of position − command = offset + compliance·load.
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double squares = 0, count = 0;
  std::vector<double> positions = robot.jointStart;
  for (std::size_t i = lag; i < series.position.size(); i += stride) {
    if (!series.used[i]) continue;
    double load = 0;
    if (!robot.freeBase) {
      for (const JointSeries& other : all)
        if (other.robot == series.robot) positions[other.joint] = other.position[i];
      load = gravityLoad(scene, robot, series.joint, positions);
    }
    const Eigen::Vector2d row(1, load);
    const double error = series.position[i] - series.command[i - lag];
    normal += row * row.transpose();
    right += error * row;
    squares += error * error;
    ++count;
  }
  if (count < 20) return std::nullopt;
  const double loadSpread = normal(1, 1) - normal(0, 1) * normal(0, 1) / count;
  const bool loaded = normal(1, 1) > 1e-12;
  // A load that never changes can't be told from an offset.
  if (loaded && loadSpread < 1e-3 * normal(1, 1)) return std::nullopt;
  if (!loaded) normal(1, 1) = 1;
  const Eigen::Matrix2d inverse = normal.inverse();
  const Eigen::Vector2d found = inverse * right;
  const double variance = std::max(0.0, squares - found.dot(right)) / count;
  const double independent = std::max(1.0, count * static_cast<double>(stride) * period_s / memory_s);

  EncoderOffset offset{found(0), std::sqrt(variance * inverse(0, 0) * count / independent)};
  double least = std::max(slides ? 0.005 : 0.05, 6 * offset.uncertainty);
  if (robot.freeBase)
    least = std::max(least, drive.kind == Drive::Kind::servo && drive.p > 0 ? 1.5 * drive.maxTorque / drive.p : 1e9);
  if (std::abs(offset.offset) < least) return std::nullopt;
  return offset;
}

}  // namespace btr
