#include "ui/scene3d/link_marks.h"

#include <algorithm>
#include <cmath>

#include "ui/scene3d/link_boxes.h"

namespace btr::ui {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double axis_m = 0.04, arc_m = 0.03, metresPerNewton = 0.01, longestForce_m = 0.3;

void addLine(LineSegments& lines, const Vector3d& from, const Vector3d& to) {
  lines.push_back(from.cast<float>());
  lines.push_back(to.cast<float>());
}

void addCross(LineSegments& lines, const Vector3d& at, double half) {
  for (int axis = 0; axis < 3; ++axis)
    addLine(lines, at - half * Vector3d::Unit(axis), at + half * Vector3d::Unit(axis));
}

void addBox(LineSegments& lines, const Eigen::AlignedBox3d& box) {
  if (box.isEmpty()) return;
  const auto corner = [&](int bits) { return box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(bits)); };
  for (int from = 0; from < 8; ++from)
    for (int axis = 1; axis < 8; axis *= 2)
      if (!(from & axis)) addLine(lines, corner(from), corner(from | axis));
}

/// The turning joint's own direction of "zero": at right angles to its axis.
Vector3d across(const Vector3d& axis) { return axis.unitOrthogonal(); }

void addLimits(LineSegments& lines, const Joint& joint) {
  constexpr double unlimited = 1e6;
  if (joint.lower < -unlimited || joint.upper > unlimited) return;
  if (joint.type == Joint::Type::slide) {
    addLine(lines, joint.origin * Vector3d(joint.lower * joint.axis),
            joint.origin * Vector3d(joint.upper * joint.axis));
    return;
  }
  constexpr int steps = 24;
  const auto place = [&](int step) {
    const double angle = joint.lower + (joint.upper - joint.lower) * step / steps;
    return Vector3d(joint.origin * (AngleAxisd(angle, joint.axis) * Vector3d(arc_m * across(joint.axis))));
  };
  for (int step = 0; step < steps; ++step) addLine(lines, place(step), place(step + 1));
  for (const int end : {0, steps}) addLine(lines, joint.origin.translation(), place(end));
}

}  // namespace

std::vector<LinkMarks> marksOf(const RobotModel& model) {
  std::vector<LinkMarks> marks(model.links.size());
  const std::vector<Eigen::AlignedBox3d> boxes = linkBoxes(model);
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    addBox(marks[i].box, boxes[i]);
    if (const Inertial& inertial = model.links[i].inertial; inertial.mass_kg > 0)
      addCross(marks[i].centre, inertial.centreOfMass_m, 0.02 * std::cbrt(inertial.mass_kg));
  }
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    if (joint.type == Joint::Type::fixed) continue;
    LinkMarks& moved = marks[i + 1];
    addLine(moved.axes, -axis_m * joint.axis, axis_m * joint.axis);
    if (joint.type == Joint::Type::rotate) addLine(moved.axes, Vector3d::Zero(), arc_m * across(joint.axis));
    addLimits(marks[static_cast<std::size_t>(joint.parentLink)].limits, joint);
  }
  return marks;
}

LineSegments contactLines(const std::vector<WorldMarks::Contact>& contacts) {
  LineSegments lines;
  for (const WorldMarks::Contact& contact : contacts) {
    if (!contact.place_m.allFinite() || !contact.force_n.allFinite()) continue;
    addCross(lines, contact.place_m, 0.006);
    Vector3d way = metresPerNewton * contact.force_n;
    if (way.norm() > longestForce_m) way *= longestForce_m / way.norm();
    addLine(lines, contact.place_m, contact.place_m + way);
  }
  return lines;
}

LineSegments trailLines(const std::vector<std::vector<Eigen::Vector3f>>& trails) {
  LineSegments lines;
  for (const auto& trail : trails)
    for (std::size_t i = 1; i < trail.size(); ++i)
      if (trail[i].allFinite() && trail[i - 1].allFinite()) {
        lines.push_back(trail[i - 1]);
        lines.push_back(trail[i]);
      }
  return lines;
}

}  // namespace btr::ui
