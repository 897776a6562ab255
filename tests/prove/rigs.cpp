// Rigs that stand still: a servo that swings a pendulum, a leg of three joints on a stand.
#include <array>
#include <cmath>
#include <optional>
#include <sstream>

#include "core/model/load_model.h"
#include "tests/prove/blind_world.h"
#include "tests/prove/excitation.h"

namespace btr::prove {
namespace {

constexpr double gravity_m_s2 = 9.81;

/// A slender bar with a weight: length, mass and where its centre lies below the joint.
std::string linkText(const std::string& name, double mass, double below, double inertia) {
  std::ostringstream out;
  out << "  <link name=\"" << name << "\"><inertial><origin xyz=\"0 0 " << toText(-below) << "\"/><mass value=\""
      << toText(mass) << "\"/><inertia ixx=\"" << toText(inertia) << "\" iyy=\"" << toText(inertia) << "\" izz=\""
      << toText(inertia) << "\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n";
  return out.str();
}

std::string jointText(const std::string& name, const std::string& parent, const std::string& child, double below,
                      const std::string& axis) {
  return "  <joint name=\"" + name + "\" type=\"continuous\"><parent link=\"" + parent + "\"/><child link=\"" + child +
         "\"/><origin xyz=\"0 0 " + toText(-below) + "\"/><axis xyz=\"" + axis + "\"/></joint>\n";
}

/// What is common to both: one robot, fixed, files, step, noise of its joints.
BlindWorld rig(const std::string& name, const std::string& urdf, Random& random) {
  BlindWorld world;
  const std::string file = name + ".urdf";
  world.files[file] = urdf;
  world.models[file] = std::make_shared<const RobotModel>(parseUrdf(urdf, file));
  world.scene.step_s = 0.001;
  RobotSpec robot;
  robot.name = name;
  robot.model = file;
  robot.base = "fixed";
  robot.position_m = {0, 0, 0.6};
  robot.collision = "none";
  world.scene.robots.push_back(robot);

  const double sample = static_cast<double>(4 + random.below(9)) / 1000;
  world.scene.controlPeriod_s = sample;
  const Sensor encoder = drawSensor(random, 3e-4, 3e-3, 0.7, 2.5);
  const bool rates = random.chance(0.25);
  const auto& joints = world.models[file]->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const std::string at = name + "." + joints[j].name;
    addColumn(world, MeasuredColumn::What::position, j, at + ".position_rad", encoder);
    const double perSecond = random.uniform(20, 60);
    const bool rounds = encoder.noise == 0;
    if (rates)
      addColumn(world, MeasuredColumn::What::rate, j, at + ".velocity_rad_s",
                {perSecond * encoder.noise, rounds ? perSecond * encoder.quantum : 0});
    world.commanded.push_back(j);
  }
  return world;
}

/// A joint that is told to stay where it is: in all trials, or in most.
struct Standing {
  std::size_t joint = 0;
  bool always = false;
  bool stands(std::size_t other, int trial) const { return other == joint && (always || trial % 4 != 1); }
};

void addTrials(BlindWorld& world, Random& random, const std::vector<double>& reach,
               const std::optional<Standing>& standing = {}) {
  constexpr int shown = 4, keptBack = 2;
  // Some people hardly move their rig.
  const double effort = random.chance(0.12) ? drawLog(random, 0.03, 0.12) : random.uniform(0.3, 1);
  const bool powerOff = random.chance(0.35);
  world.showsEnabled = powerOff;
  const std::size_t joints = reach.size();
  for (int i = 0; i < shown + keptBack; ++i) {
    TrialPlan trial;
    trial.sample_s = world.scene.controlPeriod_s;
    trial.settle_s = 1.5;
    trial.rows = static_cast<std::size_t>(std::lround(4 / trial.sample_s)) + 1;
    trial.commands.assign(trial.rows, std::vector<double>(joints));
    for (std::size_t j = 0; j < joints; ++j) {
      const double moves = standing && standing->stands(j, i) ? 0 : 1;
      const double size = moves * reach[j] * effort * random.uniform(0.5, 1.2);
      const double rest = reach[j] * effort * random.uniform(-0.3, 0.3);
      const auto command = drawCommand(random, trial.rows, trial.sample_s, rest, size);
      for (std::size_t row = 0; row < trial.rows; ++row) trial.commands[row][j] = command[row];
    }
    trial.jointStart = trial.commands[0];
    if (powerOff) trial.enabled.assign(trial.rows, 1);
    if (powerOff && i % 2 == 1) trial.enabled = drawPower(random, trial.rows, trial.sample_s);
    world.trials.push_back(std::move(trial));
  }
  keepBack(world, keptBack);
}

/// Gains that give the joint this natural frequency [rad/s] and damping ratio with the inertia it carries.
ServoSpec servoFor(double inertia, double frequency, double ratio, double most) {
  ServoSpec servo;
  servo.numbers = {{"p", inertia * frequency * frequency},
                   {"i", 0},
                   {"d", 2 * ratio * frequency * inertia},
                   {"max_torque_nm", most}};
  return servo;
}

void calibrateServo(BlindWorld& world, Random& random, const std::string& joint,
                    const std::vector<const char*>& numbers) {
  const RobotSpec& robot = world.scene.robots[0];
  for (const char* number : numbers)
    calibrate(world, random, "robots." + robot.name + ".servos." + joint + "." + number,
              robot.servos.at(joint).numbers.at(number));
}

}  // namespace

BlindWorld drawPendulum(Random& random) {
  const double mass = random.uniform(0.1, 0.5), length = random.uniform(0.07, 0.16);
  const double own = 0.1 * mass * length * length;
  BlindWorld world =
      rig("rig",
          "<robot name=\"rig\">\n" + linkText("stand", 1, 0.2, 0.01) +
              jointText("shoulder", "stand", "arm", 0, "0 1 0") + linkText("arm", mass, length, own) + "</robot>\n",
          random);
  const double inertia = mass * length * length + own, weight = mass * gravity_m_s2 * length;
  const double frequency = random.uniform(18, 40);
  world.scene.robots[0].servos["shoulder"] =
      servoFor(inertia, frequency, random.uniform(0.25, 0.8), weight * random.uniform(1.3, 3));
  if (random.chance(0.3)) {
    calibrateServo(world, random, "shoulder", {"p", "d"});
  } else {
    calibrateServo(world, random, "shoulder", {"p", "d", "max_torque_nm"});
  }
  addTrials(world, random, {1.0});
  return world;
}

BlindWorld drawLeg(Random& random) {
  const double upper = random.uniform(0.07, 0.12), lower = random.uniform(0.07, 0.12);
  const std::array masses{random.uniform(0.04, 0.08), random.uniform(0.08, 0.2), random.uniform(0.05, 0.15)};
  const auto bar = [](double m, double l) { return m * l * l / 12 + 2e-5; };
  BlindWorld world = rig(
      "leg",
      "<robot name=\"leg\">\n" + linkText("stand", 1, 0.2, 0.01) + jointText("abduct", "stand", "rotor", 0, "1 0 0") +
          linkText("rotor", masses[0], 0.005, 3e-5) + jointText("swing", "rotor", "upper", 0, "0 1 0") +
          linkText("upper", masses[1], upper / 2, bar(masses[1], upper)) +
          jointText("knee", "upper", "lower", upper, "0 1 0") +
          linkText("lower", masses[2], lower * 0.6, bar(masses[2], lower)) + "</robot>\n",
      random);
  const double reach = upper + 0.6 * lower;
  const double whole = masses[1] * upper * upper / 3 + masses[2] * reach * reach;
  const double shank = masses[2] * 0.36 * lower * lower + bar(masses[2], lower);
  const double weight = gravity_m_s2 * (masses[1] * upper / 2 + masses[2] * reach);
  const std::array<std::pair<const char*, double>, 3> joints{{{"abduct", whole}, {"swing", whole}, {"knee", shank}}};
  for (const auto& [name, inertia] : joints)
    world.scene.robots[0].servos[name] =
        servoFor(inertia, random.uniform(18, 35), random.uniform(0.35, 0.9), weight * random.uniform(1.5, 4));
  const bool limits = random.chance(0.5);
  for (const auto& [name, inertia] : joints)
    calibrateServo(world, random, name, limits ? std::vector{"p", "d", "max_torque_nm"} : std::vector{"p", "d"});
  const Standing still{random.below(joints.size()), random.chance(0.5)};
  constexpr double someStand = 0.3;
  addTrials(world, random, {0.4, 0.8, 0.9}, random.chance(someStand) ? std::optional(still) : std::nullopt);
  return world;
}

}  // namespace btr::prove
