#pragma once
#include "core/gap/search/gap_report.h"
#include "ui/charts/plot_data.h"

namespace btr::ui {

/// Plots of a gap report, as values. Each is empty, with a sentence, where the report has nothing to show.

/// Recorded, as given, calibrated (or not), with effects: one channel of one trial. `cursor_s` marks a time.
PlotData overlayPlot(const GapReport& report, std::size_t trial, std::size_t series,
                     std::optional<double> cursor_s = {}, bool withCalibrated = true);
/// (simulated − recorded)/noise floor of the same three.
PlotData errorPlot(const GapReport& report, std::size_t trial, std::size_t series, std::optional<double> cursor_s = {});
/// Held-out error after each step, with the noise floor as a line.
PlotData ladderPlot(const GapReport& report);
/// Shares of the excess error and of the time by regime of one located channel.
PlotData regimePlot(const GapReport& report, std::size_t located);
PlotData remainderPlot(const GapReport& report);
PlotData nextRecordingPlot(const GapReport& report);

/// Trials as words: "sine-1.csv", "sine-5.csv (held out)".
QString trialName(const GapReport::Trial& trial);

}  // namespace btr::ui
