// Robots' own programs on the page of a running world: their lines, lamps and ends; a stick as a controller.
#include <QComboBox>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QProcess>
#include <QPushButton>
#include <QTableWidget>
#include <QTemporaryDir>

#include <cmath>

#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"
#include "tests/ui/open_live_page.h"
#include "tests/ui/ui_tests.h"
#include "ui/live/drawn/lamp_places.h"
#include "ui/live/drawn/live_lines.h"
#include "ui/live/live_desk.h"
#include "ui/live/panels/console_panel.h"
#include "ui/live/panels/selection_panel.h"
#include "ui/live/stored_controller.h"

using namespace btr;
using namespace btr::ui;

namespace {

/// The page's row as its process told it, with more in it.
LiveRow rowWith(LivePage& page, const nlohmann::json& more) {
  nlohmann::json line{{"row", page.row().values},
                      {"period", page.row().period},
                      {"playing", false},
                      {"real_time_factor", 1},
                      {"fixed", nlohmann::json::array()}};
  line.update(more);
  return liveRowFrom(line);
}

GameController stickAt(const QString& folder) {
  GameController controller;
  controller.openr = GameStick{folder.toStdString(), "", true, false};
  return controller;
}

}  // namespace

class TestLivePrograms : public QObject {
  Q_OBJECT

 private slots:
  /// The console comes by itself with the first program, and shows lines by robot and object.
  void linesLampsAndEndsAreShown() {
    OpenPage open;
    QVERIFY(open.isThere());
    QVERIFY(!open.page.findChild<ConsolePanel*>());
    emit open.page.process().rowTold(rowWith(
        open.page,
        {{"programs", {{"dog", {{"running", true}}}, {"cat", {{"running", true}}}}},
         {"console", {{"dog", "MovingHead7", "DoStart()"}, {"cat", "Other", "meow"}}},
         {"orders",
          {{"dog", {{"motor_power", true}, {"lamps", {{"face_13", {{"brightness", 0.5}, {"mode", "A"}}}}}}}}}}));
    auto* console = open.page.findChild<ConsolePanel*>();
    QVERIFY(console);
    auto* states = open.page.findChild<QLabel*>("programStates");
    QVERIFY2(states->text().contains("dog runs"), qPrintable(states->text()));
    // What was said in the row with which the console came is there, too.
    QCOMPARE(console->text()->toPlainText(), QString("dog MovingHead7: DoStart()\ncat Other: meow"));
    QCOMPARE(console->lamps()->rowCount(), 1);
    QCOMPARE(console->lamps()->item(0, 1)->text(), QString("face_13"));
    QCOMPARE(console->lamps()->item(0, 2)->text(), QString("50 %"));
    QCOMPARE(console->lamps()->item(0, 3)->text(), QString("A"));
    auto* robot = open.page.findChild<QComboBox*>("consoleRobot");
    robot->setCurrentIndex(robot->findText("dog"));
    emit robot->activated(robot->currentIndex());
    QCOMPARE(console->text()->toPlainText(), QString("dog MovingHead7: DoStart()"));
    emit open.page.process().rowTold(
        rowWith(open.page, {{"programs", {{"dog", {{"running", false}, {"what", "MovingHead7 crashed in Ready"}}}}}}));
    QVERIFY2(states->text().contains("MovingHead7 crashed in Ready"), qPrintable(states->text()));
    open.picture("programs");
  }

  /// A stick is a controller like others; what is wrong with it is said, and the window and its world go on.
  void aStickIsAControllerThatCanFail() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.select("dog");
    auto* controller = open.page.findChild<QComboBox*>("liveController");
    QVERIFY(controller->findText("OPEN-R stick…") == controller->count() - 1);
    open.page.world().act(ControllerAct{"dog", stickAt(open.folder.filePath("no-stick"))});
    auto* panel = open.page.findChild<SelectionPanel*>();
    panel->showSelected();
    QCOMPARE(controller->currentIndex(), controller->count() - 1);
    QVERIFY(open.page.findChild<QLabel*>("stickFolder")->text().contains("no-stick"));
    QVERIFY(QTest::qWaitFor([&] { return open.page.findChild<QLabel*>("programStates") != nullptr; }, 10000));
    QVERIFY(open.page.findChild<QLabel*>("programStates")->text().contains("no-stick"));
    open.page.process().play(true);
    const long now = open.page.row().period;
    QVERIFY(QTest::qWaitFor([&] { return open.page.row().period > now + 10; }, 10000));
    QCOMPARE(open.page.row().fault, QString());
    open.page.findChild<QPushButton*>("stickStop")->click();
    QVERIFY(!open.page.world().playerOf("dog").controller);
  }

  /// A real program: it is built, put in, runs while the world plays, moves a joint, speaks, and is taken out.
  void aProgramOnAStickMovesTheRobot() {
    OpenPage open;
    QVERIFY(open.isThere());
    const QString stick = open.folder.filePath("MS");
    QProcess build;
    build.start(BTR_PROGRAM, {"openr", "build", SOURCE_DIR "/resources/openr/PanPath", "--out", stick});
    QVERIFY(build.waitForFinished(60000));
    QVERIFY2(build.exitCode() == 0, build.readAllStandardError());
    open.page.world().act(ControllerAct{"dog", stickAt(stick)});
    open.page.process().play(true);
    const auto pan = [&] {
      const auto dog = open.page.world().indexOf("dog");
      return open.page.world().scene().jointsOf(std::size_t(dog), open.page.row()).at("HEAD_PAN");
    };
    QVERIFY(QTest::qWaitFor([&] { return std::abs(pan()) > 0.3; }, 20000));
    const auto* console = open.page.findChild<ConsolePanel*>();
    QVERIFY(console);
    QVERIFY2(console->text()->toPlainText().contains("dog PanPath: pan gains 8 2 4"),
             qPrintable(console->text()->toPlainText()));
    QVERIFY(open.page.row().orders.at("dog").motorPower.value_or(false));
    open.page.world().act(ControllerAct{"dog", std::nullopt});
    QVERIFY(QTest::qWaitFor([&] { return open.page.row().orders.empty(); }, 10000));
  }

  /// An individual of a run of such programs plays with the numbers that it had in its trials.
  void aStoredIndividualIsItsStickWithItsNumbers() {
    OpenPage open;
    QVERIFY(open.isThere());
    const QString stick = open.folder.filePath("MS"), sticks = open.folder.filePath("sticks");
    QProcess build;
    build.start(BTR_PROGRAM, {"openr", "build", SOURCE_DIR "/resources/openr/PanPath", "--out", stick});
    QVERIFY(build.waitForFinished(60000));
    QVERIFY2(build.exitCode() == 0, build.readAllStandardError());
    ExperimentSpec spec = loadExperiment(SOURCE_DIR "/resources/experiments/pan-gains.json");
    spec.controller.words["stick"] = stick.toStdString();
    RunRecord run;
    run.id = 7;
    run.specJson = toJsonText(spec);
    IndividualRecord individual;
    individual.id = 3;
    for (const Parameter& p : plugins().controller("openr")->with({{"stick", stick.toStdString()}})->genotype())
      individual.parameters.push_back(p.name == "pan_p" ? 12 : p.byDefault);
    const GameController controller = storedController(run, individual, plugins(), sticks.toStdString());
    QVERIFY(controller.openr);
    QVERIFY(controller.openr->motorPower);
    QVERIFY(QString::fromStdString(controller.openr->folder).startsWith(sticks + "/run-7-individual-3-"));
    QCOMPARE(storedController(run, individual, plugins(), sticks.toStdString()), controller);
    open.page.world().act(ControllerAct{"dog", controller});
    open.page.process().play(true);
    QTRY_VERIFY_WITH_TIMEOUT(open.page.findChild<ConsolePanel*>() &&
                                 open.page.findChild<ConsolePanel*>()->text()->toPlainText().contains("pan gains 12 "),
                             20000);
    individual.parameters.push_back(1);
    QVERIFY_THROWS_EXCEPTION(InputError, storedController(run, individual, plugins(), sticks.toStdString()));
  }

  /// A program or controller that hangs is named; that is no end of the session.
  void whoHangsIsNamed() {
    QTemporaryDir folder;
    QFile program(folder.filePath("world"));
    QVERIFY(program.open(QIODevice::WriteOnly));
    program.write("#!/bin/sh\necho '{\"hangs\": \"red1 does not answer\"}'\nread line\n");
    program.close();
    program.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    LiveProcess process(program.fileName());
    QStringList named, failed;
    connect(&process, &LiveProcess::hangs, this, [&](const QString& who) { named << who; });
    connect(&process, &LiveProcess::failed, this, [&](const QString& why) { failed << why; });
    process.start("game.json", {});
    QVERIFY(QTest::qWaitFor([&] { return !named.isEmpty(); }, 10000));
    QCOMPARE(named, QStringList{"red1 does not answer"});
    QVERIFY(process.isRunning());
    QVERIFY2(failed.isEmpty(), qPrintable(failed.join('\n')));
  }

  /// Every lamp of the table of places sits on a link that the model has, and shines in its mode's colour.
  void lampsShineInTheirColour() {
    Orders orders;
    orders.lamps["face_13"] = {1, "B"};
    int shown = 0;
    for (const LampSpot& spot : lampSpots("ERS-7"))
      if (const QColor colour = shining(spot, orders); colour.isValid()) {
        ++shown;
        QVERIFY(colour.blue() > colour.red());
      }
    QCOMPARE(shown, 2);
    QVERIFY(lampSpots("a robot of mine").empty());
  }
};

UI_TEST(TestLivePrograms)
#include "test_live_programs.moc"
