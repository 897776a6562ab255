/// Waves through the limbs of any robot, 12 parameters: a first gait for robots that no other controller knows.
///
/// A limb is what hangs from one moving joint of the root link; a joint's depth is its number in the limb, from 1.
///   q = q0 + g(t)·s·(o_k + a_k·sin(2π·(f·t + φ_k + ψ)))        k = min(depth, 3)
///   ψ = rear·[the limb's first joint is behind the middle of all] + side·[it is on the right]
/// q0 is where the scene starts the joint, within whose limits q stays; g grows from 0 to 1 in lead_in_s. s mirrors the
/// limbs: joints that turn about the robot's lateral axis swing alike on both sides, others mirrored, whatever the
/// sense of their axes in the file. Beyond depth 3 a wave runs on: each further joint is late by φ_3 − φ_2 once more.
/// Joints that slide move by 0.1 m for each radian.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/robot/robot.h"

namespace {

constexpr int depths = 3;
constexpr double metresPerRadian = 0.1;

/// One moving joint and the wave that it follows.
struct Swing {
  std::size_t joint = 0;
  int depth = 1;
  bool rear = false, right = false;
  double sign = 1;
};

/// Lateral axes swing alike on both sides; about the others a limb and its mirror image turn against each other.
double signOf(const Eigen::Vector3d& axis, bool right) {
  Eigen::Index largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  const double along = axis[largest] < 0 ? -1 : 1;
  return largest == 1 || !right ? along : -along;
}

std::vector<Swing> swingsOf(const btr::RobotModel& model) {
  // A joint's frame is its child link's at position 0.
  const std::vector<Eigen::Isometry3d> links =
      btr::forwardKinematics(model, Eigen::Isometry3d::Identity(), std::vector<double>(model.joints.size(), 0.0));
  std::vector<Swing> swings;
  std::vector<int> limb(model.links.size(), -1), depth(model.links.size(), 0);  // by link; its swing's place, if any
  std::vector<double> ahead;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const btr::Joint& joint = model.joints[j];
    const auto parent = static_cast<std::size_t>(joint.parentLink);
    limb[j + 1] = limb[parent];
    depth[j + 1] = depth[parent];
    if (joint.type == btr::Joint::Type::fixed || joint.mimic) continue;
    const Eigen::Vector3d place = links[j + 1].translation();
    Swing swing{j, ++depth[j + 1]};
    if (limb[parent] < 0) {
      limb[j + 1] = static_cast<int>(swings.size());
      ahead.push_back(place.x());
      swing.right = place.y() < 0;
    } else {
      swing.right = swings[static_cast<std::size_t>(limb[parent])].right;
    }
    swing.sign = signOf(links[j + 1].linear() * joint.axis, swing.right);
    swings.push_back(swing);
  }
  if (swings.empty()) return swings;
  const auto [rearmost, foremost] = std::ranges::minmax(ahead);
  const double middle = (rearmost + foremost) / 2;
  for (Swing& swing : swings) {
    const Swing& first = swings[static_cast<std::size_t>(limb[swing.joint + 1])];
    swing.rear = links[first.joint + 1].translation().x() < middle;
  }
  return swings;
}

class LimbWaves final : public uchilsim::Behaviour {
  std::vector<btr::Parameter> parameters() const override {
    return {{"frequency_hz", "Hz", "of all waves", 0.3, 3, 1.2},
            {"amplitude_1_rad", "rad", "of each limb's first joint", 0, 0.8, 0.15},
            {"amplitude_2_rad", "rad", "of each limb's second joint", 0, 0.8, 0.15},
            {"amplitude_3_rad", "rad", "of each limb's third joint and those behind it", 0, 0.8, 0.15},
            {"offset_1_rad", "rad", "of each limb's first joint from where the scene starts it", -0.8, 0.8, 0},
            {"offset_2_rad", "rad", "of each limb's second joint from where the scene starts it", -0.8, 0.8, 0},
            {"offset_3_rad", "rad", "of each limb's third joint and those behind it", -0.8, 0.8, 0},
            {"phase_1", "", "of the first joint's wave, in cycles", -0.5, 0.5, 0},
            {"phase_2", "", "of the second joint's wave, in cycles", -0.5, 0.5, 0.15},
            {"phase_3", "", "of the third joint's wave, in cycles", -0.5, 0.5, 0.3},
            {"rear_phase", "", "of limbs behind the middle after those before it, in cycles", -0.5, 0.5, 0.5},
            {"side_phase", "", "of limbs on the right after those on the left, in cycles", -0.5, 0.5, 0.5}};
  }

  std::vector<btr::Parameter> settings() const override {
    return {{"duration_s", "s", "length of the motion", 0.1, 600, 8},
            {"lead_in_s", "s", "in which the motion grows from standing", 0.01, 10, 0.5}};
  }

  void start(const uchilsim::Robot& robot, const btr::Values& settings, std::span<const double> p) override {
    const std::vector<double> values = btr::resolve(this->settings(), settings, "limb_waves");
    duration_s_ = values[0];
    leadIn_s_ = values[1];
    parameters_.assign(p.begin(), p.end());
    swings_ = swingsOf(robot.model);
    if (swings_.empty())
      throw uchilsim::InputError("limb_waves: robot " + robot.name, "no moving joint", "a robot with moving joints");
    start_.assign(robot.start.begin(), robot.start.end());
    for (const Swing& swing : swings_) {
      const btr::Joint& joint = robot.model.joints[swing.joint];
      limits_.push_back({joint.lower, joint.upper});
      units_.push_back(joint.type == btr::Joint::Type::slide ? metresPerRadian : 1);
    }
  }

  void act(const uchilsim::Senses& senses, uchilsim::Orders& orders) override {
    const double grown = std::min(1.0, senses.time_s / leadIn_s_);
    for (std::size_t i = 0; i < swings_.size(); ++i) {
      const Swing& swing = swings_[i];
      const double way = grown * swing.sign * units_[i] * waveOf(swing, senses.time_s);
      const auto [lower, upper] = limits_[i];
      orders.targets[swing.joint] = std::clamp(start_[swing.joint] + way, lower, upper);
    }
  }

  double duration_s() const override { return duration_s_; }

  /// Of a joint, about where it starts [rad].
  double waveOf(const Swing& swing, double time_s) const {
    const auto k = static_cast<std::size_t>(std::min(swing.depth, depths) - 1);
    double phase = parameters_[7 + k] + (swing.rear ? parameters_[10] : 0) + (swing.right ? parameters_[11] : 0);
    if (swing.depth > depths) phase += (swing.depth - depths) * (parameters_[9] - parameters_[8]);
    return parameters_[4 + k] + parameters_[1 + k] * std::sin(2 * std::numbers::pi * (parameters_[0] * time_s + phase));
  }

  std::vector<Swing> swings_;
  std::vector<double> parameters_, start_, units_;
  std::vector<std::array<double, 2>> limits_;
  double duration_s_ = 0, leadIn_s_ = 1;
};

}  // namespace

UCHILSIM_ROBOT_CONTROLLER(LimbWaves, "limb_waves")
