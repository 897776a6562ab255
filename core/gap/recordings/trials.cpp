// A file's trials: which mapping, and where one trial ends and the next begins.
#include "core/gap/recordings/trials.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/doctor/counts.h"
#include "core/gap/recordings/doctor/frozen.h"
#include "core/gap/recordings/doctor/lost_rows.h"
#include "core/gap/recordings/doctor/marked_missing.h"
#include "core/gap/recordings/doctor/recording_health.h"
#include "core/gap/recordings/doctor/repeated.h"
#include "core/gap/recordings/doctor/retime.h"
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/recordings/resample.h"
#include "core/gap/recordings/table/other_table.h"
#include "core/gap/recordings/table/row_order.h"
#include "core/spec/error.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

/// The trials in a file whose mapping is known.
std::vector<Recording> divide(Recording whole, const Mapping* mapping) {
  std::vector<Recording> trials;
  if (!mapping || mapping->segmentColumn.empty()) {
    trials.push_back(std::move(whole));
    return trials;
  }
  const int column = whole.column(mapping->segmentColumn);
  if (column < 0)
    throw InputError(whole.source + ": column \"" + mapping->segmentColumn + "\" is missing, which " + mapping->source +
                     " divides the file by");
  const std::vector<double>& segment = whole.columns[static_cast<std::size_t>(column)];
  const fs::path path(whole.source);
  const auto empty = std::find_if(segment.begin(), segment.end(), [](double number) { return std::isnan(number); });
  if (empty != segment.end())
    throw InputError(whole.at(static_cast<std::size_t>(column), static_cast<std::size_t>(empty - segment.begin())),
                     "an empty cell",
                     "the number of its trial in every row, as " + mapping->source + " divides the file");
  std::size_t first = 0;
  for (std::size_t row = 1; row <= segment.size(); ++row) {
    if (row < segment.size() && segment[row] == segment[row - 1]) continue;
    Recording trial = rowsOf(whole, first, row);
    trial.source = (path.parent_path() /
                    (path.stem().string() + "-" + std::to_string(trials.size() + 1) + path.extension().string()))
                       .string();
    trials.push_back(std::move(trial));
    first = row;
  }
  return trials;
}

/// A pause that dwarfs all that was recorded is a clock that jumped: a replay would simulate all of it.
void refuseJumps(const Recording& trial) {
  constexpr double mostSamples = 1000, mostLengths = 10;
  const std::vector<double>& time = trial.columns[0];
  if (time.size() < 3) return;
  const double period = rhythm(trial);
  const double most = period * std::max(mostSamples, mostLengths * static_cast<double>(time.size()));
  for (std::size_t row = 1; row < time.size(); ++row)
    if (time[row] - time[row - 1] > most)
      throw InputError(trial.at(0, row), toText(time[row]) + " after " + toText(time[row - 1]),
                       "a pause of at most " + digits(most) + " s where a sample comes every " + digits(period) +
                           " s: the clock jumped; mend it, or divide the file there (\"segments\" in its mapping)");
}

/// The rows that the mapping lets count.
void bound(Recording& trial, const Mapping& mapping) {
  if (!mapping.from_s && !mapping.until_s) return;
  trial.bounded = true;
  const std::vector<double>& time = trial.columns[0];
  if (time.empty()) return;
  Recording bounded =
      rowsBetween(trial, time.front() + mapping.from_s.value_or(0), time.front() + mapping.until_s.value_or(INFINITY));
  if (bounded.rows() < 2)
    throw InputError(trial.source + ": from_s and until_s in " + mapping.source + " leave less than two rows of its " +
                     digits(time.back() - time.front()) + " s");
  trial = std::move(bounded);
}

void noteEmptyCells(Recording& trial) {
  for (std::size_t column = 1; column < trial.channels.size(); ++column) {
    const std::vector<double>& values = trial.columns[column];
    const auto empty = std::ranges::count_if(values, [](double value) { return std::isnan(value); });
    if (empty > 0 && parseChannel(trial.channels[column]) && everyNthRow(values) == 1)
      trial.notes.push_back(std::to_string(empty) + " of " + std::to_string(trial.rows()) + " cells of \"" +
                            trial.channels[column] + "\" are empty");
  }
}

}  // namespace

Recording rowsOf(const Recording& recording, std::size_t first, std::size_t last) {
  Recording part = recording;
  for (std::vector<double>& column : part.columns)
    column = {column.begin() + static_cast<std::ptrdiff_t>(first), column.begin() + static_cast<std::ptrdiff_t>(last)};
  if (auto& lines = part.places.line; !lines.empty())
    lines = {lines.begin() + static_cast<std::ptrdiff_t>(first), lines.begin() + static_cast<std::ptrdiff_t>(last)};
  return part;
}

Recording rowsBetween(const Recording& recording, double from_s, double until_s) {
  const std::vector<double>& time = recording.columns[0];
  const auto first = std::ranges::lower_bound(time, from_s), last = std::ranges::upper_bound(time, until_s);
  return rowsOf(recording, static_cast<std::size_t>(first - time.begin()),
                static_cast<std::size_t>(last - time.begin()));
}

std::vector<Recording> loadTrials(const std::string& path, const Mapping* mapping, std::size_t limit) {
  Mapping beside;
  if (!mapping && fs::is_regular_file(path)) {
    if (const auto found = findMapping(path)) {
      beside = loadMapping(*found);
      mapping = &beside;
    }
  }
  Recording whole = readRecording(path, mapping, limit);
  if (mapping)
    for (const OtherTable& table : mapping->tables) {
      const std::string other = table.pathBeside(path);
      appendTable(whole, readRecording(other, &table.mapping, limit));
    }
  std::vector<Recording> trials = divide(std::move(whole), mapping);
  for (Recording& trial : trials) {
    orderRows(trial, mapping && mapping->retime_s);
    mendCounts(trial, mapping);
    emptyMarked(trial, mapping);  // after it: −1 of 16 bits is 65535, too
    noteEmptyCells(trial);
    if (mapping && mapping->retime_s) retime(trial, *mapping->retime_s);
    if (mapping) bound(trial, *mapping);
    refuseJumps(trial);
    emptyFrozen(trial);
    emptyRepeated(trial);
    trial.lostRowsHold = mapping && mapping->lostRowsHold;
    if (!trial.lostRowsHold) fillLostRows(trial);
    if (mapping) trial.betweenRows = mapping->betweenRows;
  }
  if (mapping && (mapping->period_s > 0 || mapping->lowpass_hz > 0))
    for (Recording& trial : trials) trial = resampled(trial, {mapping->period_s, mapping->lowpass_hz});
  return trials;
}

Recording loadRecording(const std::string& path, const Mapping* mapping, std::size_t limit) {
  std::vector<Recording> trials = loadTrials(path, mapping, limit);
  if (trials.size() > 1)
    throw InputError(path, std::to_string(trials.size()) + " trials", "a file that is one trial, here");
  return std::move(trials.front());
}

std::vector<Recording> loadTrialsFor(const std::string& path, const std::string& mapping, const std::string& scene) {
  const std::string file = mapping.empty() ? findMapping(path, scene).value_or("") : mapping;
  if (file.empty()) return loadTrials(path);
  const Mapping found = loadMapping(file);
  return loadTrials(path, &found);
}

}  // namespace btr
