// The page of grids: cells chosen and replayed, the preview's point, maps computed beside it, and the window around it.
#include <QCheckBox>
#include <QComboBox>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>

#include "core/run/grid/grid_kicks.h"
#include "core/run/grid/grid_losses.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"
#include "tests/ui/ui_tests.h"
#include "ui/common/look/message_banner.h"
#include "ui/controllers/grid_controller.h"
#include "ui/experiment/parameter_field.h"
#include "ui/experiment/parameter_form.h"
#include "ui/grid/cube_view.h"
#include "ui/grid/grid_form.h"
#include "ui/grid/grid_page.h"
#include "ui/grid/kick_map.h"
#include "ui/grid/ramp.h"
#include "ui/main_window.h"
#include "ui/scene3d/replay_job.h"

using namespace btr;
using namespace btr::ui;

namespace {

/// kick.json in the folder: the short kick with a population of its own.
void writeSmallKick(const QTemporaryDir& folder, int population) {
  nlohmann::json experiment = nlohmann::json::parse(readFile(SOURCE_DIR "/resources/experiments/kick-short.json"));
  experiment["scene"] = SOURCE_DIR "/resources/scenes/kick.json";
  experiment["learner"]["settings"]["population"] = population;
  writeFile(folder.filePath("kick.json").toStdString(), experiment.dump());
}

GridSummary summaryOf(Id grid) {
  GridSummary s;
  s.grid.id = grid;
  s.grid.name = "kick";
  s.grid.method = "similarity";
  s.grid.seed = 7;
  s.spec.axes = {{{0.14, 0.18}, {-0.5, 0, 0.5}, {-1, 1}}};
  s.unit = "m";
  for (int cell = 1; cell <= 12; ++cell) {
    const int k = cell - 1;
    GridRow row;
    row.cell = cell;
    row.task = {s.spec.axes[0][static_cast<std::size_t>(k / 6)], s.spec.axes[1][static_cast<std::size_t>(k / 2 % 3)],
                s.spec.axes[2][static_cast<std::size_t>(k % 2)]};
    row.fitness = 0.1 * cell;
    row.run = 100 + cell;
    row.individual = 1000 + cell;
    s.rows.push_back(row);
  }
  s.rows[4].failed = true;
  s.rows[4].takenFrom = 3;
  s.edges = {{1, 2, 0.9}, {1, 3, 0.55}, {1, 7, 1}};
  return s;
}

GridMap mapOf(double distance) {
  GridMap map;
  map.distance_m = distance;
  map.bearings_rad = {-0.5, 0, 0.5};
  map.directions_rad = {-1, 1};
  map.unit = "m";
  const std::vector<Values> figures{{{"way_m", 1}, {"off_direction_rad", 0.1}, {"falls", 0}},
                                    {{"way_m", 1}, {"off_direction_rad", -0.5}, {"falls", 0}},
                                    {{"way_m", 0.4}, {"off_direction_rad", 0}, {"falls", 0}},
                                    {{"way_m", 1}, {"off_direction_rad", 0}, {"falls", 1}},
                                    {{"way_m", 1.2}, {"off_direction_rad", 0}, {"falls", 0}, {"largest_tilt_rad", 1}},
                                    {{"way_m", 1.1}, {"off_direction_rad", 0.26}, {"falls", 0}}};
  for (std::size_t k = 0; k < 6; ++k) {
    GridPoint point;
    point.number = static_cast<int>(k) + 1;
    point.task = {distance, map.bearings_rad[k / 2], map.directions_rad[k % 2]};
    point.fitness = 0.1 * static_cast<double>(k);
    point.figures = figures[k];
    point.figures[cellsWay] = 1;
    map.points.push_back(point);
  }
  return map;
}

/// A program that behaves like "btr grid map": says how far it is, then writes the map or waits to be cancelled.
QString programIn(const QTemporaryDir& folder, const std::string& map, bool waits = false) {
  writeFile(folder.filePath("map.json").toStdString(), map);
  const QString path = folder.filePath("program.sh");
  const std::string script =
      "#!/bin/sh\necho \"$@\" > '" + folder.filePath("arguments").toStdString() +
      "'\necho 'interpolated kicks 0.500' >&2\n" +
      (waits ? "exec cat /dev/zero > /dev/null\n" : "cat '" + folder.filePath("map.json").toStdString() + "'\n");
  writeFile(path.toStdString(), script);
  QFile::setPermissions(path, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
  return path;
}

}  // namespace

class TestGridPage : public QObject {
  Q_OBJECT

 private slots:
  void aClickChoosesACellAndADoubleClickReplaysIt() {
    GridPage page;
    page.resize(1000, 700);
    page.setGrids("a.db", {summaryOf(1)});
    page.show();
    QSignalSpy replayed(&page, &GridPage::replayRequested);
    const QPoint place = page.cube().centreOf(12).toPoint();
    QTest::mouseClick(&page.cube(), Qt::LeftButton, {}, place);
    QCOMPARE(page.cube().current(), 12);
    // The preview's point follows.
    QCOMPARE(page.point()[0], 0.18);
    QVERIFY(std::abs(page.point()[1] - 0.5) < 1e-3);
    QTest::mouseDClick(&page.cube(), Qt::LeftButton, {}, place);
    QCOMPARE(replayed.count(), 1);
    QCOMPARE(replayed[0][0].toLongLong(), 112);
    QCOMPARE(replayed[0][1].toLongLong(), 1012);
    QTest::keyClick(&page.cube(), Qt::Key_PageDown);
    QCOMPARE(page.cube().current(), 6);
    QTest::keyClick(&page.cube(), Qt::Key_Left);
    QCOMPARE(page.cube().current(), 6);  // the last bearing to the left
    QTest::keyClick(&page.cube(), Qt::Key_Down);
    QCOMPARE(page.cube().current(), 5);
    QTest::keyClick(&page.cube(), Qt::Key_Return);
    QCOMPARE(replayed.count(), 2);
  }

  void cellsNeverLieOnEachOtherAndLeftIsLeft() {
    CubeView cube;
    cube.setSummary(summaryOf(1));
    for (const QSize size : {QSize(300, 260), QSize(900, 600)}) {
      cube.resize(size);
      for (int a = 1; a <= 12; ++a) {
        QVERIFY(cube.rect().contains(cube.centreOf(a).toPoint()));
        for (int b = a + 1; b <= 12; ++b) {
          const QPointF away = cube.centreOf(a) - cube.centreOf(b);
          QVERIFY2(std::hypot(away.x(), away.y()) > 2 * cube.radius() * 0.8,
                   qPrintable(QString("%1 and %2 at %3").arg(a).arg(b).arg(size.width())));
        }
      }
      QVERIFY(cube.centreOf(5).x() < cube.centreOf(1).x());  // β = 0.5 against −0.5
      QVERIFY(cube.centreOf(2).y() < cube.centreOf(1).y());  // α = 1 against −1
    }
  }

  void aReplacedCellSaysSoAndIsDrawnOtherwise() {
    CubeView cube;
    cube.resize(600, 400);
    GridSummary summary = summaryOf(1);
    cube.setSummary(summary);
    QVERIFY(cube.describe(5).contains("solution of cell 3"));
    QVERIFY(!cube.describe(4).contains("solution of cell"));
    const QImage marked = cube.grab().toImage();
    summary.rows[4].failed = false;
    summary.rows[4].takenFrom = 0;
    cube.setSummary(summary);
    QVERIFY(cube.grab().toImage() != marked);
  }

  void aSliceShowsOneDistance() {
    GridPage page;
    page.resize(1000, 700);
    page.setGrids("a.db", {summaryOf(1)});
    page.cube().choose(1);
    page.cube().setSlice(1);
    QCOMPARE(page.cube().current(), 0);
    page.cube().choose(1);
    QCOMPARE(page.cube().current(), 0);
    page.cube().choose(7);
    QCOMPARE(page.cube().current(), 7);
  }

  void thePointStaysInsideTheGrid() {
    GridPage page;
    page.setGrids("a.db", {summaryOf(1)});
    page.setPoint({0.5, -3, 3});
    QCOMPARE(page.point(), (std::array{0.18, -0.5, 1.0}));
    QSignalSpy asked(&page, &GridPage::kickRequested);
    page.setPoint({0.15, 0.25, -0.5});
    for (QPushButton* button : page.findChildren<QPushButton*>())
      if (button->text() == "Play this kick") button->click();
    QCOMPARE(asked.count(), 1);
    QCOMPARE(asked[0][1].toDouble(), 0.15);
    QVERIFY(std::abs(asked[0][2].toDouble() - 0.25) < 2e-3);
  }

  void aGridThatStillLearnsHasNothingBetweenItsCells() {
    GridSummary half = summaryOf(2);
    half.rows.resize(3);
    GridPage page;
    page.setGrids("a.db", {summaryOf(1), half});
    page.choose(2);
    QCOMPARE(page.current(), Id(2));
    for (QPushButton* button : page.findChildren<QPushButton*>())
      if (button->text() == "Play this kick" || button->text() == "Compute map") QVERIFY(!button->isEnabled());
    page.setGrids("a.db", {summaryOf(1)});
    QCOMPARE(page.current(), Id(1));
    page.setGrids("a.db", {});
    QCOMPARE(page.current(), Id(0));
  }

  void lossesAreToldByTheirOrder() {
    const auto losses = lossesOf(mapOf(0.14));
    // The cells' kicks go 1 m: 0.4 m is less than half of it. 0.26 rad are just within 15°.
    const std::vector wanted{GridLoss::none,    GridLoss::direction, GridLoss::distance,
                             GridLoss::balance, GridLoss::balance,   GridLoss::none};
    QCOMPARE(losses, wanted);
    GridMap failed = mapOf(0.14);
    failed.points[0].outcome = "exploded";
    QCOMPARE(lossesOf(failed)[0], GridLoss::trial);
    // A map whose kicks all fall short of the cells' has lost them all.
    GridMap shortOnes = mapOf(0.14);
    for (GridPoint& point : shortOnes.points) point.figures = {{"way_m", 0.01}, {cellsWay, 1.0}};
    for (const GridLoss loss : lossesOf(shortOnes)) QCOMPARE(loss, GridLoss::distance);
  }

  void aMapIsComputedBesideTheWindowAndKeptForItsDistance() {
    const QTemporaryDir folder;
    GridPage page(programIn(folder, toJsonText(mapOf(0.14))));
    page.resize(1000, 700);
    page.setGrids("some.db", {summaryOf(4)});
    page.setPoint({0.14, 0, 0});
    QSignalSpy done(&page, &GridPage::mapDone), failed(&page, &GridPage::failed);
    page.computeMap();
    QVERIFY(page.isComputing());
    QVERIFY(done.wait(10'000));
    QCOMPARE(failed.count(), 0);
    const QString asked = QString::fromStdString(readFile(folder.filePath("arguments").toStdString()));
    QVERIFY2(asked.contains("grid map --db some.db --grid 4 --distance-m 0.14"), qPrintable(asked));
    QVERIFY(page.map().map());
    QCOMPARE(page.map().shareOf(GridLoss::balance), 2.0 / 6);
    QVERIFY(page.map().describe(1).contains("loses direction"));
    // What the fitness tells can be painted instead.
    const QImage lost = page.map().grab().toImage();
    page.map().setShown("off_direction_rad");
    QVERIFY(page.map().grab().toImage() != lost);
    // Another distance has no map yet; going back finds it.
    page.setPoint({0.16, 0, 0});
    QVERIFY(!page.map().map());
    page.setPoint({0.14, 0, 0});
    QVERIFY(page.map().map());
  }

  void aClickOnTheMapPlaysThatKick() {
    const QTemporaryDir folder;
    GridPage page(programIn(folder, toJsonText(mapOf(0.14))));
    page.resize(1000, 700);
    page.setGrids("some.db", {summaryOf(4)});
    page.setPoint({0.14, 0, 0});
    page.show();
    QSignalSpy done(&page, &GridPage::mapDone), asked(&page, &GridPage::kickRequested);
    page.computeMap();
    QVERIFY(done.wait(10'000));
    // The upper left corner: the ball to the left, the target to the left.
    const QPoint corner = page.map().frame().topLeft().toPoint() + QPoint(5, 5);
    QTest::mouseClick(&page.map(), Qt::LeftButton, {}, corner);
    QCOMPARE(asked.count(), 1);
    QVERIFY(std::abs(asked[0][2].toDouble() - 0.5) < 2e-3);
    QVERIFY(std::abs(asked[0][3].toDouble() - 1) < 2e-3);
  }

  void aMapCanBeCancelled() {
    const QTemporaryDir folder;
    GridPage page(programIn(folder, "", true));
    page.setGrids("some.db", {summaryOf(4)});
    QSignalSpy done(&page, &GridPage::mapDone), failed(&page, &GridPage::failed);
    page.computeMap();
    QVERIFY(QTest::qWaitFor([&] { return QFile::exists(folder.filePath("arguments")); }, 10'000));
    page.cancelMap();
    QVERIFY(QTest::qWaitFor([&] { return !page.isComputing(); }, 10'000));
    QCOMPARE(done.count() + failed.count(), 0);
    QVERIFY(!page.map().map());
  }

  void aMapThatIsNoneIsToldAndNothingIsShown() {
    const QTemporaryDir folder;
    GridPage page(programIn(folder, "{}"));
    page.setGrids("some.db", {summaryOf(4)});
    QSignalSpy failed(&page, &GridPage::failed);
    page.computeMap();
    QVERIFY(failed.wait(10'000));
    QVERIFY(failed[0][0].toString().contains("format"));
    QVERIFY(!page.map().map());
  }

  void coloursRiseInBrightness() {
    double before = -1;
    for (int i = 0; i <= 20; ++i) {
      const QColor c = rampColour(i / 20.0);
      const double brightness = 0.299 * c.red() + 0.587 * c.green() + 0.114 * c.blue();
      QVERIFY(brightness > before);
      before = brightness;
    }
    QCOMPARE(rampColour(-5), rampColour(0));
    QCOMPARE(rampColour(NAN), rampColour(0));
  }

  void aGridThatLearnsSaysHowFarAndMayBeStopped() {
    GridPage page;
    page.setGrids("a.db", {summaryOf(1), summaryOf(2)});
    auto* go = page.findChild<QPushButton*>("go");
    auto* learned = page.findChild<QProgressBar*>("learned");
    page.show();
    QVERIFY(!go->isVisible());
    page.setStates({{1, {true, false, 130, 600}}, {2, {false, true, 0, 0}}});
    QCOMPARE(learned->text(), QString("generation 130 of 600"));
    QSignalSpy stopped(&page, &GridPage::stopRequested), continued(&page, &GridPage::continueRequested);
    go->click();
    QCOMPARE(stopped.count(), 1);
    QCOMPARE(stopped[0][0].toLongLong(), 1);
    page.setStates({{1, {false, false, 130, 600}}, {2, {false, true, 0, 0}}});
    QCOMPARE(go->text(), QString("Continue"));
    go->click();
    QCOMPARE(continued.count(), 1);
    page.choose(2);
    QVERIFY(!go->isVisible());
    QVERIFY(!learned->isVisible());
  }

  void theFormKeepsWhatItsFileSays() {
    for (const char* name : {"kick-grid.json", "kick-grid-short.json"}) {
      const QString path = QString(SOURCE_DIR "/resources/grids/") + name;
      GridForm form;
      QVERIFY(!form.findChild<QPushButton*>("start")->isEnabled());
      form.openFile(path);
      QCOMPARE(form.problem(), QString());
      QVERIFY(!form.isModified());
      QCOMPARE(gridFileText(form.spec()), gridFileText(loadGrid(path.toStdString())));
      // Elsewhere it is the same grid, and its experiment is found.
      const QTemporaryDir folder;
      form.findChild<QLineEdit*>("seeds")->setText("3, 4");
      QVERIFY(form.isModified());
      const std::string there = folder.filePath("there.json").toStdString();
      writeFile(there, form.portableText());
      loadExperiment(loadGrid(there).experiment);
      form.saveFile(folder.filePath("saved.json"));
      QVERIFY(!form.isModified());
      QCOMPARE(form.problem(), QString());
      QCOMPARE(form.spec().seeds, (std::vector<std::uint64_t>{3, 4}));
      QCOMPARE(form.spec().axes, loadGrid(path.toStdString()).axes);
    }
  }

  void theFormSaysWhatIsWrongAndTakesDegrees() {
    GridForm form;
    form.openFile(SOURCE_DIR "/resources/grids/kick-grid-short.json");
    auto* start = form.findChild<QPushButton*>("start");
    auto* bearings = form.findChild<QLineEdit*>("bearings_rad");
    const auto refused = [&](QLineEdit* edit, const QString& text, const QString& word) {
      const QString before = edit->text();
      edit->setText(text);
      const bool said = form.problem().contains(word) && !start->isEnabled();
      edit->setText(before);
      return said && form.problem().isEmpty() && start->isEnabled();
    };
    QVERIFY(refused(bearings, "−20, x, 20", "\"x\""));
    // Decimal commas, where it is clear that they are: what could be one number or two is asked about.
    QVERIFY(refused(bearings, "−7,5, 7,5", "one number or two"));
    auto* distances = form.findChild<QLineEdit*>("distances_m");
    QVERIFY(refused(distances, "0,16", "one number or two"));
    const QString given = distances->text();
    for (const char* text : {"0.14, 0.16", "0.14,0.16", "0,14; 0,16", "0,14;0,16", "0,14 0,16"}) {
      distances->setText(text);
      QCOMPARE(form.spec().axes[0], (std::vector<double>{0.14, 0.16}));
    }
    distances->setText(given);
    const QString angles = bearings->text();
    bearings->setText("−20,−10,0,10,20");
    QCOMPARE(form.spec().axes[1].size(), std::size_t(5));
    bearings->setText(angles);
    QVERIFY(refused(bearings, "−20, 0, 30", "symmetric"));
    QVERIFY(refused(bearings, "", "bearings_rad"));
    QVERIFY(refused(form.findChild<QLineEdit*>("seeds"), "1.5", "whole numbers"));
    QVERIFY(refused(form.findChild<QLineEdit*>("seeds"), "1 1", "seeds"));
    QVERIFY(refused(form.findChild<QLineEdit*>("name"), " ", "name"));
    QVERIFY(refused(form.findChild<QLineEdit*>("experiment"), "none.json", "none.json"));
    for (const char* method : {"independent", "contamination", "similarity"})
      form.findChild<QCheckBox*>(method)->setChecked(false);
    QVERIFY(form.problem().contains("methods"));
    form.findChild<QCheckBox*>("similarity")->setChecked(true);
    bearings->setText("−30; 0; 30");
    QCOMPARE(form.problem(), QString());
    QCOMPARE(form.spec().axes[1], (std::vector<double>{-M_PI / 6, 0, M_PI / 6}));
    QCOMPARE(form.spec().methods, std::vector{GridSpec::Method::similarity});
  }

  // With the real program: described, started, stopped, continued, finished.
  void aGridIsLearnedFromItsFormToItsEnd() {
    const QTemporaryDir folder;
    const auto host = std::make_shared<const PluginHost>(PLUGIN_DIR);
    writeSmallKick(folder, 4);
    Database::open(folder.filePath("a.db").toStdString(), Database::Mode::create);
    Theme theme(*qApp);
    MainWindow window(host, theme, {folder.filePath("settings.ini"), BTR_PROGRAM});
    window.show();
    QVERIFY(window.openDatabase(folder.filePath("a.db")));
    window.showPage("grid");
    window.gridPage().findChild<QPushButton*>("new")->click();
    auto* form = window.findChild<GridForm*>();
    QVERIFY(form);
    form->findChild<QLineEdit*>("experiment")->setText(folder.filePath("kick.json"));
    for (const auto& [axis, text] : {std::pair("distances_m", "0.16"), {"bearings_rad", "0"}, {"directions_rad", "0"}})
      form->findChild<QLineEdit*>(axis)->setText(text);
    for (const char* method : {"contamination", "similarity"}) form->findChild<QCheckBox*>(method)->setChecked(false);
    form->findChild<ParameterForm*>()->field("generations")->setText("300");
    form->findChild<ParameterForm*>()->field("points")->setText("1");
    QCOMPARE(form->problem(), QString());
    // What the controller does not allow is said in the form, in its words and units; nothing starts.
    form->findChild<QLineEdit*>("bearings_rad")->setText("-100, 0, 100");
    QCOMPARE(form->problem(), QString("Bearings of the ball: -100° is not allowed; -68.75° to 68.75°"));
    QVERIFY(!form->findChild<QPushButton*>("start")->isEnabled());
    form->findChild<QLineEdit*>("bearings_rad")->setText("0, abc");
    QVERIFY2(form->problem().startsWith("Bearings of the ball: \"abc\""), qPrintable(form->problem()));
    form->findChild<QLineEdit*>("bearings_rad")->setText("0");
    QCOMPARE(form->problem(), QString());
    form->findChild<QPushButton*>("start")->click();

    auto* go = window.gridPage().findChild<QPushButton*>("go");
    const auto stored = [&] { return Database::open(folder.filePath("a.db").toStdString(), Database::Mode::readOnly); };
    QTRY_VERIFY_WITH_TIMEOUT(go->isVisible() && go->text() == "Stop" && !stored().runs().empty(), 60'000);
    go->click();
    QTRY_VERIFY_WITH_TIMEOUT(window.bench().watcher().activeGrids().empty(), 60'000);
    QVERIFY2(window.banner().text().isEmpty(), qPrintable(window.banner().text()));
    QVERIFY(stored().runs().front().generation < 300);
    QTRY_COMPARE(go->text(), QString("Continue"));
    go->click();
    QTRY_VERIFY_WITH_TIMEOUT(isGridFinished(stored(), 1) && window.bench().watcher().activeGrids().empty(), 120'000);
    QTRY_VERIFY(!go->isVisible());
    QVERIFY2(window.banner().text().isEmpty(), qPrintable(window.banner().text()));
  }

  // What only the program can see: it is told, and nothing is left half begun.
  void aGridThatTheProgramRefusesIsAMessage() {
    const QTemporaryDir folder;
    Database::open(folder.filePath("a.db").toStdString(), Database::Mode::create);
    Theme theme(*qApp);
    MainWindow window(std::make_shared<const PluginHost>(PLUGIN_DIR), theme,
                      {folder.filePath("settings.ini"), BTR_PROGRAM});
    window.show();
    QVERIFY(window.openDatabase(folder.filePath("a.db")));
    window.showPage("grid");
    window.gridPage().findChild<QPushButton*>("new")->click();
    auto* form = window.findChild<GridForm*>();
    nlohmann::json experiment = nlohmann::json::parse(readFile(SOURCE_DIR "/resources/experiments/kick-short.json"));
    experiment["scene"] = "gone.json";
    writeFile(folder.filePath("kick.json").toStdString(), experiment.dump());
    form->findChild<QLineEdit*>("experiment")->setText(folder.filePath("kick.json"));
    QCOMPARE(form->problem(), QString());
    form->findChild<QPushButton*>("start")->click();
    QTRY_VERIFY_WITH_TIMEOUT(window.banner().text().contains("gone.json"), 60'000);
    QVERIFY(Database::open(folder.filePath("a.db").toStdString(), Database::Mode::readOnly).grids().empty());
  }

  void theWindowShowsAStoredGridAndPlaysAKickBetweenItsCells() {
    const QTemporaryDir folder;
    const auto host = std::make_shared<const PluginHost>(PLUGIN_DIR);
    writeSmallKick(folder, 2);
    const nlohmann::json grid{{"format", "uchilsim-grid-1"},
                              {"name", "tiny"},
                              {"experiment", "kick.json"},
                              {"distances_m", {0.14}},
                              {"bearings_rad", {-0.3, 0.3}},
                              {"directions_rad", {0}},
                              {"methods", {"independent"}},
                              {"seeds", {1}},
                              {"settings", {{"generations", 1}, {"points", 0}}}};
    const std::string file = folder.filePath("grid.json").toStdString();
    writeFile(file, grid.dump());
    {
      Database db = Database::open(folder.filePath("a.db").toStdString(), Database::Mode::create);
      const Id id = startGrid(db, *host, loadGrid(file), GridSpec::Method::independent, 1);
      QCOMPARE(continueGrid(db, *host, id, StopFlag{false}, {.workers = 1, .workforce = nullptr, .progress = {}}),
               RunEnd::finished);
    }
    Theme theme(*qApp);
    MainWindow window(host, theme, {folder.filePath("settings.ini"), BTR_PROGRAM});
    window.show();
    QVERIFY(window.openDatabase(folder.filePath("a.db")));
    window.grids().show(1);
    QVERIFY(window.gridPage().isVisible());
    window.bench().reader().waitUntilIdle();
    QCOMPARE(window.gridPage().current(), Id(1));
    // A cell's replay selects its run.
    ReplayJob* job = window.findChild<ReplayJob*>();
    QVERIFY(job);
    QSignalSpy finished(job, &ReplayJob::finished), failed(job, &ReplayJob::failed);
    emit window.gridPage().cube().replayRequested(1);
    QVERIFY(finished.wait(60'000));
    QCOMPARE(finished[0][0].value<ReplayData>().check, ReplayData::Check::identical);
    emit window.gridPage().kickRequested(1, 0.14, 0.1, 0);
    QVERIFY(finished.wait(60'000));
    const auto shown = finished[1][0].value<ReplayData>();
    QVERIFY(shown.title.contains("interpolated"));
    QCOMPARE(shown.check, ReplayData::Check::notChecked);
    QVERIFY(shown.trace.rows() > 50);
    QCOMPARE(failed.count(), 0);
    // The runs come back, and the other page takes the place of this one.
    window.showPage("analysis");
    QVERIFY(!window.gridPage().isVisible());
    window.showPage("grid");
    QVERIFY(window.gridPage().isVisible());
    window.showPage({});
    QVERIFY(!window.gridPage().isVisible());
  }
};

UI_TEST(TestGridPage)
#include "test_grid_page.moc"
