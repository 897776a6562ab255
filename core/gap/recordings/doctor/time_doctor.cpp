#include "core/gap/recordings/doctor/time_doctor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/gap/recordings/channel_floor.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/doctor/even_grid.h"
#include "core/gap/recordings/doctor/retime.h"
#include "core/gap/recordings/resample.h"
#include "core/spec/figures.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

using Measured = Binding::Measured;

/// A log's usual time between samples: what is nearest to it, in powers of a thousand, was meant.
constexpr double usual_s = 0.005;

double away(double period_s) { return std::abs(std::log10(period_s / usual_s)); }

void lookForLongTimes(double period_s, bool certain, std::vector<Finding>& findings) {
  struct Unit {
    const char* name;
    double size_s;
  };
  constexpr std::array units{Unit{"milliseconds", 1e-3}, Unit{"microseconds", 1e-6}, Unit{"nanoseconds", 1e-9}};
  const auto nearer = [&](const Unit& a, const Unit& b) {
    return away(period_s * a.size_s) < away(period_s * b.size_s);
  };
  const Unit& likeliest = *std::ranges::min_element(units, nearer);
  std::string names = likeliest.name, scales = toText(likeliest.size_s);
  for (const Unit& other : units)
    if (other.size_s != likeliest.size_s && away(period_s * other.size_s) < away(period_s * likeliest.size_s) + 0.7) {
      names += std::string(" or ") + other.name;
      scales += " or " + toText(other.size_s);
    }
  if (period_s == 1) names += ", or the number of the sample";
  findings.push_back({"time_s",
                      "time_s: a sample every " + digits(period_s) + " s, too slow for a robot's log: " + names +
                          ", it seems; multiply the \"scale\" of time_s in the mapping by " + scales +
                          (period_s == 1 ? ", or the time between two samples" : ""),
                      certain});
}

/// How fast it usually is where it is fast: of its slopes over ten samples, the one that a tenth exceeds.
double highSpeed(const std::vector<double>& time, const std::vector<double>& values) {
  constexpr std::size_t over = 10;
  std::vector<double> speeds;
  for (std::size_t i = over; i < values.size(); i += over)
    if (const double speed = std::abs(values[i] - values[i - over]) / (time[i] - time[i - over]); std::isfinite(speed))
      speeds.push_back(speed);
  if (speeds.empty()) return 0;
  const auto place = speeds.begin() + static_cast<std::ptrdiff_t>(9 * speeds.size() / 10);
  std::nth_element(speeds.begin(), place, speeds.end());
  return *place;
}

void lookForShortTimes(const Recording& recording, const Binding& binding, double period_s, bool certain,
                       std::vector<Finding>& findings) {
  constexpr double fastestLog_s = 2e-5, fastLog_s = 2e-4, fastest = 300;  // rad/s, m/s
  double speed = 0;
  std::string fastChannel;
  for (const Measured& measured : binding.measured) {
    if (measured.what == Measured::What::rate || measured.what == Measured::What::torque ||
        measured.what == Measured::What::baseOrientation)
      continue;
    const double own = highSpeed(recording.columns[0], recording.columns[measured.column]);
    if (own <= speed) continue;
    speed = own;
    fastChannel = recording.channels[measured.column];
  }
  if (period_s >= (speed > fastest ? fastLog_s : fastestLog_s)) return;
  double factor = 1e3;
  for (const double other : {1e6, 1e9})
    if (away(period_s * other) < away(period_s * factor)) factor = other;
  const double length_s = recording.columns[0].back() - recording.columns[0].front();
  findings.push_back(
      {"time_s",
       "time_s: a sample every " + digits(period_s) + " s, " + digits(length_s) + " s in all" +
           (speed > fastest
                ? ", in which " + fastChannel + " moves at " + digits(speed) + " " + unitOfChannel(fastChannel) + "/s"
                : "") +
           ", too fast for a robot's log: times are " + toText(factor) +
           " times too short, it seems; multiply the \"scale\" of time_s in the mapping by " + toText(factor),
       certain});
}

/// Stamps that were not given when the samples were taken: values are smooth over the rows and not over the stamps.
void lookForJitter(const Recording& recording, const Binding& binding, std::vector<Finding>& findings) {
  const StampJitter jitter = stampJitter(recording);
  if (jitter.size_s < 0.01 * jitter.period_s) return;
  std::string channel;
  ChannelFloor worst;
  std::size_t moving = 0, follow = 0;
  for (const Measured& measured : binding.measured) {
    const ChannelFloor floor = channelFloor(recording, measured.column);
    if (!floor.shown || floor.byStamps == floor.byRows) continue;
    moving += floor.byStamps > 1.1 * floor.byRows || floor.byRows > 1.1 * floor.byStamps;
    if (!followsRowsNotStamps(floor)) continue;
    ++follow;
    if (channel.empty() || floor.byStamps / floor.byRows > worst.byStamps / worst.byRows) {
      worst = floor;
      channel = recording.channels[measured.column];
    }
  }
  if (follow == 0 || 2 * follow < moving) return;
  const std::string unit = " " + unitOfChannel(channel);
  findings.push_back({"time_s", "time_s: the stamps jitter by " + digits(jitter.size_s, 2) + " s (a sample every " +
                                    digits(jitter.period_s) + " s) and the values do not: " + channel +
                                    " is smooth to " + digits(worst.byRows, 2) + unit + " over the rows and to " +
                                    digits(worst.byStamps, 2) + unit +
                                    " over the stamps; \"retime\": \"even\" in the mapping takes the rows as even "
                                    "samples, else speed times jitter counts as noise"});
}

/// How many times the slope of its position a velocity is; nothing where they do not move alike.
std::optional<double> timesItsSlope(const std::vector<double>& time, const std::vector<double>& position,
                                    const std::vector<double>& velocity) {
  constexpr std::size_t over = 3, enough = 100;
  constexpr double alike = 0.9;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < time.size(); ++row)
    if (std::isfinite(position[row])) rows.push_back(row);
  double count = 0, xx = 0, yy = 0, xy = 0;
  for (std::size_t i = over; i + over < rows.size(); ++i) {
    const std::size_t before = rows[i - over], after = rows[i + over];
    const double slope = (position[after] - position[before]) / (time[after] - time[before]), v = velocity[rows[i]];
    if (!std::isfinite(slope) || !std::isfinite(v)) continue;
    ++count;
    xx += slope * slope;
    yy += v * v;
    xy += slope * v;
  }
  if (count < enough || xx <= 0 || yy <= 0 || std::abs(xy) < alike * std::sqrt(xx * yy)) return std::nullopt;
  return std::copysign(std::sqrt(yy / xx), xy);
}

void lookAtRates(const Recording& recording, const Binding& binding, std::vector<Finding>& findings) {
  struct Unit {
    const char* name;
    double times;  ///< the right number
  };
  constexpr std::array units{Unit{"degrees per second", 180 / M_PI}, Unit{"revolutions per minute", 30 / M_PI},
                             Unit{"thousandths", 1e3}};
  std::vector<Measured> all = binding.measured;
  all.insert(all.end(), binding.startOnly.begin(), binding.startOnly.end());
  for (const Measured& rate : all) {
    if (rate.what != Measured::What::rate) continue;
    const auto position = std::ranges::find_if(all, [&](const Measured& other) {
      return other.what == Measured::What::position && other.object == rate.object && other.part == rate.part;
    });
    if (position == all.end()) continue;
    const auto times =
        timesItsSlope(recording.columns[0], recording.columns[position->column], recording.columns[rate.column]);
    if (!times) continue;
    const std::string& channel = recording.channels[rate.column];
    const std::string evidence = channel + " is " + digits(*times) + " times the slope of " +
                                 recording.channels[position->column] + " over time";
    if (*times < 0 && std::abs(std::log(-*times)) < std::log(1.5))
      findings.push_back({channel, evidence + ": a sign is turned; give it a negative \"scale\" in the mapping"});
    const auto unit = std::ranges::find_if(
        units, [&](const Unit& each) { return std::abs(std::log(std::abs(*times) / each.times)) < std::log(1.2); });
    if (unit != units.end())
      findings.push_back({channel, evidence + ": in " + unit->name +
                                       ", it seems; multiply its \"scale\" in the mapping by " +
                                       digits(1 / unit->times, 6)});
  }
}

}  // namespace

void lookAtTime(const Recording& recording, const Binding& binding, std::vector<Finding>& findings) {
  constexpr double slowest_s = 0.9;
  constexpr std::size_t enoughRows = 50;  // fewer cost nothing to replay, however long they last
  const double period_s = rhythm(recording);
  const bool certain = recording.rows() >= enoughRows;
  const std::size_t before = findings.size();
  if (period_s > slowest_s)
    lookForLongTimes(period_s, certain, findings);
  else
    lookForShortTimes(recording, binding, period_s, certain, findings);
  if (findings.size() > before) return;
  lookForJitter(recording, binding, findings);
  lookAtRates(recording, binding, findings);
}

}  // namespace btr
