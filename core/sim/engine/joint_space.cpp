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
    Moving moving{joint.child,
                  carrier == moving_.end() ? -1 : static_cast<int>(carrier - moving_.begin()),
                  inParent * inChild.transpose(),
                  Matrix3d::Zero(),
                  Matrix3d::Zero(),
                  anchorOf(robot, joint)};
    if (!joint.slides) {
      const Vector3d& axis = joint.axisInParent;
      const Matrix3d atZero = moving.still;
      moving.still = axis * (axis.transpose() * atZero);
      moving.cosine = atZero - moving.still;
      for (int c = 0; c < 3; ++c) moving.sine.col(c) = axis.cross(Vector3d(atZero.col(c)));
    }
    moving_.push_back(moving);
    rate_[static_cast<Eigen::Index>(j)] = joint.rate;
  }
  coupled_.clear();
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    if (const RobotJoint& joint = robot.joints[j]; joint.leader >= 0)
      coupled_.push_back({static_cast<Eigen::Index>(j), joint.leader, joint.multiplier});
  beginRate_ = rate_;
  weight_ = bias_ = right_ = next_ = Eigen::VectorXd::Zero(count);
  mass_ = matrix_ = inverse_ = Eigen::MatrixXd::Zero(count, count);
  singleKnown_ = false;
  moved_.resize(robot.bodies.size());
  turn_.resize(robot.joints.size());
  push_.resize(robot.joints.size());
}

void JointSpace::setRates(const Eigen::VectorXd& middle, const Eigen::VectorXd& end) {
  rate_ = middle;
  beginRate_ = end;
}

// Taken in the body's own axes, so that nothing depends on where it is when it is first asked for.
void JointSpace::prepareSingle(const Articulation& robot, const Vector3d& gravity) {
  const RobotJoint& joint = robot.joints[0];
  if (!singleKnown_) {
    const RobotBody& body = robot.bodies[static_cast<std::size_t>(joint.child)];
    const Vector3d arm = -joint.anchorInChild;  // to its centre of mass
    single_ = {};
    if (joint.slides) {
      mass_(0, 0) = body.mass_kg;
      single_.constant = body.mass_kg * joint.axis.dot(gravity);
    } else {
      const Vector3d across = arm - joint.axisInChild.dot(arm) * joint.axisInChild;
      mass_(0, 0) = joint.axisInChild.dot(body.inertia_kg_m2 * joint.axisInChild) + body.mass_kg * across.squaredNorm();
      const Matrix3d atZero = moving_[0].still + moving_[0].cosine;
      const Vector3d inWorld = robot.rotationOf(joint.parent) * (atZero * across);
      single_.cosine = body.mass_kg * joint.axis.dot(inWorld.cross(gravity));
      single_.sine = body.mass_kg * joint.axis.dot(joint.axis.cross(inWorld).cross(gravity));
    }
    singleKnown_ = true;
  }
  weight_[0] = single_.constant;
  if (single_.cosine != 0 || single_.sine != 0)
    weight_[0] += single_.cosine * std::cos(joint.position) + single_.sine * std::sin(joint.position);
}

void JointSpace::prepare(const Articulation& robot, const Vector3d& gravity) {
  if (moving_.size() == 1) {
    prepareSingle(robot, gravity);
    return;
  }
  for (std::size_t j = 0; j < moving_.size(); ++j) {
    const RobotJoint& joint = robot.joints[j];
    turn_[j] = joint.slides ? Vector3d(Vector3d::Zero()) : joint.axis;
    push_[j] = joint.slides ? joint.axis : Vector3d(moving_[j].anchor.cross(joint.axis));
    const RobotBody& body = robot.bodies[static_cast<std::size_t>(joint.child)];
    Moved& moved = moved_[static_cast<std::size_t>(joint.child)];
    const Vector3d& centre = body.pose.translation();
    moved.mass = body.mass_kg;
    moved.moment = body.mass_kg * centre;
    moved.inertia = body.pose.linear() * body.inertia_kg_m2 * body.pose.linear().transpose() +
                    moved.moment.dot(centre) * Matrix3d::Identity() - moved.moment * centre.transpose();
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
    const Vector3d linear = carried.mass * push_[j] + turn_[j].cross(carried.moment);
    const Vector3d angular = carried.inertia * turn_[j] + carried.moment.cross(push_[j]);
    mass_(row, row) = turn_[j].dot(angular) + push_[j].dot(linear);
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

/// L·D·Lᵀ: a handful of rows, for which a library's blocks and allocations take longer than the sums.
void JointSpace::factor() {
  const Eigen::Index n = matrix_.rows();
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = j; i < n; ++i) {
      double sum = matrix_(i, j);
      for (Eigen::Index k = 0; k < j; ++k) sum -= matrix_(i, k) * matrix_(k, k) * matrix_(j, k);
      matrix_(i, j) = i == j ? sum : sum / matrix_(j, j);
    }
}

void JointSpace::solveFor(Eigen::Ref<Eigen::VectorXd> right) const {
  const Eigen::Index n = matrix_.rows();
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < i; ++k) right[i] -= matrix_(i, k) * right[k];
  for (Eigen::Index i = n; i-- > 0;) {
    right[i] /= matrix_(i, i);
    for (Eigen::Index k = i + 1; k < n; ++k) right[i] -= matrix_(k, i) * right[k];
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
    factor();
    next_ = right_;
    solveFor(next_);
    for (const Bounded& row : bounded_) {
      inverse_.col(row.joint).setZero();
      inverse_(row.joint, row.joint) = 1;
      solveFor(inverse_.col(row.joint));
    }
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
    for (Eigen::Index i = 0; i < right_.size(); ++i) {
      right_[i] = h * kick * (weight_[i] - bias_[i]);
      for (Eigen::Index k = 0; k < right_.size(); ++k) right_[i] += mass_(std::max(i, k), std::min(i, k)) * rate_[k];
    }
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
  return true;
}

void JointSpace::place(Articulation& robot) {
  for (std::size_t j = 0; j < moving_.size(); ++j) {
    Moving& moving = moving_[j];
    RobotJoint& joint = robot.joints[j];
    Isometry3d& pose = robot.bodies[static_cast<std::size_t>(joint.child)].pose;
    const Matrix3d parent = robot.rotationOf(joint.parent);
    if (joint.parent >= 0) {  // else neither moves
      joint.axis = parent * joint.axisInParent;
      moving.anchor = anchorOf(robot, joint);
    }
    const Matrix3d inParent = joint.slides ? moving.still
                                           : Matrix3d(moving.still + std::cos(joint.position) * moving.cosine +
                                                      std::sin(joint.position) * moving.sine);
    const Matrix3d linear = parent * inParent;
    pose.translation() = moving.anchor - linear * joint.anchorInChild;
    if (joint.slides) pose.translation() += joint.position * joint.axis;
    pose.linear() = linear;
  }
}

void JointSpace::placeVelocities(Articulation& robot) const {
  for (std::size_t j = 0; j < moving_.size(); ++j) {
    const RobotJoint& joint = robot.joints[j];
    RobotBody& child = robot.bodies[static_cast<std::size_t>(joint.child)];
    Vector3d spin = Vector3d::Zero(), velocity = Vector3d::Zero();  // of the parent; of its point at the anchor
    if (joint.parent >= 0) {
      const RobotBody& carrier = robot.bodies[static_cast<std::size_t>(joint.parent)];
      spin = carrier.spin_rad_s;
      velocity = carrier.velocity_m_s + spin.cross(moving_[j].anchor - carrier.pose.translation());
    }
    if (joint.slides)
      velocity += joint.rate * joint.axis;
    else
      spin += joint.rate * joint.axis;
    child.velocity_m_s = velocity + spin.cross(child.pose.translation() - moving_[j].anchor);
    child.spin_rad_s = spin;
  }
}

}  // namespace btr
