// URDF on tinyxml2, which is not recursive beyond 100 elements and expands no entities.
#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "core/model/given_joint.h"
#include "core/model/servo_by_load.h"
#include "core/model/urdf/urdf_shapes.h"
#include "core/model/urdf/urdf_tree.h"
#include "core/model/urdf/urdf_xml.h"
#include "core/spec/figures.h"
#include "core/spec/parameter.h"
#include "core/spec/utf8.h"

namespace btr {
namespace {

using Eigen::Vector3d;
using Element = UrdfXml::Element;
using Loss = Warning::Loss;

/// Cheap limits before anything is built.
void checkText(const std::string& text, const UrdfXml& xml) {
  const ModelBudget& budget = xml.budget();
  if (text.size() > budget.bytes) xml.fail(1, "more than " + std::to_string(budget.bytes) + " bytes are not allowed");
  const auto tags = static_cast<std::size_t>(std::count(text.begin(), text.end(), '<'));
  if (tags > 2 * budget.nodes) xml.fail(1, "more than " + std::to_string(budget.nodes) + " elements are not allowed");
  if (text.find('\0') != std::string::npos) xml.fail(1, "a control character is not allowed; URDF is plain text");
}

/// In the file's order: the first element that only xacro understands, and whether xacro has work to do: without a
/// definition, an inclusion, a "${" or a "$(" the file was expanded, and what is left names macros that nobody knows
/// any more.
class FindXacro : public tinyxml2::XMLVisitor {
 public:
  bool VisitEnter(const Element& element, const tinyxml2::XMLAttribute* first) override {
    const std::string name = element.Name();
    if (name.starts_with("xacro:")) {
      if (!found) found = &element;
      for (const char* own : {"macro", "include", "property", "arg", "if", "unless", "insert_block", "element"})
        hasWork = hasWork || name.substr(6) == own;
    }
    for (const auto* each = first; each; each = each->Next())
      for (const char* open : {"${", "$("})
        hasWork = hasWork || std::string_view(each->Value()).find(open) != std::string_view::npos;
    return true;
  }
  const Element* found = nullptr;
  bool hasWork = false;
};

/// Where the text begins for XML: tools write comments before the declaration, which XML wants first. What is cut off
/// keeps its lines.
std::string withDeclarationFirst(std::string text) {
  const std::size_t declaration = text.find("<?xml");
  if (declaration == std::string::npos || declaration == 0) return text;
  const std::size_t root = text.find("<robot");
  if (root != std::string::npos && root < declaration) return text;
  const std::size_t end = text.find("?>", declaration);
  if (end == std::string::npos) return text;
  for (std::size_t i = declaration; i < end + 2; ++i)
    if (text[i] != '\n') text[i] = ' ';
  return text;
}

/// About every axis [kg·m²]: the smallest that something of this mass may have.
Eigen::Matrix3d inertiaOfIronBall(double mass_kg) {
  constexpr double density_kg_m3 = 7870;
  const double radius_m = std::cbrt(3 * mass_kg / (4 * M_PI * density_kg_m3));
  return 0.4 * mass_kg * radius_m * radius_m * Eigen::Matrix3d::Identity();
}

class UrdfReader {
 public:
  UrdfReader(UrdfXml& xml, const MeshSource& meshes) : xml_(xml), shapes_(xml, meshes) {}

  UrdfTree read(const std::string& given) {
    checkText(given, xml_);
    // Names go into JSON and tables, which are UTF-8; what is not was written by a program of one byte a letter.
    const std::string text = withDeclarationFirst(isUtf8(given) ? given : utf8OfLatin1(given));
    tinyxml2::XMLDocument document;
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
      const bool deep = document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED;
      xml_.fail(document.ErrorLineNum(), deep ? "elements deeper than 100 are not allowed"
                                              : std::string("not well-formed XML: ") + document.ErrorName());
    }
    for (const auto* node = document.FirstChild(); node; node = node->NextSibling())
      if (node->ToUnknown()) xml_.fail(node->GetLineNum(), "DOCTYPE and entities are not allowed");
    const Element* robot = document.RootElement();
    if (!robot || std::string(robot->Name()) != "robot")
      xml_.fail(robot ? robot->GetLineNum() : 1, "the outermost element must be <robot>");
    FindXacro xacro;
    robot->Accept(&xacro);
    if (xacro.found && xacro.hasWork)
      xml_.fail(*xacro.found, "<" + UrdfXml::shown(xacro.found->Name()) +
                                  "> belongs to xacro: expand the file first (xacro robot.urdf.xacro > robot.urdf)");
    tree_.name = robot->Attribute("name") ? robot->Attribute("name") : "";

    // Materials first: links name them.
    for (const auto* each = robot->FirstChildElement("material"); each; each = each->NextSiblingElement("material"))
      shapes_.readMaterial(*each);
    for (const auto* each = robot->FirstChildElement(); each; each = each->NextSiblingElement()) {
      const std::string kind = each->Name();
      if (kind == "link")
        readLink(*each);
      else if (kind == "joint")
        readJoint(*each);
      else if (kind != "material")
        xml_.ignore(*each);
    }
    tree_.warnings = xml_.takeWarnings();
    return std::move(tree_);
  }

 private:
  void readLink(const Element& element) {
    UrdfLink made;
    Link& link = made.link;
    link.name = xml_.attribute(element, "name");
    link.line = element.GetLineNum();
    for (const auto* each = element.FirstChildElement(); each; each = each->NextSiblingElement()) {
      const std::string kind = each->Name();
      if (kind == "inertial")
        made.hasInertial = readInertial(*each, link);
      else if (kind == "visual" || kind == "collision")
        shapes_.read(*each, link.name, link.shapes);
      else
        xml_.ignore(*each);
    }
    shapes_.finish(link.name, link.shapes);
    if (!tree_.linkNumber.try_emplace(link.name, tree_.links.size()).second)
      xml_.fail(element, "a second link \"" + UrdfXml::shown(link.name) + "\" is not allowed");
    tree_.links.push_back(std::move(made));
  }

  /// False where the mass is 0: exporters write so for frames that are only a place.
  bool readInertial(const Element& element, Link& link) {
    Inertial& inertial = link.inertial;
    const Element* mass = element.FirstChildElement("mass");
    const Element* moments = element.FirstChildElement("inertia");
    if (mass && xml_.numberIfAny(mass, "value") == 0.) return false;
    if (!mass || !moments) xml_.fail(element, "<inertial> needs <mass> and <inertia>");
    inertial.mass_kg = xml_.positive(*mass, "value");
    const double xx = xml_.number(*moments, "ixx"), yy = xml_.number(*moments, "iyy"),
                 zz = xml_.number(*moments, "izz");
    const double xy = xml_.numberIfAny(moments, "ixy").value_or(0), xz = xml_.numberIfAny(moments, "ixz").value_or(0),
                 yz = xml_.numberIfAny(moments, "iyz").value_or(0);
    inertial.inertia_kg_m2 << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    if (inertial.inertia_kg_m2.isZero(0)) {
      inertial.inertia_kg_m2 = inertiaOfIronBall(inertial.mass_kg);
      xml_.warn(*moments,
                "link " + UrdfXml::shown(link.name) +
                    ": its inertia is 0, which no body has: it gets that of an iron ball of its mass, " +
                    brief(inertial.inertia_kg_m2(0, 0)) + " kg m2",
                Loss::inertia, link.name);
    }
    const Eigen::Isometry3d origin = xml_.originOf(element);
    inertial.centreOfMass_m = origin.translation();
    inertial.inertia_kg_m2 = origin.linear() * inertial.inertia_kg_m2 * origin.linear().transpose();
    // A rotation leaves rounding behind.
    inertial.inertia_kg_m2 = (0.5 * (inertial.inertia_kg_m2 + inertial.inertia_kg_m2.transpose())).eval();
    return true;
  }

  void readJoint(const Element& element) {
    UrdfJoint made;
    Joint& joint = made.joint;
    joint.name = xml_.attribute(element, "name");
    joint.line = element.GetLineNum();
    joint.origin = xml_.originOf(element);
    joint.axis = Vector3d::UnitX();
    const std::string type = xml_.attribute(element, "type");
    if (type == "fixed")
      joint.type = Joint::Type::fixed;
    else if (type == "prismatic")
      joint.type = Joint::Type::slide;
    else if (type == "revolute" || type == "continuous")
      joint.type = Joint::Type::rotate;
    else if (type == "floating")
      made.floating = true, joint.type = Joint::Type::fixed;
    else
      xml_.fail(element, "joint type \"" + UrdfXml::shown(type) +
                             "\" is not allowed; revolute, continuous, prismatic, fixed or floating is expected");
    const auto end = [&](const char* which) {
      const Element* found = element.FirstChildElement(which);
      if (!found) xml_.fail(element, "joint " + UrdfXml::shown(joint.name) + " needs a <" + which + ">");
      return xml_.attribute(*found, "link");
    };
    made.parent = end("parent");
    made.child = end("child");
    const bool moves = joint.type != Joint::Type::fixed;
    if (const Element* axis = element.FirstChildElement("axis"); axis && moves) {
      joint.axis = xml_.vector(*axis, "xyz");
      if (makeUnitAxis(joint.axis))
        xml_.warn(*axis,
                  "joint " + UrdfXml::shown(joint.name) + ": its axis has not the length 1: its direction is taken");
    }
    const Element* mimic = moves ? element.FirstChildElement("mimic") : nullptr;
    if (mimic)
      made.mimic = UrdfMimic{xml_.attribute(*mimic, "joint"), xml_.numberIfAny(mimic, "multiplier").value_or(1),
                             xml_.numberIfAny(mimic, "offset").value_or(0), mimic->GetLineNum()};
    readLimits(element, type, joint, mimic != nullptr);
    if (joint.type == Joint::Type::fixed) made.mimic.reset();  // its limits may have fixed it
    for (const auto* each = element.FirstChildElement(); each; each = each->NextSiblingElement()) {
      const std::string kind = each->Name();
      if (kind != "origin" && kind != "parent" && kind != "child" && kind != "axis" && kind != "limit" &&
          kind != "dynamics" && each != mimic)
        xml_.ignore(*each);
    }
    tree_.joints.push_back(std::move(made));
  }

  void readLimits(const Element& element, const std::string& type, Joint& joint, bool follows) {
    const Element* limit = element.FirstChildElement("limit");
    const std::string who = "joint " + UrdfXml::shown(joint.name);
    const auto lower = xml_.numberIfAny(limit, "lower"), upper = xml_.numberIfAny(limit, "upper");
    if (type == "revolute" || type == "prismatic") {
      const char* unit = type == "revolute" ? " rad" : " m";
      if (!limit)
        xml_.warn(element, who + " has no <limit>: it moves without limits", Loss::limits, joint.name);
      else if (!lower && !upper)
        xml_.warn(*limit,
                  who + ": lower and upper are left out, which URDF reads as 0 to 0" + unit +
                      ": it moves without limits instead",
                  Loss::limits, joint.name);
      else if (!lower || !upper)
        xml_.warn(*limit, who + ": " + (lower ? "upper" : "lower") + " is left out and taken as 0" + unit, Loss::limits,
                  joint.name);
      if (lower || upper) {
        joint.lower = lower.value_or(0);
        joint.upper = upper.value_or(0);
        const std::string settled = settleMeetingLimits(joint);
        if (!settled.empty()) xml_.warn(*limit, who + ": " + settled, Loss::limits, joint.name);
      }
    } else if (lower || upper) {
      xml_.warn(*limit, who + " is " + type + ": its lower and upper were ignored", Loss::limits, joint.name);
    }
    const auto effort = xml_.notNegativeIfAny(limit, "effort", who);
    if (effort && *effort > 0) joint.servo.maxTorque_nm = effort;
    const bool moves = joint.type != Joint::Type::fixed;
    if (effort && *effort == 0 && moves && !follows) tree_.effortless[joint.name] = limit->GetLineNum();
    const auto velocity = xml_.notNegativeIfAny(limit, "velocity", who);
    joint.speedLimit = velocity.value_or(0);
    if (velocity && *velocity == 0 && moves)
      xml_.warn(*limit, who + ": velocity 0 is taken as not given: its speed has no limit");
    const Element* dynamics = element.FirstChildElement("dynamics");
    joint.servo.viscousFriction_nm_s_rad = xml_.notNegativeIfAny(dynamics, "damping", who);
    joint.servo.coulombFriction_nm = xml_.notNegativeIfAny(dynamics, "friction", who);
  }

  UrdfXml& xml_;
  UrdfShapes shapes_;
  UrdfTree tree_;
};

/// What servos get whose effort is 0. Of one line, what is said of limits comes first, then of efforts.
void sayEffortless(const std::map<std::string, int>& effortless, RobotModel& model) {
  for (const auto& [name, line] : effortless) {
    const int number = model.findJoint(name);
    if (number < 0) continue;
    const Joint& joint = model.joints[static_cast<std::size_t>(number)];
    const double torque = joint.servo.maxTorque_nm.value_or(defaultServoLimit(joint.type));
    const std::string text = "joint " + UrdfXml::shown(name) + ": effort 0 is taken as not given: its servo gets " +
                             brief(torque) + (joint.type == Joint::Type::slide ? " N" : " N m");
    model.warnings.push_back({line, text, Loss::effort, name});
  }
  const auto place = [](const Warning& warning) {
    const int kind = warning.loss == Loss::limits ? 0 : warning.loss == Loss::effort ? 1 : 2;
    return std::pair(warning.line, kind);
  };
  std::ranges::stable_sort(model.warnings, {}, place);
}

}  // namespace

RobotModel parseUrdf(const std::string& text, const std::string& place, const ModelBudget& budget,
                     const MeshSource& meshes) {
  UrdfXml xml(place, budget);
  UrdfTree tree = UrdfReader(xml, meshes).read(text);
  const std::map<std::string, int> effortless = std::exchange(tree.effortless, {});
  RobotModel model = makeModel(std::move(tree), place);
  checkModel(model, place);
  chooseServosByLoad(model);
  sayEffortless(effortless, model);
  return model;
}

}  // namespace btr
