// How the links of a model become bodies, and its joints ODE's.
#include <algorithm>
#include <cmath>

#include "core/model/joint_range.h"
#include "core/sim/engine/articulation.h"
#include "core/sim/engine/ode_body.h"

namespace btr {
namespace {
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d anyAcross(const Vector3d& axis) {
  int least = 0;
  axis.cwiseAbs().minCoeff(&least);
  return axis.cross(Vector3d(Vector3d::Unit(least))).normalized();
}

// Round about the axis through the frame's origin, to what an ODE trial can notice: centre of mass within a millimetre
// of it and inertia across it equal within a tenth.
bool roundAbout(const Inertial& part, const Vector3d& axis) {
  const Vector3d off = part.centreOfMass_m - axis * axis.dot(part.centreOfMass_m);
  if (off.norm() > 1e-3) return false;
  const Vector3d u = anyAcross(axis), w = axis.cross(u);
  const Matrix3d& inertia = part.inertia_kg_m2;
  const double uu = u.dot(inertia * u), ww = w.dot(inertia * w), aa = axis.dot(inertia * axis);
  const double odd = std::max({std::abs(uu - ww), std::abs(u.dot(inertia * w)), std::abs(u.dot(inertia * axis)),
                               std::abs(w.dot(inertia * axis))});
  return odd <= 0.1 * std::max({uu, ww, aa});
}

}  // namespace

void Articulation::groupLinks() {
  const auto& model = robot_.model;
  groupOfLink_.assign(model.links.size(), 0);
  linkInGroup_.assign(model.links.size(), Isometry3d::Identity());
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const std::size_t link = i + 1;
    groupOfLink_[link] = static_cast<int>(link);
    if (joint.type != Joint::Type::fixed || !robot_.mergeFixed) continue;
    groupOfLink_[link] = groupOfLink_[joint.parentLink];
    linkInGroup_[link] = linkInGroup_[joint.parentLink] * joint.origin;
  }
}

Inertial Articulation::groupInertial(int group) const {
  Inertial sum;
  const auto& links = robot_.model.links;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (groupOfLink_[i] != group) continue;
    sum.mass_kg += links[i].inertial.mass_kg;
    sum.centreOfMass_m += links[i].inertial.mass_kg * (linkInGroup_[i] * links[i].inertial.centreOfMass_m);
  }
  sum.centreOfMass_m /= sum.mass_kg;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (groupOfLink_[i] != group) continue;
    const Inertial& part = links[i].inertial;
    const Matrix3d turn = linkInGroup_[i].linear();
    const Vector3d d = linkInGroup_[i] * part.centreOfMass_m - sum.centreOfMass_m;
    sum.inertia_kg_m2 += turn * part.inertia_kg_m2 * turn.transpose() +
                         part.mass_kg * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
  }
  return sum;
}

void Articulation::findUniversals() {
  const auto& joints_ = robot_.model.joints;
  const int count = static_cast<int>(joints_.size());
  universal_.assign(joints_.size(), -1);
  second_.assign(joints_.size(), 0);
  if (!movesInOde_) return;
  for (int first = 0; first < count; ++first) {
    const int group = first + 1;
    if (joints_[first].type != Joint::Type::rotate || second_[first]) continue;
    // The only thing that moves on the part between.
    int next = -1, children = 0;
    for (int j = first + 1; j < count; ++j)
      if (groupOfLink_[joints_[j].parentLink] == group && groupOfLink_[j + 1] == j + 1) {
        next = j;
        ++children;
      }
    if (children != 1 || joints_[next].type != Joint::Type::rotate) continue;
    if (joints_[first].mimic || joints_[next].mimic) continue;
    // Axes at a right angle that meet.
    const Isometry3d place = linkInGroup_[joints_[next].parentLink] * joints_[next].origin;
    const Vector3d a = joints_[first].axis, b = place.linear() * joints_[next].axis;
    if (std::abs(a.dot(b)) > 1e-6 || std::abs(place.translation().dot(a.cross(b))) > 1e-6) continue;
    if (!roundAbout(groupInertial(group), a)) continue;
    universal_[first] = next;
    second_[next] = 1;
  }
}

void Articulation::makeJoints() {
  const auto& modelJoints = robot_.model.joints;
  jointOfModel.assign(modelJoints.size(), -1);
  const auto zero = kinematics(basePose_, Vector3d::Zero(), Vector3d::Zero(), {}, {});
  placeBodies(zero);
  for (int i = 0; i < static_cast<int>(modelJoints.size()); ++i) {
    if (modelJoints[i].type == Joint::Type::fixed) {
      if (robot_.mergeFixed) continue;
      // A fixed part of its own: a fixed joint, or nothing but its place where the base itself is fixed.
      const dJointID id = dJointCreateFixed(world_, nullptr);
      dJointAttach(id, bodies[bodyOfLink_[i + 1]].id, idOf(bodyOfLink_[modelJoints[i].parentLink]));
      dJointSetFixed(id);
      continue;
    }
    if (second_[i]) continue;
    if (universal_[i] >= 0)
      makeUniversal(i, universal_[i], zero);
    else
      makeSingle(i, zero);
  }
  coupleJoints();
  for (auto& body : bodies)
    if (body.ringInertia_kg_m2 > 0)
      for (std::size_t j = 0; j < joints.size(); ++j)
        if (joints[j].child == static_cast<int>(&body - bodies.data()) && universal_[joints[j].modelJoint] >= 0)
          body.ringJoint = static_cast<int>(j);
}

/// A joint that leads others moves what they hold too.
void Articulation::coupleJoints() {
  for (RobotJoint& joint : joints) {
    const auto& mimic = robot_.model.joints[static_cast<std::size_t>(joint.modelJoint)].mimic;
    if (!mimic) continue;
    joint.leader = jointOfModel[static_cast<std::size_t>(mimic->leader)];
    joint.multiplier = mimic->multiplier;
    joint.offset = mimic->offset;
    joints[static_cast<std::size_t>(joint.leader)].heldInertia +=
        mimic->multiplier * mimic->multiplier * joint.heldInertia;
  }
}

void Articulation::makeSingle(int modelJoint, const std::vector<LinkState>& zero) {
  const Joint& model = robot_.model.joints[modelJoint];
  RobotJoint joint;
  joint.modelJoint = modelJoint;
  joint.slides = model.type == Joint::Type::slide;
  joint.child = bodyOfLink_[modelJoint + 1];
  joint.parent = bodyOfLink_[model.parentLink];
  const Vector3d axis = zero[modelJoint + 1].pose.linear() * model.axis;
  const Vector3d anchor = zero[modelJoint + 1].pose.translation();
  joint.id = joint.slides ? dJointCreateSlider(world_, nullptr) : dJointCreateHinge(world_, nullptr);
  dJointAttach(joint.id, bodies[joint.child].id, idOf(joint.parent));
  joint.axisInParent = rotationOf(joint.parent).transpose() * axis;
  joint.axisInChild = rotationOf(joint.child).transpose() * axis;
  joint.anchorInParent = poseOf(joint.parent).inverse() * anchor;
  joint.anchorInChild = poseOf(joint.child).inverse() * anchor;
  const Vector3d u = anyAcross(axis);
  joint.u = rotationOf(joint.parent).transpose() * u;
  joint.w = rotationOf(joint.parent).transpose() * axis.cross(u);
  joint.x = rotationOf(joint.child).transpose() * u;
  finishJoint(joint, zero);
}

void Articulation::makeUniversal(int first, int second, const std::vector<LinkState>& zero) {
  const auto& modelJoints = robot_.model.joints;
  const Vector3d a = zero[first + 1].pose.linear() * modelJoints[first].axis;
  const Vector3d b = zero[second + 1].pose.linear() * modelJoints[second].axis;
  const Vector3d c = a.cross(b);
  const Vector3d origin = zero[first + 1].pose.translation();
  const Vector3d anchor = origin + a * a.dot(zero[second + 1].pose.translation() - origin);

  RobotJoint joint;
  joint.child = bodyOfLink_[second + 1];
  joint.parent = bodyOfLink_[modelJoints[first].parentLink];
  joint.id = dJointCreateUniversal(world_, nullptr);
  // The child is ODE's first body: both rows then push child against parent, and axis 1 is the one fixed in the child.
  dJointAttach(joint.id, bodies[joint.child].id, idOf(joint.parent));
  const Matrix3d inParent = rotationOf(joint.parent).transpose(), inChild = rotationOf(joint.child).transpose();
  joint.anchorInParent = poseOf(joint.parent).inverse() * anchor;
  joint.anchorInChild = poseOf(joint.child).inverse() * anchor;

  // First axis, fixed in the parent: the second axis is seen turning about it.
  joint.modelJoint = first;
  joint.group = dParamGroup2;
  joint.axisInParent = inParent * a;
  joint.axisInChild = inChild * a;
  joint.u = inParent * b;
  joint.w = inParent * c;
  joint.x = inChild * b;
  finishJoint(joint, zero);

  // Second axis, fixed in the child: the first axis is seen from there.
  joint.modelJoint = second;
  joint.group = 0;
  joint.axisFollowsChild = true;
  joint.axisInParent = inParent * b;
  joint.axisInChild = inChild * b;
  joint.u = inChild * a;
  joint.w = inChild * c;
  joint.x = inParent * a;
  finishJoint(joint, zero);
}

void Articulation::finishJoint(RobotJoint& joint, const std::vector<LinkState>& zero) {
  const Joint& model = robot_.model.joints[joint.modelJoint];
  const JointRange stops = stopsOf(model);
  joint.lowStop = stops.lower;
  joint.highStop = stops.upper;
  joint.heldInertia = inertiaHeldBy(joint, zero);
  joint.axis = rotationOf(joint.parent) * joint.axisInParent;
  jointOfModel[joint.modelJoint] = static_cast<int>(joints.size());
  joints.push_back(joint);
  // ODE remembers anchor and axes from where the bodies are now: at position 0.
  const Vector3d anchor = poseOf(joint.parent) * joint.anchorInParent;
  const Vector3d& axis = joint.axis;
  if (joint.slides) {
    dJointSetSliderAxis(joint.id, axis.x(), axis.y(), axis.z());
  } else if (dJointGetType(joint.id) == dJointTypeHinge) {
    dJointSetHingeAnchor(joint.id, anchor.x(), anchor.y(), anchor.z());
    dJointSetHingeAxis(joint.id, axis.x(), axis.y(), axis.z());
  } else {
    dJointSetUniversalAnchor(joint.id, anchor.x(), anchor.y(), anchor.z());
    if (joint.axisFollowsChild)
      dJointSetUniversalAxis1(joint.id, axis.x(), axis.y(), axis.z());
    else
      dJointSetUniversalAxis2(joint.id, axis.x(), axis.y(), axis.z());
  }
}

void Articulation::aimJoints(const Isometry3d& base) {
  // Joints to the world keep their anchor in world coordinates: they are made anew from position 0 on the new base.
  basePose_ = base;
  for (const auto& joint : joints)
    if (joint.extra) dJointDestroy(joint.extra);
  std::vector<dJointID> gone;
  for (auto& body : bodies)
    for (int i = 0; i < dBodyGetNumJoints(body.id); ++i)
      if (const dJointID id = dBodyGetJoint(body.id, i); std::find(gone.begin(), gone.end(), id) == gone.end())
        gone.push_back(id);
  for (const dJointID id : gone) dJointDestroy(id);
  joints.clear();
  makeJoints();
}

void Articulation::makeExtraRows(RobotJoint& joint) {
  const Vector3d& axis = joint.axis;
  const int relative = joint.axisFollowsChild ? 1 : joint.parent >= 0 ? 2 : 0;
  static unsigned long made = 0;  // one world a process
  joint.extraMade = ExtraRowsMemory{++made, axis, {}};
  if (relative != 0)
    joint.extraMade->attitude = attitudeOf(relative == 1 ? bodies[joint.child].id : idOf(joint.parent));
  joint.extra = joint.slides ? dJointCreateLMotor(world_, nullptr) : dJointCreateAMotor(world_, nullptr);
  dJointAttach(joint.extra, bodies[joint.child].id, idOf(joint.parent));
  if (joint.slides) {
    dJointSetLMotorNumAxes(joint.extra, 2);
    for (int i = 0; i < 2; ++i) dJointSetLMotorAxis(joint.extra, i, relative, axis.x(), axis.y(), axis.z());
  } else {
    dJointSetAMotorMode(joint.extra, dAMotorUser);
    dJointSetAMotorNumAxes(joint.extra, 2);
    for (int i = 0; i < 2; ++i) dJointSetAMotorAxis(joint.extra, i, relative, axis.x(), axis.y(), axis.z());
  }
}

void Articulation::remakeExtraRows(RobotJoint& joint, const ExtraRowsMemory& memory) {
  if (joint.extra) return;
  const dBodyID body = joint.axisFollowsChild ? bodies[joint.child].id : idOf(joint.parent);
  const Vector3d axis = joint.axis;
  joint.axis = memory.axis;
  if (!body || !memory.attitude) {
    makeExtraRows(joint);
  } else {
    const auto now = attitudeOf(body);
    setAttitude(body, *memory.attitude);
    makeExtraRows(joint);
    setAttitude(body, now);
  }
  joint.axis = axis;
}

double Articulation::inertiaHeldBy(const RobotJoint& joint, const std::vector<LinkState>& zero) const {
  const auto& model = robot_.model;
  std::vector<char> held(model.links.size(), 0);
  held[joint.modelJoint + 1] = 1;
  for (std::size_t i = static_cast<std::size_t>(joint.modelJoint) + 1; i < model.joints.size(); ++i)
    held[i + 1] = held[model.joints[i].parentLink];
  const Isometry3d& frame = zero[joint.modelJoint + 1].pose;
  const Vector3d axis = frame.linear() * model.joints[joint.modelJoint].axis;
  double sum = 0;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    if (!held[i]) continue;
    const Inertial& part = model.links[i].inertial;
    if (joint.slides) {
      sum += part.mass_kg;
      continue;
    }
    const Vector3d own = zero[i].pose.linear().transpose() * axis;
    const Vector3d arm = axis.cross(zero[i].pose * part.centreOfMass_m - frame.translation());
    sum += own.dot(part.inertia_kg_m2 * own) + part.mass_kg * arm.squaredNorm();
  }
  return sum;
}

}  // namespace btr
