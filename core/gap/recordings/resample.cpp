#include "core/gap/recordings/resample.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/gap/recordings/channel_floor.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/doctor/even_grid.h"
#include "core/gap/recordings/lowpass.h"
#include "core/gap/recordings/recording.h"
#include "core/spec/error.h"

namespace btr {
namespace {

/// Values at increasing times, from samples of which some may be missing. Before the first and after the last: these.
class Samples {
 public:
  Samples(const std::vector<double>& time, const std::vector<double>& values) {
    for (std::size_t i = 0; i < time.size(); ++i)
      if (std::isfinite(values[i])) {
        time_.push_back(time[i]);
        values_.push_back(values[i]);
      }
  }
  bool empty() const { return values_.empty(); }

  /// Ask for times that do not decrease.
  double at(double t, bool hold) {
    while (next_ < time_.size() && time_[next_] <= t) ++next_;
    if (next_ == 0) return values_.front();
    if (hold || next_ == time_.size()) return values_[next_ - 1];
    const double share = (t - time_[next_ - 1]) / (time_[next_] - time_[next_ - 1]);
    return values_[next_ - 1] + share * (values_[next_] - values_[next_ - 1]);
  }

 private:
  std::vector<double> time_, values_;
  std::size_t next_ = 0;
};

std::vector<double> grid(double from, double to, double period) {
  // A last sample that misses its place by rounding alone is there.
  const auto steps = static_cast<std::size_t>(std::floor((to - from) / period + 0.01));
  std::vector<double> times(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i) times[i] = from + static_cast<double>(i) * period;
  return times;
}

/// The part of white noise that the filter below leaves, its cutoff in parts of the sampling rate: the root of
/// 2·∫|H|⁴df with |H|² = 1/(1 + (f/f_c)⁸), whose integral from 0 to ∞ is f_c·(7/8)·(π/8)/sin(π/8).
double passedOn(double cutoff) {
  const double bandwidth = 7.0 / 8 * (M_PI / 8) / std::sin(M_PI / 8) * cutoff;
  return std::sqrt(std::min(1.0, 2 * bandwidth));
}

}  // namespace

std::vector<double> sampleTimes(const Recording& recording) {
  constexpr double nearlyAll = 0.9;
  const std::vector<double>& time = recording.columns[0];
  const std::vector<double>* fullest = nullptr;
  std::ptrdiff_t most = 0;
  for (std::size_t column = 1; column < recording.channels.size(); ++column) {
    if (!parseChannel(recording.channels[column])) continue;
    const std::vector<double>& values = recording.columns[column];
    const auto there = std::ranges::count_if(values, [](double value) { return std::isfinite(value); });
    if (there <= most) continue;
    most = there;
    fullest = &values;
  }
  if (!fullest || static_cast<double>(most) > nearlyAll * static_cast<double>(time.size())) return time;
  std::vector<double> times;
  for (std::size_t row = 0; row < time.size(); ++row)
    if (std::isfinite((*fullest)[row])) times.push_back(time[row]);
  return times;
}

double rhythm(const Recording& recording) {
  const std::vector<double> time = sampleTimes(recording);
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  return median(std::move(steps));
}

std::vector<double> noiseDrawn(const Recording& recording, std::size_t column, Random& random) {
  const std::vector<double>& time = recording.columns[0];
  const bool filtered = column < recording.filteredNoise.size() && recording.filteredNoise[column] > 0;
  const double level = filtered ? recording.filteredNoise[column] : channelFloor(recording, column).level;
  std::vector<double> noise(time.size());
  if (!filtered) {
    for (double& value : noise) value = level * random.normal();
    return noise;
  }
  const double cutoff = recording.filterCutoff_hz, own = recording.filterPeriod_s;
  const std::vector<double> fine = grid(time.front(), time.back(), own);
  std::vector<double> white(fine.size());
  for (double& value : white) value = level / passedOn(cutoff * own) * random.normal();
  Samples left(fine, LowPass(4, cutoff, 1 / own).zeroPhase(white));
  for (std::size_t row = 0; row < time.size(); ++row) noise[row] = left.at(time[row], false);
  return noise;
}

Recording resampled(const Recording& recording, const Resampling& how) {
  if (recording.rows() < 2) throw InputError(recording.source, "one row", "at least two rows to resample");
  const std::vector<double>& time = recording.columns[0];
  const double own = rhythm(recording), period = how.period_s > 0 ? how.period_s : own;
  if (period > (time.back() - time.front()))
    throw InputError(recording.source + " resample period_s", toText(period),
                     "at most the recording's length, " + toText(time.back() - time.front()) + " s");
  const bool thins = period > 1.001 * own;
  const double cutoff = how.lowpass_hz > 0 ? how.lowpass_hz : thins ? 0.4 / period : 0;
  if (cutoff >= 0.5 / own)
    throw InputError(recording.source + " resample lowpass_hz", toText(cutoff),
                     "less than half the recording's sampling rate of " + toText(1 / own) + " Hz");

  Recording result = recording;
  const std::vector<double> fine = grid(time.front(), time.back(), own);
  const std::vector<double> coarse = grid(time.front(), time.back(), period);
  result.columns[0] = coarse;
  result.places.line.clear();
  if (cutoff > 0) {
    result.filterPeriod_s = own;
    result.filterCutoff_hz = cutoff;
  }
  for (std::size_t column = 1; column < recording.columns.size(); ++column) {
    std::vector<double>& values = result.columns[column];
    Samples samples(time, recording.columns[column]);
    if (samples.empty()) {
      values.assign(coarse.size(), recording.columns[column].front());
      continue;
    }
    const auto name = parseChannel(recording.channels[column]);
    const bool hold = !name || name->quantity == "enabled";
    values.clear();
    if (hold || cutoff == 0) {
      for (const double t : coarse) values.push_back(samples.at(t, hold));
      continue;
    }
    result.filteredNoise.resize(recording.channels.size(), 0);
    result.filteredNoise[column] = channelFloor(recording, column).level * passedOn(cutoff * own);
    std::vector<double> even;
    for (const double t : fine) even.push_back(samples.at(t, false));
    Samples filtered(fine, LowPass(4, cutoff, 1 / own).zeroPhase(even));
    for (const double t : coarse) values.push_back(filtered.at(t, false));
  }
  return result;
}

}  // namespace btr
