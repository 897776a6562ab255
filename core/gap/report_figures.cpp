#include "core/gap/report_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace btr {

const std::vector<double>& curveOf(const GapReport::Series& series, Simulated which) {
  switch (which) {
    case Simulated::asGiven:
      return series.asGiven;
    case Simulated::calibrated:
      return series.calibrated;
    case Simulated::withEffects:
      break;
  }
  return series.withEffects;
}

HeatRow heatRow(const GapReport& report, std::size_t trial, std::size_t series, Simulated which, std::size_t bins) {
  const GapReport::Trial& t = report.trials[trial];
  const GapReport::Series& s = t.series[series];
  HeatRow row{trial, series, 0, 0, std::vector<double>(bins, std::numeric_limits<double>::quiet_NaN())};
  if (t.time_s.empty() || bins == 0) return row;
  row.from_s = t.time_s.front();
  row.to_s = t.time_s.back();
  const std::vector<double>& simulated = curveOf(s, which);
  std::vector<double> squares(bins, 0);
  std::vector<std::size_t> counts(bins, 0);
  const double length = row.to_s - row.from_s;
  for (std::size_t i = 0; i < std::min({t.time_s.size(), simulated.size(), s.recorded.size()}); ++i) {
    const double error = (simulated[i] - s.recorded[i]) / s.noiseFloor;
    if (!std::isfinite(error)) continue;
    const double place = length > 0 ? (t.time_s[i] - row.from_s) / length : 0;
    const auto bin = std::min(bins - 1, static_cast<std::size_t>(std::max(0.0, place) * static_cast<double>(bins)));
    squares[bin] += error * error;
    ++counts[bin];
  }
  for (std::size_t i = 0; i < bins; ++i)
    if (counts[i] > 0) row.error[i] = std::sqrt(squares[i] / static_cast<double>(counts[i]));
  return row;
}

HeatColour heatColour(double error) {
  if (!std::isfinite(error)) return {};
  const double level = std::clamp(std::log(std::max(error, 1.0)) / std::log(heatTop), 0.0, 1.0);
  constexpr std::array<std::array<double, 3>, 3> stops{{{240, 178, 50}, {222, 84, 38}, {140, 20, 60}}};
  const double place = 2 * level;
  const auto first = static_cast<std::size_t>(std::min(1.0, std::floor(place)));
  const double share = place - static_cast<double>(first);
  const auto mix = [&](std::size_t k) {
    return static_cast<int>(std::lround(stops[first][k] * (1 - share) + stops[first + 1][k] * share));
  };
  return {mix(0), mix(1), mix(2), error <= 1 ? 0.06 : 0.25 + 0.75 * std::sqrt(level)};
}

std::string inWords(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string inWords(const GapReport::Rival& rival) {
  return inWords(rival.effect) + " at " + rival.at +
         (rival.with.empty() ? "" : " together with " + inWords(rival.with));
}

std::string brief(double value) {
  if (!std::isfinite(value)) return "–";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

std::string digits(double value, int count) {
  std::array<char, 32> text{};
  // 870, not 8.7e+02.
  if (const double size = std::abs(value); size >= std::pow(10, count) - 0.5 && size < 1e9) {
    const double unit = std::pow(10, std::floor(std::log10(size)) - count + 1);
    std::snprintf(text.data(), text.size(), "%.0f", std::round(value / unit) * unit);
  } else {
    std::snprintf(text.data(), text.size(), "%.*g", count, value);
  }
  return text.data();
}

std::string percent(double share) {
  if (!std::isfinite(share)) return "–";
  std::array<char, 32> text{};
  const double value = 100 * share;
  std::snprintf(text.data(), text.size(), std::abs(value) < 9.95 && value != 0 ? "%.1f %%" : "%.0f %%", value);
  return text.data();
}

std::string wholePercent(double share) { return toText(std::round(100 * share)) + " %"; }

bool isWiderAmongRivals(const GapReport::Number& number) {
  const GapReport::Interval &all = number.amongRivals, &own = number.ci95;
  return all.known() && own.known() && all.high - all.low > 2 * (own.high - own.low);
}

std::string brief(const GapReport::Interval& interval) {
  const auto side = [](double value) { return std::isfinite(value) ? brief(value) : std::string("…"); };
  return "[" + side(interval.low) + ", " + side(interval.high) + "]";
}

std::string intervalsOf(const GapReport::Number& number) {
  return (number.ci95.known() ? brief(number.ci95) : "(no interval)") +
         (number.amongRivals.known() ? ", among rivals " + brief(number.amongRivals) : "");
}

std::string headline(GapReport::Verdict verdict) {
  switch (verdict) {
    case GapReport::Verdict::noMismatch:
      return "Nothing is missing";
    case GapReport::Verdict::parametersSuffice:
      return "Other parameter values suffice";
    case GapReport::Verdict::missingPhysics:
      return "Physics was left out";
    case GapReport::Verdict::unexplained:
      return "Something is missing that has no name here";
    case GapReport::Verdict::notExcited:
      break;
  }
  return "The recordings cannot tell";
}

std::optional<UnseenError> unseenError(const GapReport& report) {
  UnseenError sum;
  double channels = 0;
  for (const GapReport::Channel& channel : report.channels) {
    const double floor2 = channel.noiseFloor * channel.noiseFloor;
    if (floor2 <= 0 || channel.heldoutAsGiven <= 0) continue;
    sum.asGiven += channel.heldoutAsGiven * channel.heldoutAsGiven / floor2;
    sum.calibrated += channel.heldoutCalibrated * channel.heldoutCalibrated / floor2;
    sum.withEffects += channel.heldoutWithEffects * channel.heldoutWithEffects / floor2;
    ++channels;
  }
  if (channels == 0) return std::nullopt;
  return UnseenError{std::sqrt(sum.asGiven / channels), std::sqrt(sum.calibrated / channels),
                     std::sqrt(sum.withEffects / channels)};
}

std::string unseenWarning(const GapReport& report) {
  const auto unseen = unseenError(report);
  if (!unseen || !unseen->gotWorse()) return "";
  return "the recordings that were held out got worse: " + digits(unseen->asGiven) + " → " +
         digits(unseen->withEffects) + " noise floors";
}

std::string headline(const GapReport& report) {
  const std::string warning = unseenWarning(report);
  return headline(report.verdict) + (warning.empty() ? "" : ", but " + warning);
}

}  // namespace btr
