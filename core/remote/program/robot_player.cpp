#include "core/remote/program/robot_player.h"

#include <algorithm>
#include <cmath>

#include "core/model/model_json.h"

namespace btr::remote {
namespace {

namespace v1 = ::uchilsim::v1;

/// A channel of a robot's senses, without the robot's name.
bool isSense(const std::string& channel) {
  for (const char* begin : {"accelerometer.", "infrared.", "paw.", "touch."})
    if (channel.starts_with(begin)) return true;
  return channel.ends_with(".sensed_rad") || channel.ends_with(".sensed_m");
}

}  // namespace

RobotPlayer::RobotPlayer(const ::uchilsim::BehaviourController& controller, PlayedMotion played, const v1::World& world,
                         const v1::RobotReply& robot, const std::string& name)
    : controller_(controller), played_(std::move(played)), seed_(robot.seed()) {
  parameters_ = resolve(controller.genotype(), played_.parameters, "--parameter");
  resolve(controller.settings(), played_.settings, "--setting");
  SceneRobot& mine = scene_.robots.emplace_back();
  mine.name = name;
  mine.model = modelFromJson(robot.model_json(), "the server's model of " + name);
  mine.jointStart.assign(robot.start().begin(), robot.start().end());
  mine.jointStart.resize(mine.model.joints.size());
  scene_.controlPeriod_s = world.control_period_s();
  const std::size_t joints = mine.model.joints.size();
  inputs_.resize(joints);
  for (std::size_t j = 0; j < joints && static_cast<int>(j) < robot.commands_size(); ++j)
    inputs_[j].command = robot.commands(static_cast<int>(j));
  told_ = inputs_;
  readings_.position.assign(joints, 0);
  readings_.rate.assign(joints, 0);
  readings_.torque.assign(joints, 0);
  for (std::size_t j = 0; j < joints; ++j) {
    const Joint& joint = mine.model.joints[j];
    if (joint.type == Joint::Type::fixed) continue;
    moving_.push_back(j);
    const bool slides = joint.type == Joint::Type::slide;
    const std::string at = name + "." + joint.name;
    wanted_.push_back(at + (slides ? ".position_m" : ".position_rad"));
    wanted_.push_back(at + (slides ? ".velocity_m_s" : ".velocity_rad_s"));
    wanted_.push_back(at + (slides ? ".force_n" : ".torque_nm"));
  }
  const std::string mineAlone = name + ".";
  for (const std::string& channel : world.channels())
    if (channel.starts_with(mineAlone) && isSense(channel.substr(mineAlone.size()))) senseChannels_.push_back(channel);
  wanted_.insert(wanted_.end(), senseChannels_.begin(), senseChannels_.end());
  for (const SenseSpec& sense : controller.senses())
    if (std::ranges::find(robot.senses(), sense.sense) == robot.senses().end())
      throw InputError("robots " + name + "/senses", "no " + sense.sense,
                       "a world in which the robot has what \"" + controller.name() + "\" must sense");
  begin();
}

void RobotPlayer::begin() {
  motion_ = controller_.begin(scene_, played_.settings, parameters_);
  clock_ = 0;
}

bool RobotPlayer::isOver() const {
  return !played_.repeats && clock_ >= motion_->duration() - scene_.controlPeriod_s / 2;
}

void RobotPlayer::perceive(const v1::State& state) {
  if (state.row_size() != static_cast<int>(wanted_.size()))
    throw InputError("the server's state", std::to_string(state.row_size()) + " numbers",
                     std::to_string(wanted_.size()));
  int at = 0;
  for (const std::size_t j : moving_) {
    readings_.position[j] = state.row(at++);
    readings_.rate[j] = state.row(at++);
    readings_.torque[j] = state.row(at++);
  }
  senses_.assign(state.row().begin() + at, state.row().end());
}

// As Session::step() asks a plugin's motion.
v1::Orders RobotPlayer::play(const v1::State& state, const CameraPicture* picture, long periods) {
  const double period_s = scene_.controlPeriod_s;
  const bool over = clock_ >= motion_->duration() - period_s / 2;
  if (over && played_.repeats) begin();
  if (!over || clock_ < period_s / 2) {
    perceive(state);
    motion_->sense({seed_, static_cast<long>(state.period()), senseChannels_, senses_, picture});
    motion_->command(clock_, readings_, inputs_);
  }
  for (long i = 0; i < periods; ++i) clock_ += period_s;
  return changes();
}

v1::Orders RobotPlayer::changes() {
  const SceneRobot& mine = scene_.robots.front();
  v1::Orders orders;
  orders.set_robot(mine.name);
  for (const std::size_t j : moving_) {
    const std::string& joint = mine.model.joints[j].name;
    const JointInput &now = inputs_[j], &was = told_[j];
    if (!std::isfinite(now.command))
      throw InputError(mine.name + ": the behaviour gave a target for " + joint + " that is no number");
    if (now.command != was.command) (*orders.mutable_targets())[joint] = now.command;
    if (now.enabled != was.enabled) (*orders.mutable_enabled())[joint] = now.enabled;
    if (now.pTimes == was.pTimes && now.iTimes == was.iTimes && now.dTimes == was.dTimes) continue;
    v1::Gains& gains = (*orders.mutable_gains())[joint];
    gains.set_p(now.pTimes);
    gains.set_i(now.iTimes);
    gains.set_d(now.dTimes);
  }
  told_ = inputs_;
  Values lamps = motion_->lamps();
  for (const auto& [lamp, brightness] : lamps_)
    if (!lamps.contains(lamp)) (*orders.mutable_lamps())[lamp] = 0;
  for (const auto& [lamp, brightness] : lamps)
    if (const auto was = lamps_.find(lamp); was == lamps_.end() || was->second != brightness)
      (*orders.mutable_lamps())[lamp] = brightness;
  lamps_ = std::move(lamps);
  return orders;
}

}  // namespace btr::remote
