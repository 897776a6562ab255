#pragma once
#include <string>
#include <vector>

#include "core/gap/search/gap_report.h"

/// What the page for people and the window draw of a report.
namespace btr {

enum class Simulated { asGiven, calibrated, withEffects };
const std::vector<double>& curveOf(const GapReport::Series& series, Simulated which);

/// One row of the heat map: the standardised error, root mean square of (simulated − recorded)/noise floor, of a
/// channel in equal bins of the trial's time; NaN where nothing is known.
struct HeatRow {
  std::size_t trial = 0, series = 0;
  double from_s = 0, to_s = 0;
  std::vector<double> error;
};
HeatRow heatRow(const GapReport& report, std::size_t trial, std::size_t series, Simulated which, std::size_t bins);

/// Colour of a standardised error, the same in print, light and dark: see-through at the noise floor, then from amber
/// to deep red, by the logarithm up to `heatTop` noise floors.
struct HeatColour {
  int red = 0, green = 0, blue = 0;
  double opacity = 0;
};
inline constexpr double heatTop = 50;
HeatColour heatColour(double error);

}  // namespace btr
