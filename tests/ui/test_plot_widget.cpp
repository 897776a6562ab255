// The plot behind all charts: what it draws, zooms, hides and exports.
#include <QClipboard>
#include <QGraphicsScene>
#include <QGraphicsTextItem>
#include <QGraphicsView>
#include <QMimeData>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QWheelEvent>
#include <cmath>
#include <stdexcept>

#include "core/run/reality/spread.h"
#include "core/spec/error.h"
#include "tests/ui/ui_tests.h"
#include "ui/charts/decimate.h"
#include "ui/charts/nice_numbers.h"
#include "ui/charts/plot_export.h"
#include "ui/charts/plot_legend.h"
#include "ui/charts/plot_widget.h"

using namespace btr;
using namespace btr::ui;

namespace {

PlotData example() {
  PlotData plot;
  plot.title = "Fitness by generation";
  plot.note = "stand-in reality";
  plot.xTitle = "generation";
  plot.yTitle = "fitness (m)";
  plot.xColumn = "generation";
  plot.yColumn = "fitness_m";
  plot.series.push_back(
      {"maximum", 0, PlotSeries::Style::line, {{1, 0.1}, {2, 0.30000000000000004}, {3, 0.25}}, {}, false, 0});
  plot.series.push_back({"measured", 1, PlotSeries::Style::points, {{2, 0.2}}, {0.05}, false, 0});
  plot.bands.push_back({"interval", 0, {1, 2, 3}, {0.05, 0.2, 0.2}, {0.15, 0.4, 0.3}});
  plot.markers.push_back({2, "simulator 1"});
  return plot;
}

QByteArray read(const QString& path) {
  QFile file(path);
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

const PlotLegend& legendOf(const PlotWidget& plot) {
  for (const QGraphicsItem* item : plot.findChild<QGraphicsView*>()->scene()->items())
    if (const auto* found = dynamic_cast<const PlotLegend*>(item)) return *found;
  throw std::logic_error("a plot without a legend");
}

}  // namespace

class TestPlotWidget : public QObject {
  Q_OBJECT

 private slots:
  void tinyNumbersAfterLargeOnesNeedFewLabels() {
    // Fitness 0, then 1e-12, then 1: labels of one range on the axis of another would fill the memory.
    PlotWidget plot;
    plot.resize(600, 400);
    plot.show();
    double last = 2;
    for (const double top : {0.0, 1.4e-12, 1.0, 1e12, 1e-300, 0.0}) {
      PlotData data;
      PlotSeries series;
      series.name = "fitness";
      series.points = {{1, 0}, {last *= 31, top}};  // the x axis changes its labels' width too
      data.series = {series};
      plot.setData(data);
      QVERIFY(plot.visibleRange().bottom() >= top);
      plot.grab();
    }
  }

  void decimationKeepsEveryColumnsExtremes() {
    // A long sine with one spike up and one down, each a single sample wide.
    std::vector<QPointF> points;
    for (int i = 0; i < 100000; ++i) points.emplace_back(i, std::sin(i * 0.01));
    points[31415].setY(7);
    points[77777].setY(-5);
    const auto kept = decimate(points, 0, 99999, 500);
    QVERIFY(kept.size() <= 4 * 502);
    QVERIFY(std::find(kept.begin(), kept.end(), QPointF(31415, 7)) != kept.end());
    QVERIFY(std::find(kept.begin(), kept.end(), QPointF(77777, -5)) != kept.end());
    QCOMPARE(kept.front(), points.front());
    QCOMPARE(kept.back(), points.back());
    QVERIFY(std::is_sorted(kept.begin(), kept.end(), [](auto& a, auto& b) { return a.x() < b.x(); }));
    for (const QPointF& point : kept) QCOMPARE(point, points[static_cast<std::size_t>(point.x())]);
  }

  void decimationKeepsTheNeighboursOfTheVisibleRange() {
    const std::vector<QPointF> points{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}};
    const std::vector<QPointF> expected{{1, 2}, {2, 3}, {3, 4}};
    QCOMPARE(decimate(points, 1.5, 2.5, 100), expected);
  }

  void stepsAreOneTwoOrFiveTimesAPowerOfTen_data() {
    QTest::addColumn<double>("range");
    QTest::addColumn<int>("most");
    QTest::addColumn<bool>("whole");
    QTest::addColumn<double>("step");
    QTest::newRow("exact") << 10.0 << 10 << false << 1.0;
    QTest::newRow("a little more") << 10.1 << 10 << false << 2.0;
    QTest::newRow("quarter") << 0.9 << 4 << false << 0.25;
    QTest::newRow("whole skips 2.5") << 9.0 << 4 << true << 5.0;
    QTest::newRow("whole is at least one") << 2.0 << 10 << true << 1.0;
    QTest::newRow("large") << 3000.0 << 8 << false << 500.0;
    QTest::newRow("nothing") << 0.0 << 8 << false << 1.0;
  }
  void stepsAreOneTwoOrFiveTimesAPowerOfTen() {
    QFETCH(double, range);
    QFETCH(int, most);
    QFETCH(bool, whole);
    QFETCH(double, step);
    QCOMPARE(niceStep(range, most, whole), step);
  }

  void tickLabelsHaveAsManyDigitsAsTheStep() {
    QCOMPARE(tickFormat(0.25, 1), QString("%.2f"));
    QCOMPARE(tickFormat(0.5, 1), QString("%.1f"));
    QCOMPARE(tickFormat(20, 100), QString("%.0f"));
    QCOMPARE(tickFormat(1e-7, 1e-6), QString("%g"));
  }

  void theIntervalOfTheMeanIsStudents() {
    // Of 1, 2, 3: s = 1, s/√3, and t(0.975, 2) = 4.302653 from the published table.
    const std::vector<double> values{1, 2, 3};
    const Spread spread = spreadOf(values);
    QCOMPARE(spread.mean, 2.0);
    QCOMPARE(spread.deviation, 1.0);
    QCOMPARE(spread.standardError, 1 / std::sqrt(3.0));
    QVERIFY(std::abs(spread.halfWidth95 - 4.302653 / std::sqrt(3.0)) < 1e-5);
    QCOMPARE(spreadOf(std::vector<double>{5}).deviation, 0.0);
    QCOMPARE(spreadOf({}).count, 0);
  }

  void drawsTheNumbersThatItWasGiven() {
    PlotWidget plot;
    plot.setData(example());
    const std::vector<QPointF> expected{{1, 0.1}, {2, 0.30000000000000004}, {3, 0.25}};
    QCOMPARE(plot.drawnPoints("maximum"), expected);
    QCOMPARE(plot.drawnPoints("nobody").size(), std::size_t(0));
    const QRectF range = plot.visibleRange();
    QVERIFY(range.left() <= 1 && range.right() >= 3);
    QVERIFY(range.top() <= 0.05 && range.bottom() >= 0.4);
  }

  void errorBarsAreInsideTheVisibleRange() {
    PlotWidget plot;
    PlotData data;
    data.series.push_back({"measured", 0, PlotSeries::Style::points, {{1, 10}, {2, 11}}, {4, 0}, false, 0});
    plot.setData(data);
    QVERIFY(plot.visibleRange().top() <= 6);
    QVERIFY(plot.visibleRange().bottom() >= 14);
  }

  void aHiddenSeriesKeepsItsNameInTheLegend() {
    PlotWidget plot;
    PlotData data = example();
    data.series.push_back({"worst", 2, PlotSeries::Style::line, {{1, -100}}, {}, true, 0});
    data.series.push_back({"", 2, PlotSeries::Style::line, {{1, 0}}, {}, false, 0});
    plot.setData(data);
    plot.show();
    QVERIFY(!plot.isSeriesShown("worst"));
    QVERIFY(plot.visibleRange().top() > -1);
    QCOMPARE(plot.legendNames(), (QStringList{"maximum", "measured", "worst", "interval"}));

    plot.setSeriesShown("worst", true);
    plot.setSeriesShown("maximum", false);
    QVERIFY(plot.visibleRange().top() <= -100);
    QCOMPARE(plot.legendNames(), (QStringList{"maximum", "measured", "worst", "interval"}));
    // Newer data do not undo the choice.
    plot.setData(data);
    QVERIFY(plot.isSeriesShown("worst"));
    QVERIFY(!plot.isSeriesShown("maximum"));
  }

  void aClickOnANameHidesAndShowsIt() {
    PlotWidget plot;
    plot.resize(700, 400);
    plot.setData(example());
    plot.show();
    QVERIFY(QTest::qWaitForWindowExposed(&plot));
    auto* view = plot.findChild<QGraphicsView*>();
    const PlotLegend& legend = legendOf(plot);
    const QPoint name = view->mapFromScene(legend.mapToScene(legend.placeOf("measured").center()));
    QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, name);
    QVERIFY(!plot.isSeriesShown("measured"));
    QTest::mouseClick(view->viewport(), Qt::LeftButton, {}, name);
    QVERIFY(plot.isSeriesShown("measured"));
  }

  void whatIsHiddenStaysOutOfExportedPictures() {
    QTemporaryDir folder;
    PlotWidget plot;
    plot.resize(700, 400);
    plot.setData(example());
    plot.setSeriesShown("measured", false);
    plot.exportTo(folder.filePath("chart.svg"));
    QVERIFY(!read(folder.filePath("chart.svg")).contains("measured"));
    QVERIFY(plot.legendNames().contains("measured"));
  }

  // Of data that come faster than they can be drawn.
  void onlyTheLastDataAreDrawn() {
    PlotWidget plot;
    plot.show();
    QVERIFY(QTest::qWaitForWindowExposed(&plot));
    QSignalSpy drawn(&plot, &PlotWidget::rangeChanged);
    PlotData data = example();
    for (int count = 0; count < 20; ++count) {
      data.series[0].points.emplace_back(50 + count, 3);
      plot.setData(data);
      QCOMPARE(plot.data().series[0].points.back(), QPointF(50 + count, 3));
    }
    QTRY_COMPARE(drawn.size(), 1);
    QVERIFY(plot.visibleRange().right() >= 69);
    plot.setData(example());
    QVERIFY2(plot.visibleRange().right() < 50, "who asks sees the latest");
  }

  void zoomStaysWhileNewDataArrive() {
    PlotWidget plot;
    plot.setData(example());
    plot.zoomTo({QPointF(1.5, 0.1), QPointF(2.5, 0.2)});
    PlotData longer = example();
    longer.series[0].points.emplace_back(50, 3);
    plot.setData(longer);
    QVERIFY(plot.isZoomed());
    QCOMPARE(plot.visibleRange(), QRectF(QPointF(1.5, 0.1), QPointF(2.5, 0.2)));
    QTest::keyClick(&plot, Qt::Key_Home);
    QVERIFY(!plot.isZoomed());
    QVERIFY(plot.visibleRange().right() >= 50);
  }

  void draggingZoomsAndDoubleClickShowsEverything() {
    PlotWidget plot;
    plot.resize(800, 500);
    plot.show();
    QVERIFY(QTest::qWaitForWindowExposed(&plot));
    plot.setData(example());
    auto* viewport = plot.findChild<QWidget*>("plotArea");
    QVERIFY(viewport);
    const QPoint a = plot.placeOf({1.5, 0.1}), b = plot.placeOf({2.5, 0.3});
    QTest::mousePress(viewport, Qt::LeftButton, {}, a);
    QTest::mouseMove(viewport, b);
    QTest::mouseRelease(viewport, Qt::LeftButton, {}, b);
    QVERIFY(plot.isZoomed());
    QVERIFY(std::abs(plot.visibleRange().left() - 1.5) < 0.02);
    QVERIFY(std::abs(plot.visibleRange().right() - 2.5) < 0.02);
    QVERIFY(std::abs(plot.visibleRange().bottom() - 0.3) < 0.01);
    QTest::mouseDClick(viewport, Qt::LeftButton, {}, a);
    QVERIFY(!plot.isZoomed());
  }

  void theWheelZoomsAtThePointer() {
    PlotWidget plot;
    plot.resize(800, 500);
    plot.show();
    QVERIFY(QTest::qWaitForWindowExposed(&plot));
    plot.setData(example());
    auto* viewport = plot.findChild<QWidget*>("plotArea");
    const QPointF value(2, 0.2);
    const QPoint place = plot.placeOf(value);
    const QRectF before = plot.visibleRange();
    QWheelEvent wheel(place, plot.mapToGlobal(place), {}, {0, 120}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(viewport, &wheel);
    QVERIFY(std::abs(plot.visibleRange().width() - before.width() * 0.8) < 1e-9);
    QVERIFY((plot.placeOf(value) - place).manhattanLength() <= 2);
  }

  void theReadOutShowsExactNumbers() {
    PlotWidget plot;
    plot.resize(800, 500);
    plot.show();
    QVERIFY(QTest::qWaitForWindowExposed(&plot));
    plot.setData(example());
    const QString text = plot.readOutAt(plot.placeOf({2, 0.30000000000000004}));
    // For people; the exact number is in the exported table.
    QVERIFY2(text.contains("maximum") && text.endsWith("= 0.3"), qPrintable(text));
    const QString measured = plot.readOutAt(plot.placeOf({2, 0.2}));
    QVERIFY2(measured.contains("0.2 ± 0.05"), qPrintable(measured));
    QCOMPARE(plot.readOutAt({0, 0}), QString());
  }

  void aLogarithmicAxisLeavesOutWhatItCannotShow() {
    PlotWidget plot;
    PlotData data;
    data.series.push_back({"error", 0, PlotSeries::Style::line, {{1, 10}, {2, 0}, {3, -1}, {4, 0.01}}, {}, false, 0});
    plot.setData(data);
    plot.setLogarithmic(true);
    const std::vector<QPointF> expected{{1, 10}, {4, 0.01}};
    QCOMPARE(plot.drawnPoints("error"), expected);
    QVERIFY(plot.visibleRange().top() > 0 && plot.visibleRange().top() <= 0.01);
    plot.setLogarithmic(false);
    QCOMPARE(plot.drawnPoints("error").size(), std::size_t(4));
  }

  void aPlotWithoutAnyPointCanBeShownAndExported() {
    QTemporaryDir folder;
    PlotWidget plot;
    plot.resize(400, 300);
    plot.setData({});
    plot.setLogarithmic(true);
    QVERIFY(!plot.grab().isNull());
    plot.exportTo(folder.filePath("empty.png"));
    QVERIFY(QFileInfo(folder.filePath("empty.png")).size() > 0);
  }

  void exportsPicturesThatCarryTitleAndNote() {
    QTemporaryDir folder;
    PlotWidget plot;
    plot.resize(700, 400);
    plot.setData(example());
    for (const char* ending : {"png", "svg", "pdf", "csv"}) plot.exportTo(folder.filePath(QString("chart.") + ending));

    const QByteArray svg = read(folder.filePath("chart.svg"));
    for (const char* text :
         {"Fitness by generation", "stand-in reality", "fitness (m)", "generation", "simulator 1", "maximum"})
      QVERIFY2(svg.contains(text), text);
    const QImage picture(folder.filePath("chart.png"));
    QCOMPARE(picture.size(), QSize(1400, 800));
    QCOMPARE(picture.pixelColor(2, 2), QColor(Qt::white));
    QVERIFY(read(folder.filePath("chart.pdf")).startsWith("%PDF-"));
  }

  void csvHoldsEveryNumberExactly() {
    const QByteArray expected =
        "series,generation,fitness_m,error,lower,upper,note\n"
        "maximum,1,0.1,,,,stand-in reality\n"
        "maximum,2,0.30000000000000004,,,,stand-in reality\n"
        "maximum,3,0.25,,,,stand-in reality\n"
        "measured,2,0.2,0.05,,,stand-in reality\n"
        "interval,1,,,0.05,0.15,stand-in reality\n"
        "interval,2,,,0.2,0.4,stand-in reality\n"
        "interval,3,,,0.2,0.3,stand-in reality\n"
        "simulator 1,2,,,,,stand-in reality\n";
    QCOMPARE(QByteArray::fromStdString(toCsv(example())), expected);
  }

  void theIntervalOfAMeanStandsInItsOwnRow() {
    PlotData plot;
    plot.xColumn = "stage";
    plot.yColumn = "fitness_m";
    plot.series.push_back({"mean", 0, PlotSeries::Style::line, {{1, 0.25}, {2, 0.5}}, {}, false, 0.125});
    plot.bands.push_back({"mean", 0, {2.125}, {0.25}, {0.75}});
    QCOMPARE(QByteArray::fromStdString(toCsv(plot)), QByteArray("series,stage,fitness_m,error,lower,upper,note\n"
                                                                "mean,1,0.25,,,,\n"
                                                                "mean,2,0.5,,0.25,0.75,\n"));
  }

  void aTickAtZeroHasNoSign() {
    QVERIFY(isNegativeZero("-0.0") && isNegativeZero("-0") && !isNegativeZero("-0.1") && !isNegativeZero("0.0"));
    PlotWidget plot;
    plot.resize(600, 400);
    plot.show();
    for (const double step : {0.1, 0.2, 0.3, 0.7}) {
      PlotData data;
      PlotSeries series{"a", 0, PlotSeries::Style::line, {}, {}, false};
      for (int i = -7; i <= 7; ++i) series.points.emplace_back(i * step, i * step);
      data.series.push_back(series);
      plot.setData(data);
      plot.resetZoom();
      plot.grab();
      auto* view = plot.findChild<QGraphicsView*>();
      for (QGraphicsItem* item : view->scene()->items())
        if (auto* label = qgraphicsitem_cast<QGraphicsTextItem*>(item))
          QVERIFY2(!isNegativeZero(label->toPlainText()), qPrintable(label->toPlainText()));
    }
  }

  void aLowPlotHasAtLeastTwoTicks() {
    for (const double range : {1.9, 1.01, 0.99, 47.0, 3.3e-3})
      for (const double from : {0.05, 0.51, 12.3}) {
        int most = 3;
        double step = niceStep(range, most);
        while (ticksWithin(from, from + range, step) < 2) step = niceStep(range, ++most);
        QVERIFY(most < 12);
      }
    PlotWidget plot;
    plot.resize(300, 180);
    plot.show();
    PlotData data = example();
    data.series[0].points = {{1, 0.3}, {2, 2.2}, {3, 1.7}};
    plot.setData(data);
    plot.zoomTo(QRectF(1, 0.31, 2, 0.9));
    plot.grab();
    int labels = 0;
    for (QGraphicsItem* item : plot.findChild<QGraphicsView*>()->scene()->items())
      if (auto* label = qgraphicsitem_cast<QGraphicsTextItem*>(item)) {
        bool isNumber = false;
        const double value = label->toPlainText().toDouble(&isNumber);
        labels += isNumber && value > 0.3 && value < 1.25;
      }
    QVERIFY2(labels >= 2, qPrintable(QString::number(labels)));
  }

  void aNameLongerThanItsPlotIsCutInItsMiddle() {
    PlotWidget plot;
    plot.resize(420, 300);
    plot.show();
    PlotData data = example();
    const QString name = QString("Learning to kick ").repeated(8) + ": maximum";
    data.series = {{name, 0, PlotSeries::Style::line, {{1, 0.1}, {2, 0.2}}, {}, false}};
    plot.setData(data);
    plot.grab();
    const auto* view = plot.findChild<QGraphicsView*>();
    const PlotLegend& legend = legendOf(plot);
    const QRectF place = legend.mapRectToScene(legend.placeOf(name));
    QVERIFY(place.left() >= 0);
    QVERIFY2(place.right() <= view->sceneRect().right(), qPrintable(QString::number(place.right())));
  }

  void manyLongNamesLeaveThePlotMostOfTheRoom() {
    PlotWidget plot;
    plot.resize(420, 240);
    plot.show();
    PlotData data = example();
    data.series.clear();
    for (int i = 0; i < 12; ++i)
      data.series.push_back({QString("Learning to kick, short, with a stand-in reality, run %1: maximum").arg(i),
                             i,
                             PlotSeries::Style::line,
                             {{1, 0.1}, {2, 0.2}},
                             {},
                             false});
    plot.setData(data);
    plot.grab();
    const int top = plot.placeOf({1, plot.visibleRange().bottom()}).y(),
              low = plot.placeOf({1, plot.visibleRange().top()}).y();
    QVERIFY2(low - top > 60, qPrintable(QString::number(low - top)));
  }

  void aMarkAtTheEdgeIsDrawnWhole() {
    PlotWidget plot;
    PlotData data = example();
    data.series = {{"measured", 1, PlotSeries::Style::points, {{1, 0.1}, {5, 0.2}}, {}, false}};
    data.bands.clear();
    data.markers.clear();
    plot.setData(data);
    plot.resetZoom();
    QVERIFY(plot.visibleRange().right() > 5);
  }

  void anIntervalOfADistanceIsDrawnDownToZeroOnly() {
    PlotWidget plot;
    PlotData data = example();
    data.bands[0].lower = {-3, -1, 0.1};
    plot.setData(data);
    plot.resetZoom();
    QVERIFY(plot.visibleRange().top() <= -3);
    data.neverNegative = true;
    plot.setData(data);
    plot.resetZoom();
    QVERIFY(plot.visibleRange().top() > -0.5);
  }

  void columnsEndInTheirUnit() {
    QCOMPARE(columnName("fitness", "m"), QString("fitness_m"));
    QCOMPARE(columnName("fitness", "cm/s"), QString("fitness_cm_s"));
    QCOMPARE(columnName("fitness", ""), QString("fitness"));
  }

  void anUnknownEndingAndAMissingFolderAreRefused() {
    QTemporaryDir folder;
    PlotWidget plot;
    plot.setData(example());
    QVERIFY_EXCEPTION_THROWN(plot.exportTo(folder.filePath("chart.bmp")), InputError);
    QVERIFY_EXCEPTION_THROWN(plot.exportTo(folder.filePath("nowhere/chart.csv")), InputError);
  }

  void copiesPictureAndNumbers() {
    PlotWidget plot;
    plot.resize(500, 300);
    plot.setData(example());
    plot.copyToClipboard();
    const QMimeData* content = QApplication::clipboard()->mimeData();
    QVERIFY(content->hasImage());
    QVERIFY(content->text().startsWith("series,generation,fitness_m"));
  }

  void followsThePaletteAndExportsOnWhiteAllTheSame() {
    QTemporaryDir folder;
    PlotWidget plot;
    plot.resize(500, 300);
    plot.setData(example());
    QPalette dark;
    dark.setColor(QPalette::Base, QColor(20, 22, 26));
    dark.setColor(QPalette::Text, Qt::white);
    plot.setPalette(dark);
    QCOMPARE(plot.grab().toImage().pixelColor(3, 3), QColor(20, 22, 26));
    plot.exportTo(folder.filePath("chart.png"));
    QCOMPARE(QImage(folder.filePath("chart.png")).pixelColor(3, 3), QColor(Qt::white));
    QCOMPARE(plot.grab().toImage().pixelColor(3, 3), QColor(20, 22, 26));
  }
};

UI_TEST(TestPlotWidget)
#include "test_plot_widget.moc"
