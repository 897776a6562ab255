#pragma once
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/robot/robot.h"
#include "uchilsim.pb.h"

namespace btr::remote {

/// What a user chose for a behaviour.
struct PlayedMotion {
  Values settings, parameters;  ///< what is left out has its default
  bool repeats = true;          ///< it begins again when it is over; else its last orders hold
};

/// A robot's behaviour seen from its program: a state of the world goes in, the orders that change come out. Asks the
/// behaviour at the same times and with the same numbers as a game that has it as a plugin.
class RobotPlayer {
 public:
  /// `world` and `robot` as the server describes them. Throws InputError where the behaviour cannot move this robot.
  RobotPlayer(const ::uchilsim::BehaviourController& controller, PlayedMotion played,
              const ::uchilsim::v1::World& world, const ::uchilsim::v1::RobotReply& robot, const std::string& name);

  /// What it needs of a state's row.
  const std::vector<std::string>& channels() const { return wanted_; }
  /// True when it is over and is not to begin again.
  bool isOver() const;
  /// The orders for `periods` control periods that begin with this state. Empty targets, gains …: nothing changes.
  ::uchilsim::v1::Orders play(const ::uchilsim::v1::State& state, const CameraPicture* picture, long periods = 1);

 private:
  void begin();
  void perceive(const ::uchilsim::v1::State& state);
  ::uchilsim::v1::Orders changes();

  const ::uchilsim::BehaviourController& controller_;
  PlayedMotion played_;
  std::vector<double> parameters_;
  Scene scene_;  ///< of the robot alone
  std::uint64_t seed_;
  std::vector<std::string> wanted_, senseChannels_;
  std::vector<std::size_t>
      moving_;  ///< joints of the model, in the order of wanted_: position, velocity, effort of each
  std::unique_ptr<Motion> motion_;
  double clock_ = 0;
  RobotReadings readings_;
  std::vector<double> senses_;
  std::vector<JointInput> inputs_, told_;
  Values lamps_;
};

}  // namespace btr::remote
