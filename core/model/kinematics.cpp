#include "core/model/kinematics.h"

#include "core/spec/require.h"

namespace btr {
namespace {

/// Steiner's term for a body whose centre of mass lies `d` from the reference point.
Eigen::Matrix3d steiner(double mass_kg, const Eigen::Vector3d& d) {
  return mass_kg * (d.squaredNorm() * Eigen::Matrix3d::Identity() - d * d.transpose());
}

Eigen::Isometry3d motion(const Joint& joint, double position) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  if (joint.type == Joint::Type::rotate) result.linear() = Eigen::AngleAxisd(position, joint.axis).toRotationMatrix();
  if (joint.type == Joint::Type::slide) result.translation() = position * joint.axis;
  return result;
}

}  // namespace

std::vector<Eigen::Isometry3d> forwardKinematics(const RobotModel& model, const Eigen::Isometry3d& root,
                                                 std::span<const double> positions) {
  require(positions.size() == model.joints.size(), "a position for each joint");
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(model.links.size());
  poses.push_back(root);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    poses.push_back(poses[static_cast<std::size_t>(joint.parentLink)] * joint.origin * motion(joint, positions[i]));
  }
  return poses;
}

Inertial carried(const Inertial& body, const Eigen::Isometry3d& pose) {
  return {body.mass_kg, pose * body.centreOfMass_m, pose.linear() * body.inertia_kg_m2 * pose.linear().transpose()};
}

Inertial combined(const Inertial& a, const Inertial& b) {
  if (b.mass_kg == 0 && b.inertia_kg_m2.isZero(0)) return a;
  if (a.mass_kg == 0 && a.inertia_kg_m2.isZero(0)) return b;
  Inertial sum;
  sum.mass_kg = a.mass_kg + b.mass_kg;
  if (sum.mass_kg > 0) sum.centreOfMass_m = (a.mass_kg * a.centreOfMass_m + b.mass_kg * b.centreOfMass_m) / sum.mass_kg;
  sum.inertia_kg_m2 = a.inertia_kg_m2 + steiner(a.mass_kg, a.centreOfMass_m - sum.centreOfMass_m) + b.inertia_kg_m2 +
                      steiner(b.mass_kg, b.centreOfMass_m - sum.centreOfMass_m);
  return sum;
}

Inertial massProperties(const RobotModel& model, std::span<const double> positions) {
  const auto poses = forwardKinematics(model, Eigen::Isometry3d::Identity(), positions);
  Inertial sum;
  for (std::size_t i = 0; i < model.links.size(); ++i) sum = combined(sum, carried(model.links[i].inertial, poses[i]));
  return sum;
}

}  // namespace btr
