#include "core/gap/recordings/table/cell_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/gap/recordings/channel_name.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// What a channel's numbers may be at most: far beyond robots in any unit that a mapping may have forgotten, far below
/// what a simulation could not compute with. Seconds since 1970 are a time.
double largestOf(const std::string& channel) {
  if (channel == "time_s") return 1e11;
  return parseChannel(channel) ? 1e7 : std::numeric_limits<double>::max();
}

/// "True", "false" as programs write them.
std::optional<double> flagOf(const std::string& cell) {
  const std::string word = trimmed(cell);
  if (word == "true" || word == "True" || word == "TRUE") return 1;
  if (word == "false" || word == "False" || word == "FALSE") return 0;
  return std::nullopt;
}

/// What a time that is no seconds may be.
std::string sinceWhen(double value, double scale) {
  constexpr double recent_s = 4e9, old_s = 1e9;  // 2001 to 2096
  for (const auto& [name, unit] : {std::pair{"milliseconds", 1e-3}, {"microseconds", 1e-6}, {"nanoseconds", 1e-9}})
    if (value * unit > old_s && value * unit < recent_s)
      return std::string("; these are ") + name + " since 1970, it seems: \"scale\" " + toText(scale * unit) +
             " in the mapping";
  return "";
}

}  // namespace

double CellReader::value(const std::vector<std::string>& cells, ColumnUse& use) {
  double value = use.scale * number(cells[use.source], use.source, use) + use.offset;
  for (const auto& [source, scale] : use.added) value += scale * number(cells[source], source, use);
  if (const double largest = largestOf(use.channel); std::abs(value) > largest)
    refuse(use.source, use, cells[use.source],
           "at most " + toText(largest) + " in the channel's unit, either sign" +
               (use.channel == "time_s" ? sinceWhen(value, use.scale) : ""));
  return value;
}

std::string CellReader::timeNote() const {
  if (!first_) return "";
  return "time_s holds time stamps; 0 s is " + firstText_ + (first_->hasZone || !first_->dated ? "" : ", read as UTC");
}

void CellReader::refuse(std::size_t source, const ColumnUse& use, const std::string& cell,
                        const std::string& allowed) const {
  throw InputError(table_.at(source + 1) + " (" + use.channel + ")", shownCell(cell), allowed);
}

/// The number in a cell; what it is multiplied with and added to is the caller's.
double CellReader::number(const std::string& cell, std::size_t source, ColumnUse& use) {
  if (cell.find_first_not_of(" \t") == std::string::npos) return nothing;
  if (saysMissing(cell) && use.channel != "time_s") {
    ++use.missing;
    return nothing;
  }
  if (!use.strict) {
    NumberReader any;
    if (const auto read = any.read(cell, table_.line())) return read->value;
    ++use.skipped;
    return nothing;
  }
  const bool isTime = use.channel == "time_s";
  if (isTime && first_) return seconds(cell, source, use);
  if (const auto read = numbers_.read(cell, table_.line())) {
    if (source == use.source && read->lastDigit > 0)
      use.lastDigit = use.lastDigit > 0 ? std::min(use.lastDigit, read->lastDigit) : read->lastDigit;
    numbered_ = numbered_ || isTime;
    return read->value;
  }
  if (isTime && !numbered_ && readTimeStamp(cell)) return seconds(cell, source, use);
  if (const auto flag = flagOf(cell); flag && use.channel.ends_with(".enabled")) return *flag;
  refuse(source, use, cell,
         isTime ? "seconds, or stamps like 2026-11-27T14:03:01.25Z in all rows" : numbers_.allowed(cell));
}

/// Of a time stamp, after the first one.
double CellReader::seconds(const std::string& cell, std::size_t source, const ColumnUse& use) {
  constexpr double day_s = 86400;
  const auto stamp = readTimeStamp(cell);
  if (!stamp || (first_ && stamp->dated != first_->dated))
    refuse(source, use, cell, "a time stamp like the first one, " + firstText_);
  if (use.scale != 1 || use.offset != 0)
    throw InputError(table_.at(source + 1) + " (time_s): " + shownCell(cell) +
                     " is a time stamp, which has no unit: \"scale\" 1 and \"offset\" 0 in the mapping");
  if (!first_) {
    first_ = stamp;
    firstText_ = shownCell(cell);
  }
  double value = days_s_ + static_cast<double>(stamp->second - first_->second) + (stamp->fraction - first_->fraction);
  // A clock without a date passes midnight.
  if (!stamp->dated && value < last_s_ - day_s / 2) {
    days_s_ += day_s;
    value += day_s;
  }
  return last_s_ = value;
}

}  // namespace btr
