#include "core/model/four_legs.h"

#include <algorithm>
#include <cmath>

#include "core/model/kinematics.h"
#include "core/spec/error.h"

namespace btr {
namespace {
using Eigen::Isometry3d;
using Eigen::Vector3d;

std::size_t jointOf(const RobotModel& model, const std::string& name, const std::string& who) {
  const int joint = model.findJoint(name);
  if (joint < 0)
    throw InputError(who + ": robot \"" + model.name + "\" has no joint " + name + "; it needs LF_J1 … RR_J3");
  return static_cast<std::size_t>(joint);
}

/// The closed form holds for crossed hip axes and a knee about y alone: compare it with the model itself.
void checkAxes(const RobotModel& model, const FourLegs::Leg& leg, const std::string& name, const std::string& who) {
  const LegAngles angles{0.3, 0.2, 0.4};
  std::vector<double> positions(model.joints.size(), 0.0);
  for (std::size_t j = 0; j < 3; ++j) positions[leg.joints[j]] = angles[j];
  const auto poses = forwardKinematics(model, Isometry3d::Identity(), positions);
  const Vector3d foot = footOf(model, poses, name, who).centre_m - leg.hip_m;
  if ((leg.turned(foot) - leg.geometry.foot(angles)).norm() > 1e-5)
    throw InputError(who + ": leg " + name + " of robot \"" + model.name +
                     "\" does not turn as an AIBO's: J1 about y away from the body's middle, J2 about x outward with "
                     "crossing axes, J3 about y the way of J1");
}

}  // namespace

FourLegs FourLegs::of(const RobotModel& model, const std::string& who) {
  FourLegs result;
  const auto poses = forwardKinematics(model, Isometry3d::Identity(), std::vector<double>(model.joints.size(), 0.0));
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = names[i];
    Leg& leg = result.legs[i];
    leg.front = name[1] == 'F';
    leg.left = name[0] == 'L';
    for (std::size_t j = 0; j < 3; ++j) {
      leg.joints[j] = jointOf(model, name + "_J" + std::to_string(j + 1), who);
      leg.limits.lower[j] = model.joints[leg.joints[j]].lower;
      leg.limits.upper[j] = model.joints[leg.joints[j]].upper;
    }
    leg.hip_m = poses[leg.joints[1] + 1].translation();
    const Vector3d knee = poses[leg.joints[2] + 1].translation();
    const FootBall foot = footOf(model, poses, name, who);
    leg.geometry = {leg.turned(knee - leg.hip_m), leg.turned(foot.centre_m - knee), leg.front ? 1.0 : -1.0};
    leg.footRadius_m = foot.radius_m;
    checkAxes(model, leg, name, who);
  }
  return result;
}

FootBall footOf(const RobotModel& model, const std::vector<Isometry3d>& poses, const std::string& leg,
                const std::string& who) {
  const std::size_t link = jointOf(model, leg + "_J3", who) + 1;
  FootBall foot;
  for (const Shape& shape : model.links[link].shapes) {
    if (shape.kind != Shape::Kind::sphere || !shape.collides) continue;
    const Vector3d centre = poses[link] * shape.pose.translation();
    if (foot.radius_m == 0 || centre.z() - shape.size_m.x() < foot.centre_m.z() - foot.radius_m)
      foot = {centre, shape.size_m.x()};
  }
  if (foot.radius_m == 0)
    throw InputError(who + ": link \"" + model.links[link].name + "\" has no sphere that could be its foot");
  return foot;
}

std::vector<double> restPositions(const RobotModel& model) {
  std::vector<double> positions;
  for (const Joint& joint : model.joints) positions.push_back(std::clamp(0.0, joint.lower, joint.upper));
  return positions;
}

Isometry3d standing(const RobotModel& model, const std::vector<double>& positions, const std::string& who) {
  const auto meanFoot = [&](const std::vector<Isometry3d>& poses, const char* one, const char* other) -> Vector3d {
    return (footOf(model, poses, one, who).centre_m + footOf(model, poses, other, who).centre_m) / 2;
  };
  auto poses = forwardKinematics(model, Isometry3d::Identity(), positions);
  const Vector3d reach = meanFoot(poses, "LF", "RF") - meanFoot(poses, "LR", "RR");
  Isometry3d root(Eigen::AngleAxisd(std::atan2(reach.z(), reach.x()), Vector3d::UnitY()));
  poses = forwardKinematics(model, root, positions);
  double lowest = HUGE_VAL;
  for (const char* leg : FourLegs::names) {
    const FootBall foot = footOf(model, poses, leg, who);
    lowest = std::min(lowest, foot.centre_m.z() - foot.radius_m);
  }
  root.translation() = Vector3d(0, 0, -lowest);
  return root;
}

}  // namespace btr
