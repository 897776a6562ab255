#include "ui/charts/stage_plot.h"

#include <QCoreApplication>
#include <algorithm>

#include "ui/charts/fitness_plot.h"

namespace btr::ui {
namespace {

struct StagePlots {
  Q_DECLARE_TR_FUNCTIONS(StagePlot)
};

bool isFitnessNeverNegative(const std::vector<ComparedArm>& arms) {
  for (const ComparedArm& arm : arms)
    for (const std::vector<StageOutcome>& run : arm.runs)
      if (std::ranges::any_of(run, [](const StageOutcome& o) { return o.realMean < 0; })) return false;
  return true;
}

}  // namespace

PlotData stagePlot(const std::vector<ComparedArm>& arms, StageQuantity quantity, const QString& unit,
                   const QString& note) {
  const bool isGap = quantity == StageQuantity::gap;
  PlotData plot;
  plot.title =
      isGap ? StagePlots::tr("Reality gap by measurement stage") : StagePlots::tr("Real fitness by measurement stage");
  plot.note = note;
  plot.xTitle = StagePlots::tr("measurement stage");
  plot.yTitle = axisTitle(isGap ? StagePlots::tr("gap on unseen individuals") : StagePlots::tr("real fitness"), unit);
  plot.xColumn = "stage";
  plot.yColumn = columnName(isGap ? "gap" : "real_fitness", unit);
  plot.wholeX = true;
  plot.yFromZero = true;
  plot.neverNegative = isGap || isFitnessNeverNegative(arms);
  plot.empty = StagePlots::tr("Tick runs with finished measurement stages to compare them");

  // Marks of different arms stand beside each other.
  constexpr double apart = 0.06;
  const double first = -apart * (static_cast<double>(arms.size()) - 1) / 2;
  for (std::size_t a = 0; a < arms.size(); ++a) {
    const ComparedArm& arm = arms[a];
    const int seeds = static_cast<int>(arm.runs.size());
    PlotSeries series;
    series.name = QString::fromStdString(arm.name);
    if (seeds > 1) series.name += StagePlots::tr(", mean and 95 % interval of %1 seeds").arg(seeds);
    series.colour = static_cast<int>(a);
    series.style = PlotSeries::Style::lineWithPoints;
    series.shift = first + apart * static_cast<double>(a);
    for (const ComparedStage& stage : arm.stages) {
      const Spread& value = isGap ? stage.gap : stage.realMean;
      series.points.emplace_back(stage.stage, value.mean);
      series.errors.push_back(value.halfWidth95);
      plot.xFrom = std::min(plot.xFrom.value_or(stage.stage - 0.5), stage.stage - 0.5);
      plot.xTo = std::max(plot.xTo.value_or(stage.stage + 0.5), stage.stage + 0.5);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace btr::ui
