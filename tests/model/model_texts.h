#pragma once
#include <string>

#include "core/model/load_model.h"
#include "tests/refusal.h"

namespace btr::test {

inline std::string vrmlRefusal(const std::string& text, const ModelBudget& budget = {}) {
  return refusal([&] { parseVrml(text, "robot.wrl", budget); });
}
inline std::string urdfRefusal(const std::string& text, const ModelBudget& budget = {}) {
  return refusal([&] { parseUrdf(text, "robot.urdf", budget); });
}

inline const std::string vrmlHeader = "#VRML V2.0 utf8\n";
inline const std::string goodMass = "mass 1 momentsOfInertia [ 1 0 0 0 1 0 0 0 1 ]";

/// A file with a robot of one link whose Segment holds `children`; `before` stands outside of the robot.
inline std::string robotWith(const std::string& children, const std::string& before = "") {
  return vrmlHeader + before + "\nDEF R Humanoid { humanoidBody [ DEF ROOT Joint { jointType \"free\" children [\n" +
         "DEF BASE Segment { " + goodMass + " children [\n" + children + "\n] }\n] } ] }\n";
}

/// A robot of two links; `joint` holds fields of the joint between them, `segment` those of the second Segment.
inline std::string robotWithJoint(const std::string& joint, const std::string& segment = goodMass) {
  return vrmlHeader + "DEF R Humanoid { humanoidBody [ DEF ROOT Joint { jointType \"free\" children [\n" +
         "DEF BASE Segment { " + goodMass + " }\nDEF HINGE Joint { " + joint + " children [\n" + "DEF ARM Segment { " +
         segment + " } ] }\n] } ] }\n";
}

inline std::string repeated(const std::string& text, std::size_t count) {
  std::string result;
  result.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

/// The shapes of the only link.
inline std::vector<Shape> shapesOf(const std::string& children) {
  return parseVrml(robotWith(children), "robot.wrl").links.at(0).shapes;
}

}  // namespace btr::test
