#include "core/gap/recordings/doctor/recording_health.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "core/gap/recordings/channel_floor.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/doctor/even_grid.h"
#include "core/gap/recordings/extent.h"
#include "core/gap/recordings/noise_floor.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/recordings/resample.h"
#include "core/gap/recordings/table/row_order.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

std::string inMillionths(double value) { return toText(std::round(value * 1e6) / 1e6); }

/// Longest stretch of rows with the same value, of a channel that changes at all.
double longestHold(const std::vector<double>& time, const std::vector<double>& values) {
  double longest = 0;
  bool changes = false;
  std::size_t begin = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] == values[begin]) {
      longest = std::max(longest, time[i] - time[begin]);
      continue;
    }
    if (std::isfinite(values[i]) && std::isfinite(values[begin])) changes = true;
    begin = i;
  }
  return changes ? longest : 0;
}

std::string ordinal(std::size_t number) {
  const char* ending = number % 100 / 10 == 1 ? "th"
                       : number % 10 == 1     ? "st"
                       : number % 10 == 2     ? "nd"
                       : number % 10 == 3     ? "rd"
                                              : "th";
  return std::to_string(number) + ending;
}

std::vector<double> changes(const std::vector<double>& values, std::size_t over) {
  std::vector<double> result;
  for (std::size_t i = over; i < values.size(); ++i) result.push_back(values[i] - values[i - over]);
  return result;
}

/// Correlation of a and of b read `shift` samples later.
double correlation(const std::vector<double>& a, const std::vector<double>& b, std::ptrdiff_t shift) {
  double ab = 0, aa = 0, bb = 0;
  const auto count = static_cast<std::ptrdiff_t>(a.size());
  for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, -shift); i < count && i + shift < count; ++i) {
    const double x = a[static_cast<std::size_t>(i)], y = b[static_cast<std::size_t>(i + shift)];
    ab += x * y;
    aa += x * x;
    bb += y * y;
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

/// The rhythm around step i: the slower of those of the ten steps before and after it.
double rhythm(const std::vector<double>& steps, std::size_t i) {
  constexpr std::size_t reach = 10;
  const auto at = [&](std::size_t index) { return steps.begin() + static_cast<std::ptrdiff_t>(index); };
  return std::max(median({at(i > reach ? i - reach : 0), at(i)}),
                  median({at(i + 1), at(std::min(steps.size(), i + 1 + reach))}));
}

/// The stamps from `row` on, and not that of `row` alone, are at least half a period behind those before.
bool staysBehind(const std::vector<double>& time, std::size_t row, double period) {
  constexpr std::size_t reach = 12;
  std::vector<double> before, after;
  for (std::size_t i = row > reach ? row - reach : 0; i < row; ++i)
    before.push_back(time[i] + period * static_cast<double>(row - i));
  for (std::size_t i = row; i < std::min(time.size(), row + reach); ++i)
    after.push_back(time[i] - period * static_cast<double>(i - row));
  return median(std::move(after)) - median(std::move(before)) > period / 2;
}

/// One more name behind a key, in the order in which they come.
void addTo(std::vector<std::pair<std::string, std::string>>& lists, const std::string& key, const std::string& name) {
  const auto known = std::ranges::find(lists, key, &std::pair<std::string, std::string>::first);
  if (known == lists.end())
    lists.emplace_back(key, name);
  else
    known->second += ", " + name;
}

}  // namespace

std::size_t everyNthRow(const std::vector<double>& values) {
  constexpr std::size_t enough = 10;
  std::vector<double> apart;
  std::size_t last = SIZE_MAX;
  for (std::size_t row = 0; row < values.size(); ++row)
    if (std::isfinite(values[row])) {
      if (last != SIZE_MAX) apart.push_back(static_cast<double>(row - last));
      last = row;
    }
  if (apart.size() < enough) return 1;
  const double usual = median(apart);
  return 10 * std::ranges::count(apart, usual) >= 9 * std::ssize(apart) ? static_cast<std::size_t>(usual) : 1;
}

RecordingHealth examine(const Recording& recording) {
  RecordingHealth health;
  const std::vector<double>& rows = recording.columns.at(0);
  const std::vector<double> time = sampleTimes(recording);
  std::vector<double> steps, deviations;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  health.period_s = median(steps);
  for (const double step : steps) deviations.push_back(std::abs(step - health.period_s));
  health.jitter_s = median(deviations);

  // Pauses. A stamp that is only late is followed by stamps that are in time.
  constexpr double muchJitter = 0.08;  // periods
  const bool jitters = noiseFloor(time) > muchJitter * health.period_s;
  double missing = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps.size() < 4 || steps[i] <= 1.5 * rhythm(steps, i)) continue;
    if (jitters && !staysBehind(time, i + 1, health.period_s)) continue;
    const double lost = std::max(1.0, std::round(steps[i] / rhythm(steps, i)) - 1);
    const auto row = std::ranges::lower_bound(rows, time[i + 1]) - rows.begin();
    health.gaps.push_back({static_cast<std::size_t>(row), time[i], time[i + 1], lost});
    missing += lost;
  }
  if (!health.gaps.empty()) {
    const auto longest = std::max_element(health.gaps.begin(), health.gaps.end(), [](const Gap& a, const Gap& b) {
      return a.to_s - a.from_s < b.to_s - b.from_s;
    });
    health.findings.push_back(std::to_string(health.gaps.size()) + " pauses, about " + toText(missing) +
                              " samples missing; the longest lasts " + inMillionths(longest->to_s - longest->from_s) +
                              " s from " + inMillionths(longest->from_s) + " s (a sample every " +
                              inMillionths(health.period_s) + " s elsewhere)");
  }

  // Channels.
  std::vector<std::pair<std::string, std::string>> counts;  // how large, and which channels have them
  for (std::size_t column = 1; column < recording.channels.size(); ++column) {
    const std::string& name = recording.channels[column];
    if (!parseChannel(name)) continue;
    const std::vector<double>& values = recording.columns[column];
    ChannelHealth channel{name, channelFloor(recording, column).level, quantisationStep(values), 0,
                          longestHold(rows, values)};
    channel.empty = static_cast<std::size_t>(
        std::count_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); }));
    const bool thinned = std::ranges::find(recording.thinned, name) != recording.thinned.end();
    if (const std::size_t every = everyNthRow(values); every > 1 && !thinned)
      health.findings.push_back(name + ": a value in every " + ordinal(every) + " row" +
                                (isInputChannel(name) ? "; held between" : "; compared there"));
    else if (channel.empty > 0 && !thinned && recording.places.line.empty())  // else whoever read or emptied it said so
      health.findings.push_back(name + ": " + std::to_string(channel.empty) + " of " + std::to_string(values.size()) +
                                " cells are empty");
    // A command that steps between two values has no counts.
    constexpr double leastSteps = 8;
    Extent extent;
    extent.add(values);
    if (channel.quantisation > 0 &&
        !(isInputChannel(name) && extent.high - extent.low < leastSteps * channel.quantisation)) {
      const std::string unit = unitOfChannel(name);
      addTo(counts, digits(channel.quantisation, 4) + (unit.empty() ? "" : " " + unit), name);
    }
    health.channels.push_back(std::move(channel));
  }
  for (const auto& [count, names] : counts) health.findings.push_back(names + ": counts of " + count);
  return health;
}

std::optional<ClockOffset> clockOffset(std::span<const double> time, std::span<const double> command,
                                       std::span<const double> measured, double limit_s) {
  constexpr double changeOver_s = 0.05;
  if (time.size() < 20) return std::nullopt;
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  const double period = median(steps);
  const double samples = (time.back() - time.front()) / period + 1;
  if (samples > 10e6) return std::nullopt;
  const auto count = static_cast<std::size_t>(samples);
  const auto over = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(changeOver_s / period)));
  if (count < 20 + over) return std::nullopt;
  const auto a = changes(onGrid(time, command, time.front(), period, count), over);
  const auto b = changes(onGrid(time, measured, time.front(), period, count), over);

  const auto most = std::min<std::ptrdiff_t>(std::lround(limit_s / period), static_cast<std::ptrdiff_t>(a.size()) / 4);
  std::vector<double> values;
  for (std::ptrdiff_t shift = -most; shift <= most; ++shift) values.push_back(correlation(a, b, shift));
  const auto top = std::max_element(values.begin(), values.end());
  if (*top < 0.5) return std::nullopt;
  ClockOffset found{static_cast<double>(top - values.begin() - most) * period, 0, *top};

  // The top of the parabola through the highest value and its neighbours.
  if (top != values.begin() && top + 1 != values.end()) {
    const double curve = top[-1] - 2 * top[0] + top[1];
    if (curve < 0) found.offset_s += std::clamp((top[-1] - top[1]) / (2 * curve), -0.5, 0.5) * period;
  }
  std::ptrdiff_t reach = 0;
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(values.size()); ++i)
    if (values[static_cast<std::size_t>(i)] >= 0.98 * *top)
      reach = std::max(reach, std::abs(i - (top - values.begin())));
  found.uncertainty_s = static_cast<double>(reach + 1) * period;
  return found;
}

}  // namespace btr
