#include "ui/charts/gap_chart.h"

#include <QVBoxLayout>
#include <algorithm>

#include "ui/charts/fitness_plot.h"
#include "ui/charts/plot_widget.h"

namespace btr::ui {
namespace {

QString version(const std::vector<SimulatorRecord>& simulators, Id id) {
  const auto found = std::find_if(simulators.begin(), simulators.end(), [&](auto& s) { return s.id == id; });
  return found == simulators.end() ? QString("?") : QString::number(found->number);
}

}  // namespace

PlotData gapPlot(const std::vector<GapRecord>& gaps, const std::vector<SimulatorRecord>& simulators, bool standIn,
                 const QString& unit, GapNorm norm) {
  PlotData plot;
  plot.title = GapChart::tr("Reality gap by simulator version");
  QStringList notes;
  if (standIn) notes << realityNote(true);
  if (norm == GapNorm::rootMeanSquare) notes << GapChart::tr("L3 made the root mean square small");
  if (norm == GapNorm::maximum) notes << GapChart::tr("L3 made the largest gap small");
  plot.note = notes.join(QStringLiteral(" · "));
  plot.xTitle = GapChart::tr("simulator version before→after");
  plot.yTitle = axisTitle(GapChart::tr("mean |real − simulated| fitness"), unit);
  plot.xColumn = "stage";
  plot.yColumn = columnName("mean_abs_real_minus_simulated_fitness", unit);
  plot.yFromZero = true;
  plot.empty = GapChart::tr("No simulator update yet: the gap is known after the first measurements");

  using Style = PlotSeries::Style;
  PlotSeries before{GapChart::tr("before the update"), 1, Style::points, {}, {}, false, -0.16};
  PlotSeries after{GapChart::tr("after the update"), 0, Style::lineWithPoints, {}, {}, false, 0.16};
  PlotSeries unseen{
      GapChart::tr("new individuals, before the update (unseen)"), 3, Style::hollowPoints, {}, {}, false, -0.24};
  PlotSeries heldOutBefore{GapChart::tr("held out, before"), 4, Style::hollowPoints, {}, {}, false, -0.08};
  PlotSeries heldOutAfter{
      GapChart::tr("held out, after (never seen by L3)"), 2, Style::lineWithPoints, {}, {}, false, 0.24};
  const auto add = [](PlotSeries& series, int stage, double value) {
    series.points.emplace_back(stage, value);
    return series.drawnAt(series.points.size() - 1);
  };
  for (const GapRecord& gap : gaps) {
    const double x = gap.stage;
    plot.segments.push_back({add(before, gap.stage, gap.before), add(after, gap.stage, gap.after), after.name});
    before.errors.push_back(gap.standardError);
    add(unseen, gap.stage, gap.newBefore);
    if (gap.heldOutBefore && gap.heldOutAfter) {
      plot.segments.push_back({add(heldOutBefore, gap.stage, *gap.heldOutBefore),
                               add(heldOutAfter, gap.stage, *gap.heldOutAfter), heldOutAfter.name});
      heldOutBefore.errors.push_back(gap.heldOutStandardError);
      heldOutAfter.errors.push_back(gap.heldOutStandardError);
    }
    // Narrow: a chart beside others has room for no more.
    plot.xLabels[x] =
        QStringLiteral("%1→%2").arg(version(simulators, gap.simulatorBefore), version(simulators, gap.simulatorAfter));
    plot.xFrom = std::min(plot.xFrom.value_or(x - 0.5), x - 0.5);
    plot.xTo = std::max(plot.xTo.value_or(x + 0.5), x + 0.5);
  }
  plot.series = {before, after, unseen};
  if (!heldOutBefore.points.empty()) plot.series.push_back(heldOutBefore);
  if (!heldOutAfter.points.empty()) plot.series.push_back(heldOutAfter);
  return plot;
}

GapChart::GapChart(QWidget* parent) : QWidget(parent), plot_(new PlotWidget(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(plot_);
  redraw();
}

void GapChart::redraw() { plot_->setData(gapPlot(gaps_, simulators_, standIn_, unit_, norm_)); }

void GapChart::setNorm(GapNorm norm) {
  norm_ = norm;
  redraw();
}

void GapChart::setUnit(const QString& unit) {
  unit_ = unit;
  redraw();
}

void GapChart::setStandIn(bool standIn) {
  standIn_ = standIn;
  redraw();
}

void GapChart::setGaps(const std::vector<GapRecord>& gaps, const std::vector<SimulatorRecord>& simulators) {
  gaps_ = gaps;
  simulators_ = simulators;
  redraw();
}

}  // namespace btr::ui
