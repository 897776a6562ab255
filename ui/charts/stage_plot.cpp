#include "ui/charts/stage_plot.h"

#include <QCoreApplication>
#include <algorithm>

#include "ui/charts/fitness_plot.h"

namespace btr::ui {
namespace {

struct StagePlots {
  Q_DECLARE_TR_FUNCTIONS(StagePlot)
};

}  // namespace

PlotData stagePlot(const std::vector<ComparedArm>& arms, const QString& unit, const QString& note) {
  PlotData plot;
  plot.title = StagePlots::tr("Reality gap and real fitness by measurement stage");
  plot.note = note;
  plot.xTitle = StagePlots::tr("measurement stage");
  plot.yTitle = axisTitle(StagePlots::tr("fitness, or its gap"), unit);
  plot.xColumn = "stage";
  plot.yColumn = columnName("fitness_or_gap", unit);
  plot.wholeX = true;
  plot.yFromZero = true;
  plot.empty = StagePlots::tr("Tick runs with finished measurement stages to compare them");

  // Marks of different arms stand beside each other, those of an arm above each other.
  constexpr double apart = 0.06;
  const double first = -apart * (static_cast<double>(arms.size()) - 1) / 2;
  for (std::size_t a = 0; a < arms.size(); ++a) {
    const ComparedArm& arm = arms[a];
    const QString name = QString::fromStdString(arm.name);
    const int colour = static_cast<int>(a), seeds = static_cast<int>(arm.runs.size());
    const double shift = first + apart * static_cast<double>(a);
    const QString over = seeds > 1 ? StagePlots::tr(", mean and 95 % interval of %1 seeds").arg(seeds) : QString();
    using Style = PlotSeries::Style;
    PlotSeries gap{StagePlots::tr("%1: gap on unseen individuals%2").arg(name, over),
                   colour,
                   Style::lineWithPoints,
                   {},
                   {},
                   false,
                   shift};
    PlotSeries real{StagePlots::tr("%1: real fitness%2").arg(name, over), colour, Style::dotted, {}, {}, false, shift};
    PlotBand band{real.name, colour, {}, {}, {}};
    for (const ComparedStage& stage : arm.stages) {
      gap.points.emplace_back(stage.stage, stage.gap.mean);
      gap.errors.push_back(stage.gap.halfWidth95);
      real.points.emplace_back(stage.stage, stage.realMean.mean);
      if (stage.realMean.count < 2) continue;
      band.x.push_back(stage.stage + shift);
      band.lower.push_back(stage.realMean.mean - stage.realMean.halfWidth95);
      band.upper.push_back(stage.realMean.mean + stage.realMean.halfWidth95);
      plot.xFrom = std::min(plot.xFrom.value_or(stage.stage - 0.5), stage.stage - 0.5);
      plot.xTo = std::max(plot.xTo.value_or(stage.stage + 0.5), stage.stage + 0.5);
    }
    plot.series.push_back(std::move(gap));
    plot.series.push_back(std::move(real));
    if (!band.x.empty()) plot.bands.push_back(std::move(band));
  }
  return plot;
}

}  // namespace btr::ui
