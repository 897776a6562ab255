#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "core/model/kinematics.h"
#include "core/model/load_model.h"
#include "core/model/servo_by_load.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

constexpr double degrees = 180 / 3.14159265358979323846;

/// printf into a string; numbers with a decimal point whatever the locale says.
__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
  char buffer[512];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(buffer, sizeof buffer, pattern, arguments);
  va_end(arguments);
  return buffer;
}

/// A number with a fixed count of decimals, independent of the locale.
std::string fixed(double value, int decimals, int width) {
  const double scale = std::pow(10, decimals);
  const double rounded = std::round(std::abs(value) * scale);
  std::string text;
  if (!(rounded < 1e15)) {
    text = value < 0 ? "-inf" : "inf";
  } else {
    const auto whole = static_cast<long long>(rounded);
    const auto unit = static_cast<long long>(scale);
    text = std::string(value < 0 && whole ? "-" : "") + std::to_string(whole / unit);
    if (decimals > 0) text += format(".%0*lld", decimals, whole % unit);
  }
  return text.size() < static_cast<std::size_t>(width)
             ? std::string(static_cast<std::size_t>(width) - text.size(), ' ') + text
             : text;
}

std::string column(const std::string& text, std::size_t width) {
  return text.size() < width ? text + std::string(width - text.size(), ' ') : text + " ";
}

const char* typeName(Joint::Type type) {
  return type == Joint::Type::rotate ? "rotate" : type == Joint::Type::slide ? "slide" : "fixed";
}

const char* sensorName(Sensor::Kind kind) {
  switch (kind) {
    case Sensor::Kind::accelerometer:
      return "accelerometer";
    case Sensor::Kind::gyro:
      return "gyro";
    case Sensor::Kind::force:
      return "force";
    case Sensor::Kind::pressure:
      return "pressure";
    case Sensor::Kind::vision:
      return "camera";
    case Sensor::Kind::range:
      return "range";
  }
  return "";
}

std::string limitsOf(const Joint& joint) {
  if (joint.type == Joint::Type::fixed) return "";
  if (joint.lower < -1e8 && joint.upper > 1e8) return "no limits";
  if (joint.type == Joint::Type::slide) return fixed(joint.lower, 4, 8) + " to " + fixed(joint.upper, 4, 7) + " m";
  return fixed(joint.lower, 4, 8) + " to " + fixed(joint.upper, 4, 7) + " rad (" + fixed(joint.lower * degrees, 1, 6) +
         " to " + fixed(joint.upper * degrees, 1, 5) + " deg)";
}

/// ", follows left_finger: -0.5 times it plus 0.002", "" for a joint that follows none.
std::string followed(const RobotModel& model, const Joint& joint) {
  if (!joint.mimic) return "";
  return ", follows " + model.joints[static_cast<std::size_t>(joint.mimic->leader)].name + ": " +
         toText(joint.mimic->multiplier) + " times it plus " + toText(joint.mimic->offset);
}

std::string servoOf(const Joint& joint) {
  const ServoData& servo = joint.servo;
  const bool slides = joint.type == Joint::Type::slide;
  std::string text;
  const auto say = [&text](const char* name, const std::string& value) {
    text += (text.empty() ? "" : "  ") + std::string(name) + " " + value;
  };
  const auto add = [&say](const char* name, const std::optional<double>& value, int decimals) {
    if (value) say(name, fixed(*value, decimals, 0));
  };
  add("p", servo.p_nm_rad, 3);
  add("i", servo.i_nm_rad_s, 3);
  add("d", servo.d_nm_s_rad, 3);
  add(slides ? "max_force_n" : "max_torque_nm", servo.maxTorque_nm, 3);
  add(slides ? "no_load_speed_m_s" : "no_load_speed_rad_s", servo.noLoadSpeed_rad_s, 3);
  add(slides ? "coulomb_friction_n" : "coulomb_friction_nm", servo.coulombFriction_nm, 4);
  add(slides ? "viscous_friction_n_s_m" : "viscous_friction_nm_s_rad", servo.viscousFriction_nm_s_rad, 4);
  add(slides ? "backlash_m" : "backlash_rad", servo.backlash_rad, 4);
  add("command_delay_s", servo.commandDelay_s, 3);
  if (servo.rotorInertia_kg_m2) say("rotor_inertia_kg_m2", toText(*servo.rotorInertia_kg_m2));
  if (servo.gearRatio) say("gear_ratio", toText(*servo.gearRatio));
  return text;
}

/// "2 joints have no gains in the file and get the default servo's, …: hip, knee"; "" where none does.
std::string defaultServos(const RobotModel& model) {
  constexpr int mostNames = 20;
  std::string names;
  int count = 0;
  for (const Joint& joint : model.joints) {
    if (joint.type == Joint::Type::fixed || joint.mimic || joint.servo.p_nm_rad) continue;
    if (++count <= mostNames) names += (names.empty() ? "" : ", ") + joint.name;
  }
  if (count == 0) return "";
  if (count > mostNames) names += " and " + std::to_string(count - mostNames) + " more";
  return std::to_string(count) +
         (count == 1 ? " joint has no gains in the file and gets" : " joints have no gains in the file and get") +
         " the default servo's, p " + toText(defaultServoP_nm_rad) + " and d " + toText(defaultServoD_nm_s_rad) + ": " +
         names;
}

std::size_t widestName(const RobotModel& model) {
  std::size_t width = 8;
  for (const Link& link : model.links) width = std::max(width, link.name.size() + 2);
  for (const Joint& joint : model.joints) width = std::max(width, joint.name.size() + 2);
  return std::min<std::size_t>(width, 40);
}

}  // namespace

std::string describeModel(const RobotModel& model) {
  const std::size_t width = widestName(model);
  std::string text = "robot  " + model.name + "  (" + (model.freeBase ? "free" : "fixed") + " base)\n\n";

  // Links with what they weigh and show.
  std::size_t triangles = 0, colliding = 0;
  text += column("link", width) + column("parent", width) + " mass_kg   com_m (x, y, z)               mass group\n";
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    const Eigen::Vector3d& com = link.inertial.centreOfMass_m;
    const std::string parent =
        i == 0 ? "-" : model.links[static_cast<std::size_t>(model.joints[i - 1].parentLink)].name;
    text += column(link.name, width) + column(parent, width) + fixed(link.inertial.mass_kg, 4, 8) + "  " +
            fixed(com.x(), 4, 8) + fixed(com.y(), 4, 9) + fixed(com.z(), 4, 9) + "    " + link.massGroup + "\n";
    for (const Shape& shape : link.shapes) {
      if (shape.surface) triangles += shape.surface->triangles.size();
      colliding += shape.collides;
    }
  }

  text += "\n" + column("joint", width) + column("moves", width) + column("type", 8) + column("axis", 22) + "limits\n";
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    std::string axis;
    if (joint.type != Joint::Type::fixed)
      axis = fixed(joint.axis.x(), 3, 6) + fixed(joint.axis.y(), 3, 7) + fixed(joint.axis.z(), 3, 7);
    text += column(joint.name, width) + column(model.links[i + 1].name, width) + column(typeName(joint.type), 8) +
            column(axis, 22) + limitsOf(joint) + followed(model, joint) + "\n";
  }
  bool head = false;
  for (const Joint& joint : model.joints) {
    const std::string servo = servoOf(joint);
    if (servo.empty()) continue;
    if (!head) text += "\n" + column("joint", width) + "servo\n";
    head = true;
    text += column(joint.name, width) + servo + "\n";
  }

  if (!model.sensors.empty()) text += "\n" + column("sensor", width) + column("link", width) + "kind\n";
  for (const Sensor& sensor : model.sensors) {
    text += column(sensor.name, width) + column(model.links[static_cast<std::size_t>(sensor.link)].name, width) +
            sensorName(sensor.kind);
    if (sensor.kind == Sensor::Kind::vision)
      text += format(" %d x %d pixels, ", sensor.width, sensor.height) + fixed(sensor.fieldOfView_rad * degrees, 1, 0) +
              " deg";
    text += "\n";
  }

  const Inertial total = massProperties(model, std::vector<double>(model.joints.size(), 0.0));
  const auto moving = std::count_if(model.joints.begin(), model.joints.end(),
                                    [](const Joint& joint) { return joint.type != Joint::Type::fixed; });
  text += "\ntotal  " + std::to_string(model.links.size()) + " links, " + std::to_string(model.joints.size()) +
          " joints (" + std::to_string(moving) + " moving), " + fixed(total.mass_kg, 4, 0) + " kg, centre of mass (" +
          fixed(total.centreOfMass_m.x(), 4, 0) + ", " + fixed(total.centreOfMass_m.y(), 4, 0) + ", " +
          fixed(total.centreOfMass_m.z(), 4, 0) + ") m at joint positions 0\n       " + std::to_string(triangles) +
          " triangles, " + std::to_string(colliding) + " colliding shapes\n";

  const std::string servos = defaultServos(model);
  text += model.warnings.empty() && servos.empty() ? "\nno warnings\n" : "\nwarnings\n";
  for (const Warning& warning : model.warnings)
    text += "  line " + std::to_string(warning.line) + ": " + warning.text + "\n";
  if (!servos.empty()) text += "  " + servos + "\n";
  return text;
}

}  // namespace btr
