#include "core/live/memory_json.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/spec/json_reader.h"

namespace btr {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using nlohmann::json;

json toJson(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }
json toJson(const Matrix3d& m) {
  json rows = json::array();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) rows.push_back(m(i, k));
  return rows;
}

Vector3d vectorOf(JsonReader& reader, const std::string& key) {
  const auto n = reader.numbers(key, 3);
  return {n[0], n[1], n[2]};
}

Matrix3d axesOf(JsonReader& reader, const std::string& key) {
  const auto n = reader.numbers(key, 9);
  Matrix3d m;
  m << n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8];
  if (std::abs(m.determinant() - 1) > 1e-3 || (m * m.transpose() - Matrix3d::Identity()).norm() > 1e-3)
    reader.refuse(key, "the rows of a rotation matrix");
  return m;
}

json toJson(const BodyMemory& body) {
  return {{"position_m", toJson(body.position_m)},
          {"axes", toJson(body.axes)},
          {"velocity_m_s", toJson(body.velocity_m_s)},
          {"spin_rad_s", toJson(body.spin_rad_s)}};
}

BodyMemory bodyFrom(JsonReader reader) {
  BodyMemory body{vectorOf(reader, "position_m"), axesOf(reader, "axes"), vectorOf(reader, "velocity_m_s"),
                  vectorOf(reader, "spin_rad_s")};
  reader.finish();
  return body;
}

/// The numbers of a joint, by the names that they have in a file.
constexpr std::array jointNumbers{std::pair{"position", &JointMemory::position},
                                  std::pair{"rate", &JointMemory::rate},
                                  std::pair{"solved_rate", &JointMemory::solvedRate},
                                  std::pair{"command", &JointMemory::command},
                                  std::pair{"integral", &JointMemory::integral},
                                  std::pair{"drive_rate", &JointMemory::driveRate},
                                  std::pair{"rate_before", &JointMemory::rateBefore},
                                  std::pair{"torque", &JointMemory::torque},
                                  std::pair{"measured", &JointMemory::measured},
                                  std::pair{"load", &JointMemory::load},
                                  std::pair{"motor_ahead", &JointMemory::motorAhead},
                                  std::pair{"motor_rate", &JointMemory::motorRate},
                                  std::pair{"coupling_load", &JointMemory::couplingLoad},
                                  std::pair{"middle_rate", &JointMemory::middleRate},
                                  std::pair{"end_rate", &JointMemory::endRate}};
constexpr double largest = 1e300;

json toJson(const JointMemory& joint) {
  json object{{"fresh", joint.fresh}, {"enabled", joint.enabled}, {"effects", joint.effects}};
  for (const auto& [name, number] : jointNumbers) object[name] = joint.*number;
  return object;
}

JointMemory jointFrom(JsonReader& reader) {
  JointMemory joint;
  for (const auto& [name, number] : jointNumbers) joint.*number = reader.number(name, -largest, largest);
  joint.fresh = reader.flag("fresh", true);
  joint.enabled = reader.flag("enabled", true);
  const json* effects = reader.any("effects");
  try {
    if (effects) joint.effects = effects->get<std::vector<std::vector<double>>>();
  } catch (const json::exception&) {
    reader.refuse("effects", "lists of numbers");
  }
  reader.finish();
  return joint;
}

json toJson(const RobotMemory& robot) {
  json bodies = json::array(), rings = json::array(), joints = json::array();
  for (const BodyMemory& body : robot.bodies) bodies.push_back(toJson(body));
  for (const Vector3d& axis : robot.ringAxes) rings.push_back({{"axis", toJson(axis)}});
  for (const JointMemory& joint : robot.joints) joints.push_back(toJson(joint));
  return {
      {"name", robot.name},
      {"base",
       {{"position_m", toJson(Vector3d(robot.base.translation()))}, {"axes", toJson(Matrix3d(robot.base.linear()))}}},
      {"bodies", bodies},
      {"rings", rings},
      {"joints", joints},
      {"contact", robot.contact},
      {"first", robot.first},
      {"touches", robot.touches},
      {"all_drives", robot.allDrives},
      {"accelerometer_velocity_m_s", toJson(robot.accelerometerVelocity_m_s)},
      {"specific_force_m_s2", toJson(robot.specificForce_m_s2)}};
}

RobotMemory robotFrom(JsonReader& reader) {
  RobotMemory robot;
  robot.name = reader.text("name");
  JsonReader base = reader.object("base");
  robot.base.translation() = vectorOf(base, "position_m");
  robot.base.linear() = axesOf(base, "axes");
  base.finish();
  reader.array("bodies", [&](JsonReader body) { robot.bodies.push_back(bodyFrom(body)); });
  reader.array("rings", [&](JsonReader ring) {
    robot.ringAxes.push_back(vectorOf(ring, "axis"));
    ring.finish();
  });
  reader.array("joints", [&](JsonReader joint) { robot.joints.push_back(jointFrom(joint)); });
  for (const double flag : reader.numberList("contact")) robot.contact.push_back(flag != 0 ? 1 : 0);
  robot.first = reader.flag("first", true);
  robot.touches = reader.flag("touches", false);
  robot.allDrives = reader.number("all_drives", 0, largest);
  robot.accelerometerVelocity_m_s = vectorOf(reader, "accelerometer_velocity_m_s");
  robot.specificForce_m_s2 = vectorOf(reader, "specific_force_m_s2");
  reader.finish();
  return robot;
}

json toJson(const ThingMemory& thing) {
  return {{"name", thing.name}, {"body", toJson(thing.body)}, {"touched", thing.touched}, {"on_floor", thing.onFloor}};
}

ThingMemory thingFrom(JsonReader& reader) {
  ThingMemory thing{reader.text("name"), bodyFrom(reader.object("body")), reader.flag("touched", false),
                    reader.flag("on_floor", false)};
  reader.finish();
  return thing;
}

}  // namespace

json toJson(const WorldMemory& memory) {
  json document{{"start_s", memory.start_s}, {"steps", memory.steps},  {"ode_seed", memory.odeSeed},
                {"robots", json::array()},   {"balls", json::array()}, {"obstacles", json::array()}};
  for (const RobotMemory& robot : memory.robots) document["robots"].push_back(toJson(robot));
  for (const ThingMemory& ball : memory.balls) document["balls"].push_back(toJson(ball));
  for (const ThingMemory& obstacle : memory.obstacles) document["obstacles"].push_back(toJson(obstacle));
  return document;
}

WorldMemory worldMemoryFromReader(JsonReader reader) {
  WorldMemory memory;
  constexpr long mostSteps = 1'000'000'000'000;
  memory.start_s = reader.number("start_s", 0, 1e9);
  memory.steps = static_cast<long>(reader.integer("steps", 0, mostSteps));
  memory.odeSeed = static_cast<unsigned long>(reader.seed("ode_seed", 0));
  reader.array("robots", [&](JsonReader robot) { memory.robots.push_back(robotFrom(robot)); });
  reader.array("balls", [&](JsonReader ball) { memory.balls.push_back(thingFrom(ball)); });
  reader.array("obstacles", [&](JsonReader obstacle) { memory.obstacles.push_back(thingFrom(obstacle)); });
  reader.finish();
  return memory;
}

}  // namespace btr
