#include "core/gap/report/report_figures.h"
#include "core/gap/search/gap_report.h"

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

}  // namespace btr
