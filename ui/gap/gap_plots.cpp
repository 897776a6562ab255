#include "ui/gap/gap_plots.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/replay/residual.h"
#include "core/gap/report/report_figures.h"
#include "core/gap/search/gap_report.h"
#include "core/spec/figures.h"
#include "ui/charts/broken_curve.h"
#include "ui/common/numbers/format.h"

namespace btr::ui {
namespace {

struct GapPlots {
  Q_DECLARE_TR_FUNCTIONS(GapPlots)
};

// Colours of the theme: what was recorded stands back, what was repaired stands out.
enum Colour { repaired = 0, asGiven = 1, noise = 2, calibrated = 4, recorded = 7 };

std::vector<QPointF> points(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<QPointF> all;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
    if (std::isfinite(x[i]) && std::isfinite(y[i])) all.emplace_back(x[i], y[i]);
  return all;
}

PlotSeries line(const QString& name, int colour, std::vector<QPointF> points,
                PlotSeries::Style style = PlotSeries::Style::line) {
  PlotSeries series;
  series.name = name;
  series.colour = colour;
  series.style = style;
  series.points = std::move(points);
  return series;
}

void addCursor(PlotData& plot, std::optional<double> cursor_s) {
  if (cursor_s) plot.markers.push_back({*cursor_s, QString::number(*cursor_s, 'f', 2) + " s"});
}

QString quantityOf(const std::string& channel) {
  const std::string quantity = channel.substr(channel.rfind('.') + 1);
  return word(unitOfChannel(channel).empty() ? quantity : quantity.substr(0, quantity.find('_')));
}

bool has(const GapReport& report, std::size_t trial, std::size_t series) {
  return trial < report.trials.size() && series < report.trials[trial].series.size();
}

}  // namespace

QString trialName(const GapReport::Trial& trial) {
  return trial.heldOut ? GapPlots::tr("%1 (held out)").arg(word(trial.name)) : word(trial.name);
}

PlotData overlayPlot(const GapReport& report, std::size_t trial, std::size_t series, std::optional<double> cursor_s,
                     bool withCalibrated) {
  PlotData plot;
  plot.xTitle = GapPlots::tr("time (s)");
  plot.xColumn = "time_s";
  plot.empty = GapPlots::tr("Choose a channel in the map above");
  if (!has(report, trial, series)) return plot;
  const GapReport::Trial& t = report.trials[trial];
  const GapReport::Series& s = t.series[series];
  plot.title = word(s.channel) + " · " + trialName(t);
  plot.yTitle = axisTitle(quantityOf(s.channel), word(s.unit));
  plot.yColumn = word(s.channel.substr(s.channel.rfind('.') + 1));
  const auto add = [&](const QString& name, Colour colour, const std::vector<double>& values) {
    addBroken(plot, line(name, colour, points(t.time_s, values), PlotSeries::Style::thinLine));
  };
  addBroken(plot, line(GapPlots::tr("recorded"), recorded, points(t.time_s, s.recorded)));
  add(GapPlots::tr("as given"), asGiven, s.asGiven);
  if (withCalibrated) add(GapPlots::tr("calibrated"), calibrated, s.calibrated);
  add(GapPlots::tr("with effects"), repaired, s.withEffects);
  addCursor(plot, cursor_s);
  return plot;
}

PlotData errorPlot(const GapReport& report, std::size_t trial, std::size_t series, std::optional<double> cursor_s) {
  PlotData plot;
  plot.xTitle = GapPlots::tr("time (s)");
  plot.xColumn = "time_s";
  plot.yTitle = GapPlots::tr("noise floors");
  plot.yColumn = "error_noise_floors";
  plot.empty = QString();
  if (!has(report, trial, series)) return plot;
  const GapReport::Trial& t = report.trials[trial];
  const GapReport::Series& s = t.series[series];
  const auto error = [&](const std::vector<double>& simulated) {
    std::vector<double> all(std::min(simulated.size(), s.recorded.size()));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = (simulated[i] - s.recorded[i]) / s.noiseFloor;
    return points(t.time_s, all);
  };
  plot.title = GapPlots::tr("Simulated − recorded");
  addBroken(plot, line(GapPlots::tr("as given"), asGiven, error(s.asGiven), PlotSeries::Style::thinLine));
  addBroken(plot, line(GapPlots::tr("calibrated"), calibrated, error(s.calibrated), PlotSeries::Style::thinLine));
  addBroken(plot, line(GapPlots::tr("with effects"), repaired, error(s.withEffects), PlotSeries::Style::thinLine));
  if (t.time_s.size() > 1)
    plot.bands = {{GapPlots::tr("noise floor"), noise, {t.time_s.front(), t.time_s.back()}, {-1, -1}, {1, 1}}};
  addCursor(plot, cursor_s);
  return plot;
}

PlotData ladderPlot(const GapReport& report) {
  PlotData plot;
  plot.title = GapPlots::tr("Held-out error, step by step");
  plot.xTitle = GapPlots::tr("step");
  plot.yTitle = GapPlots::tr("error (noise floors, RMS)");
  plot.xColumn = "step";
  plot.yColumn = "error_noise_floors";
  plot.empty = GapPlots::tr("No step was taken");
  plot.yFromZero = true;
  PlotSeries steps = line(GapPlots::tr("cross-validated error"), repaired, {}, PlotSeries::Style::lineWithPoints);
  for (std::size_t i = 0; i < report.ladder.size(); ++i) {
    const GapReport::Step& step = report.ladder[i];
    const double x = static_cast<double>(i);
    plot.xLabels[x] = word(step.what);
    if (!std::isfinite(step.error)) continue;
    steps.points.emplace_back(x, step.error);
    steps.errors.push_back(std::isfinite(step.standardError) ? step.standardError : 0);
  }
  if (report.ladder.empty()) return plot;
  plot.xFrom = -0.5;
  plot.xTo = static_cast<double>(report.ladder.size()) - 0.5;
  plot.series = {
      steps, line(GapPlots::tr("noise floor"), noise, {{*plot.xFrom, 1}, {*plot.xTo, 1}}, PlotSeries::Style::dotted)};
  return plot;
}

PlotData regimePlot(const GapReport& report, std::size_t located) {
  PlotData plot;
  plot.xTitle = GapPlots::tr("regime");
  plot.yTitle = GapPlots::tr("share (%)");
  plot.xColumn = "regime";
  plot.yColumn = "share_percent";
  plot.yFromZero = true;
  plot.empty = GapPlots::tr("No regime stands out");
  if (located >= report.located.size()) return plot;
  const GapReport::Located& l = report.located[located];
  plot.title = GapPlots::tr("Where the excess error of %1 lies").arg(word(l.channel));
  PlotSeries error = line(GapPlots::tr("of the excess error"), asGiven, {}, PlotSeries::Style::points);
  PlotSeries time = line(GapPlots::tr("of the time"), recorded, {}, PlotSeries::Style::hollowPoints);
  for (std::size_t i = 0; i < l.regimes.size(); ++i) {
    const double x = static_cast<double>(i);
    plot.xLabels[x] = word(inWords(l.regimes[i].name));
    error.points.emplace_back(x, 100 * l.regimes[i].shareOfExcess);
    time.points.emplace_back(x, 100 * l.regimes[i].shareOfTime);
    plot.segments.push_back({time.points.back(), error.points.back(), error.name});
  }
  if (l.regimes.empty()) return plot;
  plot.xFrom = -0.5;
  plot.xTo = static_cast<double>(l.regimes.size()) - 0.5;
  plot.series = {error, time};
  return plot;
}

PlotData remainderPlot(const GapReport& report) {
  const GapReport::Remainder& r = report.remainder;
  PlotData plot;
  plot.title = GapPlots::tr("What has no name");
  plot.empty = GapPlots::tr("Nothing significant remains");
  plot.xTitle = axisTitle(word(r.on.empty() ? "" : r.on + " at " + r.at), word(r.unitX));
  plot.yTitle = axisTitle(GapPlots::tr("force"), word(r.unitY));
  plot.xColumn = word(r.on);
  plot.yColumn = "force";
  if (r.on.empty() || r.x.size() < 2) return plot;
  PlotBand band{GapPlots::tr("95 %"), repaired, r.x, r.y, r.y};
  for (std::size_t i = 0; i < r.x.size(); ++i) {
    const double half = i < r.standardError.size() ? 1.96 * r.standardError[i] : 0;
    band.lower[i] -= half;
    band.upper[i] += half;
  }
  plot.series = {line(GapPlots::tr("learned force"), repaired, points(r.x, r.y))};
  // Where there were next to no samples the interval is a thousand times the curve: it is cut off, and said.
  const auto [low, high] = std::minmax_element(r.y.begin(), r.y.end());
  const double room = 2 * std::max({*high - *low, std::abs(*high), std::abs(*low)});
  double widest = 0;
  for (std::size_t i = 0; i < r.x.size(); ++i) {
    widest = std::max(widest, (band.upper[i] - band.lower[i]) / 2);
    band.lower[i] = std::max(band.lower[i], *low - room);
    band.upper[i] = std::min(band.upper[i], *high + room);
  }
  if (room > 0 && widest > room)
    plot.note = GapPlots::tr("95 % interval cut off: it reaches ± %1").arg(withUnit(widest, word(r.unitY)));
  plot.bands = {band};
  return plot;
}

PlotData nextRecordingPlot(const GapReport& report) {
  PlotData plot;
  plot.title = GapPlots::tr("Suggested next recording");
  plot.empty = GapPlots::tr("No further recording is asked for");
  plot.xTitle = GapPlots::tr("time (s)");
  plot.xColumn = "time_s";
  plot.yTitle = GapPlots::tr("command");
  plot.yColumn = "command";
  const GapReport::NextRecording& next = report.next;
  if (next.columns.size() < 2 || next.channels.size() != next.columns.size()) return plot;
  plot.yTitle = axisTitle(GapPlots::tr("command"), word(unitOfChannel(next.channels[1])));
  for (std::size_t i = 1; i < next.columns.size(); ++i)
    plot.series.push_back(line(word(next.channels[i]), int(i) - 1, points(next.columns[0], next.columns[i])));
  return plot;
}

}  // namespace btr::ui
