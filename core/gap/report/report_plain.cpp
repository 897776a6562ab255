// A gap report for a terminal.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "core/gap/report/report_plain.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"

namespace btr {
namespace {

template <class... Numbers>
std::string line(const char* format, Numbers... numbers) {
  char text[400];
  std::snprintf(text, sizeof text, format, numbers...);
  return text;
}

/// A number with so many significant digits in so many columns; "–" where there is none.
std::string column(double value, int width, int precision) {
  if (std::isfinite(value)) return line("%*.*g", width, precision, value);
  return std::string(static_cast<std::size_t>(width - 1), ' ') + "–";
}

std::string intervalText(const GapReport::Number& number) {
  // As many digits as tell its ends apart; a whole number, which has no width, has none.
  const auto text = [](const GapReport::Interval& i) {
    const double size = std::max(std::abs(i.low), std::abs(i.high)), width = i.high - i.low;
    const bool isThin = std::isfinite(size) && width > 0;
    const int figures = isThin ? std::clamp(static_cast<int>(std::ceil(std::log10(size / width))) + 2, 4, 12) : 4;
    return line(" [%.*g … %.*g]", figures, i.low, figures, i.high);
  };
  return (number.ci95.known() && number.ci95.high > number.ci95.low ? text(number.ci95) : "") +
         (number.amongRivals.known() ? ", among rivals" + text(number.amongRivals) : "");
}

}  // namespace

std::string toPlainText(const GapReport& report) {
  std::string text = std::string(toText(report.verdict)) + ": " + report.sentence + "\n\n";
  if (!report.ladder.empty()) text += "error in noise floors, cross-validated\n";
  for (const auto& step : report.ladder)
    text += line("  %8.3f ± %.3f  %s\n", step.error, step.standardError, step.what.c_str());
  text += "\nRMSE by channel        noise floor    as given  calibrated  with effects   (held-out recordings)\n";
  for (const auto& channel : report.channels) {
    text += line("  %-28s", channel.name.c_str());
    for (const double number : {channel.noiseFloor, channel.asGiven, channel.calibrated, channel.withEffects})
      text += column(number, 10, 3);
    text += "  ";
    for (const double number : {channel.heldoutAsGiven, channel.heldoutCalibrated, channel.heldoutWithEffects})
      text += column(number, 10, 3);
    text += " " + channel.unit + "\n";
  }
  for (const auto& channel : report.channels)
    if (channel.heldoutNoiseFloor > 0)
      text += "  " + channel.name + ": stamps jitter, so its noise grows with its speed; its floor is " +
              line("%.3g %s", channel.heldoutNoiseFloor, channel.unit.c_str()) + " in the held-out recordings\n";
  text += "\neffects tried\n";
  for (const auto& effect : report.tried) {
    text +=
        line("  %s %-28s at %-20s screened %2d. (%.1f %%)  %s\n", effect.accepted ? "+" : " ", effect.effect.c_str(),
             effect.at.c_str(), effect.screenRank, 100 * effect.screenShare, effect.reason.c_str());
    if (effect.accepted)
      for (const auto& number : effect.parameters)
        text += line("        %-28s %.4g %s%s\n", number.name.c_str(), number.value, number.unit.c_str(),
                     intervalText(number).c_str());
    for (const auto& rival : effect.rivals)
      text += line("        indistinguishable from %s at %s%s%s (error ratio %.3f)\n", rival.effect.c_str(),
                   rival.at.c_str(), rival.with.empty() ? "" : " together with ", rival.with.c_str(),
                   rival.heldoutErrorRatio);
  }
  text += "\ncalibrated\n";
  for (const auto& number : report.calibrated)
    text += line("  %-52s %.5g → %.5g%s%s\n", number.name.c_str(), number.before, number.value,
                 intervalText(number).c_str(),
                 !number.excited  ? " (not identifiable from these recordings)"
                 : number.atBound ? " (at its bound)"
                                  : "");
  for (const std::string& pair : report.strongCorrelations) text += "  hardly separated: " + pair + "\n";
  if (!report.notes.empty()) text += "\n";
  for (const std::string& note : report.notes) text += "note: " + note + "\n";
  text += line("\n%.1f s\n", report.seconds);
  return text;
}

}  // namespace btr
