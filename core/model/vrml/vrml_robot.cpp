#include "core/model/vrml/vrml_robot.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/model/given_joint.h"
#include "core/model/kinematics.h"
#include "core/model/vrml/vrml_scanner.h"
#include "core/model/vrml/vrml_shapes.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr::vrml {
namespace {

using Eigen::Affine3d;
using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Where a walk down the tree stands.
struct Place {
  int link = -1;                           ///< −1: above the first Joint
  Affine3d toLink = Affine3d::Identity();  ///< from the current node's frame
  std::string part;
  enum class Role { usual, drawnOnly, collisionOnly } role = Role::usual;
};

class RobotBuilder {
 public:
  RobotBuilder(Document& document, const ModelBudget& budget)
      : document_(document), budget_(budget), shapes_(document, budget) {}

  RobotModel build() {
    const Node* humanoid = nullptr;
    for (const Node* root : document_.roots) findHumanoid(root, humanoid);
    if (!humanoid) throw InputError(document_.places.front() + ": no Humanoid node is in the file; one is expected");
    model_.name = textField(*humanoid, "name");
    if (model_.name.empty()) model_.name = humanoid->def;
    children(*humanoid, "humanoidBody", Place{});
    if (model_.links.empty()) refuseBody(*humanoid);
    return std::move(model_);
  }

 private:
  /// A Humanoid without a Joint.
  [[noreturn]] void refuseBody(const Node& humanoid) const {
    if (humanoid.find("skeleton"))
      document_.fail(
          humanoid,
          "the Humanoid has a \"skeleton\", which is not allowed; its Joints are expected in \"humanoidBody\", "
          "as OpenHRP and H-Anim 1.1 have them");
    document_.fail(humanoid, "the Humanoid has no Joint in its humanoidBody");
  }

  /// Nodes that are used several times (USE) are visited several times: this is what bounds the work.
  void visit(const Node& node) {
    if (++visits_ > budget_.nodes)
      document_.fail(node,
                     "more than " + std::to_string(budget_.nodes) + " nodes are not allowed (USE counts in full)");
  }

  void findHumanoid(const Node* node, const Node*& found) {
    if (!node) return;
    visit(*node);
    if (node->kind() == "Humanoid") {
      if (found) document_.fail(*node, "a second Humanoid is not allowed; one robot is expected");
      found = node;
    } else if (const Value* value = node->find("children")) {
      for (const Node* child : value->nodes) findHumanoid(child, found);
    }
  }

  void children(const Node& node, const char* field, const Place& place) {
    if (const Value* value = node.find(field))
      for (const Node* child : value->nodes)
        if (child) walk(*child, place);
  }

  void walk(const Node& node, const Place& place) {
    visit(node);
    const std::string& kind = node.kind();
    if (kind == "Joint") return joint(node, place);
    if (kind == "Segment") return segment(node, place);
    if (kind == "Shape") return shape(node, place);
    if (kind == "Humanoid") document_.fail(node, "a Humanoid inside a Humanoid is not allowed");
    if (kind == "Transform") {
      Place inner = place;
      inner.toLink = place.toLink * transformOf(document_, node);
      return children(node, "children", inner);
    }
    if (kind == "Switch") {
      const int which = integerField(document_, node, "whichChoice", -1);
      const Value* choice = node.find("choice");
      if (choice && which >= 0 && static_cast<std::size_t>(which) < choice->nodes.size())
        if (const Node* chosen = choice->nodes[static_cast<std::size_t>(which)]) walk(*chosen, place);
      return;
    }
    if (kind == "LOD") {
      const Node* finest = nodeField(node, "level");
      return finest ? walk(*finest, place) : void();
    }
    if (kind == "Part") {
      Place inner = place;
      inner.part = textField(node, "name");
      return children(node, "choice", inner);
    }
    if (const auto sensor = sensorKind(kind)) return this->sensor(node, *sensor, place);
    children(node, "children", place);
  }

  void shape(const Node& node, const Place& place) {
    if (place.link < 0) return;  // scenery around the robot
    auto& shapes = link(place).shapes;
    const std::size_t before = shapes.size();
    shapes_.read(node, place.toLink, shapes);
    for (std::size_t i = before; i < shapes.size(); ++i) {
      Shape& each = shapes[i];
      each.part = place.part;
      each.drawn = place.role != Place::Role::collisionOnly;
      each.collides = place.role != Place::Role::drawnOnly && place.part.empty();
    }
  }

  Link& link(const Place& place) { return model_.links[static_cast<std::size_t>(place.link)]; }

  /// Joints and Segments can't stand below a scale: their masses would not follow it.
  Isometry3d rigid(const Node& node, const Affine3d& map) const {
    const Eigen::Matrix3d linear = map.linear();
    if (!map.matrix().allFinite() || !(linear.transpose() * linear).isIdentity(1e-6) || linear.determinant() < 0)
      document_.fail(node, "a " + node.kind() + " below a scale other than 1 1 1 is not allowed");
    Isometry3d result = Isometry3d::Identity();
    result.linear() = Eigen::Quaterniond(linear).normalized().toRotationMatrix();
    result.translation() = map.translation();
    return result;
  }

  void segment(const Node& node, const Place& place) {
    if (place.link < 0) document_.fail(node, "a Segment outside of a Joint is not allowed");
    const Isometry3d pose = rigid(node, place.toLink);
    const auto at = static_cast<std::size_t>(place.link);
    const std::string name = node.def.empty() ? textField(node, "name") : node.def;
    if (!namedBySegment_[at] && !name.empty()) {
      model_.links[at].name = name;
      model_.links[at].line = node.line;
      namedBySegment_[at] = true;
    }
    if (model_.links[at].massGroup.empty()) model_.links[at].massGroup = textField(node, "massGroup");

    Inertial own;
    own.mass_kg = realField(document_, node, "mass", 0);
    own.centreOfMass_m = vectorField(document_, node, "centerOfMass", Vector3d::Zero());
    if (const Value* moments = node.find("momentsOfInertia"); moments && !moments->numbers.empty()) {
      if (moments->numbers.size() != 9) document_.fail(node, "Segment.momentsOfInertia: 9 numbers are expected");
      own.inertia_kg_m2 = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(moments->numbers.data());
    }
    if (own.mass_kg < 0)
      document_.fail(node, "Segment.mass " + toText(own.mass_kg) + " is not allowed; 0 or more is expected");
    model_.links[at].inertial = combined(model_.links[at].inertial, carried(own, pose));

    Place inner = place;
    if (node.given("collision")) {
      inner.role = Place::Role::collisionOnly;
      children(node, "collision", inner);
      inner.role = Place::Role::drawnOnly;
    }
    children(node, "children", inner);
  }

  static std::optional<Sensor::Kind> sensorKind(const std::string& kind) {
    if (kind == "AccelerationSensor") return Sensor::Kind::accelerometer;
    if (kind == "Gyro") return Sensor::Kind::gyro;
    if (kind == "ForceSensor") return Sensor::Kind::force;
    if (kind == "PressureSensor") return Sensor::Kind::pressure;
    if (kind == "VisionSensor") return Sensor::Kind::vision;
    if (kind == "RangeSensor") return Sensor::Kind::range;
    return std::nullopt;
  }

  void sensor(const Node& node, Sensor::Kind kind, const Place& place) {
    if (place.link < 0) document_.fail(node, "a sensor outside of a Joint is not allowed");
    Place inner = place;
    inner.toLink = place.toLink * transformOf(document_, node);
    Sensor sensor;
    sensor.kind = kind;
    sensor.name = node.def.empty() ? textField(node, "name") : node.def;
    sensor.link = place.link;
    sensor.pose = rigid(node, inner.toLink);
    if (kind == Sensor::Kind::vision) {
      sensor.width = integerField(document_, node, "width", 320);
      sensor.height = integerField(document_, node, "height", 240);
      sensor.fieldOfView_rad = realField(document_, node, "fieldOfView", 0.785398);
      if (sensor.width < 1 || sensor.height < 1 || sensor.width > 65536 || sensor.height > 65536)
        document_.fail(node, "VisionSensor: width and height from 1 to 65536 are expected");
      if (!(sensor.fieldOfView_rad > 0 && sensor.fieldOfView_rad < M_PI))
        document_.fail(node, "VisionSensor.fieldOfView: more than 0 and less than pi is expected");
    }
    model_.sensors.push_back(std::move(sensor));
    children(node, "children", inner);
  }

  void joint(const Node& node, const Place& place);
  Joint readJoint(const Node& node, const std::string& type) const;
  Vector3d readAxis(const Node& node) const;
  ServoData readServo(const Node& node) const;

  Document& document_;
  const ModelBudget& budget_;
  ShapeReader shapes_;
  RobotModel model_;
  std::vector<bool> namedBySegment_;  // by link
  std::size_t visits_ = 0;
};

void RobotBuilder::joint(const Node& node, const Place& place) {
  const std::string name = node.def.empty() ? textField(node, "name") : node.def;
  if (name.empty()) document_.fail(node, "a Joint needs a name: DEF NAME Joint, or its field name");
  const std::string type = textField(node, "jointType");
  const bool root = place.link < 0;
  if (root) {
    if (!model_.links.empty())
      document_.fail(node, "a second root (Joint " + name + " beside the first) is not allowed; one is expected");
    if (type != "free" && type != "fixed" && !type.empty())
      document_.fail(node,
                     "jointType \"" + type + "\" of the root Joint " + name + " is not allowed; \"free\" or \"fixed\"");
    model_.freeBase = type != "fixed";
  } else {
    Joint made = readJoint(node, type);
    made.name = name;
    made.parentLink = place.link;
    made.origin = rigid(node, place.toLink * transformOf(document_, node));
    const std::string settled = settleMeetingLimits(made);
    if (!settled.empty())
      model_.warnings.push_back({node.line, "Joint " + name + ": " + settled, Warning::Loss::limits, name});
    model_.joints.push_back(std::move(made));
  }

  Link made;
  made.name = name;
  made.line = node.line;
  model_.links.push_back(std::move(made));
  namedBySegment_.push_back(false);
  Place inner;
  inner.link = static_cast<int>(model_.links.size()) - 1;
  children(node, "children", inner);
}

Joint RobotBuilder::readJoint(const Node& node, const std::string& type) const {
  Joint joint;
  joint.line = node.line;
  joint.id = integerField(document_, node, "jointId", -1);
  joint.primitive = textField(node, "primitive");
  if (type == "rotate" || type == "revolute")
    joint.type = Joint::Type::rotate;
  else if (type == "slide" || type == "prismatic")
    joint.type = Joint::Type::slide;
  else if (type == "fixed")
    joint.type = Joint::Type::fixed;
  else
    document_.fail(node, "jointType \"" + shorten(type) + "\" is not allowed; \"rotate\", \"slide\" or \"fixed\"");
  joint.axis = readAxis(node);

  const auto limit = [&](const char* field, double byDefault) {
    const Value* value = node.find(field);
    return value && (!value->numbers.empty() || !value->integers.empty()) ? realField(document_, node, field, byDefault)
                                                                          : byDefault;
  };
  joint.lower = limit("llimit", joint.lower);
  joint.upper = limit("ulimit", joint.upper);
  const double down = std::abs(limit("lvlimit", 0)), up = std::abs(limit("uvlimit", 0));
  joint.speedLimit = down > 0 && up > 0 ? std::min(down, up) : std::max(down, up);
  joint.servo = readServo(node);
  return joint;
}

/// SFVec3f, or a text "X", "Y", "Z" in old files.
Vector3d RobotBuilder::readAxis(const Node& node) const {
  const Value* value = node.find("jointAxis");
  if (!value) return Vector3d::UnitZ();
  if (value->type == FieldType::SFString || value->type == FieldType::MFString) {
    const std::string text = textField(node, "jointAxis");
    if (text == "X" || text == "x") return Vector3d::UnitX();
    if (text == "Y" || text == "y") return Vector3d::UnitY();
    if (text == "Z" || text == "z") return Vector3d::UnitZ();
    document_.fail(node, "jointAxis \"" + shorten(text) + "\" is not allowed; \"X\", \"Y\", \"Z\" or three numbers");
  }
  Vector3d axis = vectorField(document_, node, "jointAxis", Vector3d::UnitZ());
  makeUnitAxis(axis);
  return axis;
}

ServoData RobotBuilder::readServo(const Node& node) const {
  const auto number = [&](const char* field) -> std::optional<double> {
    if (!node.given(field)) return std::nullopt;
    return realField(document_, node, field, 0);
  };
  const auto notNegative = [&](const char* field) {
    const std::optional<double> value = number(field);
    if (value && *value < 0)
      document_.fail(node,
                     std::string("Joint.") + field + " " + toText(*value) + " is not allowed; 0 or more is expected");
    return value;
  };
  ServoData servo;
  servo.p_nm_rad = notNegative("pGain");
  servo.i_nm_rad_s = notNegative("iGain");
  servo.d_nm_s_rad = notNegative("dGain");
  servo.maxTorque_nm = notNegative("maxTorque");
  servo.noLoadSpeed_rad_s = notNegative("noLoadSpeed");
  servo.coulombFriction_nm = notNegative("coulombFriction");
  servo.viscousFriction_nm_s_rad = notNegative("viscousFriction");
  servo.backlash_rad = notNegative("backlash");
  servo.commandDelay_s = notNegative("commandDelay");
  servo.gearRatio = number("gearRatio");
  servo.rotorInertia_kg_m2 = notNegative("rotorInertia");
  return servo;
}

}  // namespace

RobotModel extractRobot(Document& document, const ModelBudget& budget) {
  RobotModel model = RobotBuilder(document, budget).build();
  model.warnings = document.warnings;
  return model;
}

}  // namespace btr::vrml
