// What must hold of every robot, whatever file it came from.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/model/load_model.h"
#include "core/spec/error.h"
#include "core/spec/figures.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

// As in scene files: far beyond every robot, and the squares and products of such numbers stay finite.
constexpr double lightest_kg = 1e-6, largestNumber = 1e6;  // 0.000001 to 1000000 below

void checkLargest(double value, const std::string& what, int line, const std::string& place) {
  if (!(std::abs(value) <= largestNumber))
    throw InputError(place, line,
                     what + " " + toText(value) + " is not allowed; " + toText(-largestNumber) + " to " +
                         toText(largestNumber) + " is expected");
}

void checkSizes(const Link& link, const std::string& place) {
  const std::string name = "link " + link.name + ": ";
  for (const Shape& shape : link.shapes) {
    checkLargest(shape.size_m.cwiseAbs().maxCoeff(), name + "the size of a shape", link.line, place);
    checkLargest(shape.pose.translation().cwiseAbs().maxCoeff(), name + "the place of a shape", link.line, place);
    if (!shape.surface) continue;
    for (const Eigen::Vector3f& vertex : shape.surface->vertices)
      checkLargest(vertex.cwiseAbs().maxCoeff(), name + "a corner of a mesh", link.line, place);
  }
}

void checkServo(const Joint& joint, const std::string& place) {
  const ServoData& s = joint.servo;
  const std::string name = "joint " + joint.name + ": ";
  const auto check = [&](const std::optional<double>& value, const char* what) {
    if (value) checkLargest(*value, name + what, joint.line, place);
  };
  check(s.p_nm_rad, "the proportional gain");
  check(s.i_nm_rad_s, "the integral gain");
  check(s.d_nm_s_rad, "the damping of the servo");
  check(s.maxTorque_nm, "the largest torque");
  check(s.noLoadSpeed_rad_s, "the no-load speed");
  check(s.coulombFriction_nm, "the dry friction");
  check(s.viscousFriction_nm_s_rad, "the viscous friction");
  check(s.backlash_rad, "the backlash");
  check(s.commandDelay_s, "the delay of commands");
  check(s.gearRatio, "the gear ratio");
  check(s.rotorInertia_kg_m2, "the rotor's inertia");
  check(joint.speedLimit, "the speed limit");
}

/// Eigenvalues must be those of a body with mass: positive. None of a real body's is larger than the sum of the others;
/// files of estimated or rounded numbers break that, and what moves by them still obeys Newton: a warning. Files have
/// few digits, so a thin plate may miss it by a ten thousandth.
void checkInertia(const Link& link, const std::string& place, std::vector<Warning>& warnings) {
  const Eigen::Matrix3d& inertia = link.inertial.inertia_kg_m2;
  const std::string name = "link " + link.name + ": the inertia ";
  if (!inertia.allFinite()) throw InputError(place, link.line, name + "must be finite");
  const double size = inertia.cwiseAbs().maxCoeff();
  if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() > 1e-6 * size)
    throw InputError(place, link.line, name + "must be symmetric");
  checkLargest(size, "link " + link.name + ": the inertia [kg m2]", link.line, place);
  // Scaled first: squares of very small moments would vanish.
  if (!(size > 0)) throw InputError(place, link.line, name + "must be positive definite");
  const Eigen::Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(inertia / size, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(moments(0) > 1e-9)) throw InputError(place, link.line, name + "must be positive definite");
  if (moments(2) > (moments(0) + moments(1)) * (1 + 1e-4))
    warnings.push_back({link.line,
                        name + "violates the triangle inequality, which no real body does: principal moments " +
                            brief(moments(0) * size) + ", " + brief(moments(1) * size) + ", " +
                            brief(moments(2) * size) + " kg m2; simulated as given",
                        Warning::Loss::inertia, link.name});
}

void checkLink(const Link& link, bool mayBeMassless, const std::string& place, std::vector<Warning>& warnings) {
  const Inertial& inertial = link.inertial;
  if (mayBeMassless && inertial.mass_kg == 0) return;
  if (!(inertial.mass_kg >= lightest_kg && inertial.mass_kg <= largestNumber))
    throw InputError(place, link.line,
                     "link " + link.name + ": mass " + toText(inertial.mass_kg) +
                         " kg is not allowed; 0.000001 to 1000000 kg is expected" +
                         (inertial.mass_kg == 0 ? " of what moves (a mass of its own, or a fixed joint)" : ""));
  if (!inertial.centreOfMass_m.allFinite())
    throw InputError(place, link.line, "link " + link.name + ": centre of mass must be finite");
  checkLargest(inertial.centreOfMass_m.cwiseAbs().maxCoeff(), "link " + link.name + ": the centre of mass [m]",
               link.line, place);
  checkInertia(link, place, warnings);
}

/// More than a turn is rare, and ±1000 and more are a program's "none".
void checkUnits(const Joint& joint, std::vector<Warning>& warnings) {
  constexpr double turn_rad = 7, none_rad = 1000;
  const double farthest = std::max(std::abs(joint.lower), std::abs(joint.upper));
  if (joint.type == Joint::Type::rotate && farthest > turn_rad && farthest < none_rad)
    warnings.push_back({joint.line, "joint " + joint.name + ": the limits " + toText(joint.lower) + " to " +
                                        toText(joint.upper) + " look like degrees; they are taken as radians"});
}

void checkJoint(const Joint& joint, std::size_t number, const std::string& place) {
  const std::string name = "joint " + joint.name + ": ";
  if (joint.parentLink < 0 || static_cast<std::size_t>(joint.parentLink) > number)
    throw InputError(place, joint.line, name + "its parent link must come before it");
  if (!joint.origin.matrix().allFinite()) throw InputError(place, joint.line, name + "its place must be finite");
  checkLargest(joint.origin.translation().cwiseAbs().maxCoeff(), name + "its place [m]", joint.line, place);
  checkServo(joint, place);
  if (joint.type == Joint::Type::fixed) return;
  if (!(std::abs(joint.axis.stableNorm() - 1) < 1e-6))
    throw InputError(place, joint.line,
                     name + "axis " + toText(joint.axis.x()) + " " + toText(joint.axis.y()) + " " +
                         toText(joint.axis.z()) + " is not allowed; a unit vector is expected");
  if (joint.mimic) {
    checkLargest(joint.mimic->multiplier, name + "the multiplier of its mimic", joint.line, place);
    checkLargest(joint.mimic->offset, name + "the offset of its mimic", joint.line, place);
  }
  if (!(joint.lower < joint.upper))
    throw InputError(place, joint.line,
                     name + "limits " + toText(joint.lower) + " and " + toText(joint.upper) +
                         " are not allowed; the lower must be less than the upper");
}

/// Finds two things of the same name.
class Names {
 public:
  Names(const char* what, const std::string& place) : what_(what), place_(place) {}
  void add(const std::string& name, int line) {
    const auto [first, isNew] = lines_.try_emplace(name, line);
    if (!isNew)
      throw InputError(place_, line,
                       "a second " + what_ + " \"" + name + "\" is not allowed; the first is in line " +
                           std::to_string(first->second));
  }

 private:
  std::string what_;
  const std::string& place_;
  std::unordered_map<std::string, int> lines_;
};

}  // namespace

void checkModel(RobotModel& model, const std::string& place) {
  if (model.links.empty()) throw InputError(place + ": the robot has no links; at least one is expected");
  if (model.joints.size() + 1 != model.links.size())
    throw InputError(place + ": the robot has " + std::to_string(model.links.size()) + " links and " +
                     std::to_string(model.joints.size()) +
                     " joints; one root and a joint for each other link are expected");
  Names links("link", place), joints("joint", place), ids("joint with jointId", place), sensors("sensor", place);
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    if (link.name.empty()) throw InputError(place, link.line, "a link without a name is not allowed");
    links.add(link.name, link.line);
    // A base that stands in the world needs no mass.
    checkSizes(link, place);
    checkLink(link, i == 0 && !model.freeBase, place, model.warnings);
  }
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    if (joint.name.empty()) throw InputError(place, joint.line, "a joint without a name is not allowed");
    joints.add(joint.name, joint.line);
    if (joint.id >= 0) ids.add(std::to_string(joint.id), joint.line);
    checkJoint(joint, i, place);
    checkUnits(joint, model.warnings);
  }
  for (const Sensor& sensor : model.sensors)
    if (!sensor.name.empty()) sensors.add(sensor.name, model.links[static_cast<std::size_t>(sensor.link)].line);
}

}  // namespace btr
