#include "core/gap/recordings/doctor/repeated.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/doctor/even_grid.h"
#include "core/gap/recordings/noise_floor.h"
#include "core/gap/recordings/table/row_order.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

using Columns = std::vector<std::size_t>;

/// Measured channels by sensor: joint channels one by one, the columns of a body or ball together.
std::map<std::string, Columns> sensorsOf(const Recording& trial) {
  std::map<std::string, Columns> sensors;
  for (std::size_t column = 1; column < trial.channels.size(); ++column) {
    const std::string& channel = trial.channels[column];
    const auto name = parseChannel(channel);
    if (!name || isInputChannel(channel) || std::ranges::find(trial.notCompared, channel) != trial.notCompared.end())
      continue;
    const bool body = name->part.empty() || name->part == "base";
    sensors[body ? name->owner + "." + name->part : channel].push_back(column);
  }
  return sensors;
}

/// Rows in a run of equal readings of one sensor, by the run's first row; rows with an empty cell stand alone.
struct Runs {
  std::vector<std::size_t> first, length;
};

Runs runsOf(const Recording& trial, const Columns& columns) {
  Runs runs;
  for (std::size_t row = 0; row < trial.rows(); ++row) {
    const bool repeats = row > 0 && std::ranges::all_of(columns, [&](std::size_t column) {
                           return trial.columns[column][row] == trial.columns[column][row - 1];  // never for NaN
                         });
    if (!repeats) {
      runs.first.push_back(row);
      runs.length.push_back(0);
    }
    ++runs.length.back();
  }
  return runs;
}

/// A sensor whose readings change in every n-th row only, and never between, measures in those; 1: none such. Shows
/// itself in slow motion as well, where a count lasts for many rows.
std::size_t rhythmOfChanges(const Runs& runs) {
  constexpr std::size_t longest = 10, enough = 15;
  constexpr double nearlyAll = 0.98;
  if (runs.first.size() < enough + 1) return 1;
  for (std::size_t rhythm = longest; rhythm > 1; --rhythm) {
    std::vector<std::size_t> inPhase(rhythm, 0);
    for (std::size_t run = 1; run < runs.first.size(); ++run) ++inPhase[runs.first[run] % rhythm];
    const double changes = static_cast<double>(runs.first.size() - 1);
    if (static_cast<double>(*std::ranges::max_element(inPhase)) >= nearlyAll * changes) return rhythm;
  }
  return 1;
}

/// How often the sensor is read for every time that it measures; 1: never in vain, as far as it shows.
std::size_t readingsPerMeasurement(const Recording& trial, const Columns& columns, const Runs& runs) {
  // A few runs are enough where all of them are held: noise alone never repeats in all columns at once.
  constexpr double severalCounts = 5, leastShare = 0.35, nearlyAll = 0.9;
  constexpr std::size_t enough = 20, few = 6;
  std::vector<double> counts;
  for (const std::size_t column : columns) {
    const double digit = column < trial.places.lastDigit.size() ? trial.places.lastDigit[column] : 0;
    counts.push_back(severalCounts * std::max(quantisationStep(trial.columns[column]), digit));
  }
  std::vector<double> lengths;
  std::size_t held = 0;
  for (std::size_t run = 1; run + 1 < runs.first.size(); ++run) {
    // A run in motion: it is reached and left by more than a few counts.
    const auto moves = [&](std::size_t row) {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::vector<double>& values = trial.columns[columns[i]];
        if (const double step = std::abs(values[row] - values[row - 1]); step > 0 && step >= counts[i]) return true;
      }
      return false;
    };
    if (!moves(runs.first[run]) || !moves(runs.first[run + 1])) continue;
    lengths.push_back(static_cast<double>(runs.length[run]));
    held += runs.length[run] > 1;
  }
  const double needed = lengths.size() >= enough ? leastShare : nearlyAll;
  if (lengths.size() < few || static_cast<double>(held) < needed * static_cast<double>(lengths.size())) return 1;
  // A rhythm of 1.5 rows gives runs of one and of two: the longer ones; a few reads that failed do not count.
  std::ranges::sort(lengths);
  return static_cast<std::size_t>(lengths[9 * lengths.size() / 10]);
}

}  // namespace

void emptyRepeated(Recording& trial) {
  const std::size_t rows = trial.rows();
  for (const auto& [sensor, columns] : sensorsOf(trial)) {
    const Runs runs = runsOf(trial, columns);
    const std::size_t each = std::max(readingsPerMeasurement(trial, columns, runs), rhythmOfChanges(runs));
    if (each < 2) continue;
    std::size_t emptied = 0;
    for (std::size_t run = 0; run < runs.first.size(); ++run)
      for (std::size_t i = 1; i < runs.length[run]; ++i) {
        if (i % each == 0) continue;
        for (const std::size_t column : columns)
          trial.columns[column][runs.first[run] + i] = std::numeric_limits<double>::quiet_NaN();
        ++emptied;
      }
    for (const std::size_t column : columns) trial.thinned.push_back(trial.channels[column]);
    trial.notes.push_back((columns.size() == 1 ? trial.channels[columns[0]] : sensor) + ": " + std::to_string(emptied) +
                          " of " + std::to_string(rows) +
                          " readings only repeat the one before, as its sensor measures every " +
                          digits(static_cast<double>(rows) / static_cast<double>(rows - emptied), 2) +
                          " rows; compared where new values come");
  }
}

}  // namespace btr
