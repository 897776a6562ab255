// Numbers of a scene by name: the simulator's parameters and dotted paths.
#include <algorithm>
#include <cmath>

#include "core/sim/scene_parameters.h"
#include "core/sim/world/scene_build.h"
#include "core/spec/error.h"

namespace btr {
namespace {

[[noreturn]] void noSuch(const std::string& path, const std::string& allowed) {
  throw InputError("simulator value", path, allowed);
}

/// "head, leg", or "none".
template <class List>
std::string namesOf(const List& list) {
  std::string names;
  for (const auto& each : list) names += (names.empty() ? "" : ", ") + std::string(each.name);
  return names.empty() ? "none" : names;
}

std::string next(std::string& rest) {
  const auto dot = rest.find('.');
  std::string word = rest.substr(0, dot);
  rest = dot == std::string::npos ? "" : rest.substr(dot + 1);
  return word;
}

/// A number that a path names, and what it may be. A link's mass takes its inertia along.
struct Target {
  double* number = nullptr;
  Parameter bounds;
  Link* scaled = nullptr;
};

const Parameter& declaredIn(const std::vector<Parameter>& declared, const std::string& number,
                            const std::string& path) {
  const Parameter* parameter = find(declared, number);
  if (parameter) return *parameter;
  noSuch(path, "one of " + namesOf(declared));
}

/// The other axes' numbers stay: what is about one axis alone may be known from it alone.
Target linkNumber(Link& link, const std::string& number, const std::string& path) {
  const Parameter& bounds = declaredIn(linkNumbers(), number, path);
  if (number == "mass_kg") return {&link.inertial.mass_kg, bounds, &link};
  if (number.starts_with("com_")) return {&link.inertial.centreOfMass_m[number[4] - 'x'], bounds};
  const int axis = number[8] - 'x';
  return {&link.inertial.inertia_kg_m2(axis, axis), bounds};
}

/// Where a joint's range ends, or nothing for other numbers. The ends of a range that the file leaves open are no
/// numbers.
double* limitOf(Joint& joint, const std::string& number) {
  constexpr double open = 1e8;
  const bool slides = joint.type == Joint::Type::slide;
  double* limit = number == (slides ? "lower_m" : "lower_rad")   ? &joint.lower
                  : number == (slides ? "upper_m" : "upper_rad") ? &joint.upper
                                                                 : nullptr;
  return limit && std::abs(*limit) < open ? limit : nullptr;
}

Target robotNumber(Scene& scene, const std::string& path, std::string rest) {
  const std::string name = next(rest), kind = next(rest), item = next(rest), number = next(rest);
  const auto robot =
      std::find_if(scene.robots.begin(), scene.robots.end(), [&](const auto& r) { return r.name == name; });
  if (robot == scene.robots.end()) noSuch(path, "a robot of this scene, which has " + namesOf(scene.robots));
  if (!rest.empty()) noSuch(path, "robots.NAME.servos|links|joints.ITEM.NUMBER");
  if (kind == "links") {
    const int link = robot->model.findLink(item);
    if (link < 0) noSuch(path, "a link of " + robot->model.name);
    return linkNumber(robot->model.links[static_cast<std::size_t>(link)], number, path);
  }
  if (kind != "servos" && kind != "joints") noSuch(path, "robots.NAME.servos|links|joints.ITEM.NUMBER");
  const int joint = robot->model.findJoint(item);
  if (joint < 0) noSuch(path, "a joint of " + robot->model.name);
  constexpr double farthest = 1000;  // rad or m
  if (kind == "joints")
    if (double* limit = limitOf(robot->model.joints[static_cast<std::size_t>(joint)], number))
      return {limit, {number, "", "", -farthest, farthest}};
  const std::vector<Parameter>& declared = kind == "servos" ? servoNumbers() : jointNumbers();
  const Parameter* bounds = find(declared, number);
  const auto numberOf = [&, index = static_cast<std::size_t>(joint)](const std::string& asked) {
    return driveNumber(robot->drives[index], robot->model.joints[index], asked);
  };
  double* target = numberOf(number);
  if (!bounds || !target) {
    std::vector<Parameter> here = declared;
    std::erase_if(here, [&](const Parameter& p) { return !numberOf(p.name); });
    noSuch(path, "one of " + namesOf(here));
  }
  return {target, *bounds};
}

/// One of the numbers that a floor or ball has.
struct Field {
  const char* name;
  double minimum, maximum;
  double* target;
};

Target fieldOf(const std::vector<Field>& fields, const std::string& number, const std::string& path) {
  for (const Field& field : fields)
    if (number == field.name) return {field.target, {field.name, "", "", field.minimum, field.maximum}};
  noSuch(path, "one of " + namesOf(fields));
}

Target floorNumber(Scene& scene, const std::string& path, const std::string& number) {
  if (!scene.floor) noSuch(path, "only in a scene with a floor");
  FloorSpec& floor = *scene.floor;
  return fieldOf({{"friction", 0, 100, &floor.friction},
                  {"restitution", 0, 1, &floor.restitution},
                  {"slip1_m_s_n", 0, 10, &floor.slip1_m_s_n},
                  {"slip2_m_s_n", 0, 10, &floor.slip2_m_s_n},
                  {"stiffness_n_m", 1, 1e9, &floor.stiffness_n_m},
                  {"damping_n_s_m", 0, 1e7, &floor.damping_n_s_m}},
                 number, path);
}

Target ballNumber(Scene& scene, const std::string& path, std::string rest) {
  const std::string name = next(rest), number = rest;
  const auto ball = std::find_if(scene.balls.begin(), scene.balls.end(), [&](const auto& b) { return b.name == name; });
  if (ball == scene.balls.end()) noSuch(path, "a ball of this scene, which has " + namesOf(scene.balls));
  return fieldOf({{"radius_m", 0.001, 10, &ball->radius_m},
                  {"mass_kg", 1e-6, 1000, &ball->mass_kg},
                  {"inertia_factor", 0.01, 2.0 / 3.0, &ball->inertiaFactor},
                  {"rolling_deceleration_m_s2", 0, 100, &ball->rollingDeceleration_m_s2},
                  {"restitution", 0, 1, &ball->restitution},
                  {"spin_x_rad_s", -500, 500, &ball->spin_rad_s[0]},
                  {"spin_y_rad_s", -500, 500, &ball->spin_rad_s[1]},
                  {"spin_z_rad_s", -500, 500, &ball->spin_rad_s[2]}},
                 number, path);
}

Target obstacleNumber(Scene& scene, const std::string& path, std::string rest) {
  const std::string name = next(rest), number = rest;
  const auto obstacle = std::ranges::find(scene.obstacles, name, &ObstacleSpec::name);
  if (obstacle == scene.obstacles.end())
    noSuch(path, "an obstacle of this scene, which has " + namesOf(scene.obstacles));
  return fieldOf({{"friction", 0, 100, &obstacle->friction}, {"restitution", 0, 1, &obstacle->restitution}}, number,
                 path);
}

Target targetOf(Scene& scene, const std::string& path) {
  std::string rest = path;
  const std::string first = next(rest);
  if (first == "robots") return robotNumber(scene, path, rest);
  if (first == "floor") return floorNumber(scene, path, rest);
  if (first == "balls") return ballNumber(scene, path, rest);
  if (first == "obstacles") return obstacleNumber(scene, path, rest);
  if (first == "gravity_m_s2" && rest.size() == 1 && rest[0] >= 'x' && rest[0] <= 'z')
    return {&scene.gravity_m_s2[rest[0] - 'x'], {"gravity_m_s2", "m/s²", "", -1000, 1000}};
  noSuch(path, "a simulator parameter or a path that begins with robots, floor, balls, obstacles or gravity_m_s2");
}

/// "leg" names every group that begins with "leg:"; each is scaled by itself.
void setGroupMass(Scene& scene, const std::string& group, const std::string& name, double value) {
  bool any = false;
  for (auto& robot : scene.robots) {
    std::vector<std::string> groups;
    for (const auto& link : robot.model.links)
      if (isOfGroup(link.massGroup, group) && std::find(groups.begin(), groups.end(), link.massGroup) == groups.end())
        groups.push_back(link.massGroup);
    for (const auto& each : groups) {
      double sum = 0;
      for (const auto& link : robot.model.links)
        if (link.massGroup == each) sum += link.inertial.mass_kg;
      for (auto& link : robot.model.links)
        if (link.massGroup == each) scaleMass(link, value / sum);
      any = true;
    }
  }
  if (!any) noSuch(name, whoHas(name));
}

/// Every servo whose number the scene file leaves to the model keeps its ratio to the reference joint's.
void setServos(Scene& scene, const SceneSpec& spec, const std::string& name, double value) {
  constexpr double byDefault_p = 7.5;
  bool any = false;
  for (std::size_t r = 0; r < scene.robots.size(); ++r) {
    SceneRobot& robot = scene.robots[r];
    const int reference = referenceJoint(robot.model);
    if (reference < 0) continue;
    any = true;
    for (std::size_t j = 0; j < robot.drives.size(); ++j) {
      Drive& drive = robot.drives[j];
      if (drive.kind != Drive::Kind::servo) continue;
      const ServoData& own = robot.model.joints[j].servo;
      const ServoData& first = robot.model.joints[static_cast<std::size_t>(reference)].servo;
      const auto given = spec.robots[r].servos.find(robot.model.joints[j].name);
      const auto fixedByScene = [&](const char* number) {
        return given != spec.robots[r].servos.end() && given->second.numbers.contains(number);
      };
      const auto ratio = [](const std::optional<double>& a, const std::optional<double>& b, double usual) {
        const double base = b.value_or(usual);
        return base > 0 ? a.value_or(usual) / base : 1;
      };
      if (name == "servo_p_nm_rad" && !fixedByScene("p"))
        drive.p = value * ratio(own.p_nm_rad, first.p_nm_rad, byDefault_p);
      else if (name == "servo_i_nm_rad_s" && !fixedByScene("i"))
        drive.i = value * own.p_nm_rad.value_or(byDefault_p) / byDefault_p;
      else if (name == "servo_d_nm_s_rad" && !fixedByScene("d"))
        drive.d = value * ratio(own.d_nm_s_rad, first.d_nm_s_rad, 0.05);
      else if (name == "servo_max_torque_nm" && !fixedByScene("max_torque_nm"))
        drive.maxTorque = value * ratio(own.maxTorque_nm, first.maxTorque_nm, 0.85);
    }
  }
  if (!any) noSuch(name, whoHas(name));
}

}  // namespace

void setByPath(Scene& scene, const std::string& path, double value) {
  if (!std::isfinite(value)) throw InputError(path, toText(value), "a finite number");
  const Target target = targetOf(scene, path);
  check(target.bounds, value, path);
  if (target.scaled) {
    scaleMass(*target.scaled, value / target.scaled->inertial.mass_kg);
  } else {
    *target.number = value;
  }
}

double numberByPath(Scene scene, const std::string& path) { return *targetOf(scene, path).number; }

void setSimulatorParameter(Scene& scene, const SceneSpec& spec, const std::string& name, double value) {
  check(*find(simulatorParameters(), name), value, "simulator");
  for (const char* group : {"head", "neck", "body", "leg"})
    if (name == std::string(group) + "_mass_kg") return setGroupMass(scene, group, name, value);
  if (name == "gravity_m_s2") {
    const double strength = scene.gravity_m_s2.norm();
    scene.gravity_m_s2 =
        strength > 0 ? Eigen::Vector3d(scene.gravity_m_s2 / strength * value) : Eigen::Vector3d(0, 0, -value);
    return;
  }
  if (name == "friction" || name == "slip1_m_s_n" || name == "slip2_m_s_n")
    return setByPath(scene, "floor." + name, value);
  setServos(scene, spec, name, value);
}

}  // namespace btr
