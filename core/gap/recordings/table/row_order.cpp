#include "core/gap/recordings/table/row_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>

#include "core/gap/recordings/channel_name.h"
#include "core/spec/error.h"
#include "core/spec/figures.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

/// Columns that the contract knows, besides time.
std::vector<std::size_t> knownColumns(const Recording& trial) {
  std::vector<std::size_t> known;
  for (std::size_t column = 1; column < trial.channels.size(); ++column)
    if (parseChannel(trial.channels[column])) known.push_back(column);
  return known;
}

/// A clock that was set back by whole half hours has read local time.
std::string summerTime(const Recording& trial, double back_s) {
  constexpr double half_hour_s = 1800, slack_s = 60;
  const double halves = std::round(back_s / half_hour_s);
  if (!trial.places.stamps || halves < 1 || halves > 4 || std::abs(back_s - halves * half_hour_s) > slack_s) return "";
  return "; the clock was set back by " + digits(halves / 2) +
         " h, as at the end of summer time: stamps in UTC are needed";
}

[[noreturn]] void refuseTime(const Recording& trial, std::size_t row, std::size_t before) {
  const std::vector<double>& time = trial.columns[0];
  std::string why = summerTime(trial, time[before] - time[row]);
  if (why.empty() && row > 2 && time[row] <= time[0])
    why = "; a second recording begins there, it seems: a file of its own, or \"segments\" in the mapping";
  const double usual = (time.back() - time.front()) / static_cast<double>(time.size());
  if (why.empty() && time[row] < time[before] && time[before] - time[row] < 5 * std::abs(usual))
    why = "; where only the stamps are late, \"retime\": \"even\" in the mapping takes the rows as even samples";
  throw InputError(trial.at(0, row), toText(time[row]) + (time[row] == time[before] ? " again" : ""),
                   "times that increase from row to row; before it stands " + toText(time[before]) + why);
}

std::string lineOf(const Recording& trial, std::size_t row) {
  return row < trial.places.line.size() && trial.places.line[row] > 0 ? "line " + std::to_string(trial.places.line[row])
                                                                      : "row " + std::to_string(row + 1);
}

/// Every channel must tell one story: later rows, later times, and no second value at one time.
void requireOneStory(const Recording& trial, const std::vector<std::size_t>& known) {
  const std::vector<double>& time = trial.columns[0];
  std::vector<std::size_t> last(trial.channels.size(), SIZE_MAX);
  for (std::size_t row = 0; row < time.size(); ++row) {
    bool adds = false;
    for (const std::size_t column : known) {
      const double value = trial.columns[column][row];
      if (!std::isfinite(value)) continue;
      adds = true;
      const std::size_t before = std::exchange(last[column], row);
      if (before == SIZE_MAX || time[row] > time[before]) continue;
      if (time[row] < time[before]) refuseTime(trial, row, before);
      if (const double other = trial.columns[column][before]; other != value)
        throw InputError(trial.at(column, row), toText(value) + " at " + toText(time[row]) + " s",
                         "one value at a time; " + lineOf(trial, before) + " has " + toText(other) +
                             " for the same time (where the clock is only too coarse, \"retime\": \"even\" in the "
                             "mapping takes the rows as even samples)");
    }
    if (!adds && row > 0 && time[row] <= time[row - 1]) refuseTime(trial, row, row - 1);
  }
}

/// Rows taken in the order of `rows`; those of one time become one, which has what any of them has.
std::size_t arrange(Recording& trial, const std::vector<std::size_t>& rows,
                    const std::function<bool(std::size_t, std::size_t)>& joins) {
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t row : rows) {
    if (groups.empty() || !joins(groups.back().back(), row)) groups.emplace_back();
    groups.back().push_back(row);
  }
  for (std::vector<double>& column : trial.columns) {
    std::vector<double> arranged;
    arranged.reserve(groups.size());
    for (const auto& group : groups) {
      const auto filled = std::ranges::find_if(group, [&](std::size_t row) { return std::isfinite(column[row]); });
      arranged.push_back(column[filled == group.end() ? group.front() : *filled]);
    }
    column = std::move(arranged);
  }
  if (auto& lines = trial.places.line; !lines.empty()) {
    std::vector<std::uint32_t> arranged;
    for (const auto& group : groups) arranged.push_back(lines[group.front()]);
    lines = std::move(arranged);
  }
  return rows.size() - groups.size();
}

/// A replay begins where its inputs do: with the last value of each that has begun by then.
void beginWithInputs(Recording& trial) {
  std::size_t first = 0;
  std::string channel;
  for (std::size_t column = 1; column < trial.channels.size(); ++column) {
    if (!isInputChannel(trial.channels[column])) continue;
    const auto& values = trial.columns[column];
    const auto begins = std::ranges::find_if(values, [](double value) { return std::isfinite(value); });
    if (begins == values.end() || begins - values.begin() <= static_cast<std::ptrdiff_t>(first)) continue;
    first = static_cast<std::size_t>(begins - values.begin());
    channel = trial.channels[column];
  }
  if (first == 0) return;
  for (std::size_t column = 1; column < trial.channels.size(); ++column) {
    if (!isInputChannel(trial.channels[column])) continue;
    auto& values = trial.columns[column];
    for (std::size_t row = first; !std::isfinite(values[first]) && row-- > 0;)
      if (std::isfinite(values[row])) values[first] = values[row];
  }
  for (std::vector<double>& column : trial.columns)
    column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(first));
  if (auto& lines = trial.places.line; !lines.empty())
    lines.erase(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(first));
  trial.notes.push_back(std::to_string(first) + (first == 1 ? " row" : " rows") + " before the first value of " +
                        channel + " left out");
}

/// Rows of one time, of which none has what another has too.
bool complement(const Recording& trial, const std::vector<std::size_t>& known, std::size_t a, std::size_t b) {
  const auto clash = [&](std::size_t column) {
    return std::isfinite(trial.columns[column][a]) && std::isfinite(trial.columns[column][b]);
  };
  return trial.columns[0][a] == trial.columns[0][b] && std::ranges::none_of(known, clash);
}

void joinTopics(Recording& trial, bool retimed) {
  const std::vector<double>& time = trial.columns[0];
  const auto unordered = std::ranges::adjacent_find(time, std::greater_equal<>());
  if (unordered == time.end()) return;
  const auto known = knownColumns(trial);
  std::vector<std::size_t> rows(time.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::size_t joined = 0;
  bool sorted = true;
  if (retimed) {
    joined = arrange(trial, rows,
                     [&](std::size_t before, std::size_t row) { return complement(trial, known, before, row); });
  } else {
    requireOneStory(trial, known);
    sorted = std::ranges::is_sorted(time);
    if (!sorted) std::ranges::stable_sort(rows, [&](std::size_t a, std::size_t b) { return time[a] < time[b]; });
    joined = arrange(trial, rows, [&](std::size_t before, std::size_t row) { return time[before] == time[row]; });
  }
  if (joined > 0)
    trial.notes.push_back(std::to_string(joined) + (joined == 1 ? " row was" : " rows were") +
                          " joined with the one before of the same time: several topics in one table");
  if (!sorted) trial.notes.push_back("rows of several topics were put in the order of time");
}

}  // namespace

bool isInputChannel(const std::string& channel) {
  const auto name = parseChannel(channel);
  if (!name) return false;
  constexpr std::array inputs{"command_rad", "command_m", "command_nm", "command_n", "duty", "voltage_v", "enabled"};
  return std::ranges::find(inputs, name->quantity) != inputs.end();
}

void orderRows(Recording& trial, bool retimed) {
  joinTopics(trial, retimed);
  beginWithInputs(trial);
}

}  // namespace btr
