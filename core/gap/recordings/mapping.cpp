#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/gap/recordings/mapping.h"

#include "core/gap/recordings/channel_name.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {

namespace {

/// A number, or false for `none`; nothing if it is not there.
std::optional<double> numberOrFalse(JsonReader& entry, const std::string& key, double low, double high, double none) {
  const nlohmann::json* value = entry.any(key);
  if (!value) return std::nullopt;
  if (value->is_boolean() && !value->get<bool>()) return none;
  if (!value->is_number()) entry.refuse(key, "a number, or false");
  return entry.number(key, low, high);
}

/// "even", or {"period_s": 0.01}.
std::optional<double> retimeFrom(JsonReader& reader) {
  const nlohmann::json* value = reader.any("retime");
  if (!value) return std::nullopt;
  if (value->is_string() && value->get<std::string>() == "even") return 0;
  if (!value->is_object()) reader.refuse("retime", "\"even\" or {\"period_s\": SECONDS}");
  JsonReader entry = reader.object("retime");
  const double period_s = entry.number("period_s", 1e-6, 1e3);
  entry.finish();
  return period_s;
}

}  // namespace

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

  mapping.retime_s = retimeFrom(reader);
  if (const nlohmann::json* lost = reader.any("lost_rows")) {
    if (!lost->is_string() || (*lost != "hold" && *lost != "fill")) reader.refuse("lost_rows", "\"fill\" or \"hold\"");
    mapping.lostRowsHold = *lost == "hold";
  }
  if (auto resample = reader.objectIfAny("resample")) {
    mapping.period_s = resample->number("period_s", 1e-6, 1e6, 0);
    mapping.lowpass_hz = resample->number("lowpass_hz", 1e-6, 1e6, 0);
    resample->finish();
  }

  bool hasTime = false;
  for (const auto& [channel, value] : reader.node().items()) {
    if (channel == "settings" || channel == "segments" || channel == "resample" || channel == "retime" ||
        channel == "lost_rows")
      continue;
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
    column.wrap = numberOrFalse(entry, "wrap", 1e-6, 1e12, 0);
    if (const auto bit = numberOrFalse(entry, "sign_bit", 1, 52, -1)) {
      if (*bit != std::floor(*bit)) entry.refuse("sign_bit", "a whole number");
      column.signBit = static_cast<int>(*bit);
    }
    entry.array("add", [&](JsonReader term) {
      MappedColumn::Added added{term.text("column"), term.number("scale", -1e12, 1e12, 1),
                                term.flag("optional", false)};
      term.finish();
      column.added.push_back(std::move(added));
    });
    if (column.scale == 0) entry.refuse("scale", "a number other than 0");
    if (channel == "time_s" && column.scale < 0) entry.refuse("scale", "a positive number for time");
    if (channel == "time_s" && (column.wrap || column.signBit))
      entry.refuse(column.wrap ? "wrap" : "sign_bit", "neither wrap nor sign_bit for time");
    entry.finish();
    hasTime = hasTime || channel == "time_s";
    mapping.columns.push_back(std::move(column));
  }
  reader.finish();
  // A mapping of no column at all leaves the file's own names and says only what is done with the rows.
  const bool ofRowsAlone = mapping.columns.empty() && !reader.node().empty();
  if (!hasTime && !ofRowsAlone) throw InputError(place + ": \"time_s\" is missing; it names the column of time");
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
