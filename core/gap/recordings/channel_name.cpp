#include "core/gap/recordings/channel_name.h"

#include <array>
#include <utility>

namespace btr {
namespace {

constexpr std::array jointQuantities{"command_rad",    "command_m",    "command_nm", "command_n", "position_rad",
                                     "position_m",     "velocity_m_s", "torque_nm",  "torque_n",  "force_n",
                                     "velocity_rad_s", "voltage_v",    "duty",       "current_a", "enabled"};
constexpr std::array baseQuantities{"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"};
constexpr std::array ballQuantities{"x_m", "y_m", "z_m"};

template <std::size_t N>
bool among(const std::array<const char*, N>& words, const std::string& word) {
  for (const char* known : words)
    if (word == known) return true;
  return false;
}

}  // namespace

bool ChannelName::ofRoot() const { return part == "base" && among(baseQuantities, quantity); }

std::optional<ChannelName> parseChannel(const std::string& name) {
  const std::size_t first = name.find('.'), last = name.rfind('.');
  if (first == std::string::npos || first == 0 || last + 1 == name.size()) return std::nullopt;
  ChannelName parts{name.substr(0, first), "", name.substr(last + 1)};
  if (first == last) return among(ballQuantities, parts.quantity) ? std::optional(parts) : std::nullopt;
  parts.part = name.substr(first + 1, last - first - 1);
  if (parts.part.empty()) return std::nullopt;
  return parts.ofRoot() || among(jointQuantities, parts.quantity) ? std::optional(parts) : std::nullopt;
}

std::string unitOfChannel(const std::string& channel) {
  static constexpr std::array<std::pair<const char*, const char*>, 9> endings{{{"_rad_s", "rad/s"},
                                                                               {"_m_s", "m/s"},
                                                                               {"_rad", "rad"},
                                                                               {"_nm", "N·m"},
                                                                               {"_m", "m"},
                                                                               {"_n", "N"},
                                                                               {"_v", "V"},
                                                                               {"_a", "A"},
                                                                               {"time_s", "s"}}};
  for (const auto& [ending, unit] : endings)
    if (channel.ends_with(ending)) return unit;
  return "";
}

}  // namespace btr
