#include "core/sim/engine/articulation.h"

#include <cmath>

#include "core/sim/engine/joint_space.h"
#include "core/sim/engine/ode_body.h"

namespace btr {
namespace {
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Joints that follow another one are where it puts them.
void followLeaders(const RobotModel& model, std::vector<double>& positions, std::vector<double>& rates) {
  positions.resize(model.joints.size(), 0);
  rates.resize(model.joints.size(), 0);
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    if (const auto& mimic = model.joints[i].mimic) {
      const auto leader = static_cast<std::size_t>(mimic->leader);
      positions[i] = mimic->multiplier * positions[leader] + mimic->offset;
      rates[i] = mimic->multiplier * rates[leader];
    }
}

}  // namespace

Articulation::Articulation(dWorldID world, const SceneRobot& robot)
    : world_(world), robot_(robot), movesInOde_(!JointSpace::suits(robot)) {
  basePose_ = robot.start;
  groupLinks();
  findUniversals();
  makeBodies();
  makeColliders();
  makeJoints();
  set(robot.start, robot.startVelocity_m_s, robot.startSpin_rad_s, robot.jointStart, robot.jointStartRate);
}

void Articulation::makeBodies() {
  const auto& links = robot_.model.links;
  const auto& modelJoints = robot_.model.joints;
  bodyOfLink_.assign(links.size(), -1);

  // One body for each group that is neither the fixed base nor swallowed by a universal joint.
  for (int link = 0; link < static_cast<int>(links.size()); ++link) {
    const int group = groupOfLink_[link];
    if (link != group) {
      bodyOfLink_[link] = bodyOfLink_[group];
      continue;
    }
    if (link == 0 && fixedBase()) continue;
    if (link > 0 && universal_[link - 1] >= 0) {
      bodyOfLink_[link] = bodyOfLink_[modelJoints[link - 1].parentLink];
      continue;
    }
    RobotBody body;
    body.firstLink = link;
    if (link > 0) body.carrier = bodyOfLink_[modelJoints[link - 1].parentLink];
    bodyOfLink_[link] = static_cast<int>(bodies.size());
    bodies.push_back(body);
  }

  // Mass properties: the group's own, and what swallowed parts leave behind.
  std::vector<std::vector<Inertial>> parts(bodies.size());
  for (int link = 0; link < static_cast<int>(links.size()); ++link) {
    if (groupOfLink_[link] != link) continue;
    Inertial own = groupInertial(link);
    if (link > 0 && universal_[link - 1] >= 0) {
      const Joint& first = modelJoints[link - 1];
      const double spin = first.axis.dot(own.inertia_kg_m2 * first.axis);
      const double across = (own.inertia_kg_m2.trace() - spin) / 2;
      auto& carrier = bodies[bodyOfLink_[groupOfLink_[universal_[link - 1] + 1]]];
      carrier.ringInertia_kg_m2 = spin;
      // To the parent: the part at its place, without its inertia about the axis.
      const Matrix3d turned = first.origin.linear();
      const Vector3d axis = turned * first.axis;
      own.inertia_kg_m2 = across * (Matrix3d::Identity() - axis * axis.transpose());
      own.centreOfMass_m = linkInGroup_[first.parentLink] * (first.origin * own.centreOfMass_m);
      own.inertia_kg_m2 = linkInGroup_[first.parentLink].linear() * own.inertia_kg_m2 *
                          linkInGroup_[first.parentLink].linear().transpose();
    }
    if (bodyOfLink_[link] >= 0) parts[bodyOfLink_[link]].push_back(own);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    RobotBody& body = bodies[i];
    Vector3d moment = Vector3d::Zero();
    for (const auto& part : parts[i]) {
      body.mass_kg += part.mass_kg;
      moment += part.mass_kg * part.centreOfMass_m;
    }
    body.centre_m = moment / body.mass_kg;
    for (const auto& part : parts[i]) {
      const Vector3d d = part.centreOfMass_m - body.centre_m;
      body.inertia_kg_m2 +=
          part.inertia_kg_m2 + part.mass_kg * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
    }
    body.id = dBodyCreate(world_);
    // Exact rotation over a step, however fast.
    dBodySetFiniteRotationMode(body.id, 1);
    setMass(body.id, body.mass_kg, body.inertia_kg_m2 + body.ringInertia_kg_m2 * Matrix3d::Identity() / 3);
  }
}

void Articulation::makeColliders() {
  if (robot_.collision == "none") return;
  const auto& links = robot_.model.links;
  for (int link = 0; link < static_cast<int>(links.size()); ++link) {
    for (const auto& shape : links[link].shapes) {
      if (!collidesIn(robot_.model, links[link], shape, robot_.collision)) continue;
      const int body = bodyOfLink_[link];
      // Fixed parts keep their place in the body; a swallowed part is round about its joint: it stays as at position 0.
      Isometry3d place = linkInGroup_[link];
      const int group = groupOfLink_[link];
      if (group > 0 && universal_[group - 1] >= 0) {
        const Joint& joint = robot_.model.joints[group - 1];
        place = linkInGroup_[joint.parentLink] * joint.origin * place;
      }
      if (body < 0) {
        baseColliders.push_back(makeCollider(shape, place, link));
        continue;
      }
      place = Eigen::Translation3d(-bodies[body].centre_m) * place;
      bodies[body].colliders.push_back(makeCollider(shape, place, link));
      const Collider& made = bodies[body].colliders.back();
      bodies[body].reach_m = std::max(bodies[body].reach_m, made.pose.translation().norm() + made.bound_m);
    }
  }
}

std::vector<Articulation::LinkState> Articulation::kinematics(const Isometry3d& base, const Vector3d& velocity,
                                                              const Vector3d& spin, std::span<const double> positions,
                                                              std::span<const double> rates) const {
  const auto& model = robot_.model;
  std::vector<LinkState> state(model.links.size());
  state[0] = {base, velocity, spin};
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const LinkState& parent = state[joint.parentLink];
    LinkState& child = state[i + 1];
    const double q = i < positions.size() ? positions[i] : 0, rate = i < rates.size() ? rates[i] : 0;
    child.pose = parent.pose * joint.origin;
    const Vector3d axis = child.pose.linear() * joint.axis;
    if (joint.type == Joint::Type::rotate) child.pose.rotate(Eigen::AngleAxisd(q, joint.axis));
    if (joint.type == Joint::Type::slide) child.pose.translate(q * joint.axis);
    child.spin = parent.spin;
    child.velocity = parent.velocity + parent.spin.cross(child.pose.translation() - parent.pose.translation());
    if (joint.type == Joint::Type::rotate) child.spin += rate * axis;
    if (joint.type == Joint::Type::slide) child.velocity += rate * axis;
  }
  return state;
}

void Articulation::placeBodies(const std::vector<LinkState>& links) {
  for (auto& body : bodies) {
    const LinkState& link = links[body.firstLink];
    body.pose = link.pose * Eigen::Translation3d(body.centre_m);
    body.spin_rad_s = link.spin;
    body.velocity_m_s = link.velocity + link.spin.cross(body.pose.translation() - link.pose.translation());
    setPose(body.id, body.pose);
    dBodySetLinearVel(body.id, body.velocity_m_s.x(), body.velocity_m_s.y(), body.velocity_m_s.z());
    dBodySetAngularVel(body.id, body.spin_rad_s.x(), body.spin_rad_s.y(), body.spin_rad_s.z());
  }
}

void Articulation::set(const Isometry3d& base, const Vector3d& velocity, const Vector3d& spin,
                       std::span<const double> givenPositions, std::span<const double> givenRates) {
  std::vector<double> positions(givenPositions.begin(), givenPositions.end());
  std::vector<double> rates(givenRates.begin(), givenRates.end());
  followLeaders(robot_.model, positions, rates);
  if (fixedBase() && !base.isApprox(basePose_, 0)) aimJoints(base);
  placeBodies(fixedBase() ? kinematics(base, Vector3d::Zero(), Vector3d::Zero(), positions, rates)
                          : kinematics(base, velocity, spin, positions, rates));
  for (auto& joint : joints) {
    const auto i = static_cast<std::size_t>(joint.modelJoint);
    joint.position = i < positions.size() ? positions[i] : 0;
  }
  refresh();
  for (auto& joint : joints) joint.solvedRate = joint.rate;
  updateRings();
}

void Articulation::remember(const std::vector<BodyMemory>& memory, const std::vector<Vector3d>& ringAxes) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    RobotBody& body = bodies[i];
    const BodyMemory& was = memory[i];
    Isometry3d pose = Isometry3d::Identity();
    pose.translation() = was.position_m;
    pose.linear() = was.axes;
    setPose(body.id, pose);
    if (was.attitude) setAttitude(body.id, *was.attitude);
    dBodySetLinearVel(body.id, was.velocity_m_s.x(), was.velocity_m_s.y(), was.velocity_m_s.z());
    dBodySetAngularVel(body.id, was.spin_rad_s.x(), was.spin_rad_s.y(), was.spin_rad_s.z());
    if (body.ringJoint < 0) continue;
    body.ringAxis = ringAxes[i];
    setMass(body.id, body.mass_kg,
            body.inertia_kg_m2 + body.ringInertia_kg_m2 * body.ringAxis * body.ringAxis.transpose());
  }
  refresh();
}

void Articulation::refresh() {
  for (auto& body : bodies) {
    const dReal* p = dBodyGetPosition(body.id);
    const dReal* r = dBodyGetRotation(body.id);
    const dReal* v = dBodyGetLinearVel(body.id);
    const dReal* w = dBodyGetAngularVel(body.id);
    body.pose.translation() << p[0], p[1], p[2];
    body.pose.linear() << r[0], r[1], r[2], r[4], r[5], r[6], r[8], r[9], r[10];
    body.velocity_m_s << v[0], v[1], v[2];
    body.spin_rad_s << w[0], w[1], w[2];
  }
  for (auto& joint : joints) {
    const RobotBody& child = bodies[joint.child];
    const Isometry3d& parentPose = poseOf(joint.parent);
    Vector3d parentVelocity = Vector3d::Zero(), parentSpin = Vector3d::Zero();
    if (joint.parent >= 0) {
      parentVelocity = bodies[joint.parent].velocity_m_s;
      parentSpin = bodies[joint.parent].spin_rad_s;
    }
    if (joint.slides) {
      const Vector3d relative =
          child.velocity_m_s - parentVelocity - parentSpin.cross(child.pose.translation() - parentPose.translation());
      joint.solvedRate = joint.axis.dot(relative);
      joint.axis = parentPose.linear() * joint.axisInParent;
      joint.rate = joint.axis.dot(relative);
      joint.position = joint.axis.dot(child.pose * joint.anchorInChild - parentPose * joint.anchorInParent);
      continue;
    }
    const Vector3d relative = child.spin_rad_s - parentSpin;
    joint.solvedRate = joint.axis.dot(relative);
    const Matrix3d& mine = joint.axisFollowsChild ? child.pose.linear() : parentPose.linear();
    const Matrix3d& other = joint.axisFollowsChild ? parentPose.linear() : child.pose.linear();
    const Vector3d x = other * joint.x;
    const double angle = std::atan2((mine * joint.w).dot(x), (mine * joint.u).dot(x));
    // The angle nearest to the last one: a joint may turn round many times.
    const double turned = angle - joint.position;
    joint.position += std::abs(turned) <= M_PI ? turned : std::remainder(turned, 2 * M_PI);
    joint.axis = mine * (joint.axisFollowsChild ? joint.axisInChild : joint.axisInParent);
    joint.rate = joint.axis.dot(relative);
  }
}

void Articulation::addTorque(const RobotJoint& joint, double torque) {
  const Vector3d t = torque * joint.axis;
  const dBodyID child = bodies[joint.child].id, parent = idOf(joint.parent);
  if (joint.slides) {
    dBodyAddForce(child, t.x(), t.y(), t.z());
    const Vector3d& at = bodies[joint.child].pose.translation();
    if (parent) dBodyAddForceAtPos(parent, -t.x(), -t.y(), -t.z(), at.x(), at.y(), at.z());
    return;
  }
  dBodyAddTorque(child, t.x(), t.y(), t.z());
  if (parent) dBodyAddTorque(parent, -t.x(), -t.y(), -t.z());
}

void Articulation::shift(const Vector3d& way) {
  for (auto& body : bodies) {
    body.pose.translation() += way;
    const Vector3d& p = body.pose.translation();
    dBodySetPosition(body.id, p.x(), p.y(), p.z());
  }
}

void Articulation::updateRings() {
  for (auto& body : bodies) {
    if (body.ringJoint < 0) continue;
    const Vector3d axis = body.pose.linear().transpose() * joints[body.ringJoint].axis;
    if ((axis - body.ringAxis).squaredNorm() < 1e-6) continue;
    body.ringAxis = axis;
    setLargerInertia(body.id, body.mass_kg, body.inertia_kg_m2 + body.ringInertia_kg_m2 * axis * axis.transpose());
  }
}

void Articulation::addRingTorques() {
  for (const auto& body : bodies) {
    if (body.ringJoint < 0) continue;
    const RobotJoint& joint = joints[static_cast<std::size_t>(body.ringJoint)];
    const Vector3d& axis = joint.axis;
    const Vector3d turning = (joint.parent >= 0 ? bodies[joint.parent].spin_rad_s : Vector3d(0, 0, 0)).cross(axis);
    const double inertia = body.ringInertia_kg_m2, spin = axis.dot(body.spin_rad_s);
    const Vector3d onChild = inertia * (spin * body.spin_rad_s.cross(axis) - turning.dot(body.spin_rad_s) * axis);
    dBodyAddTorque(body.id, onChild.x(), onChild.y(), onChild.z());
    if (joint.parent < 0) continue;
    const Vector3d onParent = -inertia * spin * turning;
    dBodyAddTorque(bodies[joint.parent].id, onParent.x(), onParent.y(), onParent.z());
  }
}

Isometry3d Articulation::base() const {
  if (fixedBase()) return basePose_;
  return bodies[0].pose * Eigen::Translation3d(-bodies[0].centre_m);
}

std::vector<Isometry3d> Articulation::linkPoses() const {
  const auto& model = robot_.model;
  std::vector<Isometry3d> poses(model.links.size());
  for (int link = 0; link < static_cast<int>(poses.size()); ++link) {
    const int group = groupOfLink_[link];
    if (group != link) {
      poses[link] = poses[group] * linkInGroup_[link];
      continue;
    }
    if (link == 0) {
      poses[0] = base();
    } else if (universal_[link - 1] >= 0) {
      const Joint& joint = model.joints[link - 1];
      poses[link] = poses[joint.parentLink] * joint.origin;
      poses[link].rotate(Eigen::AngleAxisd(joints[jointOfModel[link - 1]].position, joint.axis));
    } else {
      const RobotBody& body = bodies[bodyOfLink_[link]];
      poses[link] = body.pose * Eigen::Translation3d(-body.centre_m);
    }
  }
  return poses;
}

Isometry3d Articulation::linkPose(int link) const {
  const int group = groupOfLink_[link];
  const bool swallowed = group > 0 && universal_[group - 1] >= 0;
  if (swallowed) return linkPoses()[static_cast<std::size_t>(link)];
  if (bodyOfLink_[link] < 0) return basePose_ * linkInGroup_[link];
  const RobotBody& body = bodies[bodyOfLink_[link]];
  return body.pose * Eigen::Translation3d(-body.centre_m) * linkInGroup_[link];
}

Vector3d Articulation::pointVelocity(int link, const Vector3d& world) const {
  const int index = bodyOfLink_[link];
  if (index < 0) return Vector3d::Zero();
  const RobotBody& body = bodies[index];
  return body.velocity_m_s + body.spin_rad_s.cross(world - body.pose.translation());
}

}  // namespace btr
