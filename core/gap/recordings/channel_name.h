#pragma once
#include <optional>
#include <string>

namespace btr {

/// The parts of a channel's name: "leg.knee.position_rad", "leg.base.x_m", "ball.x_m" (part is empty).
struct ChannelName {
  std::string owner, part, quantity;
  /// Of a robot's root link; a joint that is called "base" has a joint's quantities.
  bool ofRoot() const;
};
/// The parts of a name that the contract knows, or nothing.
std::optional<ChannelName> parseChannel(const std::string& name);

/// For people: "position_rad" is in "rad", "torque_nm" in "N·m", "" for none.
std::string unitOfChannel(const std::string& channel);

}  // namespace btr
