#include "core/spec/scene_spec.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/pitch_spec.h"

namespace btr {
namespace {

using nlohmann::json;
constexpr double farthest_m = 1000;
constexpr double fastest_m_s = 50, fastest_rad_s = 500;  // as the world bears

constexpr std::array<double, 3> atRest{0, 0, 0};

template <std::size_t N>
std::array<double, N> vectorOf(JsonReader& reader, const std::string& key, double largest,
                               std::array<double, N> byDefault) {
  const auto numbers = reader.numbers(key, N, {byDefault.begin(), byDefault.end()});
  std::array<double, N> vector;
  for (std::size_t i = 0; i < N; ++i) {
    if (!(std::abs(numbers[i]) <= largest))
      reader.refuse(key, "numbers from " + toText(-largest) + " to " + toText(largest));
    vector[i] = numbers[i];
  }
  return vector;
}

std::array<double, 4> orientationOf(JsonReader& reader) {
  auto q = vectorOf<4>(reader, "orientation_wxyz", 2, {1, 0, 0, 0});
  const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
  if (std::abs(square - 1) > 0.01) reader.refuse("orientation_wxyz", "a unit quaternion w, x, y, z");
  // Typed with few digits: made exactly one. What is one already keeps its bits.
  if (std::abs(square - 1) > 1e-12)
    for (double& part : q) part /= std::sqrt(square);
  return q;
}

/// Names become column names ROBOT.JOINT.QUANTITY and path elements.
std::string nameOf(JsonReader& reader, std::set<std::string>& taken) {
  const std::string name = reader.text("name");
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; };
  if (name.empty() || name.size() > 64 || !std::all_of(name.begin(), name.end(), plain) || name == "floor" ||
      name == "world")
    reader.refuse("name", "1 to 64 letters, digits, _ or -, not floor or world");
  if (!taken.insert(name).second) reader.refuse("name", "a name that no other robot, ball or obstacle has");
  return name;
}

ServoSpec servoFrom(JsonReader reader) {
  ServoSpec servo;
  servo.drive = reader.word("drive", {"servo", "dc_motor", "torque", "force", "motion", "none", "locked"}, "servo");
  for (const Parameter& number : servoNumbers())
    if (reader.any(number.name))
      servo.numbers[number.name] = reader.number(number.name, number.minimum, number.maximum);
  reader.finish();
  return servo;
}

std::map<std::string, Values> entriesFrom(JsonReader& reader, const std::string& key,
                                          const std::vector<Parameter>& declared) {
  std::map<std::string, Values> entries;
  reader.members(key, [&](const std::string& name, JsonReader entry) {
    Values& values = entries[name];
    for (const Parameter& number : declared)
      if (entry.any(number.name)) values[number.name] = entry.number(number.name, number.minimum, number.maximum);
    entry.finish();
  });
  return entries;
}

/// How a robot moves at the start.
void readMotion(JsonReader& reader, RobotSpec& robot) {
  robot.velocity_m_s = vectorOf<3>(reader, "velocity_m_s", fastest_m_s, robot.velocity_m_s);
  robot.spin_rad_s = vectorOf<3>(reader, "spin_rad_s", fastest_rad_s, robot.spin_rad_s);
  if (robot.base == "fixed")
    for (const char* key : {"velocity_m_s", "spin_rad_s"})
      if (reader.has(key)) reader.refuse(key, "nothing for a robot whose base is fixed");
  robot.jointRate = reader.anyValues("joint_velocity");
  for (const auto& [joint, rate] : robot.jointRate)
    if (!(std::abs(rate) <= fastest_rad_s))
      reader.refuse("joint_velocity", "velocities from -" + toText(fastest_rad_s) + " to " + toText(fastest_rad_s) +
                                          " rad/s, from -" + toText(fastest_m_s) + " to " + toText(fastest_m_s) +
                                          " m/s of a slide joint");
}

RobotSpec robotFrom(JsonReader& reader, std::set<std::string>& taken) {
  RobotSpec robot;
  robot.name = nameOf(reader, taken);
  robot.model = reader.text("model");
  if (robot.model.empty()) reader.refuse("model", "the path of a .wrl or .urdf file");
  robot.base = reader.word("base", {"free", "fixed"}, robot.base);
  robot.position_m = vectorOf<3>(reader, "position_m", farthest_m, robot.position_m);
  robot.orientation_wxyz = orientationOf(reader);
  robot.collision = reader.word("collision", {"primitives", "mesh", "none"}, robot.collision);
  robot.mergeFixed = reader.flag("merge_fixed", robot.mergeFixed);
  reader.members("servos", [&](const std::string& joint, JsonReader entry) { robot.servos[joint] = servoFrom(entry); });
  robot.jointStart = reader.anyValues("joint_start");
  for (const auto& [joint, start] : robot.jointStart)
    if (std::abs(start) > 100) reader.refuse("joint_start", "positions from -100 to 100 rad or m");
  readMotion(reader, robot);
  robot.links = entriesFrom(reader, "links", linkNumbers());
  robot.joints = entriesFrom(reader, "joints", jointNumbers());
  reader.finish();
  return robot;
}

BallSpec ballFrom(JsonReader& reader, std::set<std::string>& taken) {
  BallSpec ball;
  ball.name = nameOf(reader, taken);
  ball.radius_m = reader.number("radius_m", 0.001, 10, ball.radius_m);
  ball.mass_kg = reader.number("mass_kg", 1e-6, 1000, ball.mass_kg);
  ball.inertiaFactor = reader.number("inertia_factor", 0.01, 2.0 / 3.0, ball.inertiaFactor);
  ball.rollingDeceleration_m_s2 = reader.number("rolling_deceleration_m_s2", 0, 100, ball.rollingDeceleration_m_s2);
  ball.restitution = reader.number("restitution", 0, 1, ball.restitution);
  ball.position_m = vectorOf<3>(reader, "position_m", farthest_m, {0, 0, ball.radius_m});
  ball.velocity_m_s = vectorOf<3>(reader, "velocity_m_s", fastest_m_s, ball.velocity_m_s);
  ball.spin_rad_s = vectorOf<3>(reader, "spin_rad_s", fastest_rad_s, ball.spin_rad_s);
  reader.finish();
  return ball;
}

ObstacleSpec obstacleFrom(JsonReader& reader, std::set<std::string>& taken) {
  ObstacleSpec obstacle;
  obstacle.name = nameOf(reader, taken);
  obstacle.shape = reader.word("shape", {"box", "cylinder", "sphere", "ramp"}, obstacle.shape);
  const bool round = obstacle.shape == "cylinder" || obstacle.shape == "sphere";
  constexpr double thinnest_m = 1e-3, largest_m = 100;
  if (obstacle.shape == "cylinder") {
    obstacle.size_m[2] = reader.number("height_m", thinnest_m, largest_m, obstacle.size_m[2]);
  } else if (!round) {
    obstacle.size_m = vectorOf<3>(reader, "size_m", largest_m, obstacle.size_m);
    for (const double edge : obstacle.size_m)
      if (edge < thinnest_m) reader.refuse("size_m", "edges from " + toText(thinnest_m) + " to " + toText(largest_m));
  }
  if (round) obstacle.radius_m = reader.number("radius_m", thinnest_m, largest_m, obstacle.radius_m);
  obstacle.mass_kg = reader.number("mass_kg", 0, 1000, obstacle.mass_kg);
  if (obstacle.mass_kg > 0 && obstacle.mass_kg < 1e-4)
    reader.refuse("mass_kg", "0 (it never moves), or 0.0001 to 1000");
  obstacle.friction = reader.number("friction", 0, 100, obstacle.friction);
  obstacle.restitution = reader.number("restitution", 0, 1, obstacle.restitution);
  const double below = obstacle.shape == "sphere" ? obstacle.radius_m : obstacle.size_m[2] / 2;
  obstacle.position_m = vectorOf<3>(reader, "position_m", farthest_m, {0, 0, below});
  obstacle.orientation_wxyz = orientationOf(reader);
  obstacle.velocity_m_s = vectorOf<3>(reader, "velocity_m_s", fastest_m_s, obstacle.velocity_m_s);
  obstacle.spin_rad_s = vectorOf<3>(reader, "spin_rad_s", fastest_rad_s, obstacle.spin_rad_s);
  obstacle.colour = colourFromReader(reader, "colour", obstacle.colour);
  reader.finish();
  return obstacle;
}

FloorSpec floorFrom(JsonReader reader) {
  FloorSpec floor;
  floor.friction = reader.number("friction", 0, 100, floor.friction);
  floor.restitution = reader.number("restitution", 0, 1, floor.restitution);
  floor.slip1_m_s_n = reader.number("slip1_m_s_n", 0, 10, floor.slip1_m_s_n);
  floor.slip2_m_s_n = reader.number("slip2_m_s_n", 0, 10, floor.slip2_m_s_n);
  floor.stiffness_n_m = reader.number("stiffness_n_m", 1, 1e9, floor.stiffness_n_m);
  floor.damping_n_s_m = reader.number("damping_n_s_m", 0, 1e7, floor.damping_n_s_m);
  reader.finish();
  return floor;
}

CalibratePath pathFrom(JsonReader reader) {
  CalibratePath path;
  path.path = reader.text("path");
  path.minimum = reader.number("min", -1e12, 1e12);
  path.maximum = reader.number("max", -1e12, 1e12);
  if (path.path.empty()) reader.refuse("path", "a path into the scene, as robots.leg.servos.knee.p");
  if (path.minimum >= path.maximum) reader.refuse("max", "a number above min");
  reader.finish();
  return path;
}

json robotToJson(const RobotSpec& robot) {
  json object{{"name", robot.name},
              {"model", robot.model},
              {"base", robot.base},
              {"position_m", robot.position_m},
              {"orientation_wxyz", robot.orientation_wxyz},
              {"collision", robot.collision},
              {"merge_fixed", robot.mergeFixed}};
  for (const auto& [joint, servo] : robot.servos) {
    json entry = toJson(servo.numbers, servoNumbers());
    entry["drive"] = servo.drive;
    object["servos"][joint] = std::move(entry);
  }
  if (!robot.jointStart.empty()) object["joint_start"] = robot.jointStart;
  // Left out where there is nothing to say: scenes that are stored keep their text.
  if (robot.velocity_m_s != atRest) object["velocity_m_s"] = robot.velocity_m_s;
  if (robot.spin_rad_s != atRest) object["spin_rad_s"] = robot.spin_rad_s;
  if (!robot.jointRate.empty()) object["joint_velocity"] = robot.jointRate;
  for (const auto& [link, numbers] : robot.links) object["links"][link] = toJson(numbers, linkNumbers());
  for (const auto& [joint, numbers] : robot.joints) object["joints"][joint] = toJson(numbers, jointNumbers());
  return object;
}

json ballToJson(const BallSpec& ball) {
  return {{"name", ball.name},
          {"radius_m", ball.radius_m},
          {"mass_kg", ball.mass_kg},
          {"inertia_factor", ball.inertiaFactor},
          {"rolling_deceleration_m_s2", ball.rollingDeceleration_m_s2},
          {"restitution", ball.restitution},
          {"position_m", ball.position_m},
          {"velocity_m_s", ball.velocity_m_s},
          {"spin_rad_s", ball.spin_rad_s}};
}

json obstacleToJson(const ObstacleSpec& obstacle) {
  json object{{"name", obstacle.name},
              {"shape", obstacle.shape},
              {"mass_kg", obstacle.mass_kg},
              {"friction", obstacle.friction},
              {"restitution", obstacle.restitution},
              {"position_m", obstacle.position_m},
              {"orientation_wxyz", obstacle.orientation_wxyz},
              {"velocity_m_s", obstacle.velocity_m_s},
              {"spin_rad_s", obstacle.spin_rad_s},
              {"colour", obstacle.colour}};
  if (obstacle.shape == "box" || obstacle.shape == "ramp") object["size_m"] = obstacle.size_m;
  if (obstacle.shape == "cylinder") object["height_m"] = obstacle.size_m[2];
  if (obstacle.shape == "cylinder" || obstacle.shape == "sphere") object["radius_m"] = obstacle.radius_m;
  return object;
}

}  // namespace

bool RobotSpec::moves() const {
  return velocity_m_s != atRest || spin_rad_s != atRest ||
         std::ranges::any_of(jointRate, [](const auto& rate) { return rate.second != 0; });
}

RobotSpec robotFromJson(const std::string& text, const std::string& place) {
  JsonReader reader = JsonReader::parse(text, place);
  std::set<std::string> taken;
  return robotFrom(reader, taken);
}

BallSpec ballFromJson(const std::string& text, const std::string& place) {
  JsonReader reader = JsonReader::parse(text, place);
  std::set<std::string> taken;
  return ballFrom(reader, taken);
}

ObstacleSpec obstacleFromJson(const std::string& text, const std::string& place) {
  JsonReader reader = JsonReader::parse(text, place);
  std::set<std::string> taken;
  return obstacleFrom(reader, taken);
}

std::string toJsonText(const RobotSpec& robot) { return robotToJson(robot).dump(); }
std::string toJsonText(const BallSpec& ball) { return ballToJson(ball).dump(); }
std::string toJsonText(const ObstacleSpec& obstacle) { return obstacleToJson(obstacle).dump(); }

SceneSpec sceneFromJson(const std::string& text, const std::string& place, const std::string& directory) {
  JsonReader reader = JsonReader::parse(text, place);
  reader.word("format", {"uchilsim-scene-1"});
  SceneSpec scene;
  scene.directory = directory;
  scene.gravity_m_s2 = vectorOf<3>(reader, "gravity_m_s2", 100, scene.gravity_m_s2);
  scene.step_s = reader.number("step_s", 1e-5, 0.02, scene.step_s);
  scene.controlPeriod_s = reader.number("control_period_s", 1e-5, 1, scene.controlPeriod_s);
  const double steps = scene.controlPeriod_s / scene.step_s;
  if (std::round(steps) < 1 || std::abs(steps - std::round(steps)) > 1e-6 * steps)
    reader.refuse("step_s", "a whole part of control_period_s = " + toText(scene.controlPeriod_s));
  if (auto floor = reader.objectIfAny("floor")) scene.floor = floorFrom(*floor);
  std::set<std::string> taken;
  reader.array("robots", [&](JsonReader entry) { scene.robots.push_back(robotFrom(entry, taken)); });
  reader.array("balls", [&](JsonReader entry) { scene.balls.push_back(ballFrom(entry, taken)); });
  reader.array("obstacles", [&](JsonReader entry) { scene.obstacles.push_back(obstacleFrom(entry, taken)); });
  pitchFromReader(reader);  // who needs it reads it for himself
  scene.robotsCollide = reader.flag("robots_collide", scene.robotsCollide);
  if (reader.word("sliding_friction", {"box", "isotropic"}, "box") == "isotropic")
    scene.slidingFriction = SlidingFriction::isotropic;
  std::set<std::string> paths;
  reader.array("calibrate", [&](JsonReader entry) {
    scene.calibrate.push_back(pathFrom(entry));
    if (!paths.insert(scene.calibrate.back().path).second) entry.refuse("path", "each path once");
  });
  reader.finish();
  return scene;
}

SceneSpec loadScene(const std::string& path) {
  return sceneFromJson(readFile(path), path, std::filesystem::path(path).parent_path().string());
}

std::string toJsonText(const SceneSpec& scene) {
  json document{{"format", "uchilsim-scene-1"}, {"gravity_m_s2", scene.gravity_m_s2},
                {"step_s", scene.step_s},       {"control_period_s", scene.controlPeriod_s},
                {"robots", json::array()},      {"balls", json::array()},
                {"calibrate", json::array()}};
  if (scene.floor)
    document["floor"] = {{"friction", scene.floor->friction},           {"restitution", scene.floor->restitution},
                         {"slip1_m_s_n", scene.floor->slip1_m_s_n},     {"slip2_m_s_n", scene.floor->slip2_m_s_n},
                         {"stiffness_n_m", scene.floor->stiffness_n_m}, {"damping_n_s_m", scene.floor->damping_n_s_m}};
  for (const RobotSpec& robot : scene.robots) document["robots"].push_back(robotToJson(robot));
  for (const BallSpec& ball : scene.balls) document["balls"].push_back(ballToJson(ball));
  // Left out where there is nothing to say: scenes that are stored keep their text.
  for (const ObstacleSpec& obstacle : scene.obstacles) document["obstacles"].push_back(obstacleToJson(obstacle));
  if (scene.robotsCollide) document["robots_collide"] = true;
  if (scene.slidingFriction == SlidingFriction::isotropic) document["sliding_friction"] = "isotropic";
  for (const CalibratePath& path : scene.calibrate)
    document["calibrate"].push_back({{"path", path.path}, {"min", path.minimum}, {"max", path.maximum}});
  return document.dump(2) + "\n";
}

const std::vector<Parameter>& servoNumbers() {
  static const std::vector<Parameter> numbers{
      {"p", "N·m/rad or N/m", "proportional gain", 0, 1e9, 7.5},
      {"i", "N·m/(rad·s) or N/(m·s)", "integral gain", 0, 1e6, 0},
      {"d", "N·m·s/rad or N·s/m", "damping", 0, 1e6, 0.05},
      {"max_torque_nm", "N·m", "largest torque of the drive", 0, 1e6, 0.85},
      {"max_force_n", "N", "largest force of the drive on a slide joint", 0, 1e6, 10},
      {"no_load_speed_rad_s", "rad/s", "a servo's torque ends at this speed; 0: no such limit", 0, 1e6, 0},
      {"no_load_speed_m_s", "m/s", "a servo's force ends at this speed of a slide joint; 0: no such limit", 0, 1e6, 0},
      {"firmware_gain_v_per_rad", "V/rad", "voltage per position error", 0, 1e6, 0},
      {"firmware_gain_v_per_m", "V/m", "voltage per position error on a slide joint", 0, 1e6, 0},
      {"voltage_v", "V", "supply voltage", 0, 1000, 7.2},
      {"torque_constant_nm_per_a", "N·m/A", "torque at the joint per current", 0, 1e6, 1},
      {"force_constant_n_per_a", "N/A", "force at a slide joint per current", 0, 1e6, 1},
      {"resistance_ohm", "Ω", "resistance of the motor's winding", 1e-6, 1e6, 1},
      {"max_duty", "", "largest share of the supply voltage", 0, 1, 1},
      {"off_braking", "", "share of the motor's own braking when switched off: 0 open winding, 1 shorted", 0, 1, 0},
      {"rotor_inertia_kg_m2", "kg·m²", "inertia of the rotor, seen at the joint", 0, 1e6, 0},
      {"rotor_inertia_kg", "kg", "inertia of the rotor, seen at a slide joint", 0, 1e6, 0},
  };
  return numbers;
}

const std::vector<Parameter>& linkNumbers() {
  static const std::vector<Parameter> numbers{
      {"mass_kg", "kg", "mass; the inertia scales with it", 1e-6, 1e6, 1},
      {"com_x_m", "m", "centre of mass, link's x", -100, 100, 0},
      {"com_y_m", "m", "centre of mass, link's y", -100, 100, 0},
      {"com_z_m", "m", "centre of mass, link's z", -100, 100, 0},
      {"inertia_xx_kg_m2", "kg·m²", "about the centre of mass, link's x", 1e-12, 1e6, 1},
      {"inertia_yy_kg_m2", "kg·m²", "about the centre of mass, link's y", 1e-12, 1e6, 1},
      {"inertia_zz_kg_m2", "kg·m²", "about the centre of mass, link's z", 1e-12, 1e6, 1},
  };
  return numbers;
}

const std::vector<Parameter>& jointNumbers() {
  static const std::vector<Parameter> numbers{
      {"coulomb_friction_nm", "N·m", "dry friction", 0, 1e6, 0},
      {"coulomb_friction_n", "N", "dry friction of a slide joint", 0, 1e6, 0},
      {"viscous_friction_nm_s_rad", "N·m·s/rad", "friction proportional to speed", 0, 1e6, 0},
      {"viscous_friction_n_s_m", "N·s/m", "friction proportional to speed of a slide joint", 0, 1e6, 0},
  };
  return numbers;
}

}  // namespace btr
