// The gap page: a stored report shown, the map and its plots, effects with their reasons, adoption, the mapping form.
#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTabBar>
#include <QTabWidget>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <QTextBrowser>
#include <QTimer>

#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/report/report_figures.h"
#include "core/gap/report/report_files.h"
#include "core/gap/report/report_html.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"
#include "core/spec/error.h"
#include "core/spec/figures.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"
#include "tests/gap/report/sample_report.h"
#include "tests/ui/ui_tests.h"
#include "ui/charts/plot_widget.h"
#include "ui/common/progress.h"
#include "ui/gap/analysis_setup.h"
#include "ui/gap/clues_view.h"
#include "ui/gap/effects_table.h"
#include "ui/gap/gap_page.h"
#include "ui/gap/gap_plots.h"
#include "ui/gap/ghost_replay.h"
#include "ui/gap/heat_map.h"
#include "ui/gap/mapping_draft.h"
#include "ui/gap/mapping_form.h"
#include "ui/gap/recording_plot.h"
#include "ui/gap/report_view.h"

using namespace btr;
using namespace btr::ui;

namespace {

/// A page with the sample report opened from a folder.
struct Bench {
  Bench() {
    writeReport(sampleReport(), folder.filePath("report").toStdString());
    page.resize(1100, 800);
    page.show();
    opened = page.openReport(folder.filePath("report"));
  }
  QTemporaryDir folder;
  GapPage page{BTR_PROGRAM};
  bool opened = false;
};

std::vector<SimulatorRecord> versions(int count) {
  std::vector<SimulatorRecord> all(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) all[static_cast<std::size_t>(i)].number = i;
  return all;
}

QString file(const QTemporaryDir& folder, const QString& name, const std::string& content) {
  writeFile(folder.filePath(name).toStdString(), content);
  return folder.filePath(name);
}

void type(QTableWidget& table, int row, int column, const QString& text) { table.item(row, column)->setText(text); }

}  // namespace

class TestGapPage : public QObject {
  Q_OBJECT
 private slots:
  void showsTheVerdictOfAStoredReport() {
    Bench bench;
    QVERIFY(bench.opened);
    QCOMPARE(bench.page.findChild<QLabel*>("headline")->text(), QString("Backlash at leg.knee was left out"));
    const QString findings = bench.page.findChild<QTextBrowser*>("findings")->toPlainText();
    QVERIFY2(findings.contains(QString::fromStdString(sampleReport().sentence)), qPrintable(findings));
    QVERIFY2(findings.contains("0.043 rad"), qPrintable(findings));
    QVERIFY2(findings.contains("What to do next"), qPrintable(findings));
    QCOMPARE(bench.page.findChild<QTableWidget*>("steps")->rowCount(), int(sampleReport().ladder.size()));
    QCOMPARE(bench.page.findChild<QTabWidget*>("gapTabs")->currentIndex(), 1);
  }

  // A success on what was fitted is none where the user's own held-out recording got worse: 259 → 278 noise floors.
  void whatGotWorseOnHeldOutRecordingsIsInTheHeadlineAndAskedAboutBeforeItIsAdopted() {
    GapReport report = sampleReport();
    for (GapReport::Channel& channel : report.channels)
      channel.heldoutAsGiven = channel.heldoutCalibrated = channel.heldoutWithEffects = 0;
    GapReport::Channel& channel = report.channels.front();
    channel.heldoutAsGiven = 259 * channel.noiseFloor;
    channel.heldoutCalibrated = 260 * channel.noiseFloor;
    channel.heldoutWithEffects = 278 * channel.noiseFloor;
    QTemporaryDir folder;
    writeReport(report, folder.filePath("report").toStdString());
    GapPage page(BTR_PROGRAM);
    page.show();
    QVERIFY(page.openReport(folder.filePath("report")));
    const QString headline = page.findChild<QLabel*>("headline")->text();
    QVERIFY2(headline.contains("held out got worse: 259 → 278 noise floors"), qPrintable(headline));
    page.setTargets({{"Run 1", "", versions(1), ""}});
    QSignalSpy adopt(&page, &GapPage::adoptRequested);
    const auto answer = [](const char* name) {
      QTimer::singleShot(0, [name] {
        auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
        QVERIFY(box && box->text().contains("259 → 278"));
        if (auto* button = box->findChild<QPushButton*>(name))
          button->click();
        else
          box->reject();
      });
    };
    answer("");
    page.adoptAction()->trigger();
    QCOMPARE(adopt.count(), 0);
    answer("adoptWorse");
    page.adoptAction()->trigger();
    QCOMPARE(adopt.count(), 1);
    const auto* errors = page.findChild<QTableWidget*>("errors");
    QCOMPARE(errors->rowCount(), int(report.channels.size()));
    QCOMPARE(errors->item(0, ErrorsTable::unit)->text(), QString::fromStdString(channel.unit));
    QCOMPARE(errors->item(0, ErrorsTable::heldWithEffects)->text(),
             QString::fromStdString(brief(278 * channel.noiseFloor)));
  }

  void bothPlotsOfARecordingShowTheSameTime() {
    Bench bench;
    auto* overlay = bench.page.findChild<PlotWidget*>("overlay");
    auto* error = bench.page.findChild<PlotWidget*>("error");
    overlay->zoomTo(QRectF(0.5, overlay->visibleRange().top(), 0.25, overlay->visibleRange().height()));
    QCOMPARE(error->visibleRange().left(), 0.5);
    QCOMPARE(error->visibleRange().width(), 0.25);
    error->zoomTo(QRectF(0.25, error->visibleRange().top(), 0.5, error->visibleRange().height()));
    QCOMPARE(overlay->visibleRange().left(), 0.25);
    error->resetZoom();
    QVERIFY(!overlay->isZoomed());
    QCOMPARE(overlay->visibleRange().width(), error->visibleRange().width());
  }

  void anIntervalAThousandTimesTheCurveIsCutOffAndSaid() {
    GapReport report;
    report.remainder.on = "velocity";
    report.remainder.at = "leg.knee";
    report.remainder.unitY = "N·m";
    report.remainder.x = {-1, 0, 1};
    report.remainder.y = {-0.7, 0, 0.7};
    report.remainder.standardError = {0.01, 0.01, 300};
    const PlotData plot = remainderPlot(report);
    PlotWidget widget;
    widget.setData(plot);
    widget.resetZoom();
    QVERIFY(widget.visibleRange().height() < 10);
    QVERIFY2(plot.note.contains("± 588"), qPrintable(plot.note));  // 1.96·300
  }

  void progressTellsTheTimeLeftAtThePaceSoFar() {
    QCOMPARE(secondsLeft(0.25, 30), 90.0);
    QCOMPARE(secondsLeft(0.5, 10), 10.0);
    QVERIFY(secondsLeft(0, 30) < 0);
    QVERIFY(secondsLeft(-1, 30) < 0);
    QProgressBar bar;
    showProgress(bar, "handing over", 0.5, 10);
    QVERIFY2(bar.format().contains("handing over") && bar.format().contains("about 10 s left"),
             qPrintable(bar.format()));
  }

  // Two of them with the same letter would only take turns in getting the focus.
  void noTwoThingsOnThePageShareAKey() {
    GapPage page("/bin/true");
    page.show();
    QStringList letters{"&F", "&E", "&R", "&V", "&H"};  // the window's menus
    const auto add = [&](const QString& text) {
      for (int at = 0; (at = int(text.indexOf('&', at))) >= 0; at += 2)
        if (text.mid(at, 2) != "&&") letters << text.mid(at, 2).toUpper();
    };
    for (const auto* button : page.findChildren<QAbstractButton*>())
      if (button->isVisibleTo(&page)) add(button->text());
    for (const auto* label : page.findChildren<QLabel*>())
      if (label->isVisibleTo(&page) && label->buddy()) add(label->text());
    for (const auto* tabs : page.findChildren<QTabBar*>())
      for (int i = 0; tabs->isVisibleTo(&page) && i < tabs->count(); ++i) add(tabs->tabText(i));
    QVERIFY(letters.size() > 12);
    QCOMPARE(letters.removeDuplicates(), 0);
  }

  void anEmptyPageIsFilledWithTheShippedExample() {
    qputenv("UCHILSIM_RESOURCES", SOURCE_DIR "/resources");
    QTemporaryDir home;
    GapPage page(BTR_PROGRAM);
    page.setMeasured(home.filePath("my.db"), 0, 0);
    page.show();
    AnalysisSetup& setup = page.setup();
    auto* example = setup.findChild<QPushButton*>("tryExample");
    QVERIFY(example->isVisibleTo(&setup));
    QTest::mouseClick(example, Qt::LeftButton);
    QVERIFY2(setup.problem().isEmpty(), qPrintable(setup.problem()));
    const AnalysisJob job = setup.job();
    QCOMPARE(job.recordings.size(), 2);
    QCOMPARE(job.heldOut.size(), 1);
    QVERIFY(!example->isVisibleTo(&setup));
    // The report lies beside the database, not among the recordings.
    QCOMPARE(QFileInfo(job.out).absolutePath(), QFileInfo(home.path()).absoluteFilePath());
    qunsetenv("UCHILSIM_RESOURCES");
  }

  void theUnitOfACalibratedNumberIsThatOfItsPath() {
    GapReport report;
    for (const char* path : {"robots.a.servos.b.torque_constant_nm_per_a", "robots.a.servos.b.resistance_ohm",
                             "robots.a.servos.b.rotor_inertia_kg_m2", "floor.friction", "robots.a.servos.b.p"})
      report.calibrated.emplace_back().name = path;
    CalibratedTable table;
    table.setReport(report);
    const auto unit = [&](int row) { return table.item(row, CalibratedTable::unit)->text(); };
    QCOMPARE(unit(0), QString("N·m/A"));
    QCOMPARE(unit(1), QString("Ω"));
    QCOMPARE(unit(2), QString("kg·m²"));
    QCOMPARE(unit(3), QString("1"));
    QCOMPARE(unit(4), QString());
  }

  void aRecordingIsSeenBeforeItIsAnalysed() {
    QTemporaryDir folder;
    const QString csv =
        file(folder, "a.csv", "time_s,leg.knee.command_rad,leg.knee.position_rad\n0,1,0\n0.5,1,0.5\n1,1,0.75\n");
    RecordingPlot looks;
    looks.setRecording(csv, {}, {});
    QCOMPARE(looks.channel().currentText(), QString("leg.knee.position_rad"));
    const PlotData& plot = looks.plot().data();
    QCOMPARE(plot.series.size(), std::size_t(2));  // with the command beside it
    QCOMPARE(plot.series[0].points, (std::vector<QPointF>{{0, 0}, {0.5, 0.5}, {1, 0.75}}));
    QVERIFY(plot.yTitle.contains("(rad)"));
    looks.setRecording(file(folder, "b.csv", "time_s\nno number\n"), {}, {});
    QVERIFY2(looks.plot().data().empty.contains("b.csv"), qPrintable(looks.plot().data().empty));
  }

  void aFolderThatIsNoReportIsAMessageAndKeepsWhatIsShown() {
    Bench bench;
    QSignalSpy failed(&bench.page, &GapPage::failed);
    QVERIFY(!bench.page.openReport(bench.folder.filePath("nothing")));
    QVERIFY(failed.first().first().toString().contains("there is no such folder"));
    QVERIFY(bench.page.view().report() != nullptr);
  }

  void theMapOpensAtTheWorstPlace() {
    Bench bench;
    const HeatMap& map = bench.page.view().map();
    QCOMPARE(map.rows(), 10);
    QVERIFY(map.current().has_value());
    const double worst = map.row(map.current()->row).error[map.current()->bin];
    for (int r = 0; r < map.rows(); ++r)
      for (const double error : map.row(std::size_t(r)).error) QVERIFY(!(error > worst));
  }

  void aClickInTheMapMovesTheCursorOfThePlots() {
    Bench bench;
    HeatMap& map = bench.page.view().map();
    QSignalSpy chosen(&bench.page, &GapPage::timeChosen);
    const HeatMap::Cell cell{2, 40};
    QTest::mouseClick(map.viewport(), Qt::LeftButton, {}, map.rectOf(cell).center());
    const HeatRow& row = map.row(2);
    const double time = row.from_s + (row.to_s - row.from_s) * 40.5 / double(HeatMap::bins);
    QCOMPARE(chosen.size(), 1);
    QCOMPARE(chosen.first().at(0).toULongLong(), 1ULL);  // the second trial's first channel
    QCOMPARE(chosen.first().at(1).toDouble(), time);
    const PlotData& plot = bench.page.view().overlay().data();
    QVERIFY(plot.title.startsWith("leg.knee.position_rad · sine-2.csv"));
    QCOMPARE(plot.markers.size(), std::size_t(1));
    QCOMPARE(plot.markers.front().x, time);
    const QRectF seen = bench.page.view().overlay().visibleRange();
    QVERIFY(seen.left() < time && time < seen.right());
    QVERIFY(seen.width() < 2);
    QCOMPARE(bench.page.findChild<QComboBox*>("channel")->currentIndex(), 2);
  }

  void theMapsColoursAreAllExplained() {
    HeatMap map;
    map.setReport(std::make_shared<const GapReport>(sampleReport()));
    map.show();
    for (const int width : {500, 710, 1200}) {
      map.resize(width, 200);
      for (const QRect& place : map.scalePlaces())
        QVERIFY2(map.viewport()->rect().contains(place), qPrintable(QString::number(width)));
    }
  }

  void theMapIsUsedWithKeysToo() {
    Bench bench;
    HeatMap& map = bench.page.view().map();
    map.choose({0, 10});
    QTest::keyClick(&map, Qt::Key_Right);
    QTest::keyClick(&map, Qt::Key_Down);
    QCOMPARE(map.current()->row, std::size_t(1));
    QCOMPARE(map.current()->bin, std::size_t(11));
    for (int i = 0; i < 3; ++i) QTest::keyClick(&map, Qt::Key_Up);
    QCOMPARE(map.current()->row, std::size_t(0));
  }

  void theMapFollowsTheChosenSimulator() {
    Bench bench;
    const HeatMap& map = bench.page.view().map();
    const double before = map.row(0).error[20];
    bench.page.findChild<QComboBox*>("which")->setCurrentIndex(2);
    QVERIFY(map.row(0).error[20] < before);
    QVERIFY(map.describe({0, 20}).contains("noise floors"));
  }

  void theCurvesAreThoseOfTheReport() {
    const GapReport report = sampleReport();
    const PlotData plot = overlayPlot(report, 4, 0);
    QVERIFY(plot.title.endsWith("(held out)"));
    QCOMPARE(plot.series.size(), std::size_t(4));
    QCOMPARE(plot.series[0].points.size(), std::size_t(500));
    QCOMPARE(plot.series[3].points.size(), std::size_t(497));  // three are not known
    QCOMPARE(plot.series[0].points[7].y(), report.trials[4].series[0].recorded[7]);
    QCOMPARE(plot.yTitle, QString("position (rad)"));
    const PlotData error = errorPlot(report, 4, 0);
    const GapReport::Series& s = report.trials[4].series[0];
    QCOMPARE(error.series[0].points[7].y(), (s.asGiven[7] - s.recorded[7]) / s.noiseFloor);
  }

  // What is not compared, as where rows were lost and the command stepped, is no straight line that looks measured.
  void noCurveGoesOverAPause() {
    GapReport report = sampleReport();
    GapReport::Series& s = report.trials[4].series[0];
    for (std::size_t i = 100; i < 200; ++i) s.recorded[i] = NAN;
    s.recorded[300] = NAN;
    const PlotData plot = overlayPlot(report, 4, 0);
    std::vector<std::size_t> recorded;
    for (const PlotSeries& series : plot.series)
      if (series.name == "recorded") recorded.push_back(series.points.size());
    QCOMPARE(recorded, (std::vector<std::size_t>{100, 299}));
    PlotWidget widget;
    widget.setData(plot);
    QCOMPARE(widget.legendNames(), (QStringList{"recorded", "as given", "calibrated", "with effects"}));
  }

  void rejectedEffectsAreShownWithTheirReason() {
    Bench bench;
    const EffectsTable& table = bench.page.view().effects();
    QCOMPARE(table.rowCount(), 4);
    QCOMPARE(table.item(0, EffectsTable::verdict)->text(), QString("accepted"));
    QVERIFY(table.item(0, EffectsTable::effect)->font().bold());
    QVERIFY(table.item(0, EffectsTable::rivals)->text().startsWith("gear elasticity at leg.knee"));
    QCOMPARE(table.item(3, EffectsTable::verdict)->text(), QString("rejected"));
    QCOMPARE(table.item(3, EffectsTable::reason)->text(), QString("explains nothing that the calibration does not"));
    QCOMPARE(table.item(0, EffectsTable::gain)->text(), QString("71 %"));
  }

  void theLadderEndsBesideTheNoiseFloor() {
    const PlotData plot = ladderPlot(sampleReport());
    QCOMPARE(plot.series[0].points.size(), std::size_t(3));
    QCOMPARE(plot.series[0].points[2], QPointF(2, 1.19));
    QCOMPARE(plot.series[0].errors[1], 1.1);
    QCOMPARE(plot.series[1].points[0].y(), 1.0);
    QCOMPARE(plot.xLabels.value(2), QString("+ backlash at leg.knee"));
  }

  void anEmptyReportSaysSoEverywhere() {
    const GapReport nothing;
    for (const PlotData& plot : {overlayPlot(nothing, 0, 0), ladderPlot(nothing), regimePlot(nothing, 0),
                                 remainderPlot(nothing), nextRecordingPlot(nothing)}) {
      QVERIFY(plot.series.empty());
      QVERIFY(!plot.empty.isEmpty());
    }
    ReportView view;
    view.setReport(std::make_shared<const GapReport>(nothing));
    QVERIFY(view.next().data().series.empty());
  }

  void adoptingAsksForTheReportsSimulator() {
    Bench bench;
    QSignalSpy adopted(&bench.page, &GapPage::adoptRequested), reverted(&bench.page, &GapPage::revertRequested);
    QVERIFY(!bench.page.adoptAction()->isEnabled());  // no run is selected
    bench.page.setTargets({{"run 3", {}, versions(1), {}}});
    QVERIFY(bench.page.adoptAction()->isEnabled());
    QVERIFY(!bench.page.revertAction()->isEnabled());
    bench.page.adoptAction()->trigger();
    QCOMPARE(adopted.first().at(0).toString(), bench.folder.filePath("report/simulator.json"));
    QCOMPARE(adopted.first().at(1).toString(), bench.folder.filePath("report"));
    bench.page.setTargets({{"run 3", {}, versions(2), {}}});
    bench.page.revertAction()->trigger();
    QCOMPARE(reverted.size(), 1);
  }

  void ofRunAndRigTheUserChooses() {
    Bench bench;
    QSignalSpy adopted(&bench.page, &GapPage::adoptRequested), reverted(&bench.page, &GapPage::revertRequested);
    auto* into = bench.page.findChild<QComboBox*>("adoptInto");
    // A rig of which the database has nothing yet takes a simulator, too.
    const std::vector<AdoptionTarget> both{{"run 3", {}, versions(1), {}}, {"rig leg", "/rigs/leg.json", {}, {}}};
    bench.page.setTargets(both, 1);
    QCOMPARE(into->currentText(), QString("rig leg"));
    QVERIFY(bench.page.adoptAction()->isEnabled());
    QVERIFY(!bench.page.revertAction()->isEnabled());
    bench.page.adoptAction()->trigger();
    QCOMPARE(adopted.last().at(2).toString(), QString("/rigs/leg.json"));

    // What was chosen stays while a run goes on, until another report is opened.
    into->setCurrentIndex(0);
    emit into->activated(0);
    bench.page.setTargets({{"run 3", {}, versions(3), {}}, {"rig leg", "/rigs/leg.json", versions(2), {}}}, 1);
    QCOMPARE(into->currentText(), QString("run 3, simulator version 2"));
    bench.page.revertAction()->trigger();
    QCOMPARE(reverted.last().at(0).toString(), QString());
    QVERIFY(bench.page.openReport(bench.folder.filePath("report")));
    bench.page.setTargets({{"run 3", {}, versions(3), {}}, {"rig leg", "/rigs/leg.json", versions(2), {}}}, 1);
    QCOMPARE(into->currentText(), QString("rig leg, simulator version 1"));
    bench.page.revertAction()->trigger();
    QCOMPARE(reverted.last().at(0).toString(), QString("/rigs/leg.json"));
    QVERIFY(into->isEnabled());
    bench.page.setTargets({{"rig leg", "/rigs/leg.json", versions(2), {}}});
    QVERIFY(!into->isEnabled());
  }

  void whatFoundNothingIsNotAdopted() {
    for (const auto& [verdict, why] : {std::pair{GapReport::Verdict::noMismatch, "agrees with the recordings"},
                                       std::pair{GapReport::Verdict::notExcited, "the recordings cannot tell"}}) {
      Bench bench;
      GapReport report = sampleReport();
      report.verdict = verdict;
      writeReport(report, bench.folder.filePath("nothing").toStdString());
      bench.page.setTargets({{"run 3", {}, versions(1), {}}});
      QVERIFY(bench.page.adoptAction()->isEnabled());
      QVERIFY(bench.page.openReport(bench.folder.filePath("nothing")));
      QVERIFY(!bench.page.adoptAction()->isEnabled());
      QVERIFY(bench.page.adoptAction()->toolTip().contains(why));
    }
  }

  void theGhostsStandInTheReportsOwnScene() {
    QTemporaryDir folder;
    GapReport report = sampleReport();
    QVERIFY(sceneOf(report).problem.contains("does not name its scene"));
    const QString scene = file(folder, "scene.json", R"({"format": "uchilsim-scene-1", "balls": [
        {"name": "ball", "mass_kg": 0.1, "radius_m": 0.04, "position_m": [0, 0, 0.04]}]})");
    report.scene = scene.toStdString();
    report.sceneSha256 = sha256(readFile(report.scene));
    const ReportScene known = sceneOf(report);
    QCOMPARE(known.problem, QString());
    QCOMPARE(known.scene.balls.size(), std::size_t(1));
    writeReport(report, folder.filePath("r").toStdString());
    QCOMPARE(loadReport(folder.filePath("r").toStdString()).scene, report.scene);
    file(folder, "scene.json", "{}");
    QVERIFY(sceneOf(report).problem.contains("has changed since the analysis"));
    QFile::remove(scene);
    QVERIFY(sceneOf(report).problem.contains("cannot be read"));
  }

  void aFittedFileIsNoHeldOutOne() {
    QTemporaryDir folder;
    AnalysisSetup setup;
    setup.setScene(SOURCE_DIR "/resources/scenes/xl330.json");
    const std::string text = "time_s,rig.hinge.position_rad\n0,0\n0.1,0.1\n";
    setup.addRecordings({file(folder, "a.csv", text), file(folder, "copy.csv", text)});
    QCOMPARE(setup.problem(), QString());
    setup.setHeldOut(1, true);
    QVERIFY(setup.problem().contains("copy.csv is held out, but the same file is fitted"));
    QVERIFY(!setup.findChild<QPushButton*>("startAnalysis")->isEnabled());
    setup.setHeldOut(1, false);
    QCOMPARE(setup.problem(), QString());
  }

  void theTableSaysWhatItsNumbersAre() {
    Bench bench;
    const EffectsTable& table = bench.page.view().effects();
    QVERIFY(table.horizontalHeaderItem(EffectsTable::gain)->toolTip().contains("cross-validated"));
    QCOMPARE(table.item(0, EffectsTable::qValue)->text(), QString("0.0076"));
    QCOMPARE(table.item(2, EffectsTable::parameters)->text(), QString::fromUtf8("torque_nm = 0.004 N·m"));
  }

  void adoptionSaysWhyItIsNotPossible() {
    Bench bench;
    bench.page.setTargets({{"run 3", {}, versions(2), "A process works on the run."}});
    QVERIFY(!bench.page.adoptAction()->isEnabled());
    QVERIFY(!bench.page.revertAction()->isEnabled());
    QCOMPARE(bench.page.adoptAction()->toolTip(), QString("A process works on the run."));
  }

  void thePageAndTheSuggestedCommandsAreExported() {
    Bench bench;
    QVERIFY(bench.page.exportTo(bench.folder.filePath("out.html")));
    QCOMPARE(readFile(bench.folder.filePath("out.html").toStdString()), toHtml(sampleReport()));
    QVERIFY(bench.page.saveNext(bench.folder.filePath("next.csv")));
    const Recording next = loadRecording(bench.folder.filePath("next.csv").toStdString());
    QCOMPARE(next.channels[1], std::string("leg.knee.command_rad"));
    QVERIFY(next.columns[1] == sampleReport().next.columns[1]);
    QSignalSpy failed(&bench.page, &GapPage::failed);
    QVERIFY(!bench.page.exportTo(bench.folder.filePath("none/out.html")));
    QCOMPARE(failed.size(), 1);
  }

  void aTrialIsShownAsRecordedWithTwoGhosts() {
    SceneSpec scene;
    scene.robots.emplace_back();
    scene.robots[0].name = "leg";
    scene.robots[0].position_m = {0, 0, 0.5};
    const GapReport report = sampleReport();
    const auto shown = ghostTrial(report, 1, scene, {});
    QVERIFY(shown.has_value());
    QCOMPARE(shown->recorded.trace.rows(), std::size_t(500));
    const int knee = shown->recorded.trace.column("leg.knee.position_rad");
    QVERIFY(knee > 0);
    QCOMPARE(shown->recorded.trace.at(9, std::size_t(knee)), report.trials[1].series[0].recorded[9]);
    QCOMPARE(shown->recorded.fixedBase.translation().z(), 0.5);
    QCOMPARE(shown->ghosts.size(), std::size_t(2));
    QCOMPARE(shown->ghosts[0].data.trace.at(9, std::size_t(knee)), report.trials[1].series[0].asGiven[9]);
    // The first three repaired values are not known: the first recorded one stands there.
    QCOMPARE(shown->ghosts[1].data.trace.at(2, std::size_t(knee)), report.trials[1].series[0].recorded[0]);
    QVERIFY(shown->ghosts[0].colour != shown->ghosts[1].colour);
    QVERIFY(!ghostTrial(report, 9, scene, {}));
    scene.robots[0].name = "other";
    QVERIFY(!ghostTrial(report, 1, scene, {}));
  }

  // Three files of somebody else's: each one's guess can be looked at, what was typed is kept, nonsense is said.
  void theMappingIsThatOfTheChosenRecording() {
    QTemporaryDir folder;
    const QString one = file(folder, "one.csv", "t;winkel\n0;0,5\n0,1;0,6\n"),
                  two = file(folder, "two.csv", "time,q\n0,1\n1,2\n"), none = file(folder, "none.csv", "\x82\xff\n");
    AnalysisSetup setup;
    QSignalSpy failed(&setup, &AnalysisSetup::failed);
    auto* recordings = setup.findChild<QTableWidget*>("recordings");
    auto* form = setup.findChild<MappingForm*>();
    setup.addRecordings({one});
    QCOMPARE(form->recording(), one);
    setup.addRecordings({two});
    QCOMPARE(form->recording(), two);
    recordings->setCurrentCell(0, 0);
    QCOMPARE(form->recording(), one);
    QCOMPARE(failed.count(), 0);
    form->table().item(0, MappingForm::scale)->setText("0.5");
    recordings->setCurrentCell(1, 0);
    QCOMPARE(form->recording(), one);
    QVERIFY(failed.takeFirst().at(0).toString().contains("one.csv has changes that are not saved"));
    form->undoStack().undo();
    setup.addRecordings({none});
    QVERIFY(failed.takeLast().at(0).toString().contains("none.csv"));
  }

  void aMappingOfOtherRecordingsIsNotOverwritten() {
    QTemporaryDir folder;
    const QString csv = file(folder, "swing.csv", "t,q\n0,1\n1,2\n"),
                  scenes = file(folder, "scene.mapping.json",
                                R"({"time_s": {"column": "t"}, "leg.knee.position_rad": {"column": "q"},
                                    "leg.knee.duty": {"column": "pwm"}})");
    const std::string before = readFile(scenes.toStdString());
    MappingForm form;
    form.open(csv, scenes);
    QVERIFY(!form.isValid());
    while (!form.isValid()) {
      const auto missing = std::ranges::find(form.draft().rows, "pwm", &MappingRow::column);
      form.table().setCurrentCell(int(missing - form.draft().rows.begin()), 0);
      form.removeRow();
    }
    form.save();
    QCOMPARE(readFile(scenes.toStdString()), before);
    QCOMPARE(form.file(), folder.filePath("swing.mapping.json"));
    QVERIFY(QFile::exists(form.file()));
    // One that fits is edited where it is, and is saved, whatever was looked at before.
    MappingForm own;
    own.open(file(folder, "guessed.csv", "t,q\n0,1\n1,2\n"));
    QVERIFY(own.isChanged() && !own.isEdited());
    own.open(csv, form.file());
    QCOMPARE(own.file(), form.file());
    QVERIFY(!own.isChanged());
  }

  void aMappingForTheWholeFolderServesItsOtherRecordings() {
    QTemporaryDir folder;
    const QString one = file(folder, "one.csv", "t [ms],q [°]\n0,10\n1,20\n");
    const QString two = file(folder, "two.csv", "t [ms],q [°]\n0,20\n1,10\n");
    MappingForm form;
    form.open(one);
    form.addRow();
    type(form.table(), 1, MappingForm::channel, "leg.knee.position_rad");
    type(form.table(), 1, MappingForm::column, "q [°]");
    // The headings say the units.
    QCOMPARE(form.table().item(0, MappingForm::unit)->text(), QString("ms"));
    QCOMPARE(form.table().item(1, MappingForm::unit)->text(), QString("deg"));
    auto* forAll = form.findChild<QCheckBox*>("mappingForAll");
    QVERIFY(!forAll->isChecked());
    QCOMPARE(form.file(), folder.filePath("one.mapping.json"));
    forAll->click();
    form.save();
    QCOMPARE(form.file(), folder.filePath("mapping.json"));
    MappingForm other;
    other.open(two);
    QCOMPARE(other.file(), folder.filePath("mapping.json"));
    QVERIFY(other.isValid() && !other.isChanged());
    QVERIFY(other.findChild<QCheckBox*>("mappingForAll")->isChecked());
    // What is made of it for one recording is that one's; what another form wrote is not written over.
    type(other.table(), 1, MappingForm::offset, "0.5");
    other.findChild<QCheckBox*>("mappingForAll")->click();
    other.save();
    QCOMPARE(other.file(), folder.filePath("two.mapping.json"));
    other.findChild<QCheckBox*>("mappingForAll")->click();
    QVERIFY_EXCEPTION_THROWN(other.save(), InputError);
    QCOMPARE(loadMapping(folder.filePath("mapping.json").toStdString()).columns[1].offset, 0.0);
  }

  void unitsAreReadFromHeadings() {
    const auto factor = [](const char* column, const char* channel) {
      return unitInHeading(QString::fromUtf8(column), channel).value_or(0);
    };
    const double deg = std::numbers::pi / 180;
    QCOMPARE(factor("angle (deg)", "a.b.position_rad"), deg);
    QCOMPARE(factor("angle / °", "a.b.position_rad"), deg);
    QCOMPARE(factor("pos_deg", "a.b.position_rad"), deg);
    QCOMPARE(factor("speed_deg_s", "a.b.velocity_rad_s"), deg);
    QCOMPARE(factor("vel_rad_s", "a.b.velocity_rad_s"), 1.0);
    QCOMPARE(factor("speed [rpm]", "a.b.velocity_rad_s"), std::numbers::pi / 30);
    QCOMPARE(factor("torque [mNm]", "a.b.torque_nm"), 1e-3);
    QCOMPARE(factor("Time {us}", "time_s"), 1e-6);
    QCOMPARE(factor("angle (deg)", "a.b.torque_nm"), 0.0);  // not a torque's unit
    QCOMPARE(factor("q", "a.b.position_rad"), 0.0);
    const MappingDraft draft = MappingDraft::guess({"Time [ms]", "q"});
    QCOMPARE(draft.rows.at(0).column, QString("Time [ms]"));
    QCOMPARE(draft.rows.at(0).scale, QString("0.001"));
  }

  // Half of a range is none: a form too narrow for all columns is scrolled.
  void whatAColumnGivesIsNeverCut() {
    QTemporaryDir folder;
    const QString csv = file(folder, "swing.csv", "t_ms,q\n0,-1.17525\n10,2.17525\n");
    file(folder, "swing.mapping.json",
         R"({"time_s": {"column": "t_ms", "scale": 0.001}, "leg.shoulder.position_rad": {"column": "q"}})");
    MappingForm form;
    form.open(csv);
    for (const int width : {300, 640, 1400}) {
      form.resize(width, 300);
      form.setVisible(true);
      QVERIFY(QTest::qWaitForWindowExposed(&form));
      const QTableWidget& table = form.table();
      const int text = table.fontMetrics().horizontalAdvance(table.item(1, MappingForm::range)->text());
      QVERIFY2(table.columnWidth(MappingForm::range) > text, qPrintable(QString::number(width)));
    }
  }

  void aMappingSurvivesBeingReadAndWritten() {
    QTemporaryDir folder;
    const QString csv = file(folder, "swing.csv", "t_ms,q,extra\n0,10,1\n10,20,1\n");
    const std::string text =
        R"({"time_s": {"column": "t_ms", "scale": 0.001},
            "leg.knee.position_rad": {"column": "q", "scale": -0.5, "offset": 0.25, "optional": true},
            "segments": {"column": "extra"}, "resample": {"period_s": 0.01, "lowpass_hz": 20},
            "settings": [{"file_contains": "kp8", "values": {"robots.leg.servos.knee.p": 8}}]})";
    file(folder, "swing.mapping.json", text);
    MappingForm form;
    form.open(csv);
    QVERIFY(form.isValid());
    QCOMPARE(form.draft().rows.size(), std::size_t(2));
    QVERIFY(form.draft().rows[1].flipped);
    QCOMPARE(form.table().item(1, MappingForm::range)->text(), QString("−9.75 … −4.75\u202Frad"));
    form.save();
    const Mapping before = mappingFromJson(text, "before"), after = loadMapping(form.file().toStdString());
    QCOMPARE(after.columns.size(), before.columns.size());
    for (std::size_t i = 0; i < before.columns.size(); ++i) {
      QCOMPARE(after.columns[i].channel, before.columns[i].channel);
      QCOMPARE(after.columns[i].column, before.columns[i].column);
      QCOMPARE(after.columns[i].scale, before.columns[i].scale);
      QCOMPARE(after.columns[i].offset, before.columns[i].offset);
      QCOMPARE(after.columns[i].optional, before.columns[i].optional);
    }
    QCOMPARE(after.settings.size(), std::size_t(1));
    QCOMPARE(after.segmentColumn, before.segmentColumn);
    QCOMPARE(after.period_s, 0.01);
    QCOMPARE(after.lowpass_hz, 20.0);
  }

  void everyShippedMappingCanBeKept() {
    const QDir folder(SOURCE_DIR "/resources/scenes");
    const QStringList names = folder.entryList({"*.mapping.json"});
    QVERIFY(names.size() > 3);
    for (const QString& name : names) {
      const Mapping before = loadMapping(folder.filePath(name).toStdString());
      const MappingDraft draft = MappingDraft::fromJson(readFile(before.source), before.source);
      QCOMPARE(draft.rows.size(), before.columns.size());
      const Mapping after = mappingFromJson(draft.toJson(), before.source);
      QCOMPARE(after.columns.size(), before.columns.size());
      QCOMPARE(after.settings.size(), before.settings.size());
      QCOMPARE(after.segmentColumn, before.segmentColumn);
      QCOMPARE(after.period_s, before.period_s);
      QCOMPARE(after.lowpass_hz, before.lowpass_hz);
    }
  }

  void whatIsNotAllowedIsMarkedSaidAndNotSaved() {
    QTemporaryDir folder;
    MappingForm form;
    form.open(file(folder, "swing.csv", "t,q\n0,10\n1,20\n"));
    form.addRow();
    QTableWidget& table = form.table();
    type(table, 1, MappingForm::channel, "leg.knee.position");
    type(table, 1, MappingForm::column, "q");
    type(table, 1, MappingForm::scale, "many");
    QVERIFY(!form.isValid());
    QVERIFY(table.item(1, MappingForm::channel)->toolTip().contains("leg.knee.position is not allowed"));
    QVERIFY(table.item(1, MappingForm::scale)->toolTip().contains("many is not allowed"));
    QVERIFY(table.item(1, MappingForm::scale)->background().style() != Qt::NoBrush);
    QVERIFY(table.item(1, MappingForm::column)->background().style() == Qt::NoBrush);
    QVERIFY(form.findChild<QLabel*>("problem")->text().contains("Line 2"));
    QVERIFY(!form.findChild<QPushButton*>("saveMapping")->isEnabled());
    QVERIFY_EXCEPTION_THROWN(form.save(), InputError);
    QVERIFY(!QFile::exists(form.file()));

    type(table, 1, MappingForm::channel, "leg.knee.position_rad");
    type(table, 1, MappingForm::unit, "deg");
    QVERIFY(form.isValid());
    form.save();
    QCOMPARE(form.file(), folder.filePath("swing.mapping.json"));
    QVERIFY(qAbs(loadMapping(form.file().toStdString()).columns[1].scale - 0.017453292519943295) < 1e-15 ||
            qAbs(loadMapping(form.file().toStdString()).columns[0].scale - 0.017453292519943295) < 1e-15);
  }

  void everyChangeOfAMappingCanBeUndone() {
    QTemporaryDir folder;
    MappingForm form;
    form.open(file(folder, "swing.csv", "time,leg.knee.position_rad\n0,1\n1,2\n"));
    const MappingDraft first = form.draft();
    QCOMPARE(first.rows.size(), std::size_t(2));
    type(form.table(), 1, MappingForm::offset, "0.5");
    form.table().item(1, MappingForm::flip)->setCheckState(Qt::Checked);
    form.table().setCurrentCell(0, 0);
    form.removeRow();
    QCOMPARE(form.draft().rows.size(), std::size_t(1));
    QVERIFY(!form.isValid());
    form.undoStack().undo();
    QVERIFY(form.draft().rows[1].flipped);
    form.undoStack().undo();
    form.undoStack().undo();
    QVERIFY(form.draft() == first);
    QVERIFY(!form.undoStack().canUndo());
    form.undoStack().redo();
    QCOMPARE(form.draft().rows[1].offset, QString("0.5"));
  }

  // What was adopted, or cited in a paper, is not written over by the next analysis.
  void aReportIsNotWrittenOver() {
    QTemporaryDir folder;
    AnalysisSetup setup;
    setup.setReportBase(folder.path());
    setup.addRecordings({SOURCE_DIR "/tests/data/bam_xl330/lift_and_drop_kp200_2026-01-15_10h28m49.csv"});
    const auto* out = setup.findChild<QLineEdit*>("out");
    const QString first = out->text();
    QVERIFY(!setup.keepEarlierReport());
    QCOMPARE(out->text(), first);
    for (int n = 2; n < 4; ++n) {
      QVERIFY(QDir().mkpath(out->text()));
      QFile report(out->text() + "/report.json");
      QVERIFY(report.open(QIODevice::WriteOnly));
      QVERIFY(setup.keepEarlierReport());
      QCOMPARE(out->text(), first + "-" + QString::number(n));
    }
    // Other recordings, another name, until somebody gives one.
    setup.recordings().setCurrentCell(0, 0);
    setup.removeRecording();
    setup.addRecordings({SOURCE_DIR "/tests/data/bam_xl330/sin_sin_kp800_2026-01-15_10h29m47.csv"});
    QCOMPARE(out->text(), folder.filePath("sin_sin_kp800_2026-01-15_10h29m47-gap-report"));
  }

  void theJobIsWhatTheFormSays() {
    QTemporaryDir folder;
    AnalysisSetup setup;
    QVERIFY(!setup.problem().isEmpty());
    QVERIFY(!setup.findChild<QPushButton*>("startAnalysis")->isEnabled());
    setup.setScene(SOURCE_DIR "/resources/scenes/xl330.json");
    const QString a = SOURCE_DIR "/tests/data/bam_xl330/lift_and_drop_kp200_2026-01-15_10h28m49.csv";
    const QString b = SOURCE_DIR "/tests/data/bam_xl330/sin_sin_kp800_2026-01-15_10h29m47.csv";
    setup.addRecordings({a, b, a});
    setup.setHeldOut(1, true);
    setup.findChild<QLineEdit*>("out")->setText(folder.filePath("report"));
    setup.findChild<QLineEdit*>("seed")->setText("7");
    QCOMPARE(setup.problem(), QString());
    QVERIFY(setup.findChild<QPushButton*>("startAnalysis")->isEnabled());
    QCOMPARE(setup.recordings().rowCount(), 2);
    const AnalysisJob job = setup.job();
    QCOMPARE(job.recordings, QStringList{a});
    QCOMPARE(job.heldOut, QStringList{b});
    QCOMPARE(argumentsOf(job),
             (QStringList{"gap", "analyse", SOURCE_DIR "/resources/scenes/xl330.json", "--recording", a, "--held-out",
                          b, "--seed", "7", "--out", folder.filePath("report"), "--progress"}));
    // The scene's own mapping is in the form.
    QVERIFY(setup.mapping().file().endsWith("xl330.mapping.json"));
    QVERIFY(setup.mapping().isValid());
    setup.findChild<QSpinBox*>("within")->setValue(3);
    QVERIFY(argumentsOf(setup.job()).join(' ').contains("--within 180 "));
    setup.findChild<QLineEdit*>("seed")->setText("-1");
    QVERIFY(setup.problem().contains("-1 is not allowed"));
  }

  void whatTheDoctorSaysStandsThereBeforeTheStart() {
    QTemporaryDir folder;
    AnalysisSetup setup;
    setup.setScene(SOURCE_DIR "/resources/scenes/xl330.json");
    const QString good = SOURCE_DIR "/tests/data/bam_xl330/lift_and_drop_kp200_2026-01-15_10h28m49.csv";
    const QString bad = folder.filePath("kp200.csv");
    QVERIFY(QFile::copy(good, bad));
    setup.addRecordings({good});
    auto& start = *setup.findChild<QPushButton*>("startAnalysis");
    auto& said = *setup.findChild<QLabel*>("doctorSays");
    auto& anyway = *setup.findChild<QCheckBox*>("asRecorded");
    QVERIFY(start.isEnabled());
    QVERIFY(!said.text().contains("a sign is turned"));
    QVERIFY(anyway.isHidden());

    // The same file with a mapping that turns the position's sign.
    std::string text = readFile(SOURCE_DIR "/resources/scenes/xl330.mapping.json");
    MappingDraft draft = MappingDraft::fromJson(text, "xl330.mapping.json");
    for (MappingRow& row : draft.rows)
      if (row.channel == "xl330.shoulder.position_rad") row.flipped = !row.flipped;
    file(folder, "kp200.mapping.json", draft.toJson().c_str());
    setup.addRecordings({bad});
    QVERIFY(said.text().contains("kp200.csv: xl330.shoulder.position_rad moves against"));
    QVERIFY(!anyway.isHidden());
    QVERIFY(!start.isEnabled());
    QVERIFY(setup.problem().contains("not what its name says"));
    anyway.setChecked(true);
    QVERIFY(start.isEnabled());
    QVERIFY(argumentsOf(setup.job()).contains("--as-recorded"));
  }

  void aVersionOfTheRunCanBeWhatIsAnalysed() {
    QTemporaryDir folder;
    // Keeps what it was given, and fails.
    const QString given = folder.filePath("given.json");
    const QString script = "#!/bin/sh\nwhile [ \"$1\" != --simulator ]; do shift; done\ncp \"$2\" '" + given +
                           "'\necho \"$1 $2\" >&2\nexit 1\n";
    const QString program = file(folder, "btr", script.toUtf8().constData());
    QFile::setPermissions(program, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    GapPage page(program);
    page.setup().setScene(SOURCE_DIR "/resources/scenes/xl330.json");
    page.setup().addRecordings({SOURCE_DIR "/tests/data/bam_xl330/lift_and_drop_kp200_2026-01-15_10h28m49.csv"});
    page.setup().findChild<QLineEdit*>("out")->setText(folder.filePath("report"));
    auto all = versions(2);
    all[1].simulator.values = {{"friction", 0.5}};
    page.setStarts({{"run 3", {}, all, {}}});
    page.findChild<QComboBox*>("simulator")->setCurrentIndex(1);  // the newest
    QSignalSpy failed(&page, &GapPage::failed);
    page.findChild<QPushButton*>("startAnalysis")->click();
    QVERIFY(failed.count() == 1 || failed.wait(10000));
    const QString kept = folder.filePath("report/simulator_before.json");
    QVERIFY(failed.first().first().toString().contains("--simulator " + kept));
    QVERIFY(loadSimulator(given.toStdString()) == all[1].simulator);
    QVERIFY(!QFileInfo::exists(folder.filePath("report")));  // nothing is left of what failed
  }

  void progressIsReadFromTheProcess() {
    QTemporaryDir folder;
    const QString program = file(folder, "btr",
                                 "#!/bin/sh\necho 'calibrating 0.25' >&2\necho 'screening effects 0.5' >&2\n"
                                 "echo 'scene.json: is wrong' >&2\nexit 1\n");
    QFile::setPermissions(program, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    AnalysisProcess process(program);
    QSignalSpy progressed(&process, &AnalysisProcess::progressed), failed(&process, &AnalysisProcess::failed);
    process.start({"scene.json", {"a.csv"}, {}, {}, {}, "out", 0, 1});
    QVERIFY(failed.wait(10000));
    QCOMPARE(progressed.size(), 2);
    QCOMPARE(progressed.at(1).at(0).toString(), QString("screening effects"));
    QCOMPARE(progressed.at(1).at(1).toDouble(), 0.5);
    QCOMPARE(failed.first().first().toString(), QString("scene.json: is wrong"));
  }

  void aFinishedAnalysisOpensItsReportAndACancelledOneDoesNot() {
    QTemporaryDir folder;
    writeReport(sampleReport(), folder.filePath("report").toStdString());
    const QString program = file(folder, "btr", "#!/bin/sh\nexit 0\n");
    QFile::setPermissions(program, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    GapPage page(program);
    QSignalSpy opened(&page, &GapPage::reportOpened);
    auto* tabs = page.view().findChild<QTabWidget*>();
    tabs->setCurrentIndex(3);
    page.process().start({"scene.json", {"a.csv"}, {}, {}, {}, folder.filePath("report"), 0, 1});
    QVERIFY(opened.wait(10000));
    QVERIFY(page.view().report() != nullptr);
    QCOMPARE(tabs->currentIndex(), 0);  // what was found

    file(folder, "btr", "#!/bin/sh\necho 'calibrating 0.1' >&2\nexec tail -f /dev/null\n");
    QSignalSpy progressed(&page.process(), &AnalysisProcess::progressed);
    QSignalSpy cancelled(&page.process(), &AnalysisProcess::cancelled);
    page.process().start({"scene.json", {"a.csv"}, {}, {}, {}, folder.filePath("other"), 0, 1});
    QVERIFY(progressed.wait(10000));
    page.process().cancel();
    QVERIFY(cancelled.wait(10000));
    QCOMPARE(opened.size(), 1);
  }

  void fitnessAloneIsAskedWhereEnoughIsMeasured() {
    QTemporaryDir folder;
    FitnessClues clues;
    clues.run = 4;
    clues.sentence = "Six individuals were measured.";
    clues.alike = 1;
    clues.clues = {{{"voltage_sag", "world", {{"per_torque_1_nm", 0.25}}}, 0.8, 0.01, {}},
                   {{"backlash", "ers7.LF_J1", {}}, 0.3, 0.6, {}}};
    writeFile(folder.filePath("answer.json").toStdString(), toJsonText(clues));
    const QString program = file(folder, "btr",
                                 "#!/bin/sh\necho \"$@\" > '" + folder.filePath("asked").toStdString() +
                                     "'\necho 'simulating with each effect 0.5' >&2\ncat '" +
                                     folder.filePath("answer.json").toStdString() + "'\n");
    QFile::setPermissions(program, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    GapPage page(program);
    auto* ask = page.clues().findChild<QPushButton*>("ask");
    auto* table = page.clues().findChild<QTableWidget*>("clues");
    auto* sentence = page.clues().findChild<QLabel*>("cluesSentence");
    QVERIFY(!ask->isEnabled());  // no run
    page.setMeasured("a.db", 4, 2);
    QVERIFY(!ask->isEnabled());
    QVERIFY(page.clues().findChild<QLabel*>("state")->text().contains("2 of this run's individuals"));
    page.setMeasured("a.db", 4, 6);
    QVERIFY(ask->isEnabled());
    QSignalSpy done(&page.clues().process(), &ProgramProcess::done);
    ask->click();
    QVERIFY(done.wait(10000));
    QCOMPARE(QString::fromStdString(readFile(folder.filePath("asked").toStdString())).trimmed(),
             QString("--json gap clues --db a.db --run 4 --progress"));
    QCOMPARE(sentence->text(), QString("Six individuals were measured."));
    QCOMPARE(table->rowCount(), 2);
    QCOMPARE(table->item(0, CluesView::effect)->text(), QString("voltage sag"));
    QVERIFY(table->item(0, CluesView::effect)->font().bold());
    QVERIFY(!table->item(1, CluesView::effect)->font().bold());
    page.setMeasured("a.db", 5, 6);  // another run: the answer was not about it
    QCOMPARE(table->rowCount(), 0);
    QVERIFY(sentence->text().isEmpty());
  }

  void aProgramThatIsNotThereIsAMessage() {
    AnalysisProcess process("/no/such/program");
    QSignalSpy failed(&process, &AnalysisProcess::failed);
    process.start({"scene.json", {"a.csv"}, {}, {}, {}, "out", 0, 1});
    if (failed.isEmpty()) QVERIFY(failed.wait(10000));
    QVERIFY(failed.first().first().toString().contains("cannot be started"));
  }
};

UI_TEST(TestGapPage)
#include "test_gap_page.moc"
