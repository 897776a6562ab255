#include "core/sim/engine/coupled_inertia.h"

#include <algorithm>
#include <utility>

namespace btr {
namespace {
using Eigen::Matrix3d;
using Eigen::Vector3d;

bool carries(const Articulation& robot, int carrier, int body) {
  while (body > carrier) body = robot.bodies[static_cast<std::size_t>(body)].carrier;
  return body == carrier;
}

/// Of what a joint carries, at a unit rate: spin, and velocity of the point at the origin.
struct Motion {
  Vector3d turn, push;
};

Motion motionOf(const Articulation& robot, const RobotJoint& joint, const Vector3d& origin) {
  if (joint.slides) return {Vector3d::Zero(), joint.axis};
  const Vector3d anchor = robot.poseOf(joint.child) * joint.anchorInChild - origin;
  return {joint.axis, anchor.cross(joint.axis)};
}

}  // namespace

void CoupledInertia::prepare(const Articulation& robot) {
  const std::vector<RobotJoint>& joints = robot.joints;
  carry(robot);
  leaders_.assign(joints.size(), {});
  mass_.resize(joints.size() * joints.size());
  for (std::size_t f = 0; f < joints.size(); ++f) {
    if (joints[f].leader < 0) continue;
    const auto leader = static_cast<std::size_t>(joints[f].leader);
    for (std::size_t j = 0; j < joints.size(); ++j)
      if (j == leader || joints[j].leader == joints[f].leader)
        mass_[f * joints.size() + j] = massBetween(robot, joints[f], joints[j]);
  }
  for (std::size_t l = 0; l < joints.size(); ++l) {
    double own = 0, coupling = 0;
    for (std::size_t f = 0; f < joints.size(); ++f) {
      if (joints[f].leader != static_cast<int>(l)) continue;
      coupling += joints[f].multiplier * between(f, l);
      for (std::size_t g = 0; g < joints.size(); ++g)
        if (joints[g].leader == joints[f].leader) own += joints[f].multiplier * joints[g].multiplier * between(f, g);
    }
    leaders_[l] = {own + std::max(0.0, coupling), coupling > 0};
  }
}

void CoupledInertia::carry(const Articulation& robot) {
  origin_ = robot.bodies.front().pose.translation();
  carried_.resize(robot.bodies.size());
  for (std::size_t i = 0; i < carried_.size(); ++i) {
    const RobotBody& body = robot.bodies[i];
    const Vector3d centre = body.pose.translation() - origin_;
    Carried& own = carried_[i];
    own.mass = body.mass_kg;
    own.moment = body.mass_kg * centre;
    own.inertia = body.pose.linear() * body.inertia_kg_m2 * body.pose.linear().transpose() +
                  own.moment.dot(centre) * Matrix3d::Identity() - own.moment * centre.transpose();
    if (body.ringJoint < 0) continue;
    const Vector3d& axis = robot.joints[static_cast<std::size_t>(body.ringJoint)].axis;
    own.inertia += body.ringInertia_kg_m2 * axis * axis.transpose();
  }
  // A body comes after the one that carries it.
  for (std::size_t i = carried_.size(); i-- > 0;) {
    if (robot.bodies[i].carrier < 0) continue;
    Carried& carrier = carried_[static_cast<std::size_t>(robot.bodies[i].carrier)];
    carrier.mass += carried_[i].mass;
    carrier.moment += carried_[i].moment;
    carrier.inertia += carried_[i].inertia;
  }
}

/// Between two joints, of which one carries the other or is it; else 0.
double CoupledInertia::massBetween(const Articulation& robot, const RobotJoint& a, const RobotJoint& b) const {
  const RobotJoint *upper = &a, *lower = &b;
  if (upper->child > lower->child) std::swap(upper, lower);
  if (!carries(robot, upper->child, lower->child)) return 0;
  const Carried& all = carried_[static_cast<std::size_t>(lower->child)];
  const Motion moved = motionOf(robot, *lower, origin_), at = motionOf(robot, *upper, origin_);
  const Vector3d linear = all.mass * moved.push + moved.turn.cross(all.moment);
  const Vector3d angular = all.inertia * moved.turn + all.moment.cross(moved.push);
  return at.turn.dot(angular) + at.push.dot(linear);
}

}  // namespace btr
