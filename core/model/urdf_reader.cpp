// URDF on tinyxml2, which is not recursive beyond 100 elements and expands no entities.
#include <tinyxml2.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/model/urdf_tree.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

using Eigen::Vector3d;
using tinyxml2::XMLElement;

/// Finite numbers in an attribute, separated by blanks.
std::vector<double> numbersIn(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n", at);
    if (begin == std::string::npos) break;
    const std::size_t end = std::min(text.find_first_of(" \t\r\n", begin), text.size());
    const auto number = toNumber(text.substr(begin, end - begin));
    if (!number) return {};
    numbers.push_back(*number);
    at = end;
  }
  return numbers;
}

class UrdfReader {
 public:
  UrdfReader(std::string place, const ModelBudget& budget) : place_(std::move(place)), budget_(budget) {}

  UrdfTree read(const std::string& text) {
    checkText(text);
    tinyxml2::XMLDocument document;
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
      const bool deep = document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED;
      fail(document.ErrorLineNum(), deep ? "elements deeper than 100 are not allowed"
                                         : std::string("not well-formed XML: ") + document.ErrorName());
    }
    for (const auto* node = document.FirstChild(); node; node = node->NextSibling())
      if (node->ToUnknown()) fail(node->GetLineNum(), "DOCTYPE and entities are not allowed");
    const XMLElement* robot = document.RootElement();
    if (!robot || std::string(robot->Name()) != "robot")
      fail(robot ? robot->GetLineNum() : 1, "the outermost element must be <robot>");
    tree_.name = robot->Attribute("name") ? robot->Attribute("name") : "";

    // Materials first: links name them.
    for (const auto* each = robot->FirstChildElement("material"); each; each = each->NextSiblingElement("material"))
      readMaterial(*each);
    for (const auto* each = robot->FirstChildElement(); each; each = each->NextSiblingElement()) {
      const std::string kind = each->Name();
      if (kind == "link")
        readLink(*each);
      else if (kind == "joint")
        readJoint(*each);
      else if (kind != "material")
        ignore(*each);
    }
    return std::move(tree_);
  }

 private:
  [[noreturn]] void fail(int line, const std::string& message) const { throw InputError(place_, line, message); }
  [[noreturn]] void fail(const XMLElement& element, const std::string& message) const {
    fail(element.GetLineNum(), message);
  }
  void warn(const XMLElement& element, const std::string& text) {
    if (tree_.warnings.size() < 200) tree_.warnings.push_back({element.GetLineNum(), text});
  }
  void ignore(const XMLElement& element) { warn(element, "<" + shown(element.Name()) + "> was ignored"); }
  static std::string shown(const std::string& text) { return text.size() > 40 ? text.substr(0, 40) + "..." : text; }

  /// Cheap limits before anything is built.
  void checkText(const std::string& text) const {
    if (text.size() > budget_.bytes) fail(1, "more than " + std::to_string(budget_.bytes) + " bytes are not allowed");
    const auto tags = static_cast<std::size_t>(std::count(text.begin(), text.end(), '<'));
    if (tags > 2 * budget_.nodes) fail(1, "more than " + std::to_string(budget_.nodes) + " elements are not allowed");
    if (text.find('\0') != std::string::npos) fail(1, "a control character is not allowed; URDF is plain text");
  }

  std::string attribute(const XMLElement& element, const char* name) const {
    const char* value = element.Attribute(name);
    if (!value || !*value) fail(element, "<" + std::string(element.Name()) + "> needs the attribute " + name);
    if (std::string(value).size() > budget_.identifier)
      fail(element,
           std::string(name) + " longer than " + std::to_string(budget_.identifier) + " characters is not allowed");
    return value;
  }

  std::vector<double> numbers(const XMLElement& element, const char* name, std::size_t count) const {
    const std::string text = attribute(element, name);
    auto result = numbersIn(text);
    if (result.size() != count)
      fail(element, std::string(name) + "=\"" + shown(text) + "\" is not allowed; " + std::to_string(count) +
                        (count == 1 ? " finite number is expected" : " finite numbers are expected"));
    return result;
  }
  double number(const XMLElement& element, const char* name) const { return numbers(element, name, 1)[0]; }
  std::optional<double> numberIfAny(const XMLElement* element, const char* name) const {
    if (!element || !element->Attribute(name)) return std::nullopt;
    return number(*element, name);
  }
  double positive(const XMLElement& element, const char* name) const {
    const double value = number(element, name);
    if (!(value > 0))
      fail(element, std::string(name) + " " + toText(value) + " is not allowed; greater than 0 is expected");
    return value;
  }
  Vector3d vector(const XMLElement& element, const char* name) const {
    const auto values = numbers(element, name, 3);
    return {values[0], values[1], values[2]};
  }

  Eigen::Isometry3d originOf(const XMLElement& parent) const {
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    const XMLElement* origin = parent.FirstChildElement("origin");
    if (!origin) return result;
    if (origin->Attribute("xyz")) result.translation() = vector(*origin, "xyz");
    if (origin->Attribute("rpy")) {
      const Vector3d rpy = vector(*origin, "rpy");
      result.linear() = (Eigen::AngleAxisd(rpy.z(), Vector3d::UnitZ()) * Eigen::AngleAxisd(rpy.y(), Vector3d::UnitY()) *
                         Eigen::AngleAxisd(rpy.x(), Vector3d::UnitX()))
                            .toRotationMatrix();
    }
    return result;
  }

  using Colour = std::array<float, 4>;
  std::optional<Colour> readMaterial(const XMLElement& element) {
    const char* name = element.Attribute("name");
    if (const XMLElement* colour = element.FirstChildElement("color")) {
      const auto values = numbers(*colour, "rgba", 4);
      Colour result{};
      for (std::size_t i = 0; i < 4; ++i) result[i] = static_cast<float>(std::clamp(values[i], 0., 1.));
      if (name) materials_[name] = result;
      return result;
    }
    const auto known = name ? materials_.find(name) : materials_.end();
    return known == materials_.end() ? std::nullopt : std::optional(known->second);
  }

  void readShape(const XMLElement& element, bool drawn, std::vector<Shape>& shapes) {
    Shape shape;
    shape.drawn = drawn;
    shape.collides = !drawn;
    shape.pose = originOf(element);
    if (const XMLElement* material = element.FirstChildElement("material"))
      if (const auto colour = readMaterial(*material)) shape.colour = *colour;
    const XMLElement* geometry = element.FirstChildElement("geometry");
    const XMLElement* body = geometry ? geometry->FirstChildElement() : nullptr;
    if (!body) fail(element, "<" + std::string(element.Name()) + "> needs a <geometry>");
    const std::string kind = body->Name();
    if (kind == "box") {
      shape.kind = Shape::Kind::box;
      shape.size_m = vector(*body, "size");
      if (!(shape.size_m.minCoeff() > 0)) fail(*body, "size must be greater than 0");
    } else if (kind == "sphere") {
      shape.kind = Shape::Kind::sphere;
      shape.size_m = {positive(*body, "radius"), 0, 0};
    } else if (kind == "cylinder") {
      // URDF's cylinder lies along z, ours along y.
      shape.kind = Shape::Kind::cylinder;
      shape.size_m = {positive(*body, "radius"), positive(*body, "length"), 0};
      shape.pose.rotate(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()));
    } else {
      return warn(*body, kind == "mesh"
                             ? "mesh files are not read; this " + std::string(element.Name()) + " was ignored"
                             : "the geometry <" + shown(kind) + "> was ignored");
    }
    shapes.push_back(std::move(shape));
  }

  void readLink(const XMLElement& element) {
    UrdfLink made;
    Link& link = made.link;
    link.name = attribute(element, "name");
    link.line = element.GetLineNum();
    for (const auto* each = element.FirstChildElement(); each; each = each->NextSiblingElement()) {
      const std::string kind = each->Name();
      if (kind == "inertial")
        link.inertial = readInertial(*each), made.hasInertial = true;
      else if (kind == "visual" || kind == "collision")
        readShape(*each, kind == "visual", link.shapes);
      else
        ignore(*each);
    }
    if (!tree_.linkNumber.try_emplace(link.name, tree_.links.size()).second)
      fail(element, "a second link \"" + shown(link.name) + "\" is not allowed");
    tree_.links.push_back(std::move(made));
  }

  Inertial readInertial(const XMLElement& element) const {
    const XMLElement* mass = element.FirstChildElement("mass");
    const XMLElement* moments = element.FirstChildElement("inertia");
    if (!mass || !moments) fail(element, "<inertial> needs <mass> and <inertia>");
    Inertial result;
    result.mass_kg = positive(*mass, "value");
    const double xx = number(*moments, "ixx"), yy = number(*moments, "iyy"), zz = number(*moments, "izz");
    const double xy = numberIfAny(moments, "ixy").value_or(0), xz = numberIfAny(moments, "ixz").value_or(0),
                 yz = numberIfAny(moments, "iyz").value_or(0);
    result.inertia_kg_m2 << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    const Eigen::Isometry3d origin = originOf(element);
    result.centreOfMass_m = origin.translation();
    result.inertia_kg_m2 = origin.linear() * result.inertia_kg_m2 * origin.linear().transpose();
    // A rotation leaves rounding behind.
    result.inertia_kg_m2 = (0.5 * (result.inertia_kg_m2 + result.inertia_kg_m2.transpose())).eval();
    return result;
  }

  void readJoint(const XMLElement& element) {
    UrdfJoint made;
    Joint& joint = made.joint;
    joint.name = attribute(element, "name");
    joint.line = element.GetLineNum();
    joint.origin = originOf(element);
    joint.axis = Vector3d::UnitX();
    const std::string type = attribute(element, "type");
    if (type == "fixed")
      joint.type = Joint::Type::fixed;
    else if (type == "prismatic")
      joint.type = Joint::Type::slide;
    else if (type == "revolute" || type == "continuous")
      joint.type = Joint::Type::rotate;
    else if (type == "floating")
      made.floating = true, joint.type = Joint::Type::fixed;
    else
      fail(element, "joint type \"" + shown(type) +
                        "\" is not allowed; revolute, continuous, prismatic, fixed or floating is expected");
    const auto end = [&](const char* which) {
      const XMLElement* found = element.FirstChildElement(which);
      if (!found) fail(element, "joint " + shown(joint.name) + " needs a <" + which + ">");
      return attribute(*found, "link");
    };
    made.parent = end("parent");
    made.child = end("child");
    if (const XMLElement* axis = element.FirstChildElement("axis"); axis && joint.type != Joint::Type::fixed) {
      joint.axis = vector(*axis, "xyz");
      // Texts have few digits; what is nearly a unit vector is made one, the rest is for checkModel to refuse.
      const double length = joint.axis.stableNorm();
      if (std::abs(length - 1) < 1e-3) joint.axis /= length;
    }
    readLimits(element, type, joint);
    for (const auto* each = element.FirstChildElement(); each; each = each->NextSiblingElement()) {
      const std::string kind = each->Name();
      if (kind != "origin" && kind != "parent" && kind != "child" && kind != "axis" && kind != "limit" &&
          kind != "dynamics")
        ignore(*each);
    }
    tree_.joints.push_back(std::move(made));
  }

  void readLimits(const XMLElement& element, const std::string& type, Joint& joint) {
    const XMLElement* limit = element.FirstChildElement("limit");
    if (type == "revolute" || type == "prismatic") {
      if (!limit) warn(element, "joint " + shown(joint.name) + " has no <limit>: it moves without limits");
      if (limit && (limit->Attribute("lower") || limit->Attribute("upper"))) {
        joint.lower = numberIfAny(limit, "lower").value_or(0);
        joint.upper = numberIfAny(limit, "upper").value_or(0);
      }
    }
    const auto notNegative = [&](const XMLElement* from, const char* name) {
      const auto value = numberIfAny(from, name);
      if (value && *value < 0)
        fail(*from, "joint " + shown(joint.name) + ": " + name + " " + toText(*value) +
                        " is not allowed; 0 or more is expected");
      return value;
    };
    if (const auto effort = notNegative(limit, "effort"); effort && *effort > 0) joint.servo.maxTorque_nm = effort;
    joint.speedLimit = notNegative(limit, "velocity").value_or(0);
    const XMLElement* dynamics = element.FirstChildElement("dynamics");
    joint.servo.viscousFriction_nm_s_rad = notNegative(dynamics, "damping");
    joint.servo.coulombFriction_nm = notNegative(dynamics, "friction");
  }

  std::string place_;
  const ModelBudget& budget_;
  UrdfTree tree_;
  std::map<std::string, Colour> materials_;
};

}  // namespace

RobotModel parseUrdf(const std::string& text, const std::string& place, const ModelBudget& budget) {
  RobotModel model = makeModel(UrdfReader(place, budget).read(text), place);
  checkModel(model, place);
  return model;
}

}  // namespace btr
