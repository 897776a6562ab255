#include <algorithm>
#include <map>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/recording.h"
#include "core/spec/error.h"

namespace btr {
namespace {

using Input = Binding::Input;
using Measured = Binding::Measured;

/// The columns of one joint by quantity.
using JointColumns = std::map<std::string, std::size_t>;

class Binder {
 public:
  Binder(const Scene& scene, const Recording& recording) : scene_(scene), recording_(recording) {}

  Binding bind() {
    std::map<std::pair<std::size_t, std::size_t>, JointColumns> joints;
    for (std::size_t column = 1; column < recording_.channels.size(); ++column) {
      const auto name = parseChannel(recording_.channels[column]);
      if (!name) continue;
      if (name->part.empty()) {
        bindBall(*name, column);
      } else if (name->ofRoot()) {
        bindBase(*name, column);
      } else {
        const std::size_t robot = findRobot(name->owner, column);
        joints[{robot, findJoint(robot, name->part, column)}][name->quantity] = column;
      }
    }
    for (std::size_t robot = 0; robot < scene_.robots.size(); ++robot)
      for (std::size_t joint = 0; joint < scene_.robots[robot].model.joints.size(); ++joint)
        bindJoint(robot, joint, joints[{robot, joint}]);
    return std::move(binding_);
  }

 private:
  [[noreturn]] void refuse(std::size_t column, const std::string& allowed) const {
    throw InputError(recording_.atHeader(column), "channel \"" + recording_.channels[column] + "\"", allowed);
  }

  std::size_t findRobot(const std::string& name, std::size_t column) const {
    std::string known;
    for (std::size_t i = 0; i < scene_.robots.size(); ++i) {
      if (scene_.robots[i].name == name) return i;
      known += (i ? ", " : "") + scene_.robots[i].name;
    }
    refuse(column, "the scene's robots are: " + (known.empty() ? "none" : known));
  }

  std::size_t findJoint(std::size_t robot, const std::string& name, std::size_t column) const {
    const RobotModel& model = scene_.robots[robot].model;
    const int joint = model.findJoint(name);
    if (joint >= 0 && model.joints[static_cast<std::size_t>(joint)].type != Joint::Type::fixed)
      return static_cast<std::size_t>(joint);
    std::string known;
    for (const Joint& other : model.joints)
      if (other.type != Joint::Type::fixed) known += (known.empty() ? "" : ", ") + other.name;
    refuse(column, "the joints of " + scene_.robots[robot].name + " are: " + (known.empty() ? "none" : known));
  }

  void bindBall(const ChannelName& name, std::size_t column) {
    for (std::size_t i = 0; i < scene_.balls.size(); ++i) {
      if (scene_.balls[i].name != name.owner) continue;
      binding_.measured.push_back(
          {Measured::What::ballPosition, i, static_cast<std::size_t>(name.quantity[0] - 'x'), column});
      return;
    }
    std::string known;
    for (const BallSpec& ball : scene_.balls) known += (known.empty() ? "" : ", ") + ball.name;
    refuse(column, "the scene's balls are: " + (known.empty() ? "none" : known));
  }

  void bindBase(const ChannelName& name, std::size_t column) {
    const std::size_t robot = findRobot(name.owner, column);
    if (name.quantity[0] == 'q') {
      binding_.measured.push_back(
          {Measured::What::baseOrientation, robot, std::string("wxyz").find(name.quantity[1]), column});
    } else {
      binding_.measured.push_back(
          {Measured::What::basePosition, robot, static_cast<std::size_t>(name.quantity[0] - 'x'), column});
    }
  }

  /// Takes the column of a quantity out of the set; the unit must be that of the joint.
  std::optional<std::size_t> take(JointColumns& columns, const std::string& rotary, const std::string& slide,
                                  bool slides) const {
    const auto wrong = columns.find(slides ? rotary : slide);
    if (rotary != slide && wrong != columns.end())
      refuse(wrong->second, std::string("the joint ") + (slides ? "slides: " + slide : "turns: " + rotary));
    const auto found = columns.find(slides ? slide : rotary);
    if (found == columns.end()) return std::nullopt;
    const std::size_t column = found->second;
    columns.erase(found);
    return column;
  }

  void bindJoint(std::size_t robot, std::size_t joint, JointColumns columns) {
    const Joint& description = scene_.robots[robot].model.joints[joint];
    if (description.type == Joint::Type::fixed) return;
    const Drive& drive = scene_.robots[robot].drives[joint];
    const bool slides = description.type == Joint::Type::slide;
    const std::string name = scene_.robots[robot].name + "." + description.name;
    const auto input = [&](Input::What what, std::size_t column) {
      binding_.inputs.push_back({what, robot, joint, column});
    };

    // Measurements.
    const auto position = take(columns, "position_rad", "position_m", slides);
    const auto rate = take(columns, "velocity_rad_s", "velocity_m_s", slides);
    if (drive.kind != Drive::Kind::motion) {
      if (position) binding_.measured.push_back({Measured::What::position, robot, joint, *position});
      if (rate) binding_.measured.push_back({Measured::What::rate, robot, joint, *rate});
    }

    // What drives the joint: depends on the kind of its drive.
    const auto command = take(columns, "command_rad", "command_m", slides);
    if (description.mimic && command)
      binding_.notes.push_back(
          recording_.channels[*command] + ": the joint follows " +
          scene_.robots[robot].model.joints[static_cast<std::size_t>(description.mimic->leader)].name +
          "; its own commands are not used");
    const auto forceCommand = take(columns, "command_nm", "command_n", slides);
    auto torque = take(columns, "torque_nm", "torque_n", slides);
    if (const auto force = take(columns, "force_n", "force_n", slides)) {
      if (!slides) refuse(*force, "the joint turns: torque_nm");
      if (torque) refuse(*force, "torque_n and force_n are the same; one of them");
      torque = force;
    }
    bool driven = true;
    if (drive.kind == Drive::Kind::torque) {
      driven = forceCommand || torque;
      if (driven) input(Input::What::command, forceCommand ? *forceCommand : *torque);
      if (driven) binding_.inputs.back().isMeasuredTorque = !forceCommand;
      if (!forceCommand) torque.reset();
      if (!driven) binding_.notes.push_back(name + ": no torque_nm or force_n column drives it; it gets none");
    } else if (drive.kind == Drive::Kind::dcMotor) {
      const auto duty = columns.find("duty"), volts = columns.find("voltage_v");
      if (command && drive.firmwareGain_v_rad != 0) {
        input(Input::What::command, *command);
        if (volts != columns.end()) input(Input::What::supply, volts->second);
      } else if (duty != columns.end()) {
        input(Input::What::duty, duty->second);
        if (volts != columns.end()) input(Input::What::supply, volts->second);
        columns.erase(duty);
      } else if (volts != columns.end()) {
        input(Input::What::volts, volts->second);
      } else {
        driven = false;
        binding_.notes.push_back(name + ": no command, duty or voltage_v column drives its motor; duty 0");
      }
      columns.erase("voltage_v");
    } else if (drive.kind == Drive::Kind::motion) {
      driven = command || position;
      if (driven) input(Input::What::motion, position ? *position : *command);
      if (!torque) torque = forceCommand;
      if (!driven)
        binding_.notes.push_back(name + ": no position or command column moves it; it holds where it starts");
    } else if (drive.kind == Drive::Kind::servo) {
      driven = command.has_value();
      if (driven) input(Input::What::command, *command);
      if (!driven) binding_.notes.push_back(name + ": no command column; its servo holds the starting position");
    }
    if (torque) binding_.measured.push_back({Measured::What::torque, robot, joint, *torque});

    if (const auto enabled = columns.find("enabled"); enabled != columns.end()) {
      input(Input::What::enabled, enabled->second);
      columns.erase(enabled);
    }
    for (const auto& [quantity, column] : columns)
      binding_.notes.push_back(recording_.channels[column] + ": the simulator has no such quantity here; not compared");
  }

  const Scene& scene_;
  const Recording& recording_;
  Binding binding_;
};

}  // namespace

Binding bind(const Scene& scene, const Recording& recording) {
  Binding binding = Binder(scene, recording).bind();
  std::stable_sort(binding.measured.begin(), binding.measured.end(),
                   [](const Measured& a, const Measured& b) { return a.column < b.column; });
  const auto& silent = recording.notCompared;
  const auto compared = std::stable_partition(binding.measured.begin(), binding.measured.end(), [&](const Measured& m) {
    return std::find(silent.begin(), silent.end(), recording.channels[m.column]) == silent.end();
  });
  binding.startOnly.assign(compared, binding.measured.end());
  binding.measured.erase(compared, binding.measured.end());
  // A cell that holds the last value needs a first one.
  for (const Input& input : binding.inputs)
    if (!(recording.columns[input.column][0] == recording.columns[input.column][0]))
      throw InputError(recording.at(input.column, 0), "an empty cell",
                       "an input needs a value in the first row; later empty cells hold the last one");
  return binding;
}

const Binding::Input* Binding::input(Input::What what, std::size_t robot, std::size_t joint) const {
  const auto found = std::ranges::find_if(
      inputs, [&](const Input& input) { return input.what == what && input.robot == robot && input.joint == joint; });
  return found == inputs.end() ? nullptr : &*found;
}

}  // namespace btr
