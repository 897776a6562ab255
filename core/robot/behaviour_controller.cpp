// From a behaviour to what plugins are: senses by name become senses by field, orders become inputs of joints.
#include <algorithm>

#include "core/robot/robot.h"

namespace uchilsim {
namespace {

bool hasFourLegs(const btr::RobotModel& model) {
  return std::ranges::all_of(btr::FourLegs::names, [&](const char* leg) {
    return std::ranges::all_of(std::array{"_J1", "_J2", "_J3"},
                               [&](const char* joint) { return model.findJoint(std::string(leg) + joint) >= 0; });
  });
}

/// Where the channels of the senses are in what the robot senses.
class SenseFields {
 public:
  void find(std::span<const std::string> channels, const std::string& robot, const std::vector<std::string>& joints) {
    if (std::ranges::equal(channels, known_)) return;
    known_.assign(channels.begin(), channels.end());
    const auto at = [&](const std::string& name) -> std::optional<std::size_t> {
      const auto found = std::ranges::find(known_, robot + "." + name);
      if (found == known_.end()) return std::nullopt;
      return static_cast<std::size_t>(found - known_.begin());
    };
    acceleration_ = at("accelerometer.x_m_s2");
    near_ = at("infrared.near_m");
    far_ = at("infrared.far_m");
    chest_ = at("infrared.chest_m");
    head_ = at("infrared.head_m");
    paws_ = at("paw.lf");
    touch_ = at("touch.head");
    joints_.clear();
    for (const std::string& joint : joints) {
      const auto place = at(joint + ".sensed_rad");
      joints_.push_back(place ? place : at(joint + ".sensed_m"));
    }
  }

  void fill(std::span<const double> values, std::vector<double>& positions, Senses& senses) const {
    const auto number = [&](const std::optional<std::size_t>& at, std::size_t further = 0) {
      return values[*at + further];
    };
    const auto distance = [&](const std::optional<std::size_t>& at) {
      return at ? std::optional(values[*at]) : std::nullopt;
    };
    senses.infrared = {distance(near_), distance(far_), distance(chest_), distance(head_)};
    if (acceleration_)
      senses.acceleration_m_s2 = {number(acceleration_), number(acceleration_, 1), number(acceleration_, 2)};
    if (paws_) senses.paws = {number(paws_) != 0, number(paws_, 1) != 0, number(paws_, 2) != 0, number(paws_, 3) != 0};
    if (touch_) senses.touch = {number(touch_) != 0, number(touch_, 1) != 0, number(touch_, 2) != 0};
    for (std::size_t j = 0; j < joints_.size(); ++j)
      if (joints_[j]) positions[j] = values[*joints_[j]];
  }

 private:
  std::vector<std::string> known_;
  std::optional<std::size_t> acceleration_, near_, far_, chest_, head_, paws_, touch_;  ///< the first of its channels
  std::vector<std::optional<std::size_t>> joints_;
};

class BehaviourMotion final : public btr::Motion {
 public:
  BehaviourMotion(std::unique_ptr<Behaviour> behaviour, const btr::Scene& scene, const Values& settings,
                  std::span<const double> parameters)
      : behaviour_(std::move(behaviour)), name_(scene.robots.front().name) {
    const btr::SceneRobot& robot = scene.robots.front();
    for (const btr::Joint& joint : robot.model.joints) joints_.push_back(joint.name);
    senses_.period_s = scene.controlPeriod_s;
    behaviour_->start({robot.name, robot.model, robot.jointStart, scene.controlPeriod_s}, settings, parameters);
  }

  void sense(const btr::MotionSenses& now) override { now_ = now; }

  void command(double time, const btr::RobotReadings& readings, std::span<btr::JointInput> inputs) override {
    perceive(time, readings);
    if (orders_.targets.size() != inputs.size()) {
      orders_.gains.assign(inputs.size(), {});
      orders_.enabled.assign(inputs.size(), 1);
      orders_.targets.resize(inputs.size());
      for (std::size_t j = 0; j < inputs.size(); ++j) orders_.targets[j] = inputs[j].command;
    }
    behaviour_->act(senses_, orders_);
    if (orders_.targets.size() != inputs.size() || orders_.gains.size() != inputs.size() ||
        orders_.enabled.size() != inputs.size())
      throw InputError(name_ + ": its behaviour orders for another number of joints than the robot's " +
                       std::to_string(inputs.size()));
    for (std::size_t j = 0; j < inputs.size(); ++j) {
      const Orders::Gains& gains = orders_.gains[j];
      inputs[j].command = orders_.targets[j];
      inputs[j].enabled = orders_.enabled[j] != 0;
      inputs[j].pTimes = gains.p;
      inputs[j].iTimes = gains.i;
      inputs[j].dTimes = gains.d;
    }
  }

  double duration() const override { return behaviour_->duration_s(); }
  Values remarks() const override { return behaviour_->remarks(); }
  Values lamps() const override { return orders_.lamps; }
  std::vector<double> memory() const override { return behaviour_->memory(); }
  void remember(std::span<const double> memory) override { behaviour_->remember(memory); }

 private:
  void perceive(double time, const btr::RobotReadings& readings) {
    positions_ = readings.position;
    senses_.time_s = time;
    senses_.seed = now_.seed;
    senses_.period = now_.period;
    senses_.picture = now_.picture;
    if (!now_.channels.empty()) {
      fields_.find(now_.channels, name_, joints_);
      fields_.fill(now_.values, positions_, senses_);
    }
    senses_.position = positions_;
    senses_.velocity = readings.rate;
    senses_.effort = readings.torque;
  }

  std::unique_ptr<Behaviour> behaviour_;
  std::string name_;
  std::vector<std::string> joints_;
  std::vector<double> positions_;  ///< by joint, as they are sensed
  SenseFields fields_;
  Senses senses_;
  Orders orders_;
  btr::MotionSenses now_;
};

}  // namespace

std::size_t Robot::joint(const std::string& joint) const {
  const int index = model.findJoint(joint);
  if (index < 0 || model.joints[static_cast<std::size_t>(index)].type == btr::Joint::Type::fixed)
    throw InputError("joint", "\"" + joint + "\"", "a joint of " + name + " that moves");
  return static_cast<std::size_t>(index);
}

std::vector<double> BehaviourController::posture(const btr::RobotModel& model) const {
  std::vector<double> own = make_()->posture(model);
  return own.empty() && hasFourLegs(model) ? btr::stanceOf(model, name_) : own;
}

void BehaviourController::arrange(btr::Scene& scene, const Values& settings) const {
  if (scene.robots.empty()) throw InputError(name_ + ": the scene has no robot");
  const std::unique_ptr<Behaviour> behaviour = make_();
  btr::SceneRobot& robot = scene.robots.front();
  if (std::vector<double> posture = behaviour->posture(robot.model); !posture.empty()) {
    btr::standStill(robot, std::move(posture), name_);
  } else if (robot.freeBase && scene.floor && hasFourLegs(robot.model)) {
    btr::arrangeStance(scene, name_);
  }
  behaviour->setTask(scene, settings);
}

std::unique_ptr<btr::Motion> BehaviourController::begin(const btr::Scene& scene, const Values& settings,
                                                        std::span<const double> parameters) const {
  return std::make_unique<BehaviourMotion>(make_(), scene, settings, parameters);
}

}  // namespace uchilsim
