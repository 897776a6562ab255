#include "core/gap/recordings/doctor/leaps.h"

#include <algorithm>
#include <cmath>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/resample.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

using Measured = Binding::Measured;

/// A position's samples that are there, and which of its steps are leaps.
struct Track {
  std::vector<std::size_t> row;
  std::vector<std::size_t> leaps;  ///< i: from row[i] to row[i + 1]
  std::size_t spikes = 0;          ///< samples that stand out: leaps that soon undo each other
  std::size_t undone = 0;          ///< leaps that do
  double first = 0, largest = 0;   ///< sizes of leaps
};

/// Counts leaps away from which a few samples lead back, in leaps or (over an empty cell) not.
void countSpikes(Track& track, const std::vector<double>& steps) {
  constexpr std::size_t longest = 3;  // samples, on end
  constexpr double back = 0.25;       // of the largest step meanwhile
  for (std::size_t k = 0; k < track.leaps.size();) {
    const std::size_t first = track.leaps[k];
    double away = steps[first], largest = std::abs(away);
    std::size_t samples = 0;
    for (std::size_t n = 1; n <= longest && first + n < steps.size() && samples == 0; ++n) {
      away += steps[first + n];
      largest = std::max(largest, std::abs(steps[first + n]));
      const bool another = std::ranges::binary_search(track.leaps, first + n + 1);
      if (std::abs(away) < back * largest && !another) samples = n;
    }
    std::size_t end = k + 1;
    while (samples > 0 && end < track.leaps.size() && track.leaps[end] <= first + samples) ++end;
    if (samples > 0) {
      track.spikes += samples;
      track.undone += end - k;
    }
    k = end;
  }
}

Track trackOf(const Recording& recording, std::size_t column, double period_s) {
  constexpr double leastSpeed = 100, usualSteps = 20, longest = 3.5;  // rad/s or m/s; −; periods
  const std::vector<double>&time = recording.columns[0], &values = recording.columns[column];
  Track track;
  for (std::size_t row = 0; row < values.size(); ++row)
    if (std::isfinite(values[row])) track.row.push_back(row);
  std::vector<double> steps;
  for (std::size_t i = 1; i < track.row.size(); ++i) steps.push_back(values[track.row[i]] - values[track.row[i - 1]]);
  if (steps.size() < 20) return track;
  std::vector<double> sizes;
  for (const double step : steps) sizes.push_back(std::abs(step));
  const auto place = sizes.begin() + static_cast<std::ptrdiff_t>(9 * sizes.size() / 10);
  std::nth_element(sizes.begin(), place, sizes.end());
  const double usual = *place;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double passed_s = time[track.row[i + 1]] - time[track.row[i]];
    if (passed_s > longest * period_s || std::abs(steps[i]) < leastSpeed * passed_s ||
        std::abs(steps[i]) < usualSteps * usual)
      continue;
    track.leaps.push_back(i);
    if (track.leaps.size() == 1) track.first = std::abs(steps[i]);
    track.largest = std::max(track.largest, std::abs(steps[i]));
  }
  countSpikes(track, steps);
  return track;
}

}  // namespace

std::set<std::string> lookForLeaps(const Recording& recording, const Binding& binding, std::vector<Finding>& findings) {
  std::set<std::string> leaping;
  const double period_s = rhythm(recording);
  for (const Measured& measured : binding.measured) {
    if (measured.what != Measured::What::position) continue;
    const Track track = trackOf(recording, measured.column, period_s);
    if (track.leaps.empty()) continue;
    const std::string& channel = recording.channels[measured.column];
    const std::vector<double>& time = recording.columns[0];
    const std::size_t first = track.row[track.leaps[0] + 1];
    const std::string unit = " " + unitOfChannel(channel), size = digits(track.largest) + unit;
    if (track.undone == track.leaps.size()) {
      findings.push_back({channel, channel + ": " + std::to_string(track.spikes) +
                                       (track.spikes == 1 ? " single sample stands" : " single samples stand") +
                                       " out by up to " + size + ", the first at " + digits(time[first], 6) +
                                       " s: read wrongly, it seems; leave these cells empty"});
      continue;
    }
    const std::string more = track.leaps.size() > 1 ? ", and " + std::to_string(track.leaps.size() - 1) +
                                                          " times more (by up to " + size + ")"
                                                    : "";
    findings.push_back(
        {channel,
         channel + " leaps by " + digits(track.first) + unit + " within " +
             digits(time[first] - time[track.row[track.leaps[0]]], 2) + " s, at " + digits(time[first], 6) + " s" +
             more +
             ", which no joint does: a counter that begins again (\"wrap\" in the mapping says after how "
             "much), a sign in a bit of its own (\"sign_bit\"), or numbers that were read wrongly",
         true});
    leaping.insert(channel);
  }
  return leaping;
}

}  // namespace btr
