#include "core/sim/senses.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/sim/world.h"
#include "core/spec/error.h"
#include "core/spec/random.h"

namespace btr {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr std::array pawLegs{"LF", "RF", "LR", "RR"};
constexpr std::array legWords{"lf", "rf", "lr", "rr"};

Parameter numberOf(const char* name, const char* unit, const char* meaning, double most, double byDefault) {
  return {name, unit, meaning, 0, most, byDefault, {}, false, {}};
}

std::vector<Parameter> senseTimings(double period_s, double delay_s) {
  return {numberOf("period_s", "s", "time between two samples, which are held in between", 10, period_s),
          numberOf("delay_s", "s", "time after which a sample is known", 1, delay_s)};
}

// The ranges and periods of the distance sensors and the bound of the accelerometer are Sony's model information of the
// ERS-7 and the ERS-210; noise, delays and the resolution of joints are estimates, none was published.
constexpr double controlFrame_s = 0.008;

std::vector<Parameter> infraredParameters(double nearest_m, double farthest_m, double period_s, double down_rad) {
  std::vector<Parameter> all = senseTimings(period_s, controlFrame_s);
  all.insert(all.begin(), numberOf("noise_m", "m", "standard deviation", 1, 0.005));
  all.push_back(numberOf("nearest_m", "m", "what is nearer is said to be here", 10, nearest_m));
  all.push_back(numberOf("farthest_m", "m", "what is further is said to be here", 10, farthest_m));
  all.push_back({"down_rad", "rad", "how far it looks down", -M_PI / 2, M_PI / 2, down_rad, {}, false, {}});
  return all;
}

std::vector<Parameter> parametersOfSense(const std::string& sense) {
  if (sense == "accelerometer") {
    std::vector<Parameter> all = senseTimings(controlFrame_s, controlFrame_s);
    all.insert(all.begin(), numberOf("noise_m_s2", "m/s²", "standard deviation on each axis", 100, 0.1));
    all.push_back(numberOf("limit_m_s2", "m/s²", "largest value on each axis, both ways", 1000, 19.6133));
    return all;
  }
  if (sense == "infrared_near") return infraredParameters(0.05, 0.5, 0.05, 0);
  if (sense == "infrared_far") return infraredParameters(0.2, 1.5, 0.05, 0);
  if (sense == "infrared_chest") return infraredParameters(0.1, 0.9, 0.04, M_PI / 6);
  if (sense == "infrared_head") return infraredParameters(0.1, 0.9, 0.04, 0);
  if (sense == "joints") {
    std::vector<Parameter> all = senseTimings(controlFrame_s, controlFrame_s);
    all.insert(all.begin(), numberOf("noise_rad", "rad", "standard deviation (on slide joints in m)", 1, 0.001));
    all.push_back(
        numberOf("resolution_rad", "rad", "steps of what is read (on slide joints in m); 0: none", 1, 0.0017));
    return all;
  }
  return senseTimings(controlFrame_s, controlFrame_s);
}

/// All links that a link carries, itself among them.
std::vector<std::size_t> linksCarriedBy(const RobotModel& model, std::size_t link) {
  std::vector<std::size_t> links{link};
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    if (std::ranges::find(links, static_cast<std::size_t>(model.joints[j].parentLink)) != links.end())
      links.push_back(j + 1);
  return links;
}

/// Where the camera is and looks, which the distance sensors of the head lie beside.
Isometry3d headEyeOf(const RobotModel& model, int head) {
  for (const Sensor& sensor : model.sensors)
    if (sensor.kind == Sensor::Kind::vision && sensor.link == head) {
      Isometry3d eye = sensor.pose;
      // x forward: a camera looks along −z with y up.
      Eigen::Matrix3d turn;
      turn << 0, -1, 0, 0, 0, 1, -1, 0, 0;
      eye.linear() = eye.linear() * turn;
      return eye;
    }
  return Isometry3d::Identity();
}

}  // namespace

const std::vector<std::string>& senseNames() {
  static const std::vector<std::string> names{"accelerometer", "infrared_near", "infrared_far", "infrared_chest",
                                              "infrared_head", "paws",          "touch",        "joints"};
  return names;
}

const std::vector<Parameter>& senseParameters(const std::string& sense) {
  static const std::map<std::string, std::vector<Parameter>> all = [] {
    std::map<std::string, std::vector<Parameter>> made;
    for (const std::string& name : senseNames()) made[name] = parametersOfSense(name);
    return made;
  }();
  return all.at(sense);
}

std::vector<SenseSpec> sensesOfModel(const std::string& model, const std::string& place) {
  if (model == "ers7")
    return {{"accelerometer"}, {"infrared_near"}, {"infrared_far"}, {"infrared_chest"},
            {"paws"},          {"touch"},         {"joints"}};
  if (model == "ers210") return {{"accelerometer"}, {"infrared_head"}, {"paws"}, {"touch"}, {"joints"}};
  throw InputError(place, "\"" + model + "\"", "\"ers7\", \"ers210\" or a list of senses");
}

Senses::Senses(const std::vector<SenseSpec>& specs, const SceneRobot& robot, std::uint64_t seed,
               const std::string& place)
    : seed_(seed), head_(robot.model.findLink("HEAD")), jaw_(robot.model.findLink("MOUTH_JAW")) {
  for (const SenseSpec& spec : specs) add(spec, robot, place);
}

void Senses::add(const SenseSpec& spec, const SceneRobot& robot, const std::string& place) {
  const std::string at = place + "/" + spec.sense;
  if (std::ranges::find(senseNames(), spec.sense) == senseNames().end()) {
    std::string allowed;
    for (const std::string& name : senseNames()) allowed += (allowed.empty() ? "" : ", ") + name;
    throw InputError(place, "\"" + spec.sense + "\"", allowed);
  }
  const std::vector<Parameter>& declared = senseParameters(spec.sense);
  resolve(declared, spec.parameters, at);
  const auto number = [&](const char* name) {
    return find(declared, name) ? valueOf(declared, spec.parameters, name) : 0;
  };
  Sense sense;
  sense.first = names_.size();
  sense.period_s = number("period_s");
  sense.delay_s = number("delay_s");
  const auto name = [&](const std::string& channel) { names_.push_back(robot.name + "." + channel); };
  const bool chest = spec.sense == "infrared_chest";
  if (spec.sense == "accelerometer") {
    sense.kind = Kind::accelerometer;
    sense.noise = number("noise_m_s2");
    sense.highest = number("limit_m_s2");
    sense.lowest = -sense.highest;
    for (const char* axis : {"x_m_s2", "y_m_s2", "z_m_s2"}) name(std::string("accelerometer.") + axis);
  } else if (spec.sense.starts_with("infrared")) {
    if (!chest && head_ < 0) throw InputError(place, "\"" + spec.sense + "\"", "a robot with a link HEAD");
    sense.kind = Kind::infrared;
    sense.noise = number("noise_m");
    sense.lowest = number("nearest_m");
    sense.highest = std::max(sense.lowest, number("farthest_m"));
    sense.link = chest ? 0 : head_;
    Isometry3d eye = chest ? Isometry3d::Identity() : headEyeOf(robot.model, head_);
    // In the chest plate of the ERS-7 (as our model of it has it).
    if (chest) eye.translation() << 0.104, 0, -0.003;
    const double down = number("down_rad");
    sense.eye_m = eye.translation();
    sense.look = eye.linear() * Vector3d(std::cos(down), 0, -std::sin(down));
    name("infrared." + spec.sense.substr(std::string("infrared_").size()) + "_m");
  } else if (spec.sense == "paws") {
    sense.kind = Kind::paws;
    sense.highest = 1;
    for (std::size_t leg = 0; leg < pawLegs.size(); ++leg) {
      const int joint = robot.model.findJoint(std::string(pawLegs[leg]) + "_J3");
      if (joint < 0) throw InputError(place, "\"paws\"", "a robot with joints LF_J3, RF_J3, LR_J3, RR_J3");
      sense.paws.push_back(linksCarriedBy(robot.model, static_cast<std::size_t>(joint) + 1));
      name(std::string("paw.") + legWords[leg]);
    }
  } else if (spec.sense == "touch") {
    if (head_ < 0) throw InputError(place, "\"touch\"", "a robot with a link HEAD");
    sense.kind = Kind::touch;
    sense.highest = 1;
    for (const char* where : {"touch.head", "touch.chin", "touch.back"}) name(where);
  } else {
    sense.noise = number("noise_rad");
    sense.resolution = number("resolution_rad");
    constexpr double anywhere = 1e9;
    sense.lowest = -anywhere;
    sense.highest = anywhere;
    for (std::size_t j = 0; j < robot.model.joints.size(); ++j) {
      const Joint& joint = robot.model.joints[j];
      if (joint.type == Joint::Type::fixed) continue;
      sense.parts.push_back(j);
      name(joint.name + (joint.type == Joint::Type::slide ? ".sensed_m" : ".sensed_rad"));
    }
  }
  sense.count = names_.size() - sense.first;
  for (std::size_t i = sense.first; i < names_.size(); ++i)
    if (std::find(names_.begin(), names_.begin() + static_cast<std::ptrdiff_t>(sense.first), names_[i]) !=
        names_.begin() + static_cast<std::ptrdiff_t>(sense.first))
      throw InputError(place, "\"" + spec.sense + "\" twice", "each sense once");
  senses_.push_back(std::move(sense));
}

void Senses::truth(const Sense& sense, const World& world, std::size_t robot, const std::vector<Touch>& touches,
                   std::vector<double>& values) const {
  values.clear();
  switch (sense.kind) {
    case Kind::accelerometer: {
      const Vector3d force = world.robot(robot).accelerometer_m_s2;
      values = {force.x(), force.y(), force.z()};
      return;
    }
    case Kind::infrared: {
      const Isometry3d link = world.linkPoses(robot)[static_cast<std::size_t>(sense.link)];
      values = {world.rayDistance_m(link * sense.eye_m, link.linear() * sense.look, sense.highest, robot)};
      return;
    }
    case Kind::paws: {
      const std::vector<char> contact = world.robot(robot).contact;
      for (const auto& links : sense.paws)
        values.push_back(std::ranges::any_of(links, [&](std::size_t link) { return contact[link] != 0; }));
      return;
    }
    case Kind::touch:
      values = {0, 0, 0};
      for (const Touch& touch : touches) {
        if (touch.link == head_) values[touch.point_m.z() >= 0 ? 0 : 1] = 1;
        if (jaw_ >= 0 && touch.link == jaw_) values[1] = 1;
        if (touch.link == 0 && touch.point_m.z() > 0) values[2] = 1;
      }
      return;
    case Kind::joints: {
      const std::vector<double> positions = world.robot(robot).position;
      for (const std::size_t joint : sense.parts) values.push_back(positions[joint]);
      return;
    }
  }
}

void Senses::sense(const World& world, std::size_t robot, const std::vector<Touch>& touches, long period,
                   double period_s) {
  const bool fresh = pending_.size() != names_.size();
  if (fresh) pending_.assign(names_.size(), {});
  std::vector<double> values;
  for (const Sense& sense : senses_) {
    const auto numberAt = [&](long at) {
      if (sense.period_s <= period_s) return at;
      constexpr double rounding = 1e-9;
      return static_cast<long>(std::floor(static_cast<double>(at) * period_s / sense.period_s + rounding));
    };
    const long number = numberAt(period);
    const bool due = fresh || period == 0 || number != numberAt(period - 1);
    if (due) truth(sense, world, robot, touches, values);
    const auto later = static_cast<std::size_t>(std::lround(sense.delay_s / period_s));
    for (std::size_t i = 0; i < sense.count; ++i) {
      std::vector<double>& pending = pending_[sense.first + i];
      double value = pending.empty() ? 0 : pending.back();
      if (due) {
        value = values[i];
        if (sense.noise > 0)
          value += sense.noise *
                   Random::forPurpose(seed_, names_[sense.first + i], static_cast<std::uint64_t>(number)).normal();
        if (sense.resolution > 0) value = sense.resolution * std::round(value / sense.resolution);
        value = std::clamp(value, sense.lowest, sense.highest);
      }
      if (fresh)
        pending.assign(later + 1, value);
      else
        pending.erase(pending.begin()), pending.push_back(value);
    }
  }
}

void Senses::sample(std::vector<double>& row) const {
  for (const std::vector<double>& pending : pending_) row.push_back(pending.front());
}

void Senses::remember(const std::vector<std::vector<double>>& memory, const std::string& place) {
  if (memory.size() != names_.size() || std::ranges::any_of(memory, [](const auto& each) { return each.empty(); }))
    throw InputError(place, "what other senses remember", std::to_string(names_.size()) + " lists of numbers");
  pending_ = memory;
}

}  // namespace btr
