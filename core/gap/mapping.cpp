#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/gap/recording.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

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

std::optional<ChannelName> parseChannel(const std::string& name) {
  const std::size_t first = name.find('.'), last = name.rfind('.');
  if (first == std::string::npos || first == 0 || last + 1 == name.size()) return std::nullopt;
  ChannelName parts{name.substr(0, first), "", name.substr(last + 1)};
  if (first == last) return among(ballQuantities, parts.quantity) ? std::optional(parts) : std::nullopt;
  parts.part = name.substr(first + 1, last - first - 1);
  if (parts.part.empty()) return std::nullopt;
  const bool known =
      parts.part == "base" ? among(baseQuantities, parts.quantity) : among(jointQuantities, parts.quantity);
  return known ? std::optional(parts) : std::nullopt;
}

Mapping mappingFromJson(const std::string& text, const std::string& place) {
  JsonReader reader = JsonReader::parse(text, place);
  Mapping mapping;
  mapping.source = place;
  if (!reader.node().is_object())
    throw InputError(place, "not an object", "{\"CHANNEL\": {\"column\": \"NAME\"}, ...}");

  // What is said of the whole file stands beside the channels; no channel is called like that.
  reader.array("settings", [&](JsonReader entry) {
    TrialSetting setting{entry.text("file_contains"), entry.anyValues("values")};
    if (setting.fileContains.empty()) entry.refuse("file_contains", "a part of the file's name");
    entry.finish();
    mapping.settings.push_back(std::move(setting));
  });

  if (auto segments = reader.objectIfAny("segments")) {
    mapping.segmentColumn = segments->text("column");
    segments->finish();
  }

  if (auto resample = reader.objectIfAny("resample")) {
    mapping.period_s = resample->number("period_s", 1e-6, 1e6, 0);
    mapping.lowpass_hz = resample->number("lowpass_hz", 1e-6, 1e6, 0);
    resample->finish();
  }

  bool hasTime = false;
  for (const auto& [channel, value] : reader.node().items()) {
    if (channel == "settings" || channel == "segments" || channel == "resample") continue;
    if (channel != "time_s" && !parseChannel(channel))
      throw InputError(place, "channel \"" + channel + "\"",
                       "time_s, ROBOT.JOINT.QUANTITY, ROBOT.base.QUANTITY or BALL.QUANTITY, for example "
                       "leg.knee.position_rad");
    JsonReader entry = reader.object(channel);
    MappedColumn column;
    column.channel = channel;
    column.column = entry.text("column");
    column.scale = entry.number("scale", -1e12, 1e12, 1);
    column.offset = entry.number("offset", -1e12, 1e12, 0);
    column.optional = entry.flag("optional", false);
    column.compare = entry.flag("compare", true);
    entry.array("add", [&](JsonReader term) {
      MappedColumn::Added added{term.text("column"), term.number("scale", -1e12, 1e12, 1),
                                term.flag("optional", false)};
      term.finish();
      column.added.push_back(std::move(added));
    });
    if (column.scale == 0) entry.refuse("scale", "a number other than 0");
    if (channel == "time_s" && column.scale < 0) entry.refuse("scale", "a positive number for time");
    entry.finish();
    hasTime = hasTime || channel == "time_s";
    mapping.columns.push_back(std::move(column));
  }
  reader.finish();
  if (!hasTime) throw InputError(place + ": \"time_s\" is missing; it names the column of time");
  return mapping;
}

Mapping loadMapping(const std::string& path) { return mappingFromJson(readFile(path), path); }

std::optional<std::string> findMapping(const std::string& recordingPath, const std::string& scene) {
  namespace fs = std::filesystem;
  const fs::path recording(recordingPath);
  const fs::path folder = recording.parent_path();
  const std::string ending = ".mapping.json";
  std::vector<fs::path> candidates{folder / (recording.stem().string() + ending),
                                   folder / (recording.filename().string() + ending), folder / "mapping.json"};
  if (const fs::path path(scene); !scene.empty())
    candidates.push_back(path.parent_path() / (path.stem().string() + ending));
  for (const fs::path& candidate : candidates) {
    std::error_code ignored;
    if (fs::exists(candidate, ignored)) return candidate.string();
  }
  return std::nullopt;
}

}  // namespace btr
