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

/// Of the stamps: over ten rows jitter counts a tenth; rows between which samples were dropped, as a step shows that is
/// far longer than usual, do not count. Coarse stamps need all rows.
double averagePeriod(const std::vector<double>& time) {
  constexpr double dropped = 1.7;    // of the usual step, from which one shows them
  constexpr std::size_t enough = 5;  // places of ten rows without
  if (std::ranges::adjacent_find(time, std::greater_equal<>()) != time.end())
    return (time.back() - time.front()) / static_cast<double>(time.size() - 1);
  const std::size_t over = std::min<std::size_t>(10, time.size() - 1);
  std::vector<double> steps(time.size());
  std::adjacent_difference(time.begin(), time.end(), steps.begin());
  const double longest = dropped * median({steps.begin() + 1, steps.end()});
  std::vector<double> periods, whole;
  for (std::size_t i = over; i < time.size(); ++i) {
    periods.push_back((time[i] - time[i - over]) / static_cast<double>(over));
    const auto row = steps.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::all_of(row + 1 - static_cast<std::ptrdiff_t>(over), row + 1, [&](double s) { return s < longest; }))
      whole.push_back(periods.back());
  }
  return median(whole.size() >= enough ? std::move(whole) : std::move(periods));
}

/// How many samples were dropped just before the first of `zeros` (where the clock's zero would be by each row), if it
/// stood at `before_s`: the cheapest way in which more and more are dropped from row to row, all later stamps staying
/// behind each time. So a late stamp, which is followed by one that is in time, drops none.
double droppedBefore(const std::vector<double>& zeros, double before_s, double period_s) {
  constexpr double ofDropping = 0.5;  // what it costs, in periods that a stamp strays
  std::vector<double> dropped{0};
  for (const double zero : zeros)
    if (const double whole = std::round((zero - before_s) / period_s); whole > 0) dropped.push_back(whole);
  std::ranges::sort(dropped);
  dropped.erase(std::unique(dropped.begin(), dropped.end()), dropped.end());
  // From the last row on: the cost of all that follows, by what was dropped until then.
  std::vector<double> cost(dropped.size(), 0);
  for (std::size_t row = zeros.size(); row-- > 0;) {
    double least = INFINITY;
    for (std::size_t k = dropped.size(); k-- > 0;) {
      const double after = std::min(cost[k], least + ofDropping);
      least = std::min(least, cost[k]);
      cost[k] = after + std::abs((zeros[row] - before_s) / period_s - dropped[k]);
    }
  }
  std::size_t cheapest = 0;
  for (std::size_t k = 1; k < dropped.size(); ++k)
    if (cost[k] + ofDropping < cost[cheapest] + (cheapest > 0 ? ofDropping : 0)) cheapest = k;
  return dropped[cheapest];
}

/// The number of each row's sample. Where samples were dropped, all later stamps stay behind.
std::vector<double> sampleNumbers(const std::vector<double>& time, double period) {
  std::vector<double> number(time.size(), 0), before, after;  // where the clock's zero would be
  for (std::size_t row = 1; row < time.size(); ++row) {
    number[row] = number[row - 1] + 1;
    before.clear();
    after.clear();
    for (std::size_t i = row > around ? row - around : 0; i < row; ++i) before.push_back(time[i] - period * number[i]);
    for (std::size_t i = row; i < std::min(time.size(), row + around); ++i)
      after.push_back(time[i] - period * (number[row] + static_cast<double>(i - row)));
    number[row] += droppedBefore(after, median(before), period);
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
