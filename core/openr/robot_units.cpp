#include "core/openr/robot_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/openr/joint_gains.h"
#include "core/spec/error.h"

namespace btr::openr {
namespace {

constexpr double perUnit = 1e6;  ///< values are 10⁻⁶ of the SI unit
constexpr int fullDuty = 1023;

std::int32_t inMillionths(double si) {
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::lround(std::clamp(perUnit * si, -most, most)));
}

/// How a sensor's value is counted, and what it says when nothing is there to sense.
struct Sensing {
  const char* name;  ///< its beginning
  double neutral;    ///< SI; of switches 0 or 1
  double unit;       ///< what 1 is in the value
};
// Ranges after Sony's Model Information. The acceleration sensors show what pulls at a mass on a spring: at rest on its
// feet −9.8 m/s² upwards.
constexpr Sensing sensings[] = {{"distance_near", 0.5, perUnit},
                                {"distance_far", 1.5, perUnit},
                                {"distance_chest", 0.9, perUnit},
                                {"distance", 0.9, perUnit},
                                {"acceleration_up", -9.81, perUnit},
                                {"acceleration", 0, perUnit},
                                {"temperature", 25, perUnit},
                                {"touch_head_", 0, 980665},
                                {"wireless", 1, 1},
                                {"touch_head", 0, 80},
                                {"touch_back_", 0, 80},
                                {"", 0, 1}};

const Sensing& sensingOf(const std::string& name) {
  return *std::ranges::find_if(sensings, [&](const Sensing& each) { return name.starts_with(each.name); });
}

}  // namespace

const RobotDesign& designOf(const RobotModel& model, const std::string& wanted, const std::string& place) {
  if (!wanted.empty()) return robotDesign(wanted);
  for (const char* name : {"ERS-7", "ERS-210", "ERS-220"})
    if (model.name == name) return robotDesign(name);
  throw InputError(place, "the model \"" + model.name + "\"",
                   "an ERS-7, ERS-210 or ERS-220, or \"design\" that says which of them it is like");
}

RobotUnits::RobotUnits(const RobotDesign& design, const SceneRobot& robot) : design_(&design) {
  for (const Primitive& joint : design.joints) {
    const int index = joint.kind == Primitive::Kind::joint ? robot.model.findJoint(joint.name) : -1;
    const bool moves = index >= 0 && robot.model.joints[static_cast<std::size_t>(index)].type != Joint::Type::fixed;
    joints_.push_back(moves ? index : -1);
  }
  for (const Drive& drive : robot.drives) maxTorques_.push_back(drive.maxTorque);
}

std::vector<JointReading> RobotUnits::joints(const RobotReadings& now, const std::vector<JointInput>& told) const {
  std::vector<JointReading> all(joints_.size());
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    if (joints_[i] < 0) continue;
    const auto j = static_cast<std::size_t>(joints_[i]);
    const double share = maxTorques_[j] > 0 ? std::clamp(now.torque[j] / maxTorques_[j], -1.0, 1.0) : 0;
    all[i] = {inMillionths(now.position[j]), inMillionths(told[j].command),
              static_cast<std::int16_t>(std::lround(fullDuty * share))};
  }
  return all;
}

std::vector<std::int32_t> RobotUnits::sensors(const std::map<std::string, double>& si) const {
  std::vector<std::int32_t> all;
  for (const Primitive& sensor : design_->sensors) {
    const Sensing& sensing = sensingOf(sensor.name);
    const auto found = si.find(sensor.name);
    const double value = found == si.end() ? sensing.neutral : found->second;
    all.push_back(inMillionths(value * sensing.unit / perUnit));
  }
  return all;
}

// OPEN-R's constants begin at 1: INDOOR, OUTDOOR, FL; SLOW, MID, FAST; LOW, MID, HIGH.
Values cameraNumbers(const RobotDesign& design, const CameraOrder& order) {
  const bool ers7 = design.name == "ERS-7";
  const std::array<double, 3> white_k =
      ers7 ? std::array<double, 3>{2856, 6500, 5000} : std::array<double, 3>{2800, 7000, 4300};
  constexpr std::array<double, 3> exposures_s{1. / 50, 1. / 100, 1. / 200};
  const std::array<double, 3> gains_db = ers7 ? std::array<double, 3>{-6, 0, 6} : std::array<double, 3>{0, 0, 6};
  Values numbers;
  const auto choose = [&](const char* name, const std::optional<std::uint32_t>& constant, const auto& table) {
    if (constant && *constant >= 1 && *constant <= table.size()) numbers[name] = table[*constant - 1];
  };
  choose("balance_k", order.whiteBalance, white_k);
  choose("exposure_s", order.shutter, exposures_s);
  choose("gain_db", order.gain, gains_db);
  return numbers;
}

RobotUnits::Ordered RobotUnits::ordered(const OrderFrame& frame) const {
  Ordered all;
  const std::size_t count = std::min(frame.joints.size(), joints_.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (joints_[i] < 0) continue;
    const Primitive& joint = design_->joints[i];
    const JointOrder& order = frame.joints[i];
    if (order.target_urad) all.targets[joint.name] = std::clamp(*order.target_urad, joint.low, joint.high) / perUnit;
    if (order.gain) all.orders.gains[joint.name] = timesStandard(*order.gain, standardGain(design_->name, joint.name));
    if (order.gainEnabled) all.orders.enabled[joint.name] = *order.gainEnabled;
  }
  all.orders.motorPower = frame.motorPower;
  for (const LampOrder& lamp : frame.lamps) {
    if (lamp.lamp >= design_->lamps.size()) continue;
    constexpr double brightest = 255;
    constexpr std::uint16_t modeA = 0, modeB = 1;
    all.orders.lamps[design_->lamps[lamp.lamp].name] = {lamp.intensity / brightest, lamp.mode == modeA   ? "A"
                                                                                    : lamp.mode == modeB ? "B"
                                                                                                         : ""};
  }
  return all;
}

}  // namespace btr::openr
