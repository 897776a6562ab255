#include "core/gap/recordings/doctor/lost_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/doctor/even_grid.h"
#include "core/gap/recordings/table/row_order.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

constexpr double forgets_s = 1.5;  // a servo, how it came where it is
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

struct Loss {
  std::size_t row = 0;   ///< the first one behind it
  std::size_t rows = 0;  ///< that are missing
};

/// Nothing where the rhythm is not steady, or where hardly anything is lost in whole periods.
std::vector<Loss> lossesOf(const std::vector<double>& time) {
  constexpr double atMost = 0.35;  // of a period, by which stamps jitter
  constexpr std::size_t several = 3, longest = 10, enough = 30;
  constexpr double nearlyAll = 0.9;
  if (time.size() < enough) return {};
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  const double period_s = median(steps);
  std::vector<Loss> losses;
  std::size_t steady = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double periods = steps[i] / period_s, whole = std::round(periods);
    steady += std::abs(periods - whole) <= atMost && whole >= 1 && whole <= static_cast<double>(longest);
    if (whole < 2 || whole > static_cast<double>(longest) || std::abs(periods - whole) > atMost) continue;
    // A stamp that is only late, or early, is beside another one.
    const auto isLong = [&](std::size_t k) { return k >= steps.size() || steps[k] > (1 - atMost) * period_s; };
    if (isLong(i + 1) && (i == 0 || isLong(i - 1))) losses.push_back({i + 1, static_cast<std::size_t>(whole) - 1});
  }
  if (losses.size() < several || static_cast<double>(steady) < nearlyAll * static_cast<double>(steps.size())) return {};
  return losses;
}

/// Numbers that go up and down: not whether a servo is on.
std::vector<std::size_t> inputsOf(const Recording& trial) {
  std::vector<std::size_t> inputs;
  for (std::size_t column = 1; column < trial.channels.size(); ++column)
    if (isInputChannel(trial.channels[column]) && !trial.channels[column].ends_with(".enabled"))
      inputs.push_back(column);
  return inputs;
}

/// Whether a row of the table is a row of this column: topics at rates of their own make steps of any length.
bool isInEveryRow(const std::vector<double>& values) {
  constexpr double nearlyAll = 0.9;
  const auto given = std::ranges::count_if(values, [](double value) { return std::isfinite(value); });
  return static_cast<double>(given) >= nearlyAll * static_cast<double>(values.size());
}

bool isCommandedPosition(const std::string& channel) {
  return channel.ends_with(".command_rad") || channel.ends_with(".command_m");
}

/// Whether a column goes over a loss as it does before and behind it.
bool goesOn(const std::vector<double>& values, const Loss& loss) {
  constexpr double as = 0.5;  // of the change that its neighbours promise
  const std::size_t before = loss.row - 1;
  const double change = values[loss.row] - values[before];
  if (!std::isfinite(change)) return false;
  const double ahead = before > 0 ? values[before] - values[before - 1] : 0;
  const double behind = loss.row + 1 < values.size() ? values[loss.row + 1] - values[loss.row] : 0;
  const double promised = static_cast<double>(loss.rows + 1) * (ahead + behind) / 2;
  return change == 0 || std::abs(change - promised) <= as * std::max(std::abs(change), std::abs(promised));
}

/// Empties what the joints of `robot` are seen to do for some time from `row` on.
void forget(Recording& trial, const std::string& robot, std::size_t row, double for_s) {
  for (std::size_t column = 1; column < trial.channels.size(); ++column) {
    const auto name = parseChannel(trial.channels[column]);
    if (!name || name->owner != robot || isInputChannel(trial.channels[column])) continue;
    for (std::size_t k = row; k < trial.rows() && trial.columns[0][k] < trial.columns[0][row] + for_s; ++k)
      trial.columns[column][k] = nothing;
  }
}

void putBack(Recording& trial, const Loss& loss, const std::vector<std::size_t>& inputs) {
  const double parts = static_cast<double>(loss.rows + 1);
  const auto at = static_cast<std::ptrdiff_t>(loss.row);
  for (std::size_t column = 0; column < trial.columns.size(); ++column) {
    std::vector<double>& values = trial.columns[column];
    const bool isLine = column == 0 || (std::ranges::find(inputs, column) != inputs.end() && goesOn(values, loss));
    const double from = values[loss.row - 1], change = values[loss.row] - from;
    std::vector<double> between;
    for (std::size_t k = 1; k <= loss.rows; ++k)
      between.push_back(isLine ? from + change * static_cast<double>(k) / parts : nothing);
    values.insert(values.begin() + at, between.begin(), between.end());
  }
  if (auto& lines = trial.places.line; loss.row < lines.size())
    lines.insert(lines.begin() + at, loss.rows, lines[loss.row]);
}

}  // namespace

void fillLostRows(Recording& trial, const std::vector<std::size_t>& driving) {
  constexpr double mostForgotten = 0.6;  // of the trial
  std::vector<std::size_t> inputs = inputsOf(trial);
  inputs.insert(inputs.end(), driving.begin(), driving.end());
  std::vector<Loss> losses = lossesOf(trial.columns[0]);
  if (inputs.empty() || losses.empty()) return;
  if (!std::ranges::all_of(inputs, [&](std::size_t column) { return isInEveryRow(trial.columns[column]); })) return;

  // From the end: rows keep their numbers that way.
  struct Step {
    std::string robot;
    double time_s;
  };
  std::vector<Step> steps;
  std::size_t lost = 0;
  std::ranges::reverse(losses);
  for (const Loss& loss : losses) {
    std::set<std::string> robots;
    for (const std::size_t column : inputs)
      if (isCommandedPosition(trial.channels[column]) && std::isfinite(trial.columns[column][loss.row]) &&
          std::isfinite(trial.columns[column][loss.row - 1]) && !goesOn(trial.columns[column], loss))
        robots.insert(parseChannel(trial.channels[column])->owner);
    for (const std::string& robot : robots) steps.push_back({robot, trial.columns[0][loss.row - 1]});
    putBack(trial, loss, inputs);
    lost += loss.rows;
  }
  std::string note = std::to_string(lost) +
                     " rows are lost: commands of those times are taken from a straight line between their neighbours";
  if (!steps.empty()) {
    const double length_s = trial.columns[0].back() - trial.columns[0].front();
    const double for_s = std::min(forgets_s, mostForgotten * length_s / static_cast<double>(steps.size()));
    for (const Step& step : steps) {
      const auto row = std::ranges::upper_bound(trial.columns[0], step.time_s) - trial.columns[0].begin();
      forget(trial, step.robot, static_cast<std::size_t>(row), for_s);
    }
    note += "; where one steps meanwhile (" + std::to_string(steps.size()) +
            " times) nobody knows when, and the next " + digits(for_s, 2) + " s are not compared";
  }
  trial.notes.push_back(note);
}

}  // namespace btr
