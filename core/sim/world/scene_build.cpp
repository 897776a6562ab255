// Scene file and models → a Scene.
#include "core/sim/world/scene_build.h"

#include <cmath>
#include <filesystem>
#include <utility>

#include "core/model/joint_range.h"
#include "core/model/load_model.h"
#include "core/model/servo_by_load.h"
#include "core/sim/contact/collision.h"
#include "core/spec/error.h"

namespace btr {
namespace {

Drive driveFromModel(const Joint& joint) {
  Drive drive;
  drive.kind = joint.type == Joint::Type::fixed || joint.mimic ? Drive::Kind::none : Drive::Kind::servo;
  if (joint.type == Joint::Type::fixed) return drive;
  const ServoData& servo = joint.servo;
  drive.p = servo.p_nm_rad.value_or(defaultServoP_nm_rad);
  drive.i = servo.i_nm_rad_s.value_or(0);
  drive.d = servo.d_nm_s_rad.value_or(defaultServoD_nm_s_rad);
  drive.maxTorque = servo.maxTorque_nm.value_or(defaultServoLimit(joint.type));
  drive.noLoadSpeed_rad_s = servo.noLoadSpeed_rad_s.value_or(0);
  drive.coulombFriction = servo.coulombFriction_nm.value_or(0);
  drive.viscousFriction = servo.viscousFriction_nm_s_rad.value_or(0);
  const double ratio = servo.gearRatio.value_or(1);
  drive.rotorInertia_kg_m2 = servo.rotorInertia_kg_m2.value_or(0) * ratio * ratio;
  return drive;
}

Drive::Kind kindOf(const ServoSpec& servo, const Joint& joint, const std::string& place) {
  const bool slides = joint.type == Joint::Type::slide;
  if (servo.drive == "servo") return Drive::Kind::servo;
  if (servo.drive == "dc_motor") return Drive::Kind::dcMotor;
  if (servo.drive == "motion") return Drive::Kind::motion;
  if (servo.drive == "none" || servo.drive == "locked") return Drive::Kind::none;
  if (servo.drive == (slides ? "force" : "torque")) return Drive::Kind::torque;
  throw InputError(place + ".drive", servo.drive,
                   slides ? "servo, dc_motor, force, motion, none or locked on a slide joint"
                          : "servo, dc_motor, torque, motion, none or locked on a rotary joint");
}

int jointOf(const SceneRobot& robot, const std::string& name, const std::string& place) {
  const int joint = robot.model.findJoint(name);
  if (joint < 0 || robot.model.joints[static_cast<std::size_t>(joint)].type == Joint::Type::fixed)
    throw InputError(place, name, "a moving joint of the model " + robot.model.name);
  return joint;
}

/// "follows left_finger"
std::string followsOf(const RobotModel& model, std::size_t joint) {
  return "follows " + model.joints[static_cast<std::size_t>(model.joints[joint].mimic->leader)].name;
}

/// A body that nothing carries needs a mass: the root's, with what is rigidly fixed to it.
void needMass(const RobotSpec& spec, const RobotModel& model) {
  std::vector<char> rigid(model.links.size(), 0);
  rigid[0] = 1;
  double mass = model.links[0].inertial.mass_kg;
  for (std::size_t i = 0; i < model.joints.size() && spec.mergeFixed; ++i) {
    const Joint& joint = model.joints[i];
    rigid[i + 1] = joint.type == Joint::Type::fixed && rigid[static_cast<std::size_t>(joint.parentLink)];
    if (rigid[i + 1]) mass += model.links[i + 1].inertial.mass_kg;
  }
  if (!(mass > 0))
    throw InputError("scene robots." + spec.name + ".base", "free",
                     "fixed: the root link " + model.links[0].name + " of the model " + model.name + " has no mass");
}

/// Beyond its stop a joint would be thrown off it. (A stop yields a little, and files have rounded numbers.)
void setStarts(SceneRobot& robot, const RobotSpec& spec, const std::string& place) {
  constexpr double yields_rad = 1e-3, yields_m = 1e-4;
  const RobotModel& model = robot.model;
  robot.jointStart = startPositions(model);
  for (const auto& [name, start] : spec.jointStart) {
    const auto index = static_cast<std::size_t>(jointOf(robot, name, place));
    const Joint& joint = model.joints[index];
    if (joint.mimic) throw InputError(place, name, "no joint that " + followsOf(model, index));
    const bool slides = joint.type == Joint::Type::slide;
    const auto [lower, upper] = stopsOf(joint);
    const double yields = slides ? yields_m : yields_rad;
    if (start < lower - yields || start > upper + yields)
      throw InputError(place + "." + name, toText(start),
                       toText(lower) + " to " + toText(upper) + (slides ? " m" : " rad") +
                           ", where the mechanical stops of the model " + model.name + " are");
    robot.jointStart[index] = start;
  }
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    if (const auto& mimic = model.joints[i].mimic)
      robot.jointStart[i] =
          mimic->multiplier * robot.jointStart[static_cast<std::size_t>(mimic->leader)] + mimic->offset;
}

void setRates(SceneRobot& robot, const RobotSpec& spec, const std::string& place) {
  constexpr double fastest_m_s = 50;  // as the world bears
  const RobotModel& model = robot.model;
  for (const auto& [name, rate] : spec.jointRate) {
    const auto joint = static_cast<std::size_t>(jointOf(robot, name, place));
    if (model.joints[joint].mimic) throw InputError(place, name, "no joint that " + followsOf(model, joint));
    if (model.joints[joint].type == Joint::Type::slide && std::abs(rate) > fastest_m_s)
      throw InputError(place + "." + name, toText(rate) + " m/s",
                       "from -" + toText(fastest_m_s) + " to " + toText(fastest_m_s));
    robot.jointStartRate[joint] = rate;
  }
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    if (const auto& mimic = model.joints[i].mimic)
      robot.jointStartRate[i] = mimic->multiplier * robot.jointStartRate[static_cast<std::size_t>(mimic->leader)];
}

/// A joint that is rigid where it begins: a fixed one from here on, so that what it carries is one body with the rest.
void lock(SceneRobot& robot, std::size_t index, const RobotSpec& spec, const std::string& place) {
  Joint& joint = robot.model.joints[index];
  if (!spec.servos.at(joint.name).numbers.empty())
    throw InputError(place + ".servos." + joint.name, "numbers", "none beside \"drive\": \"locked\"");
  if (robot.jointStartRate[index] != 0)
    throw InputError(place + ".joint_velocity." + joint.name, toText(robot.jointStartRate[index]), "0: it is locked");
  for (const Joint& other : robot.model.joints)
    if (other.mimic && other.mimic->leader == static_cast<int>(index))
      throw InputError(place + ".servos." + joint.name + ".drive", "locked",
                       "another drive: " + other.name + " follows it");
  const double start = std::exchange(robot.jointStart[index], 0);
  if (joint.type == Joint::Type::rotate) joint.origin.rotate(Eigen::AngleAxisd(start, joint.axis));
  if (joint.type == Joint::Type::slide) joint.origin.translate(start * joint.axis);
  joint.type = Joint::Type::fixed;
  robot.drives[index] = driveFromModel(joint);
}

SceneRobot robotFrom(const RobotSpec& spec, const RobotModel& model) {
  SceneRobot robot;
  robot.name = spec.name;
  robot.model = model;
  robot.freeBase = spec.base == "free";
  if (robot.freeBase) needMass(spec, model);
  robot.collision = spec.collision;
  robot.mergeFixed = spec.mergeFixed;
  const auto& q = spec.orientation_wxyz;
  robot.start = Eigen::Translation3d(spec.position_m[0], spec.position_m[1], spec.position_m[2]) *
                Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  robot.startVelocity_m_s << spec.velocity_m_s[0], spec.velocity_m_s[1], spec.velocity_m_s[2];
  robot.startSpin_rad_s << spec.spin_rad_s[0], spec.spin_rad_s[1], spec.spin_rad_s[2];
  robot.jointStartRate.assign(model.joints.size(), 0);
  for (const Joint& joint : model.joints) robot.drives.push_back(driveFromModel(joint));

  const std::string place = "scene robots." + spec.name;
  setStarts(robot, spec, place + ".joint_start");
  setRates(robot, spec, place + ".joint_velocity");
  for (const auto& [name, servo] : spec.servos) {
    const auto joint = static_cast<std::size_t>(jointOf(robot, name, place + ".servos"));
    Drive& drive = robot.drives[joint];
    drive.kind = kindOf(servo, model.joints[joint], place + ".servos." + name);
    if (model.joints[joint].mimic && drive.kind != Drive::Kind::none)
      throw InputError(place + ".servos." + name + ".drive", servo.drive,
                       "none for a joint that " + followsOf(model, joint));
    // What a kind of drive does not have stays out of it: only a servo's numbers come from the model.
    if (drive.kind != Drive::Kind::servo) drive.maxTorque = 1e9, drive.noLoadSpeed_rad_s = 0;
    if (drive.kind == Drive::Kind::dcMotor)
      for (const char* number : {"voltage_v", "resistance_ohm", "max_duty"})
        setDriveNumber(drive, model.joints[joint], number, find(servoNumbers(), number)->byDefault, place);
    for (const auto& [number, value] : servo.numbers)
      setDriveNumber(drive, model.joints[joint], number, value, place + ".servos." + name);
  }
  for (const auto& [name, servo] : spec.servos)
    if (servo.drive == "locked") lock(robot, static_cast<std::size_t>(robot.model.findJoint(name)), spec, place);
  return robot;
}

}  // namespace

double* driveNumber(Drive& drive, const Joint& joint, const std::string& number) {
  const bool slides = joint.type == Joint::Type::slide;
  const auto is = [&](const char* rotary, const char* sliding) { return number == (slides ? sliding : rotary); };
  if (number == "p") return &drive.p;
  if (number == "i") return &drive.i;
  if (number == "d") return &drive.d;
  if (number == "off_braking") return &drive.offBraking;
  if (is("max_torque_nm", "max_force_n")) return &drive.maxTorque;
  if (is("no_load_speed_rad_s", "no_load_speed_m_s")) return &drive.noLoadSpeed_rad_s;
  if (is("firmware_gain_v_per_rad", "firmware_gain_v_per_m")) return &drive.firmwareGain_v_rad;
  if (number == "voltage_v") return &drive.supply_v;
  if (is("torque_constant_nm_per_a", "force_constant_n_per_a")) return &drive.torqueConstant_nm_a;
  if (number == "resistance_ohm") return &drive.resistance_ohm;
  if (number == "max_duty") return &drive.maxDuty;
  if (is("rotor_inertia_kg_m2", "rotor_inertia_kg")) return &drive.rotorInertia_kg_m2;
  if (is("coulomb_friction_nm", "coulomb_friction_n")) return &drive.coulombFriction;
  if (is("viscous_friction_nm_s_rad", "viscous_friction_n_s_m")) return &drive.viscousFriction;
  return nullptr;
}

void setDriveNumber(Drive& drive, const Joint& joint, const std::string& number, double value,
                    const std::string& place) {
  double* target = driveNumber(drive, joint, number);
  if (!target)
    throw InputError(place, number,
                     joint.type == Joint::Type::slide
                         ? "a number of a slide joint's drive (p, i, d, max_force_n, …)"
                         : "a number of a rotary joint's drive (p, i, d, max_torque_nm, …)");
  *target = value;
}

void scaleMass(Link& link, double factor) {
  link.inertial.mass_kg *= factor;
  link.inertial.inertia_kg_m2 *= factor;
}

void makeHulls(RobotModel& model, const std::string& path, const SceneSpec& scene) {
  for (const RobotSpec& robot : scene.robots) {
    if (robot.model != path) continue;
    for (Link& link : model.links)
      for (Shape& shape : link.shapes)
        if (shape.kind == Shape::Kind::mesh && !shape.hull && collidesIn(model, link, shape, robot.collision))
          shape.hull = convexHull(shape.surface->vertices);
  }
}

ModelSet loadModels(const SceneSpec& spec, const ModelSet& known) {
  ModelSet models;
  for (const auto& robot : spec.robots) {
    if (models.contains(robot.model)) continue;
    const std::filesystem::path path(robot.model);
    const auto full = path.is_absolute() ? path : std::filesystem::path(spec.directory) / path;
    const auto there = known.find(robot.model);
    RobotModel model = there == known.end() ? loadModel(full.string()) : *there->second;
    makeHulls(model, robot.model, spec);
    models[robot.model] = std::make_shared<const RobotModel>(std::move(model));
  }
  return models;
}

Scene sceneFromModels(const SceneSpec& spec, const ModelSet& models) {
  Scene scene;
  scene.gravity_m_s2 << spec.gravity_m_s2[0], spec.gravity_m_s2[1], spec.gravity_m_s2[2];
  scene.step_s = spec.step_s;
  scene.controlPeriod_s = spec.controlPeriod_s;
  scene.floor = spec.floor;
  scene.balls = spec.balls;
  scene.obstacles = spec.obstacles;
  scene.robotsCollide = spec.robotsCollide;
  scene.slidingFriction = spec.slidingFriction;
  for (const auto& robot : spec.robots) {
    const auto model = models.find(robot.model);
    if (model == models.end())
      throw InputError("scene robots." + robot.name + ".model", robot.model, "a model that was loaded");
    scene.robots.push_back(robotFrom(robot, *model->second));
  }
  // Numbers of single links and joints are paths into the scene like those of a simulator version.
  for (const auto& robot : spec.robots) {
    // A mass takes its inertia with it: it comes before an inertia that is given.
    for (const auto& [link, values] : robot.links)
      for (const bool mass : {true, false})
        for (const auto& [number, value] : values)
          if ((number == "mass_kg") == mass)
            setByPath(scene, "robots." + robot.name + ".links." + link + "." + number, value);
    for (const auto& [joint, values] : robot.joints)
      for (const auto& [number, value] : values)
        setByPath(scene, "robots." + robot.name + ".joints." + joint + "." + number, value);
  }
  return scene;
}

}  // namespace btr
