#include "core/gap/recordings/recording.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/table/cell_reader.h"
#include "core/gap/recordings/table/table_layout.h"
#include "core/gap/recordings/table/table_preview.h"
#include "core/gap/recordings/table/table_reader.h"
#include "core/gap/recordings/trials.h"
#include "core/spec/error.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

constexpr std::size_t noColumn = static_cast<std::size_t>(-1);  // place of a time that is counted

std::string list(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < 20; ++i) text += (i ? ", " : "") + names[i];
  return names.size() > 20 ? text + ", ..." : text;
}

/// The header's names, each once: what nothing reads may stand there twice or have no name.
std::vector<std::string> namesOf(const TableReader& table, const Mapping* mapping, std::vector<std::string>& notes) {
  const auto isRead = [&](const std::string& name) {
    if (name == "time_s" || parseChannel(name)) return true;
    if (!mapping) return false;
    const auto adds = [&](const MappedColumn& column) {
      return column.column == name ||
             std::ranges::any_of(column.added, [&](const auto& term) { return term.column == name; });
    };
    return name == mapping->segmentColumn || std::ranges::any_of(mapping->columns, adds);
  };
  std::vector<std::string> names = table.header();
  std::set<std::string> taken;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string number = std::to_string(i + 1);
    if (names[i].empty()) names[i] = "column " + number;
    if (taken.insert(names[i]).second) continue;
    if (isRead(names[i]))
      throw InputError(table.atHeading(i + 1), "\"" + names[i] + "\"" + " again", "each column name once");
    notes.push_back("the name \"" + names[i] + "\" stands again over column " + number);
    names[i] += " (column " + number + ")";
    taken.insert(names[i]);
  }
  return names;
}

/// time_s first, then the columns in the file's order.
std::vector<ColumnUse> usesOf(const std::vector<std::string>& header, const Mapping* mapping, Recording& recording) {
  std::vector<ColumnUse> uses;
  std::vector<char> mapped(header.size(), 0);
  std::set<std::string> taken;
  if (mapping) {
    for (const MappedColumn& column : mapping->columns) {
      const auto found = placeOf(header, column.column);
      if (!found) {
        if (!column.optional)
          throw InputError(recording.source + ": column \"" + column.column + "\" is missing, which " +
                           mapping->source + " maps to " + column.channel + "; the file has " + list(header));
        recording.notes.push_back("column \"" + column.column + "\" (" + column.channel + ") is not in this file");
        continue;
      }
      const std::size_t source = *found;
      mapped[source] = 1;
      taken.insert(column.channel);
      uses.push_back({column.channel, source, column.scale, column.offset, true, 0, {}});
      for (const MappedColumn::Added& term : column.added) {
        const auto other = placeOf(header, term.column);
        if (!other && !term.optional)
          throw InputError(recording.source + ": column \"" + term.column + "\" is missing, which " + mapping->source +
                           " adds to " + column.channel + "; the file has " + list(header));
        if (!other) continue;
        mapped[*other] = 1;
        uses.back().added.emplace_back(*other, term.scale);
      }
      if (!column.compare) recording.notCompared.push_back(column.channel);
    }
  }
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (mapped[i]) continue;
    if (taken.count(header[i]))
      throw InputError(recording.source + ": column \"" + header[i] + "\" has the name of a channel that " +
                       mapping->source + " fills from another column");
    const bool known =
        header[i] == "time_s" || parseChannel(header[i]) || (mapping && header[i] == mapping->segmentColumn);
    if (!known) recording.notes.push_back("column \"" + header[i] + "\" is not mapped to a channel; kept, not used");
    uses.push_back({header[i], i, 1, 0, known, 0, {}});
  }
  if (mapping && mapping->rowPeriod_s > 0) {
    ColumnUse counted{"time_s", noColumn, 1, 0, true, 0, {}};
    counted.rowPeriod_s = mapping->rowPeriod_s;
    uses.push_back(counted);
    recording.notes.push_back("no column has the time: a row every " + digits(mapping->rowPeriod_s) +
                              " s, as its mapping says");
  }
  std::stable_sort(uses.begin(), uses.end(),
                   [](const ColumnUse& a, const ColumnUse& b) { return a.source < b.source; });
  const auto time =
      std::find_if(uses.begin(), uses.end(), [](const ColumnUse& use) { return use.channel == "time_s"; });
  if (time == uses.end())
    throw InputError(recording.source + ": there is no column time_s; the file has " + list(header) +
                     "; a mapping (NAME.mapping.json beside it) says which column is what" +
                     (header[0] != numberedColumn(1) ? ""
                                                     : ", here by numbers: {\"time_s\": {\"column\": 1}, ...}, or "
                                                       "{\"time_s\": {\"period_s\": 0.01}, ...} where no column has "
                                                       "the time"));
  std::rotate(uses.begin(), time, time + 1);
  return uses;
}

void readRows(TableReader& table, std::vector<ColumnUse>& uses, Recording& recording) {
  constexpr std::size_t rowsForEstimate = 65536;
  CellReader reader(table);
  std::vector<std::string> cells;
  while (table.next(cells)) {
    const auto row = static_cast<double>(recording.rows());
    for (std::size_t i = 0; i < uses.size(); ++i)
      recording.columns[i].push_back(uses[i].source == noColumn ? row * uses[i].rowPeriod_s
                                                                : reader.value(cells, uses[i]));
    recording.places.line.push_back(static_cast<std::uint32_t>(table.line()));

    const std::vector<double>& time = recording.columns[0];
    if (std::isnan(time.back()))
      throw InputError(table.at(uses[0].source + 1) + " (time_s)", "an empty cell", "a time in every row");
    // Long files: ask for the memory at once, not twice the memory in doublings.
    if (time.size() == rowsForEstimate) {
      const double expected =
          1.03 * static_cast<double>(table.size()) / static_cast<double>(table.bytesRead()) * rowsForEstimate;
      for (std::vector<double>& column : recording.columns) column.reserve(static_cast<std::size_t>(expected));
      recording.places.line.reserve(static_cast<std::size_t>(expected));
    }
  }
  if (const std::string note = reader.timeNote(); !note.empty()) {
    recording.notes.push_back(note);
    recording.places.stamps = true;
  }
}

}  // namespace

double Recording::samplePeriod() const {
  return (columns[0].back() - columns[0].front()) / static_cast<double>(rows() - 1);
}

int Recording::column(const std::string& name) const {
  const auto found = std::find(channels.begin(), channels.end(), name);
  return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
}

std::string Recording::at(std::size_t column, std::size_t row) const {
  const std::string place = places.file.empty() ? source : places.file;
  const std::string line =
      row < places.line.size() && places.line[row] > 0 ? " line " + std::to_string(places.line[row]) : "";
  const std::string number = column < places.column.size() && places.column[column] > 0
                                 ? ", column " + std::to_string(places.column[column])
                                 : "";
  return place + line + number + " (" + channels[column] + ")";
}

std::string Recording::atHeader(std::size_t column) const {
  if (column >= places.column.size() || places.column[column] == 0) return source;
  return places.file + " line " + std::to_string(places.headerLine) + ", column " +
         std::to_string(places.column[column]);
}

Recording readRecording(const std::string& path, const Mapping* mapping, std::size_t limit) {
  std::string timeColumn = mapping && mapping->rowPeriod_s > 0 ? "" : "time_s";
  std::vector<std::string> others;
  if (mapping)
    for (const MappedColumn& column : mapping->columns)
      column.channel == "time_s" ? void(timeColumn = column.column) : others.push_back(column.column);
  TableReader table(path, timeColumn, others, limit);

  Recording recording;
  recording.source = path;
  if (mapping) recording.mapping = mapping->source;
  recording.places.file = path;
  recording.places.headerLine = static_cast<std::size_t>(table.headingLine());
  std::vector<ColumnUse> uses = usesOf(namesOf(table, mapping, recording.notes), mapping, recording);
  for (const ColumnUse& use : uses) {
    recording.channels.push_back(use.channel);
    recording.places.column.push_back(use.source + 1);
  }
  recording.columns.resize(uses.size());
  readRows(table, uses, recording);
  if (recording.rows() == 0) throw InputError(path + ": there is a header but no row of numbers");
  recording.sha256 = table.finish();
  const auto said = table.notes();
  recording.notes.insert(recording.notes.end(), said.begin(), said.end());
  if (!table.endsWithLine() && static_cast<std::size_t>(table.line()) == recording.places.line.back())
    recording.notes.push_back("the last line, " + std::to_string(recording.places.line.back()) +
                              ", has no line end: it may have been cut off, even inside a number");

  for (const ColumnUse& use : uses) {
    recording.places.lastDigit.push_back(std::abs(use.scale) * use.lastDigit);
    const std::string of = " of " + std::to_string(recording.rows()) + " cells of \"" + use.channel + "\"";
    if (use.missing > 0)
      recording.notes.push_back(std::to_string(use.missing) + of + " say that there is no number; read as empty");
    if (use.skipped > 0) recording.notes.push_back(std::to_string(use.skipped) + of + " are not numbers; left out");
  }
  if (mapping) {
    const std::string name = std::filesystem::path(path).filename().string();
    for (const TrialSetting& setting : mapping->settings) {
      if (name.find(setting.fileContains) == std::string::npos) continue;
      for (const auto& [place, value] : setting.values) recording.settings[place] = value;
    }
  }
  return recording;
}

}  // namespace btr
