#include "core/gap/recordings/doctor/frozen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/gap/recordings/channel_floor.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/extent.h"
#include "core/gap/recordings/table/row_order.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

constexpr std::array<std::size_t, 2> windows{8, 16};  // readings that tell how fast it was; more for noisy ones
constexpr double leastCounts = 8;                     // that it moves in those: full motion
constexpr double keepsSpeed = 0.7;                    // of that speed in their second half; less, and it brakes
constexpr std::size_t leastReadings = 15;             // that are equal
constexpr double least_s = 0.2;                       // the same
constexpr double leap = 2;                            // times the largest step of the rest of the trial: no motion
constexpr double commandGoes = 0.05;                  // of a command's spread over the trial: it goes on
constexpr double commandGoesFar = 0.5;  // the same: no friction holds a joint that long which followed it before
constexpr double farLeast_s = 0.5;      // then

/// Readings of one value, one after another.
struct Hold {
  std::size_t first = 0, last = 0;  ///< indices into the rows that have a value
  double length_s = 0;
  bool fromMotion = false;  ///< begins in full motion
};

/// A position's readings.
struct PositionReadings {
  std::vector<std::size_t> rows;
  std::vector<double> values;

  double step(std::size_t i) const { return values[i + 1] - values[i]; }
  bool endsWith(const Hold& hold) const { return hold.last + 1 == rows.size(); }
};

PositionReadings readingsIn(const std::vector<double>& column) {
  PositionReadings position;
  for (std::size_t row = 0; row < column.size(); ++row)
    if (std::isfinite(column[row])) {
      position.rows.push_back(row);
      position.values.push_back(column[row]);
    }
  return position;
}

bool beginsInMotion(const PositionReadings& position, const Hold& hold, double count) {
  return std::ranges::any_of(windows, [&](std::size_t window) {
    if (hold.first < window) return false;
    const double whole = position.values[hold.first] - position.values[hold.first - window];
    const double half = position.values[hold.first] - position.values[hold.first - window / 2];
    return whole != 0 && std::abs(whole) >= leastCounts * count && half / whole >= keepsSpeed / 2;
  });
}

std::vector<Hold> holdsOf(const PositionReadings& position, const std::vector<double>& time, double count) {
  std::vector<Hold> holds;
  for (std::size_t first = 0; first < position.rows.size();) {
    Hold hold{first, first};
    while (!position.endsWith(hold) && position.values[hold.last + 1] == position.values[first]) ++hold.last;
    first = hold.last + 1;
    hold.length_s = time[position.rows[hold.last]] - time[position.rows[hold.first]];
    hold.fromMotion = beginsInMotion(position, hold, count);
    if (hold.last - hold.first + 1 >= leastReadings && hold.length_s >= least_s &&
        (hold.fromMotion || position.endsWith(hold)))
      holds.push_back(hold);
  }
  return holds;
}

/// The largest step but for those with which a hold ends.
double usualStep(const PositionReadings& position, const std::vector<Hold>& holds) {
  double most = 0;
  for (std::size_t i = 0; i + 1 < position.rows.size(); ++i)
    if (std::ranges::find(holds, i, &Hold::last) == holds.end()) most = std::max(most, std::abs(position.step(i)));
  return most;
}

std::vector<std::size_t> channelsOf(const Recording& trial, const std::string& joint, bool inputs) {
  std::vector<std::size_t> columns;
  for (std::size_t column = 1; column < trial.channels.size(); ++column) {
    const auto name = parseChannel(trial.channels[column]);
    if (name && name->owner + "." + name->part == joint && isInputChannel(trial.channels[column]) == inputs)
      columns.push_back(column);
  }
  return columns;
}

/// How far the joint's command goes from `row` to the end, of its spread over the trial; 1 where there is none.
double commandFrom(const Recording& trial, const std::string& joint, std::size_t row) {
  double most = -1;
  for (const std::size_t column : channelsOf(trial, joint, true)) {
    const std::string quantity = parseChannel(trial.channels[column])->quantity;
    if (!quantity.starts_with("command") && quantity != "duty") continue;
    const std::vector<double>& values = trial.columns[column];
    Extent whole, meanwhile;
    whole.add(values);
    meanwhile.add(std::span(values).subspan(row));
    most = std::max(most,
                    whole.some() && meanwhile.some() ? (meanwhile.high - meanwhile.low) / (whole.high - whole.low) : 0);
  }
  return most < 0 ? 1 : most;
}

bool hangs(const Recording& trial, const std::string& joint, const PositionReadings& position, const Hold& hold,
           double usual) {
  if (!position.endsWith(hold)) return hold.fromMotion && std::abs(position.step(hold.last)) > leap * usual;
  const double command = commandFrom(trial, joint, position.rows[hold.first]);
  if (hold.fromMotion) return command >= commandGoes;
  const bool isDriven = !channelsOf(trial, joint, true).empty();
  return isDriven && usual > 0 && command >= commandGoesFar && hold.length_s >= farLeast_s;
}

/// Empties the hold's rows but for the first, in every measured column of the joint that stands still with it.
void empty(Recording& trial, const std::string& joint, std::size_t first, std::size_t last) {
  for (const std::size_t column : channelsOf(trial, joint, false)) {
    std::vector<double>& values = trial.columns[column];
    Extent extent;
    extent.add(std::span(values).subspan(first, last - first + 1));
    if (extent.some()) continue;
    for (std::size_t row = first + 1; row <= last; ++row) values[row] = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

void emptyFrozen(Recording& trial) {
  const std::vector<double>& time = trial.columns[0];
  for (std::size_t column = 1; column < trial.channels.size(); ++column) {
    const std::string channel = trial.channels[column];
    const auto name = parseChannel(channel);
    if (!name || (name->quantity != "position_rad" && name->quantity != "position_m")) continue;
    if (name->part.empty() || name->ofRoot()) continue;
    const std::string joint = name->owner + "." + name->part;
    const PositionReadings position = readingsIn(trial.columns[column]);
    const std::vector<Hold> holds = holdsOf(position, time, stepOfNumbers(trial, column));
    const double usual = usualStep(position, holds);
    for (const Hold& hold : holds) {
      const std::size_t first = position.rows[hold.first], last = position.rows[hold.last];
      if (!hangs(trial, joint, position, hold, usual)) continue;
      trial.notes.push_back(channel + ": stays at exactly " + digits(position.values[hold.first], 6) + " from " +
                            digits(time[first], 6) + " s to " + digits(time[last], 6) + " s" +
                            (hold.fromMotion ? ", stopped in full motion" : ", while its command goes on") +
                            ": its sensor hung there, it seems; not compared");
      empty(trial, joint, first, last);
    }
  }
}

}  // namespace btr
