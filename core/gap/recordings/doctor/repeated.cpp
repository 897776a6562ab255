#include "core/gap/recordings/doctor/repeated.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/gap/recordings/channel_floor.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/doctor/even_grid.h"
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
    const bool body = name->part.empty() || name->ofRoot();
    sensors[body ? name->owner + "." + name->part : channel].push_back(column);
  }
  return sensors;
}

/// Equal readings of one sensor, one after another.
struct Run {
  std::vector<std::size_t> rows;
  bool dated = false;  ///< it is known when its value came: no reading is missing before it
  bool whole = true;   ///< no reading is missing in it
};

/// What a sensor tells, in the rows that have all of its cells.
struct Readings {
  std::vector<Run> runs;
  std::vector<long> place;  ///< by row: how many readings there would have been by then if none were missing
};

Readings readingsOf(const Recording& trial, const Columns& columns) {
  constexpr double lost = 1.6;  // of the usual time between readings: stamps may jitter
  const std::vector<double>& time = trial.columns[0];
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < trial.rows(); ++row)
    if (std::ranges::none_of(columns, [&](std::size_t column) { return std::isnan(trial.columns[column][row]); }))
      rows.push_back(row);
  std::vector<double> steps;
  for (std::size_t i = 1; i < rows.size(); ++i) steps.push_back(time[rows[i]] - time[rows[i - 1]]);
  const double usual_s = median(std::move(steps));
  Readings readings;
  readings.place.assign(trial.rows(), 0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double passed = i > 0 && usual_s > 0 ? (time[rows[i]] - time[rows[i - 1]]) / usual_s : 0;
    const bool follows = i > 0 && !(passed > lost);
    if (i > 0) readings.place[rows[i]] = readings.place[rows[i - 1]] + (follows ? 1 : std::lround(passed));
    const bool repeats = i > 0 && std::ranges::all_of(columns, [&](std::size_t column) {
                           return trial.columns[column][rows[i]] == trial.columns[column][rows[i - 1]];
                         });
    if (!repeats) readings.runs.push_back({{}, follows, true});
    Run& run = readings.runs.back();
    run.whole = run.whole && (follows || !repeats);
    run.rows.push_back(rows[i]);
  }
  return readings;
}

/// A sensor whose readings change in every n-th row only, and never between, measures in those; 1: none such. Shows
/// itself in slow motion as well, where a count lasts for many rows.
std::size_t rhythmOfChanges(const Readings& readings) {
  constexpr std::size_t longest = 10, enough = 15;
  constexpr double nearlyAll = 0.98;
  std::vector<std::size_t> changes;
  for (const Run& run : readings.runs)
    if (run.dated) changes.push_back(static_cast<std::size_t>(readings.place[run.rows[0]]));
  if (changes.size() < enough) return 1;
  for (std::size_t rhythm = longest; rhythm > 1; --rhythm) {
    std::vector<std::size_t> inPhase(rhythm, 0);
    for (const std::size_t change : changes) ++inPhase[change % rhythm];
    if (static_cast<double>(*std::ranges::max_element(inPhase)) >= nearlyAll * static_cast<double>(changes.size()))
      return rhythm;
  }
  return 1;
}

/// What is a motion beyond rounding, by column: a few counts.
std::vector<double> severalCountsOf(const Recording& trial, const Columns& columns) {
  constexpr double several = 5;
  std::vector<double> counts;
  for (const std::size_t column : columns) counts.push_back(several * stepOfNumbers(trial, column));
  return counts;
}

/// Where a read failed in motion, the value before stands once more, and the next one catches up: its step is as many
/// of the steps around it as the run has rows. (What sticks and slips begins slowly again.) Returns the longest of such
/// runs, 1 where too few show it.
std::size_t longestFailure(const Recording& trial, const Columns& columns, const Readings& readings) {
  constexpr double nearlyAll = 0.8, slower = 0.6, faster = 1.6;
  constexpr std::size_t enough = 8;
  const std::vector<double> counts = severalCountsOf(trial, columns);
  const auto change = [&](std::size_t k, std::size_t column) {  // from run k to the next, in a row's time
    const std::vector<double>& values = trial.columns[column];
    return (values[readings.runs[k + 1].rows[0]] - values[readings.runs[k].rows[0]]) /
           static_cast<double>(readings.runs[k].rows.size());
  };
  std::size_t held = 0, caughtUp = 0, longest = 1;
  for (std::size_t k = 1; k + 2 < readings.runs.size(); ++k) {
    const Run &run = readings.runs[k], &next = readings.runs[k + 1];
    const std::size_t rows = run.rows.size();
    if (rows < 2 || !readings.runs[k - 1].whole || !run.dated || !run.whole || !next.dated || !next.whole) continue;
    const auto moved = [&](std::size_t i) {
      return std::min(std::abs(change(k - 1, columns[i])), std::abs(change(k + 1, columns[i]))) - counts[i] / 2;
    };
    std::size_t most = 0;
    for (std::size_t i = 1; i < columns.size(); ++i)
      if (moved(i) > moved(most)) most = i;
    const double before = change(k - 1, columns[most]), after = change(k + 1, columns[most]);
    if (!(moved(most) > 0) || before * after <= 0) continue;
    ++held;
    const double ratio = change(k, columns[most]) / ((before + after) / 2);
    if (!(ratio > slower && ratio < faster)) continue;
    ++caughtUp;
    longest = std::max(longest, rows);
  }
  return caughtUp >= enough && static_cast<double>(caughtUp) >= nearlyAll * static_cast<double>(held) ? longest : 1;
}

/// How often the sensor is read for every time that it measures; 1: never in vain, as far as it shows.
std::size_t readingsPerMeasurement(const Recording& trial, const Columns& columns, const Readings& readings) {
  // A few runs are enough where all of them are held: noise alone never repeats in all columns at once.
  constexpr double leastShare = 0.35, nearlyAll = 0.9;
  constexpr std::size_t enough = 20, few = 6;
  const std::vector<double> counts = severalCountsOf(trial, columns);
  std::vector<double> lengths;
  std::size_t held = 0;
  for (std::size_t k = 1; k + 1 < readings.runs.size(); ++k) {
    // A run in motion: it is reached and left by more than a few counts.
    const auto moves = [&](const Run& before, const Run& after) {
      for (std::size_t i = 0; i < columns.size(); ++i) {
        const std::vector<double>& values = trial.columns[columns[i]];
        const double step = std::abs(values[after.rows[0]] - values[before.rows[0]]);
        if (step > 0 && step >= counts[i]) return true;
      }
      return false;
    };
    const Run &run = readings.runs[k], &next = readings.runs[k + 1];
    if (!run.dated || !run.whole || !next.dated || !moves(readings.runs[k - 1], run) || !moves(run, next)) continue;
    lengths.push_back(static_cast<double>(run.rows.size()));
    held += run.rows.size() > 1;
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
    const Readings readings = readingsOf(trial, columns);
    const std::size_t rhythm = std::max(readingsPerMeasurement(trial, columns, readings), rhythmOfChanges(readings));
    const std::size_t failure = longestFailure(trial, columns, readings);
    const std::size_t each = failure > rhythm ? failure + 1 : rhythm;  // a longer one may be in slow motion
    if (each < 2) continue;
    constexpr std::size_t rests = 3;
    std::size_t emptied = 0;
    for (std::size_t k = 0; k < readings.runs.size(); ++k) {
      const Run& run = readings.runs[k];
      for (const std::size_t row : run.rows) {
        const auto after = static_cast<std::size_t>(readings.place[row] - readings.place[run.rows[0]]);
        // When a value came of which the first reading is lost, nobody knows; what rests is not late.
        const bool isKnown = k == 0 || run.dated || after >= 2 * each;
        // Reads that fail have no rhythm: later rows are new only where the joint plainly rests.
        const bool isNew = isKnown && after % each == 0 && (rhythm >= failure || after == 0 || after >= rests * each);
        if (isNew) continue;
        for (const std::size_t column : columns) trial.columns[column][row] = std::numeric_limits<double>::quiet_NaN();
        ++emptied;
      }
    }
    for (const std::size_t column : columns) trial.thinned.push_back(trial.channels[column]);
    trial.notes.push_back(
        (columns.size() == 1 ? trial.channels[columns[0]] : sensor) + ": " + std::to_string(emptied) + " of " +
        std::to_string(rows) + " readings only repeat the one before, as " +
        (rhythm >= failure ? "its sensor measures every " +
                                 digits(static_cast<double>(rows) / static_cast<double>(rows - emptied), 2) + " rows"
                           : "now and then no new value came in time") +
        "; compared where new values come");
  }
}

}  // namespace btr
