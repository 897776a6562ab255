#include "core/gap/recordings/channel_floor.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/doctor/even_grid.h"
#include "core/gap/recordings/extent.h"
#include "core/gap/recordings/noise_floor.h"

namespace btr {
namespace {

constexpr double withoutAnything = 1e-6;  // [the channel's unit]

/// Root mean square of the speed over a few samples, by their numbers: stamps may be off. What `noise` makes of it is
/// taken out.
double usualSpeed(const std::vector<double>& values, double noise, double period_s) {
  constexpr std::size_t over = 3;
  double squares = 0, count = 0;
  for (std::size_t i = over; i < values.size(); ++i, ++count) squares += std::pow(values[i] - values[i - over], 2);
  if (count == 0) return 0;
  return std::sqrt(std::max(0.0, squares / count - 2 * noise * noise)) / (static_cast<double>(over) * period_s);
}

/// Where cells are empty, rows are further apart.
double noiseOverRows(const std::vector<double>& column, bool hasGaps, Impacts impacts) {
  if (!hasGaps) return noiseFloor(column, impacts);
  std::vector<double> rows(column.size());
  std::iota(rows.begin(), rows.end(), 0.0);
  return noiseFloor(rows, column, impacts);
}

double digitWritten(const Recording& recording, std::size_t column) {
  return column < recording.places.lastDigit.size() ? recording.places.lastDigit[column] : 0;
}

}  // namespace

double stepOfNumbers(const Recording& recording, std::size_t column) {
  return std::max(quantisationStep(recording.columns[column]), digitWritten(recording, column));
}

bool followsRowsNotStamps(const ChannelFloor& floor) {
  constexpr double clearly = 1.5;
  return floor.shown && floor.byStamps > clearly * floor.byRows;
}

ChannelFloor channelFloor(const Recording& recording, std::size_t column, Stamps stamps) {
  constexpr std::size_t leastNumbers = 5;
  std::vector<double> time, values;
  Extent extent;
  for (std::size_t row = 0; row < recording.rows(); ++row) {
    const double value = recording.columns[column][row];
    if (!std::isfinite(value)) continue;
    time.push_back(recording.columns[0][row]);
    values.push_back(value);
    extent.add(value);
  }
  ChannelFloor floor;
  if (values.empty()) return floor;
  const double rounding = quantisationStep(values) / std::sqrt(12.0);
  const auto name = parseChannel(recording.channels[column]);
  const Impacts impacts = name && name->part.empty() ? Impacts::some : Impacts::none;  // a ball bounces
  floor.byRows = noiseOverRows(recording.columns[column], values.size() < recording.rows(), impacts);
  floor.byStamps = noiseFloor(recording.columns[0], recording.columns[column], impacts);
  floor.moves = impacts == Impacts::none && motionPasses(recording.columns[column], floor.byRows);
  const double filtered = column < recording.filteredNoise.size() ? recording.filteredNoise[column] : 0;
  floor.level = std::max({floor.byStamps, rounding, filtered});
  // A constant's differences show the rounding of the arithmetic.
  floor.shown = floor.level > 1e-12 * std::max(std::abs(extent.low), std::abs(extent.high));
  if (stamps == Stamps::off || followsRowsNotStamps(floor)) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
    floor.ofSensor = std::max(floor.byRows, rounding);
    floor.jitter_s = noiseFloor(recording.columns[0]);
    floor.ofTime = usualSpeed(values, floor.ofSensor, median(std::move(steps))) * floor.jitter_s;
    floor.level = std::max(floor.level, std::hypot(floor.ofSensor, floor.ofTime));
  }
  const double written = digitWritten(recording, column) / std::sqrt(12.0);
  floor.few = !floor.shown && values.size() < leastNumbers;
  floor.level = floor.shown ? std::max(floor.level, written) : written > 0 ? written : withoutAnything;
  return floor;
}

}  // namespace btr
