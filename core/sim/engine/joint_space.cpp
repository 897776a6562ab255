#include "core/sim/engine/joint_space.h"

#include <algorithm>
#include <cmath>

namespace btr {
namespace {
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// In the world. (Eigen multiplies whole matrices in place, the parts of a pose by calls.)
Vector3d anchorOf(const Articulation& robot, const RobotJoint& joint) {
  return robot.rotationOf(joint.parent) * joint.anchorInParent + robot.poseOf(joint.parent).translation();
}

}  // namespace

bool JointSpace::suits(const SceneRobot& robot) {
  constexpr std::size_t rowsOfAJoint = 2;  // its drive and its dry friction
  if (robot.freeBase || !robot.mergeFixed || rowsOfAJoint * robot.model.joints.size() > BoxSolver::mostRows)
    return false;
  const auto collides = [](const Link& link) { return std::ranges::any_of(link.shapes, &Shape::collides); };
  return robot.collision == "none" || std::ranges::none_of(robot.model.links, collides);
}

void JointSpace::begin(const Articulation& robot) {
  const auto count = static_cast<Eigen::Index>(robot.joints.size());
  moving_.clear();
  rate_.resize(count);
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const RobotJoint& joint = robot.joints[j];
    Matrix3d inParent, inChild;
    inParent << joint.axisInParent, joint.u, joint.w;
    inChild << joint.axisInChild, joint.x, joint.axisInChild.cross(joint.x);
    const auto carrier = std::ranges::find(moving_, joint.parent, &Moving::child);
    moving_.push_back({joint.child, carrier == moving_.end() ? -1 : static_cast<int>(carrier - moving_.begin()),
                       inParent * inChild.transpose(), robot.rotationOf(joint.parent) * joint.axisInParent,
                       anchorOf(robot, joint)});
    rate_[static_cast<Eigen::Index>(j)] = joint.rate;
  }
  coupled_.clear();
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    if (const RobotJoint& joint = robot.joints[j]; joint.leader >= 0)
      coupled_.push_back({static_cast<Eigen::Index>(j), joint.leader, joint.multiplier});
  beginRate_ = rate_;
  weight_ = bias_ = right_ = next_ = Eigen::VectorXd::Zero(count);
  mass_ = matrix_ = inverse_ = Eigen::MatrixXd::Zero(count, count);
  massKnown_ = false;
  moved_.resize(robot.bodies.size());
  turn_.resize(robot.joints.size());
  push_.resize(robot.joints.size());
}

void JointSpace::setRates(const Eigen::VectorXd& middle, const Eigen::VectorXd& end) {
  rate_ = middle;
  beginRate_ = end;
  massKnown_ = false;
}

void JointSpace::prepare(const Articulation& robot, const Vector3d& gravity) {
  const bool several = moving_.size() > 1;  // a single joint has no bias
  for (std::size_t j = 0; j < moving_.size(); ++j) {
    const RobotJoint& joint = robot.joints[j];
    turn_[j] = joint.slides ? Vector3d(Vector3d::Zero()) : joint.axis;
    push_[j] =
        joint.slides ? joint.axis : (joint.parent < 0 ? moving_[j].anchor : anchorOf(robot, joint)).cross(joint.axis);
    const RobotBody& body = robot.bodies[static_cast<std::size_t>(joint.child)];
    Moved& moved = moved_[static_cast<std::size_t>(joint.child)];
    const Vector3d& centre = body.pose.translation();
    moved.mass = body.mass_kg;
    moved.moment = body.mass_kg * centre;
    if (massKnown_) continue;
    moved.inertia = body.pose.linear() * body.inertia_kg_m2 * body.pose.linear().transpose() +
                    moved.moment.dot(centre) * Matrix3d::Identity() - moved.moment * centre.transpose();
    if (!several) continue;
    Vector3d spin = Vector3d::Zero(), velocity = spin, spinChange = spin, velocityChange = spin;
    if (joint.parent >= 0) {
      const Moved& carrier = moved_[static_cast<std::size_t>(joint.parent)];
      spin = carrier.spin;
      velocity = carrier.velocity;
      spinChange = carrier.spinChange;
      velocityChange = carrier.velocityChange;
    }
    const Vector3d turning = beginRate_[static_cast<Eigen::Index>(j)] * turn_[j];
    const Vector3d pushing = beginRate_[static_cast<Eigen::Index>(j)] * push_[j];
    moved.spinChange = spinChange + spin.cross(turning);
    moved.velocityChange = velocityChange + spin.cross(pushing) + velocity.cross(turning);
    moved.spin = spin + turning;
    moved.velocity = velocity + pushing;
    const Vector3d linear = moved.mass * moved.velocity + moved.spin.cross(moved.moment);
    const Vector3d angular = moved.inertia * moved.spin + moved.moment.cross(moved.velocity);
    moved.force = moved.mass * moved.velocityChange + moved.spinChange.cross(moved.moment) + moved.spin.cross(linear);
    moved.turning = moved.inertia * moved.spinChange + moved.moment.cross(moved.velocityChange) +
                    moved.spin.cross(angular) + moved.velocity.cross(linear);
  }
  // From the ends of the tree to its root: what each joint carries.
  for (std::size_t j = moving_.size(); j-- > 0;) {
    const auto row = static_cast<Eigen::Index>(j);
    const Moved& carried = moved_[static_cast<std::size_t>(moving_[j].child)];
    weight_[row] = turn_[j].dot(carried.moment.cross(gravity)) + push_[j].dot(carried.mass * gravity);
    if (massKnown_) continue;
    const Vector3d linear = carried.mass * push_[j] + turn_[j].cross(carried.moment);
    const Vector3d angular = carried.inertia * turn_[j] + carried.moment.cross(push_[j]);
    mass_(row, row) = turn_[j].dot(angular) + push_[j].dot(linear);
    if (!several) continue;
    bias_[row] = turn_[j].dot(carried.turning) + push_[j].dot(carried.force);
    mass_.row(row).head(row).setZero();
    for (int by = moving_[j].carrier; by >= 0; by = moving_[static_cast<std::size_t>(by)].carrier)
      mass_(row, by) =
          turn_[static_cast<std::size_t>(by)].dot(angular) + push_[static_cast<std::size_t>(by)].dot(linear);
    if (robot.joints[j].parent < 0) continue;
    Moved& carrier = moved_[static_cast<std::size_t>(robot.joints[j].parent)];
    carrier.mass += carried.mass;
    carrier.moment += carried.moment;
    carrier.inertia += carried.inertia;
    carrier.force += carried.force;
    carrier.turning += carried.turning;
  }
  massKnown_ = !several;
}

// T has a column for each joint that follows none, with the multipliers of those that follow it. The others' equations
// are left as "nothing moves", so that the sizes stay.
void JointSpace::coupleEquations() {
  matrix_.triangularView<Eigen::StrictlyUpper>() = matrix_.transpose();
  for (const Coupled& c : coupled_) {
    right_[c.leader] += c.multiplier * right_[c.joint];
    matrix_.row(c.leader) += c.multiplier * matrix_.row(c.joint);
    matrix_.col(c.leader) += c.multiplier * matrix_.col(c.joint);
    right_[c.joint] = 0;
    matrix_.row(c.joint).setZero();
    matrix_.col(c.joint).setZero();
    matrix_(c.joint, c.joint) = 1;
    for (Bounded& row : bounded_)
      if (row.joint == c.joint) row.joint = c.leader, row.factor = c.multiplier;
  }
}

bool JointSpace::solve(const std::vector<JointRows>& rows, double h) {
  bounded_.clear();
  for (std::size_t j = 0; j < rows.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    const auto add = [&](double p, double d) {
      matrix_(i, i) += h * d;
      right_[i] += h * p;
    };
    add(rows[j].passive.p, rows[j].passive.d);
    const DriveRow& drive = rows[j].drive;
    if (!drive.limited())
      add(drive.p, drive.d);
    else if (drive.d <= noDamping)
      add(drive.torqueAt(0), 0);
    else
      bounded_.push_back({i, 1, drive.p / drive.d, 1 / drive.d, drive.limit});
    if (const DryFriction& dry = rows[j].dry; dry.limit > 0)
      bounded_.push_back({i, 1, rows[j].heldRate, dry.softness(), dry.limit});
  }
  if (!coupled_.empty()) coupleEquations();
  const Eigen::Index joints = right_.size();
  if (joints == 1) {
    inverse_(0, 0) = 1 / matrix_(0, 0);
    next_[0] = right_[0] * inverse_(0, 0);
  } else {
    factor_.compute(matrix_);
    next_ = factor_.solve(right_);
    if (!bounded_.empty()) inverse_ = factor_.solve(Eigen::MatrixXd::Identity(joints, joints));
  }
  if (bounded_.empty()) return next_.allFinite();

  // Torques of the bounded rows: (h·S·A⁻¹·Sᵀ + softness)·torque = target − S·rate without them.
  const std::size_t count = bounded_.size();
  a_.resize(count * count);
  bx_.assign(2 * count, 0);
  loHi_.resize(2 * count);
  for (std::size_t r = 0; r < count; ++r) {
    const Bounded& row = bounded_[r];
    for (std::size_t c = 0; c <= r; ++c)
      a_[r * count + c] = h * row.factor * bounded_[c].factor * inverse_(row.joint, bounded_[c].joint);
    a_[r * count + r] += row.softness;
    bx_[2 * r] = row.target - row.factor * next_[row.joint];
    loHi_[2 * r] = -row.limit;
    loHi_[2 * r + 1] = row.limit;
  }
  const auto n = static_cast<unsigned>(count);
  if (!box_.solve({n, n, a_.data(), bx_.data(), loHi_.data(), nullptr}, true)) return false;
  for (std::size_t r = 0; r < count; ++r)
    for (Eigen::Index i = 0; i < joints; ++i)
      next_[i] += h * bx_[2 * r + 1] * bounded_[r].factor * inverse_(i, bounded_[r].joint);
  return next_.allFinite();
}

bool JointSpace::step(Articulation& robot, const std::vector<JointRows>& rows, double kick, double h) {
  if (moving_.size() == 1) {
    matrix_(0, 0) = mass_(0, 0);
    right_[0] = mass_(0, 0) * rate_[0] + h * kick * weight_[0];
  } else {
    matrix_ = mass_;
    right_ = mass_.selfadjointView<Eigen::Lower>() * rate_ + h * kick * (weight_ - bias_);
  }
  if (!solve(rows, h)) return false;
  for (const Coupled& c : coupled_) next_[c.joint] = c.multiplier * next_[c.leader];
  beginRate_ = next_ + (next_ - rate_) / (2 * kick);
  rate_ = next_;
  for (std::size_t j = 0; j < moving_.size(); ++j) {
    RobotJoint& joint = robot.joints[j];
    joint.rate = joint.solvedRate = rate_[static_cast<Eigen::Index>(j)];
    joint.position += h * joint.rate;
  }
  place(robot);
  return true;
}

void JointSpace::place(Articulation& robot) const {
  for (std::size_t j = 0; j < moving_.size(); ++j) {
    RobotJoint& joint = robot.joints[j];
    RobotBody& child = robot.bodies[static_cast<std::size_t>(joint.child)];
    const Matrix3d turned = robot.rotationOf(joint.parent);
    joint.axis = moving_[j].axis;
    Vector3d anchor = moving_[j].anchor;
    Matrix3d linear;
    Vector3d spin = Vector3d::Zero(), velocity = Vector3d::Zero();  // of the parent; of its point at the anchor
    if (joint.parent >= 0) {
      joint.axis = turned * joint.axisInParent;
      anchor = anchorOf(robot, joint);
      const RobotBody& carrier = robot.bodies[static_cast<std::size_t>(joint.parent)];
      spin = carrier.spin_rad_s;
      velocity = carrier.velocity_m_s + spin.cross(anchor - carrier.pose.translation());
    }
    if (joint.slides) {
      linear = turned * moving_[j].turnAtZero;
      child.pose.translation() = anchor + joint.position * joint.axis - linear * joint.anchorInChild;
      child.velocity_m_s = velocity + spin.cross(child.pose.translation() - anchor) + joint.rate * joint.axis;
    } else {
      const Matrix3d turn = Eigen::AngleAxisd(joint.position, joint.axisInParent).toRotationMatrix();
      linear = turned * turn * moving_[j].turnAtZero;
      child.pose.translation() = anchor - linear * joint.anchorInChild;
      spin += joint.rate * joint.axis;
      child.velocity_m_s = velocity + spin.cross(child.pose.translation() - anchor);
    }
    child.pose.linear() = linear;
    child.spin_rad_s = spin;
  }
}

}  // namespace btr
