#include "ui/charts/fitness_plot.h"

#include <QCoreApplication>
#include <algorithm>
#include <map>

#include "core/run/reality/adoption.h"
#include "core/run/reality/spread.h"

namespace btr::ui {
namespace {

struct FitnessPlots {
  Q_DECLARE_TR_FUNCTIONS(FitnessPlot)
};

PlotData frame(const QString& unit) {
  PlotData plot;
  plot.title = FitnessPlots::tr("Fitness by generation");
  plot.xTitle = FitnessPlots::tr("generation");
  plot.yTitle = axisTitle(FitnessPlots::tr("fitness"), unit);
  plot.xColumn = "generation";
  plot.yColumn = columnName("fitness", unit);
  plot.wholeX = true;
  plot.xFrom = 0;
  plot.empty = FitnessPlots::tr("No generation yet");
  return plot;
}

std::vector<QPointF> curve(const std::vector<GenerationRecord>& generations, double GenerationRecord::*value) {
  std::vector<QPointF> points;
  for (const GenerationRecord& generation : generations) points.emplace_back(generation.number, generation.*value);
  return points;
}

/// Fitness of two simulator versions is not comparable, so the best so far starts anew with each.
std::vector<QPointF> bestSoFar(const std::vector<GenerationRecord>& generations) {
  std::vector<QPointF> points;
  Id simulator = 0;
  for (const GenerationRecord& generation : generations) {
    const bool goesOn = !points.empty() && generation.simulator == simulator;
    points.emplace_back(generation.number, goesOn ? std::max(points.back().y(), generation.best) : generation.best);
    simulator = generation.simulator;
  }
  return points;
}

PlotSeries measured(const FitnessRun& run) {
  std::map<Id, std::vector<double>> values;
  for (const MeasurementRecord& measurement : run.measurements)
    if (!measurement.isVoid) values[measurement.individual].push_back(measurement.value);

  PlotSeries series;
  series.name = run.standIn ? FitnessPlots::tr("measured in stand-in reality (mean ± standard error)")
                            : FitnessPlots::tr("measured in reality (mean ± standard error)");
  series.colour = 1;
  series.style = PlotSeries::Style::points;
  for (const IndividualRecord& individual : run.measuredIndividuals) {
    const auto found = values.find(individual.id);
    if (found == values.end()) continue;
    const Spread spread = spreadOf(found->second);
    series.points.emplace_back(individual.generation, spread.mean);
    series.errors.push_back(spread.standardError);
  }
  return series;
}

std::vector<PlotMarker> updates(const std::vector<SimulatorRecord>& simulators) {
  std::vector<PlotMarker> markers;
  for (const SimulatorRecord& simulator : simulators) {
    if (simulator.number < 1) continue;
    QString label = FitnessPlots::tr("simulator %1").arg(simulator.number);
    if (const std::string origin = originOf(simulator); origin != "L3" && !origin.empty())
      label += " (" + QString::fromStdString(origin) + ')';
    markers.push_back({static_cast<double>(simulator.madeAfterGeneration), label});
  }
  std::stable_sort(markers.begin(), markers.end(), [](auto& a, auto& b) { return a.x < b.x; });
  return markers;
}

bool isNeverNegative(const FitnessRun& run) {
  const auto isNegative = [](const auto& record) { return record < 0; };
  return std::ranges::none_of(run.generations, isNegative, &GenerationRecord::worst) &&
         std::ranges::none_of(run.generations, isNegative, &GenerationRecord::mean);
}

/// A line through one point would not be seen.
void markSinglePoints(PlotData& plot) {
  for (PlotSeries& series : plot.series)
    if (series.points.size() == 1 && series.style != PlotSeries::Style::hollowPoints)
      series.style = PlotSeries::Style::points;
}

/// "Learning to kick, runs 1, 2, 5"
QString groupName(const std::vector<const FitnessRun*>& runs) {
  QStringList ids;
  for (const FitnessRun* run : runs) ids << QString::number(run->run);
  if (ids.size() > 8) ids = ids.mid(0, 3) + QStringList{"…"} + ids.mid(ids.size() - 2);
  return FitnessPlots::tr("%1, runs %2").arg(runs.front()->experiment, ids.join(", "));
}

/// Mean and interval over runs of the same group, generation by generation.
void addJoined(PlotData& plot, const QString& name, const std::vector<const FitnessRun*>& runs, int colour) {
  std::map<int, std::vector<double>> values;
  for (const FitnessRun* run : runs)
    for (const GenerationRecord& generation : run->generations) values[generation.number].push_back(generation.best);
  PlotSeries mean;
  mean.name = FitnessPlots::tr("%1: maximum, mean of %2 seeds and 95 % interval").arg(name).arg(runs.size());
  mean.colour = colour;
  PlotBand band;
  band.name = mean.name;
  band.colour = colour;
  for (const auto& [number, sample] : values) {
    const Spread spread = spreadOf(sample);
    mean.points.emplace_back(number, spread.mean);
    if (spread.count < 2) continue;
    band.x.push_back(number);
    band.lower.push_back(spread.mean - spread.halfWidth95);
    band.upper.push_back(spread.mean + spread.halfWidth95);
  }
  plot.series.push_back(std::move(mean));
  plot.bands.push_back(std::move(band));
}

}  // namespace

QString realityNote(bool standIn) { return standIn ? FitnessPlots::tr("stand-in reality") : QString(); }

QString realityNote(const std::vector<FitnessRun>& runs) {
  const auto standIns = std::count_if(runs.begin(), runs.end(), [](auto& run) { return run.standIn; });
  return standIns == 0 || standIns == std::ssize(runs) ? realityNote(standIns > 0)
                                                       : FitnessPlots::tr("some runs in stand-in reality");
}

PlotData fitnessPlot(const FitnessRun& run, const QString& unit) {
  PlotData plot = frame(unit);
  if (!run.name.isEmpty()) plot.title = FitnessPlots::tr("%1: fitness by generation").arg(run.name);
  plot.note = realityNote(run.standIn);
  using Style = PlotSeries::Style;
  plot.series.push_back(
      {FitnessPlots::tr("maximum"), 0, Style::line, curve(run.generations, &GenerationRecord::best), {}, false});
  plot.series.push_back(
      {FitnessPlots::tr("average"), 2, Style::line, curve(run.generations, &GenerationRecord::mean), {}, false});
  plot.series.push_back(
      {FitnessPlots::tr("worst"), 7, Style::thinLine, curve(run.generations, &GenerationRecord::worst), {}, true});
  plot.series.push_back(
      {FitnessPlots::tr("best so far in this simulator"), 5, Style::dotted, bestSoFar(run.generations), {}, false});
  for (PlotSeries& simulated : plot.series)
    std::erase_if(simulated.points, [&](const QPointF& point) { return run.hidden.contains(point.y()); });
  if (PlotSeries points = measured(run); !points.points.empty()) plot.series.push_back(std::move(points));
  plot.markers = updates(run.simulators);
  plot.neverNegative = isNeverNegative(run);
  markSinglePoints(plot);
  return plot;
}

PlotData comparisonPlot(const std::vector<FitnessRun>& runs, const QString& unit, bool joinSeeds) {
  PlotData plot = frame(unit);
  plot.empty = FitnessPlots::tr("Tick runs to compare them");
  plot.note = realityNote(runs);
  plot.neverNegative = std::ranges::all_of(runs, isNeverNegative);

  // Groups keep the order in which their first run comes.
  std::vector<std::vector<const FitnessRun*>> groups;
  for (const FitnessRun& run : runs) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](auto& group) {
      return joinSeeds && !run.group.isEmpty() && group.front()->group == run.group;
    });
    if (same == groups.end())
      groups.push_back({&run});
    else
      same->push_back(&run);
  }
  using Style = PlotSeries::Style;
  int colour = 0;
  for (const auto& group : groups) {
    const FitnessRun& first = *group.front();
    const QString plain = group.size() > 1 ? groupName(group) : first.name;
    const QString name = first.standIn ? FitnessPlots::tr("%1 (stand-in)").arg(plain) : plain;
    if (group.size() > 1) {
      addJoined(plot, name, group, colour++);
      continue;
    }
    plot.series.push_back({FitnessPlots::tr("%1: maximum").arg(name),
                           colour,
                           Style::line,
                           curve(first.generations, &GenerationRecord::best),
                           {},
                           false});
    plot.series.push_back({FitnessPlots::tr("%1: average").arg(name),
                           colour,
                           Style::thinLine,
                           curve(first.generations, &GenerationRecord::mean),
                           {},
                           false});
    if (groups.size() == 1) plot.markers = updates(first.simulators);
    ++colour;
  }
  markSinglePoints(plot);
  return plot;
}

}  // namespace btr::ui
