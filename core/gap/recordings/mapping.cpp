#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/gap/recordings/mapping.h"

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/table/table_preview.h"
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

/// A column by its name or, counted from 1, by its number.
std::string columnFrom(JsonReader& entry) {
  constexpr std::size_t most = 10'000;  // that a table may have
  const nlohmann::json* value = entry.any("column");
  if (value && value->is_number()) return numberedColumn(static_cast<std::size_t>(entry.integer("column", 1, most)));
  return entry.text("column");
}

MappedColumn mappedColumn(JsonReader& entry, const std::string& channel) {
  MappedColumn column;
  column.channel = channel;
  column.column = columnFrom(entry);
  column.scale = entry.number("scale", -1e12, 1e12, 1);
  column.offset = entry.number("offset", -1e12, 1e12, 0);
  column.optional = entry.flag("optional", false);
  column.compare = entry.flag("compare", true);
  column.wrap = numberOrFalse(entry, "wrap", 1e-6, 1e12, 0);
  if (const auto bit = numberOrFalse(entry, "sign_bit", 1, 52, -1)) {
    if (*bit != std::floor(*bit)) entry.refuse("sign_bit", "a whole number");
    column.signBit = static_cast<int>(*bit);
  }
  column.missing = numberOrFalse(entry, "missing", -1e308, 1e308, NAN);
  entry.array("add", [&](JsonReader term) {
    MappedColumn::Added added{columnFrom(term), term.number("scale", -1e12, 1e12, 1), term.flag("optional", false)};
    term.finish();
    column.added.push_back(std::move(added));
  });
  if (column.missing && !column.added.empty()) entry.refuse("missing", "not beside \"add\"");
  if (column.scale == 0) entry.refuse("scale", "a number other than 0");
  if (channel == "time_s" && column.scale < 0) entry.refuse("scale", "a positive number for time");
  if (channel == "time_s" && (column.wrap || column.signBit || column.missing))
    entry.refuse(column.wrap      ? "wrap"
                 : column.signBit ? "sign_bit"
                                  : "missing",
                 "neither wrap nor sign_bit nor missing for time");
  return column;
}

/// What is said of channels; true if time is among them.
bool readColumns(JsonReader& reader, Mapping& mapping) {
  constexpr std::array others{"format", "settings", "segments", "resample", "retime",      "lost_rows",
                              "tables", "file",     "from_s",   "until_s",  "between_rows"};
  bool hasTime = false;
  for (const auto& [channel, value] : reader.node().items()) {
    if (std::ranges::find(others, channel) != others.end()) continue;
    if (channel != "time_s" && !parseChannel(channel))
      throw InputError(reader.place(), "channel \"" + channel + "\"",
                       "time_s, ROBOT.JOINT.QUANTITY, ROBOT.base.QUANTITY or BALL.QUANTITY, for example "
                       "leg.knee.position_rad");
    JsonReader entry = reader.object(channel);
    hasTime = hasTime || channel == "time_s";
    if (channel == "time_s" && entry.has("period_s") && !entry.has("column"))
      mapping.rowPeriod_s = entry.number("period_s", 1e-9, 1e3);
    else
      mapping.columns.push_back(mappedColumn(entry, channel));
    entry.finish();
  }
  return hasTime;
}

/// {"file": "input.csv", …} or {"file": {"replace": "state", "with": "command"}, …}
OtherTable tableFrom(JsonReader& entry) {
  OtherTable table;
  if (const nlohmann::json* file = entry.any("file"); file && file->is_object()) {
    JsonReader change = entry.object("file");
    table.replace = change.text("replace");
    table.with = change.text("with");
    if (table.replace.empty()) change.refuse("replace", "a part of the recording's name");
    change.finish();
  } else {
    table.file = entry.text("file");
    const std::filesystem::path path(table.file);
    if (table.file.empty() || path.has_parent_path()) entry.refuse("file", "the name of a file beside the recording");
  }
  table.mapping.source = entry.place();
  if (!readColumns(entry, table.mapping) || table.mapping.columns.empty())
    throw InputError(entry.place() + ": \"time_s\" and at least one channel are needed");
  entry.finish();
  return table;
}

}  // namespace

std::string OtherTable::pathBeside(const std::string& path) const {
  const std::filesystem::path recording(path);
  if (replace.empty()) return (recording.parent_path() / file).string();
  std::string name = recording.filename().string();
  const std::size_t place = name.find(replace);
  if (place == std::string::npos)
    throw InputError(mapping.source, "\"replace\" \"" + replace + "\"", "a part of the recording's name, " + name);
  return (recording.parent_path() / name.replace(place, replace.size(), with)).string();
}

Mapping mappingFromJson(const std::string& text, const std::string& place) {
  JsonReader reader = JsonReader::parse(text, place);
  Mapping mapping;
  mapping.source = place;
  if (!reader.node().is_object())
    throw InputError(place, "not an object", "{\"CHANNEL\": {\"column\": \"NAME\"}, ...}");

  // What is said of the whole file stands beside the channels; no channel is called like that.
  constexpr const char* format = "uchilsim-mapping-1";
  if (reader.any("format") && reader.text("format") != format)
    reader.refuse("format", std::string("\"") + format + "\", or none");
  reader.array("settings", [&](JsonReader entry) {
    TrialSetting setting{entry.text("file_contains"), entry.anyValues("values")};
    if (setting.fileContains.empty()) entry.refuse("file_contains", "a part of the file's name");
    entry.finish();
    mapping.settings.push_back(std::move(setting));
  });

  if (auto segments = reader.objectIfAny("segments")) {
    mapping.segmentColumn = columnFrom(*segments);
    segments->finish();
  }

  mapping.retime_s = retimeFrom(reader);
  if (const nlohmann::json* lost = reader.any("lost_rows")) {
    if (!lost->is_string() || (*lost != "hold" && *lost != "fill")) reader.refuse("lost_rows", "\"fill\" or \"hold\"");
    mapping.lostRowsHold = *lost == "hold";
  }
  if (const nlohmann::json* between = reader.any("between_rows")) {
    if (between->is_number())
      mapping.betweenRows = reader.number("between_rows", 0, 0.5);
    else if (*between == "hold" || *between == "line")
      mapping.betweenRows = *between == "line" ? 0.5 : 0;
    else
      reader.refuse("between_rows", "\"hold\", \"line\" or a number from 0 to 0.5");
  }
  if (auto resample = reader.objectIfAny("resample")) {
    mapping.period_s = resample->number("period_s", 1e-6, 1e6, 0);
    mapping.lowpass_hz = resample->number("lowpass_hz", 1e-6, 1e6, 0);
    resample->finish();
  }

  constexpr double longest_s = 1e6;
  if (reader.any("from_s")) mapping.from_s = reader.number("from_s", 0, longest_s);
  if (reader.any("until_s")) mapping.until_s = reader.number("until_s", mapping.from_s.value_or(0), longest_s);
  const bool hasTime = readColumns(reader, mapping);
  reader.array("tables", [&](JsonReader entry) { mapping.tables.push_back(tableFrom(entry)); });
  reader.finish();
  // A mapping of no column at all leaves the file's own names and says only what is done with the rows.
  const bool ofRowsAlone = mapping.columns.empty() && !reader.node().empty();
  if (!hasTime && !ofRowsAlone)
    throw InputError(
        place +
        ": \"time_s\" is missing; it names the column of time, or says \"period_s\", the seconds from row to row");
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
