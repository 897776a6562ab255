#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/gap/gap_report.h"

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

/// "backlash" → "backlash", "velocity_reversal" → "velocity reversal".
std::string inWords(std::string name);
/// "dry friction at rig.hinge", and what it is a rival together with.
std::string inWords(const GapReport::Rival& rival);
/// Three or four digits that matter; "–" if it is not finite.
std::string brief(double value);
/// So many digits that matter: "0.0512", "1230".
std::string digits(double value, int count = 3);
/// "0.7 %", "83 %".
std::string percent(double share);
/// "1 %", "83 %": for sentences.
std::string wholePercent(double share);
/// Whether rivals would put a number where its own interval does not hold it: more than twice as wide with them.
bool isWiderAmongRivals(const GapReport::Number& number);
/// "[0.047, 0.055]"; an open side is "…".
std::string brief(const GapReport::Interval& interval);
/// "[0.047, 0.055], among rivals [0.02, 0.055]", or "(no interval)".
std::string intervalsOf(const GapReport::Number& number);
/// What the verdict means, a few words.
std::string headline(GapReport::Verdict verdict);

/// Error of the recordings that no fit saw, root mean square over their channels in noise floors; nothing if none was
/// held out. It got worse where the simulator to adopt is off by 5 % more than the one as given.
struct UnseenError {
  double asGiven = 0, calibrated = 0, withEffects = 0;
  bool gotWorse() const { return withEffects > 1.05 * asGiven; }
};
std::optional<UnseenError> unseenError(const GapReport& report);
/// "the recordings that were held out got worse: 259 → 278 noise floors"; "" if they did not.
std::string unseenWarning(const GapReport& report);
/// What the verdict means, and what speaks against it: a success on paper whose held-out recordings got worse is none.
std::string headline(const GapReport& report);

}  // namespace btr
