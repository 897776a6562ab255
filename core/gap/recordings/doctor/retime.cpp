#include "core/gap/recordings/doctor/retime.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "core/gap/recordings/doctor/even_grid.h"
#include "core/gap/recordings/noise_floor.h"
#include "core/gap/recordings/resample.h"
#include "core/spec/error.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

constexpr std::size_t around = 25;   // stamps that tell where a clock stands: their median is what no late one changes
constexpr double mostPeriods = 3;    // that a stamp may be off, in the usual row
constexpr double mostTelling = 0.4;  // jitter, in periods, that still shows dropped samples
constexpr double samePeriod = 0.1;   // by which a given period may differ from that of the stamps

/// Of the stamps: over ten rows jitter counts a tenth, and dropped samples do no harm; coarse stamps need all rows.
double averagePeriod(const std::vector<double>& time) {
  if (std::ranges::adjacent_find(time, std::greater_equal<>()) != time.end())
    return (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  const std::size_t over = std::min<std::size_t>(10, time.size() - 1);
  std::vector<double> periods;
  for (std::size_t i = over; i < time.size(); ++i)
    periods.push_back((time[i] - time[i - over]) / static_cast<double>(over));
  return median(std::move(periods));
}

/// Where a clock stands, from the stamps around a row, and how far it can be known from them.
struct Level {
  double median_s = 0, uncertainty_s = 0;
};

Level levelOf(const std::vector<double>& zeros) {
  Level level{median(zeros), 0};
  double squares = 0;
  for (const double zero : zeros) squares += (zero - level.median_s) * (zero - level.median_s);
  // A median is 1.25 times as uncertain as a mean.
  level.uncertainty_s = 1.25 * std::sqrt(squares) / static_cast<double>(zeros.size());
  return level;
}

/// Of `zeros`, the first that a clock `later_s` behind explains together with all that follow.
std::size_t firstLate(const std::vector<double>& zeros, double before_s, double later_s) {
  double cost = 0;
  for (const double zero : zeros) cost += std::abs(zero - before_s - later_s);
  std::size_t first = 0;
  double least = cost;
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    cost += std::abs(zeros[i] - before_s) - std::abs(zeros[i] - before_s - later_s);
    if (cost < least) {
      least = cost;
      first = i + 1;
    }
  }
  return first;
}

/// The number of each row's sample. A late stamp is followed by one that is in time; where samples were dropped, all
/// later stamps stay behind.
std::vector<double> sampleNumbers(const std::vector<double>& time, double period) {
  constexpr double clearly = 3;
  std::vector<double> number(time.size(), 0), before, after;  // where the clock's zero would be
  for (std::size_t row = 1; row < time.size(); ++row) {
    number[row] = number[row - 1] + 1;
    before.clear();
    after.clear();
    for (std::size_t i = row > around ? row - around : 0; i < row; ++i) before.push_back(time[i] - period * number[i]);
    for (std::size_t i = row; i < std::min(time.size(), row + around); ++i)
      after.push_back(time[i] - period * (number[row] + static_cast<double>(i - row)));
    const Level was = levelOf(before), is = levelOf(after);
    const double behind = is.median_s - was.median_s, missing = std::round(behind / period);
    if (missing < 1 || behind < clearly * std::hypot(was.uncertainty_s, is.uncertainty_s)) continue;
    if (firstLate(after, was.median_s, missing * period) == 0) number[row] += missing;
  }
  return number;
}

struct Clock {
  double start_s = 0, period_s = 0;
};

/// Least squares; with a given period only its start.
Clock evenClock(const std::vector<double>& time, const std::vector<double>& number, double period_s) {
  double meanTime = 0, meanNumber = 0, spread = 0, joint = 0;
  const auto count = static_cast<double>(time.size());
  for (std::size_t i = 0; i < time.size(); ++i) {
    meanTime += (time[i] - time[0]) / count;
    meanNumber += number[i] / count;
  }
  for (std::size_t i = 0; i < time.size(); ++i) {
    spread += (number[i] - meanNumber) * (number[i] - meanNumber);
    joint += (number[i] - meanNumber) * (time[i] - time[0] - meanTime);
  }
  Clock clock{0, period_s > 0 ? period_s : joint / spread};
  clock.start_s = time[0] + meanTime - clock.period_s * meanNumber;
  return clock;
}

}  // namespace

void retime(Recording& trial, double period_s) {
  constexpr std::size_t enough = 10;
  std::vector<double>& time = trial.columns[0];
  if (time.size() < enough)
    throw InputError(trial.source + ": retime", std::to_string(time.size()) + " rows",
                     "at least " + std::to_string(enough) + " to tell an even clock from");
  const double own = averagePeriod(time);
  if (own <= 0) throw InputError(trial.source + ": retime", "time that stands still", "stamps that advance");
  if (period_s > 0 && std::abs(period_s - own) > samePeriod * own)
    throw InputError(trial.source + ": retime period_s", toText(period_s),
                     "about " + digits(own) + ", which the stamps have on the average");
  // Stamps that stray too far do not tell of dropped samples; else numbers and period follow from each other.
  std::vector<double> number(time.size());
  std::iota(number.begin(), number.end(), 0.0);
  const bool tells = noiseFloor(time) < mostTelling * own;
  Clock clock{0, period_s > 0 ? period_s : own};
  for (int round = 0; round < 4 && tells; ++round) {
    number = sampleNumbers(time, clock.period_s);
    clock = evenClock(time, number, period_s);
  }
  if (!tells) clock = evenClock(time, number, period_s);
  std::vector<double> moved;
  double most = 0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const double even = clock.start_s + clock.period_s * number[i];
    moved.push_back(std::abs(even - time[i]));
    most = std::max(most, moved.back());
    time[i] = even;
  }
  const double typical = median(std::move(moved));
  if (typical > mostPeriods * clock.period_s)
    throw InputError(trial.source + ": retime", "stamps that stray by " + digits(typical) + " s from any even clock",
                     "at most " + digits(mostPeriods * clock.period_s) + " s; the rows are no even samples");
  trial.notes.push_back("time_s: stamps made even as the mapping says, a sample every " + digits(clock.period_s, 6) +
                        " s; moved by " + digits(typical, 2) + " s in the median and " + digits(most, 2) +
                        " s at most");
}

StampJitter stampJitter(const Recording& trial) {
  constexpr double whole = 0.2;  // of a period, by which a pause may differ from lost samples
  const double period_s = rhythm(trial);
  std::vector<double> time = trial.columns[0];
  // Stamps behind lost samples are as regular as those before them.
  double lost_s = 0;
  for (std::size_t row = 1; row < time.size(); ++row) {
    const double periods = (trial.columns[0][row] - trial.columns[0][row - 1]) / period_s;
    if (periods > 2 - whole && std::abs(periods - std::round(periods)) <= whole)
      lost_s += (std::round(periods) - 1) * period_s;
    time[row] -= lost_s;
  }
  return {period_s, noiseFloor(std::span<const double>(time))};
}

}  // namespace btr
