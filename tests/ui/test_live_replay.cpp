// A session's log on the Scene page: played again with the same bits, gone to and fro in, gone on from; a moment of it
// as a scene and as the start of an experiment. Through the widgets and with the real program.
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <QToolButton>

#include "core/live/session_log.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/scene_spec.h"
#include "tests/ui/open_live_page.h"
#include "tests/ui/ui_tests.h"
#include "ui/common/look/message_banner.h"
#include "ui/common/look/theme.h"
#include "ui/experiment/experiment_form.h"
#include "ui/live/live_replayer.h"
#include "ui/live/panels/act_timeline.h"
#include "ui/live/panels/replay_bar.h"
#include "ui/main_window.h"

using namespace btr;
using namespace btr::ui;

namespace {

constexpr int patience_ms = 30000;

/// A page with a session of 200 control periods that is over, in which the ball was thrown at 60 and the crate taken
/// away at 120.
struct Played : OpenPage {
  QString log;

  Played() {
    if (!isThere()) qFatal("no world");
    go(60);
    page.process().act(ThrowAct{"ball", {0.6, 0.2, 0.8}, {0, 0, 0}});
    go(60);
    page.process().act(RemoveAct{"crate"});
    go(80);
    log = page.log();
  }
  void go(int periods) {
    const long from = page.row().period;
    page.process().step(periods);
    if (!QTest::qWaitFor([&] { return page.row().period == from + periods; }, patience_ms)) qFatal("it does not go on");
  }
  /// By the entry in the menu of Save.
  void replay() {
    action("liveReplaySession")->trigger();
    if (!QTest::qWaitFor([&] { return bar()->isEnabled() && page.row().replay && page.row().period == 0; },
                         patience_ms))
      qFatal("no replay");
  }
  ReplayBar* bar() { return page.findChild<ReplayBar*>(); }
  QString sameness() { return page.findChild<QLabel*>("replaySameness")->text(); }
  QString lastAct() { return page.findChild<QLabel*>("replayLastAct")->text(); }
  QString said() { return page.findChild<MessageBanner*>()->text(); }
  ActTimeline* line() { return page.findChild<ActTimeline*>(); }
  bool comesTo(long period) {
    return QTest::qWaitFor([&] { return page.row().replay && page.row().period == period; }, patience_ms);
  }
};

/// Types a name into the file dialog that comes next.
void chooseFile(const QString& file) {
  QTimer::singleShot(0, qApp, [file] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    QVERIFY(dialog);
    dialog->findChild<QLineEdit*>()->setText(file);
    QTest::keyClick(dialog->findChild<QLineEdit*>(), Qt::Key_Return);
  });
}

}  // namespace

class TestLiveReplay : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs); }

  void aSessionPlaysAgainWithTheSameBits() {
    Played open;
    open.replay();
    QVERIFY(open.bar()->isVisible());
    QCOMPARE(open.count(), std::size_t(3));
    QCOMPARE(open.line()->maximum(), 200);
    QTest::keyClick(&open.page.view(), Qt::Key_Period);
    QVERIFY(open.comesTo(1));
    QTest::keyClick(&open.page.view(), Qt::Key_Space);
    QVERIFY(open.comesTo(200));
    QTRY_VERIFY2(open.sameness().contains("Identical to the end, step 200"), qPrintable(open.sameness()));
    QTRY_COMPARE(open.count(), std::size_t(2));
    QTRY_VERIFY(!open.action("livePlay")->isEnabled());
    QVERIFY2(open.lastAct().contains("remove crate"), qPrintable(open.lastAct()));
  }

  void anotherSessionsBitsAreSaidToDiffer() {
    Played open;
    open.page.process().end();
    std::string text = readFile(open.log.toStdString());
    const auto at = text.find("[0.6,");
    QVERIFY(at != std::string::npos);
    text[at + 3] = '5';
    const QString other = open.folder.filePath("other.log");
    writeFile(other.toStdString(), text);
    open.page.openIfWorld(other);
    QVERIFY(open.comesTo(0));
    QTest::keyClick(&open.page.view(), Qt::Key_End);
    QVERIFY(open.comesTo(200));
    QTRY_VERIFY2(open.sameness().contains("between the steps 50 and 100"), qPrintable(open.sameness()));
  }

  void isGoneToAndFroInByKeysTimesAndStrokes() {
    Played open;
    open.replay();
    LiveView& view = open.page.view();
    QTest::keyClick(&view, Qt::Key_Right);  // a second
    QVERIFY(open.comesTo(125));
    QTest::keyClick(&view, Qt::Key_Left, Qt::ShiftModifier);
    QVERIFY(open.comesTo(120));
    QCOMPARE(open.count(), std::size_t(3));  // the crate is there again, or still
    open.page.findChild<QToolButton*>("replayActBefore")->click();
    QVERIFY(open.comesTo(60));
    open.page.findChild<QToolButton*>("replayActAfter")->click();
    QVERIFY(open.comesTo(120));
    auto* time = open.page.findChild<QDoubleSpinBox*>("replayTime");
    time->setFocus();
    time->selectAll();
    QTest::keyClicks(time, "1.2");
    QTest::keyClick(time, Qt::Key_Return);
    QVERIFY(open.comesTo(150));
    // A click on the stroke of the throw; what it is stands in its tip.
    ActTimeline* line = open.line();
    QPoint stroke;
    for (int x = 0; x < line->width() && stroke.isNull(); ++x)
      if (line->textAt({x, 5}).contains("throw ball")) stroke = {x + 4, line->height() / 2};
    QVERIFY(!stroke.isNull());
    QTest::mouseClick(line, Qt::LeftButton, {}, stroke);
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(open.page.row().period - 60) <= 2, patience_ms);
    QTest::keyClick(&view, Qt::Key_Home);
    QVERIFY(open.comesTo(0));
    QTest::keyClick(&view, Qt::Key_End);
    QVERIFY(open.comesTo(200));
    QTRY_VERIFY(open.sameness().contains("Identical to the end"));
  }

  void handsAreOffUntilItGoesOn() {
    Played open;
    open.replay();
    open.select("ball");
    for (const char* name : {"liveAdd", "liveRemove", "liveDuplicate", "liveUndo", "liveSaveLog", "liveReplaySession"})
      QVERIFY2(!open.action(name)->isEnabled(), name);
    QVERIFY(!open.page.findChild<QPushButton*>("liveThrow")->isEnabled());
    QTest::keyClick(&open.page.view(), Qt::Key_Delete);
    QVERIFY2(open.said().contains("Hands are off"), qPrintable(open.said()));
    emit open.page.view().ledTo("ball", {0, 0, 0.5});
    emit open.page.view().letGo("ball");
    QTest::keyClick(&open.page.view(), Qt::Key_End);
    QVERIFY(open.comesTo(200));
    QTRY_VERIFY(open.sameness().contains("Identical to the end"));  // nothing reached into it

    // To before the crate went; it stays then.
    QTest::keyClick(&open.page.view(), Qt::Key_Left, Qt::ShiftModifier);
    QVERIFY(open.comesTo(120));
    open.page.findChild<QPushButton*>("replayGoOn")->click();
    QTRY_VERIFY(!open.bar()->isVisible());
    QVERIFY(!open.page.row().replay);
    open.go(40);
    QCOMPARE(open.count(), std::size_t(3));
    open.page.world().select({"crate"});
    open.action("liveRemove")->trigger();
    QTRY_COMPARE(open.count(), std::size_t(2));
    // Its own log has all of it, from the first step.
    const QString all = open.page.log();
    open.action("liveUndo")->trigger();
    QTRY_COMPARE(open.count(), std::size_t(3));
    // What is undone last is that it went on.
    QTRY_VERIFY(open.action("liveUndo")->toolTip().contains("go on from here"));
    open.action("liveUndo")->trigger();
    QVERIFY(open.comesTo(120));
    QVERIFY(open.bar()->isVisible());
    open.page.open(all);
    QVERIFY(open.comesTo(0));
    QTest::keyClick(&open.page.view(), Qt::Key_End);
    QVERIFY(open.comesTo(160));
    QTRY_VERIFY2(open.sameness().contains("Identical to the end, step 160"), qPrintable(open.sameness()));
  }

  // Of a moment that is played again, too: what is saved does not disturb what follows.
  void aMomentBecomesASceneAGameAndAnExperiment() {
    Played open;
    open.replay();
    QTest::keyClick(&open.page.view(), Qt::Key_Right);
    QVERIFY(open.comesTo(125));
    QSignalSpy saved(&open.page.process(), &LiveProcess::saved), made(&open.page, &LivePage::experimentMade);
    const QString scene = open.folder.filePath("moment.json"), game = open.folder.filePath("later.json"),
                  experiment = open.folder.filePath("from-here.json");
    chooseFile(scene);
    open.action("liveSaveScene")->trigger();
    QTRY_COMPARE(saved.count(), 1);
    chooseFile(game);
    open.action("liveSave")->trigger();
    QTRY_COMPARE(saved.count(), 2);
    open.select("dog");
    chooseFile(experiment);
    open.action("liveExperiment")->trigger();
    QTRY_VERIFY2(made.count() == 1, qPrintable(open.said()));
    const SceneSpec is = loadScene(scene.toStdString());
    QCOMPARE(is.obstacles.size(), std::size_t(0));
    QVERIFY(is.robots.at(0).jointStart.size() >= 15);
    const ExperimentSpec learns = loadExperiment(experiment.toStdString());
    QCOMPARE(learns.controller.name, std::string("walk"));
    QCOMPARE(learns.fitness.name, std::string("walk_speed"));
    QTest::keyClick(&open.page.view(), Qt::Key_End);
    QVERIFY(open.comesTo(200));
    QTRY_VERIFY2(open.sameness().contains("Identical to the end"), qPrintable(open.sameness()));
    open.page.open(game);
    QTRY_VERIFY_WITH_TIMEOUT(!open.page.row().replay && open.page.row().period == 125, patience_ms);
  }

  // It is ours from there on: shown, and let go.
  void whatTheLogHoldsIsKnownWhereItGoesOn() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.page.process().act(HoldAct{"dog", "LF_J1", 0.3, std::nullopt});
    open.page.process().step(10);
    QTRY_COMPARE_WITH_TIMEOUT(open.page.row().period, 10L, patience_ms);
    open.action("liveReplaySession")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(open.page.row().replay && open.page.row().period == 0, patience_ms);
    QTest::keyClick(&open.page.view(), Qt::Key_End);
    QTRY_COMPARE_WITH_TIMEOUT(open.page.row().period, 10L, patience_ms);
    emit open.page.findChild<ReplayBar*>()->goOnWanted();
    QTRY_VERIFY_WITH_TIMEOUT(open.page.world().handsAreOn(), patience_ms);
    QTRY_COMPARE(open.page.world().held("dog"), (Values{{"LF_J1", 0.3}}));
  }

  // As they were written before the game stood in them: it is found where games are.
  void aLogWithoutItsGameFindsIt() {
    Played open;
    open.page.process().end();
    const std::string text = readFile(open.log.toStdString());
    const std::string sha = headOfSessionLog(open.log.toStdString()).gameSha256;
    const QString old = open.folder.filePath("old.log");  // beside game.json
    writeFile(old.toStdString(), "{\"format\":\"uchilsim-log-1\",\"version\":\"0.2.0\",\"game_sha256\":\"" + sha +
                                     "\"}\n" + text.substr(text.find('\n') + 1));
    open.page.open(old);
    QVERIFY(open.comesTo(0));
    QTest::keyClick(&open.page.view(), Qt::Key_End);
    QVERIFY(open.comesTo(200));
    QTRY_VERIFY(open.sameness().contains("Identical to the end"));
  }

  void aDamagedLogIsRefusedInOneSentence() {
    Played open;
    open.page.process().end();
    std::string text = readFile(open.log.toStdString());
    text.insert(text.find('\n') + 1, "{\"act\": \"fly\", \"period\": 1}\n");
    const QString bad = open.folder.filePath("bad.log");
    writeFile(bad.toStdString(), text);
    open.page.openIfWorld(bad);
    QTRY_VERIFY2(open.said().contains("bad.log:2"), qPrintable(open.said()));
    QVERIFY(!open.said().contains('\n'));
    QVERIFY(!open.action("livePlay")->isEnabled());
  }

  void theWindowTakesALogAndOpensTheExperiment() {
    Played played;
    played.page.process().end();
    Theme theme(*qApp);
    WindowOptions options;
    options.settingsFile = played.folder.filePath("settings.ini");
    options.program = BTR_PROGRAM;
    options.isActive = [](const std::string&, Id) { return false; };
    MainWindow window(std::make_shared<const PluginHost>(PLUGIN_DIR), theme, options);
    window.resize(1280, 720);
    window.show();
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(played.log)});
    QDragEnterEvent enter(QPoint(10, 10), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window, &enter);
    QDropEvent event(QPointF(10, 10), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&window, &event);
    auto* page = window.findChild<LivePage*>();
    QTRY_VERIFY2(page->row().replay, qPrintable(page->findChild<MessageBanner*>()->text()));
    QVERIFY(page->isVisible());
    const QString experiment = played.folder.filePath("learn.json");
    chooseFile(experiment);
    window.findChild<QAction*>("liveExperiment")->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(window.draft().spec().scene, std::string("learn.scene.json"), patience_ms);
    QVERIFY2(window.draft().isValid(), qPrintable(window.draft().problems().join("; ")));
    // And by the menu.
    chooseFile(played.log);
    window.findChild<QAction*>("replaySession")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(page->isVisible() && page->row().replay && page->row().period == 0, patience_ms);
  }
};

UI_TEST(TestLiveReplay)
#include "test_live_replay.moc"
