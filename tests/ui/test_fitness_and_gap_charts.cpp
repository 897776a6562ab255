// Fitness, reality gap and comparison charts, built from records.
#include <QTest>
#include <algorithm>
#include <cmath>

#include "tests/ui/ui_tests.h"
#include "ui/charts/fitness_chart.h"
#include "ui/charts/gap_chart.h"
#include "ui/charts/plot_widget.h"

using namespace btr;
using namespace btr::ui;

namespace {

GenerationRecord generation(int number, Id simulator, double best, double mean, double worst) {
  GenerationRecord record;
  record.run = 7;
  record.number = number;
  record.simulator = simulator;
  record.best = best;
  record.mean = mean;
  record.worst = worst;
  return record;
}

SimulatorRecord simulator(Id id, int number, int after, const char* madeBy = "L3") {
  SimulatorRecord record;
  record.id = id;
  record.run = 7;
  record.number = number;
  record.madeAfterGeneration = after;
  record.madeBy = madeBy;
  return record;
}

MeasurementRecord measurement(Id individual, double value, bool isVoid = false) {
  MeasurementRecord record;
  record.run = 7;
  record.individual = individual;
  record.value = value;
  record.isVoid = isVoid;
  return record;
}

FitnessRun example() {
  FitnessRun run;
  run.run = 7;
  run.name = "Kick";
  run.generations = {generation(1, 10, 0.1, 0.05, 0), generation(2, 10, 0.3, 0.1, 0.01),
                     generation(3, 10, 0.2, 0.15, 0.02), generation(4, 11, 0.12, 0.08, 0.03)};
  run.simulators = {simulator(10, 0, 0, "start"), simulator(11, 1, 3), simulator(12, 2, 4, "gap analysis")};
  IndividualRecord a, b, c;
  a.id = 31, a.generation = 2;
  b.id = 32, b.generation = 3;
  c.id = 33, c.generation = 3;
  run.measuredIndividuals = {a, b, c};
  run.measurements = {measurement(31, 0.2), measurement(32, 0.1), measurement(31, 0.4), measurement(33, 9, true),
                      measurement(31, 50, true)};
  return run;
}

const PlotSeries& series(const PlotData& plot, const QString& beginning) {
  const auto found =
      std::find_if(plot.series.begin(), plot.series.end(), [&](auto& s) { return s.name.startsWith(beginning); });
  if (found == plot.series.end()) qFatal("no series %s", qPrintable(beginning));
  return *found;
}

using Points = std::vector<QPointF>;

}  // namespace

class TestFitnessAndGapCharts : public QObject {
  Q_OBJECT

 private slots:
  // The maximum of a generation is the fitness of an individual, which may be one that is measured blind.
  void whatIsMeasuredBlindIsNotReadOffTheCurves() {
    FitnessRun run = example();
    run.hidden = {0.3};
    const PlotData plot = fitnessPlot(run, "m");
    QCOMPARE(series(plot, "maximum").points, (Points{{1, 0.1}, {3, 0.2}, {4, 0.12}}));
    for (const PlotSeries& curve : plot.series)
      for (const QPointF& point : curve.points) QVERIFY2(point.y() != 0.3, qPrintable(curve.name));
  }

  void curvesAreTheRecordsNumbers() {
    const PlotData plot = fitnessPlot(example(), "m");
    QCOMPARE(series(plot, "maximum").points, (Points{{1, 0.1}, {2, 0.3}, {3, 0.2}, {4, 0.12}}));
    QCOMPARE(series(plot, "average").points, (Points{{1, 0.05}, {2, 0.1}, {3, 0.15}, {4, 0.08}}));
    QCOMPARE(series(plot, "worst").points, (Points{{1, 0}, {2, 0.01}, {3, 0.02}, {4, 0.03}}));
    QVERIFY(series(plot, "worst").hiddenAtFirst);
    QCOMPARE(plot.yTitle, QString("fitness (m)"));
    QCOMPARE(plot.yColumn, QString("fitness_m"));
  }

  // A line through one point is drawn by nobody.
  void oneGenerationIsDrawnAsAPoint() {
    FitnessRun run = example();
    run.generations.resize(1);
    QCOMPARE(series(fitnessPlot(run, "m"), "maximum").style, PlotSeries::Style::points);
    QCOMPARE(series(fitnessPlot(example(), "m"), "maximum").style, PlotSeries::Style::line);
    for (const PlotSeries& shown : comparisonPlot({run}, "m", true).series)
      QCOMPARE(shown.style, PlotSeries::Style::points);
  }

  void theBestSoFarStartsAnewWithEachSimulator() {
    QCOMPARE(series(fitnessPlot(example(), "m"), "best so far").points,
             (Points{{1, 0.1}, {2, 0.3}, {3, 0.3}, {4, 0.12}}));
  }

  void markersStandAtTheGenerationOfTheUpdate() {
    const PlotData plot = fitnessPlot(example(), "m");
    QCOMPARE(plot.markers.size(), std::size_t(2));
    QCOMPARE(plot.markers[0].x, 3.0);
    QCOMPARE(plot.markers[0].label, QString("simulator 1"));
    QCOMPARE(plot.markers[1].x, 4.0);
    QCOMPARE(plot.markers[1].label, QString("simulator 2 (gap analysis)"));
  }

  void realFitnessIsMeanAndStandardErrorWithoutVoidValues() {
    const PlotData plot = fitnessPlot(example(), "m");
    const PlotSeries& measured = series(plot, "measured in reality");
    QCOMPARE(measured.points.size(), std::size_t(2));
    QCOMPARE(measured.points[0].x(), 2.0);
    QVERIFY(std::abs(measured.points[0].y() - 0.3) < 1e-15);
    QVERIFY(std::abs(measured.errors[0] - 0.1) < 1e-15);  // s = 0.2/√2, divided by √2
    QCOMPARE(measured.points[1], QPointF(3, 0.1));
    QCOMPARE(measured.errors[1], 0.0);
  }

  void aStandInIsLabelledInTitleAndLegend() {
    FitnessRun run = example();
    QCOMPARE(fitnessPlot(run, "m").note, QString());
    run.standIn = true;
    const PlotData plot = fitnessPlot(run, "m");
    QCOMPARE(plot.note, QString("stand-in reality"));
    QVERIFY(series(plot, "measured in stand-in reality").points.size() == 2);
  }

  void liveGenerationsAreAppendedInOrderAndOtherRunsIgnored() {
    FitnessChart chart;
    chart.setUnit("m");
    chart.setRun(example());
    chart.append(generation(6, 11, 0.6, 0.2, 0));
    chart.append(generation(5, 11, 0.5, 0.2, 0));
    chart.append(generation(6, 11, 0.7, 0.2, 0));
    GenerationRecord foreign = generation(7, 11, 99, 99, 99);
    foreign.run = 8;
    chart.append(foreign);
    QCOMPARE(chart.plot().drawnPoints("maximum"),
             (Points{{1, 0.1}, {2, 0.3}, {3, 0.2}, {4, 0.12}, {5, 0.5}, {6, 0.7}}));
  }

  void aLongRunIsDrawnWithAllItsPeaks() {
    FitnessChart chart;
    FitnessRun run;
    for (int i = 1; i <= 20000; ++i) run.generations.push_back(generation(i, 1, i == 12345 ? 5 : 1, 0.5, 0));
    chart.setRun(run);
    const Points drawn = chart.plot().drawnPoints("maximum");
    QVERIFY(drawn.size() < 20000);
    QVERIFY(std::find(drawn.begin(), drawn.end(), QPointF(12345, 5)) != drawn.end());
  }

  void runsOfTheSameSpecAreJoinedIntoMeanAndInterval() {
    std::vector<FitnessRun> runs(3);
    const double best[3] = {1, 2, 3};
    for (int i = 0; i < 3; ++i) {
      runs[static_cast<std::size_t>(i)].name = "Kick";
      runs[static_cast<std::size_t>(i)].experiment = "Learning to kick";
      runs[static_cast<std::size_t>(i)].run = i + 1;
      runs[static_cast<std::size_t>(i)].group = "same";
      runs[static_cast<std::size_t>(i)].generations = {generation(1, 1, best[i], 0, 0)};
    }
    runs[0].generations.push_back(generation(2, 1, 8, 0, 0));
    const PlotData joined = comparisonPlot(runs, "m", true);
    QCOMPARE(joined.series.size(), std::size_t(1));
    QVERIFY(joined.series[0].name.startsWith("Learning to kick, runs 1, 2, 3: "));
    QCOMPARE(joined.series[0].points, (Points{{1, 2}, {2, 8}}));
    // t(0.975, 2) = 4.302653, s = 1; only one run came to generation 2, so the band ends before it.
    QCOMPARE(joined.bands.size(), std::size_t(1));
    QCOMPARE(joined.bands[0].x, std::vector<double>{1});
    QVERIFY(std::abs(joined.bands[0].upper[0] - (2 + 4.302653 / std::sqrt(3.0))) < 1e-5);
    QVERIFY(std::abs(joined.bands[0].lower[0] - (2 - 4.302653 / std::sqrt(3.0))) < 1e-5);

    QCOMPARE(comparisonPlot(runs, "m", false).series.size(), std::size_t(6));
    runs[2].group = "other";
    QCOMPARE(comparisonPlot(runs, "m", true).series.size(), std::size_t(3));
  }

  void aComparisonSaysWhichRunsHadAStandIn() {
    std::vector<FitnessRun> runs(2);
    runs[0].name = "Real";
    runs[1].name = "Shown";
    runs[1].standIn = true;
    const PlotData plot = comparisonPlot(runs, "m", true);
    QCOMPARE(plot.note, QString("some runs in stand-in reality"));
    QCOMPARE(series(plot, "Shown (stand-in)").colour, 1);
    QCOMPARE(series(plot, "Real").colour, 0);
  }

  void theGapIsShownBeforeAndAfterEachUpdate() {
    GapRecord first, second;
    first.stage = 1, first.simulatorBefore = 10, first.simulatorAfter = 11;
    first.before = 0.4, first.after = 0.1, first.newBefore = 0.45, first.standardError = 0.03;
    second.stage = 2, second.simulatorBefore = 11, second.simulatorAfter = 12;
    second.before = 0.2, second.after = 0.05, second.newBefore = 0.3;
    second.heldOutBefore = 0.25, second.heldOutAfter = 0.15, second.heldOutStandardError = 0.02;
    const PlotData plot = gapPlot({first, second}, example().simulators, true, "m");

    QCOMPARE(series(plot, "before the update").points, (Points{{1, 0.4}, {2, 0.2}}));
    QCOMPARE(series(plot, "before the update").errors, (std::vector<double>{0.03, 0}));
    QCOMPARE(series(plot, "after the update").points, (Points{{1, 0.1}, {2, 0.05}}));
    QCOMPARE(series(plot, "new individuals").points, (Points{{1, 0.45}, {2, 0.3}}));
    QCOMPARE(series(plot, "held out, before").points, (Points{{2, 0.25}}));
    QCOMPARE(series(plot, "held out, after").points, (Points{{2, 0.15}}));
    QCOMPARE(series(plot, "held out, after").errors, (std::vector<double>{0.02}));
    QCOMPARE(plot.segments.size(), std::size_t(3));
    QCOMPARE(plot.xLabels.value(1), QString("0→1"));
    QCOMPARE(plot.xLabels.value(2), QString("1→2"));
    QCOMPARE(plot.note, QString("stand-in reality"));
    QVERIFY(plot.yFromZero);
  }

  void withoutHeldOutIndividualsThereIsNoSuchSeries() {
    GapRecord gap;
    gap.stage = 1;
    const PlotData plot = gapPlot({gap}, {}, false, "m");
    QCOMPARE(plot.note, QString());
    QVERIFY(gapPlot({gap}, {}, false, "m", GapNorm::rootMeanSquare).note.contains("root mean square"));
    QCOMPARE(plot.series.size(), std::size_t(3));
    GapChart chart;
    chart.setUnit("m");
    chart.setGaps({gap}, {});
    QCOMPARE(chart.plot().visibleRange().top(), 0.0);
    QCOMPARE(chart.plot().visibleRange().left(), 0.5);
    QCOMPARE(chart.plot().visibleRange().right(), 1.5);
  }
};

UI_TEST(TestFitnessAndGapCharts)
#include "test_fitness_and_gap_charts.moc"
