#include "core/model/model_json.h"

#include <nlohmann/json.hpp>

#include "core/spec/error.h"

namespace btr {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using nlohmann::json;

json toJson(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Vector3d vectorFrom(const json& numbers) {
  return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
}

/// The three rows of a pose's matrix: a quaternion would round.
json toJson(const Isometry3d& pose) {
  json rows = json::array();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) rows.push_back(pose.matrix()(row, column));
  return rows;
}

Isometry3d poseFrom(const json& rows) {
  Isometry3d pose = Isometry3d::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      pose.matrix()(row, column) = rows.at(static_cast<std::size_t>(4 * row + column)).get<double>();
  return pose;
}

json toJson(const Link& link) {
  json inertia = json::array();
  for (int i = 0; i < 9; ++i) inertia.push_back(link.inertial.inertia_kg_m2(i / 3, i % 3));
  json object{{"name", link.name},
              {"mass_kg", link.inertial.mass_kg},
              {"centre_m", toJson(link.inertial.centreOfMass_m)},
              {"inertia_kg_m2", inertia},
              {"shapes", json::array()}};
  for (const Shape& shape : link.shapes)
    if (shape.kind != Shape::Kind::mesh)
      object["shapes"].push_back({{"kind", static_cast<int>(shape.kind)},
                                  {"pose", toJson(shape.pose)},
                                  {"size_m", toJson(shape.size_m)},
                                  {"collides", shape.collides},
                                  {"part", shape.part}});
  return object;
}

Link linkFrom(const json& object) {
  Link link;
  link.name = object.at("name");
  link.inertial.mass_kg = object.at("mass_kg");
  link.inertial.centreOfMass_m = vectorFrom(object.at("centre_m"));
  for (int i = 0; i < 9; ++i)
    link.inertial.inertia_kg_m2(i / 3, i % 3) = object.at("inertia_kg_m2").at(static_cast<std::size_t>(i));
  for (const json& each : object.at("shapes")) {
    Shape shape;
    const int kind = each.at("kind");
    if (kind < 0 || kind >= static_cast<int>(Shape::Kind::mesh)) throw InputError("a shape of no kind");
    shape.kind = static_cast<Shape::Kind>(kind);
    shape.pose = poseFrom(each.at("pose"));
    shape.size_m = vectorFrom(each.at("size_m"));
    shape.collides = each.at("collides");
    shape.part = each.at("part");
    link.shapes.push_back(shape);
  }
  return link;
}

json toJson(const Joint& joint) {
  json object{{"name", joint.name},
              {"id", joint.id},
              {"type", static_cast<int>(joint.type)},
              {"parent", joint.parentLink},
              {"origin", toJson(joint.origin)},
              {"axis", toJson(joint.axis)},
              {"lower", joint.lower},
              {"upper", joint.upper},
              {"speed_limit", joint.speedLimit},
              {"primitive", joint.primitive}};
  if (joint.mimic)
    object["mimic"] = {
        {"leader", joint.mimic->leader}, {"multiplier", joint.mimic->multiplier}, {"offset", joint.mimic->offset}};
  return object;
}

Joint jointFrom(const json& object, std::size_t links) {
  Joint joint;
  joint.name = object.at("name");
  joint.id = object.at("id");
  const int type = object.at("type");
  if (type < 0 || type > static_cast<int>(Joint::Type::fixed)) throw InputError("a joint of no type");
  joint.type = static_cast<Joint::Type>(type);
  joint.parentLink = object.at("parent");
  if (joint.parentLink < 0 || static_cast<std::size_t>(joint.parentLink) >= links)
    throw InputError("a joint at no link");
  joint.origin = poseFrom(object.at("origin"));
  joint.axis = vectorFrom(object.at("axis"));
  joint.lower = object.at("lower");
  joint.upper = object.at("upper");
  joint.speedLimit = object.at("speed_limit");
  joint.primitive = object.at("primitive");
  if (object.contains("mimic")) {
    const json& mimic = object.at("mimic");
    joint.mimic = Mimic{mimic.at("leader"), mimic.at("multiplier"), mimic.at("offset")};
  }
  return joint;
}

json toJson(const Sensor& sensor) {
  return {{"name", sensor.name},
          {"kind", static_cast<int>(sensor.kind)},
          {"link", sensor.link},
          {"pose", toJson(sensor.pose)},
          {"width", sensor.width},
          {"height", sensor.height},
          {"field_of_view_rad", sensor.fieldOfView_rad}};
}

Sensor sensorFrom(const json& object) {
  Sensor sensor;
  sensor.name = object.at("name");
  sensor.kind = static_cast<Sensor::Kind>(object.at("kind").get<int>());
  sensor.link = object.at("link");
  sensor.pose = poseFrom(object.at("pose"));
  sensor.width = object.at("width");
  sensor.height = object.at("height");
  sensor.fieldOfView_rad = object.at("field_of_view_rad");
  return sensor;
}

}  // namespace

json toJson(const RobotModel& model) {
  json object{{"name", model.name},          {"links", json::array()},
              {"joints", json::array()},     {"sensors", json::array()},
              {"free_base", model.freeBase}, {"meshes_replace_primitives", model.meshesReplacePrimitives}};
  for (const Link& link : model.links) object["links"].push_back(toJson(link));
  for (const Joint& joint : model.joints) object["joints"].push_back(toJson(joint));
  for (const Sensor& sensor : model.sensors) object["sensors"].push_back(toJson(sensor));
  return object;
}

RobotModel modelFromJson(const std::string& text, const std::string& place) {
  try {
    const json object = json::parse(text);
    RobotModel model;
    model.name = object.at("name");
    for (const json& link : object.at("links")) model.links.push_back(linkFrom(link));
    for (const json& joint : object.at("joints")) model.joints.push_back(jointFrom(joint, model.joints.size() + 1));
    for (const json& sensor : object.at("sensors")) model.sensors.push_back(sensorFrom(sensor));
    model.freeBase = object.at("free_base");
    model.meshesReplacePrimitives = object.at("meshes_replace_primitives");
    if (model.links.size() != model.joints.size() + 1) throw InputError("links and joints that make no tree");
    return model;
  } catch (const json::exception& error) {
    throw InputError(place, error.what(), "a model as the server writes it");
  } catch (const InputError& error) {
    throw InputError(place, error.what(), "a model as the server writes it");
  }
}

}  // namespace btr
