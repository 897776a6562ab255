// What goes wrong around a world loses nothing, and is said: files that are no world, a disk without room, a process
// that dies, folders that cannot be made. Through the widgets and with the real program.
#include <signal.h>

#include <QApplication>
#include <QComboBox>
#include <QFileDialog>
#include <QLineEdit>
#include <QMessageBox>
#include <QProcess>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalSpy>
#include <QTimer>
#include <QToolButton>

#include "core/live/session_log.h"
#include "tests/ui/open_live_page.h"
#include "tests/ui/ui_tests.h"
#include "ui/common/look/message_banner.h"
#include "ui/live/live_tools.h"
#include "ui/live/panels/signals_panel.h"

using namespace btr;
using namespace btr::ui;

namespace {

constexpr int patience_ms = 30000;

QString saidBy(LivePage& page) { return page.findChild<MessageBanner*>()->text(); }

/// The real program behind a line of shell.
QString programAfter(const QTemporaryDir& folder, const QString& line) {
  const QString file = folder.filePath("btr-behind");
  writeFile(file.toStdString(), "#!/bin/sh\n" + line.toStdString() + "\nexec '" BTR_PROGRAM "' \"$@\"\n");
  QFile::setPermissions(file, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
  return file;
}

nlohmann::json emptyScene() {
  return {{"format", "uchilsim-scene-1"}, {"step_s", 0.008}, {"control_period_s", 0.008}, {"floor", {{"friction", 1}}}};
}

/// A game of one dog.
std::string dogGame(const char* model, const char* controller) {
  nlohmann::json scene = emptyScene();
  scene["robots"] = {{{"name", "dog"}, {"model", model}}};
  nlohmann::json players;
  players["dog"]["controller"]["plugin"] = controller;
  return nlohmann::json{{"format", "uchilsim-game-1"}, {"scene", scene}, {"robots", players}}.dump();
}

/// A game of a ball alone.
QString ballIn(const QTemporaryDir& folder) {
  const QString file = folder.filePath("ball.json");
  nlohmann::json scene = emptyScene();
  scene["balls"] = {{{"name", "ball"}, {"position_m", {0, 0, 0.0425}}}};
  writeFile(file.toStdString(), nlohmann::json{{"format", "uchilsim-game-1"}, {"scene", scene}}.dump());
  return file;
}

bool isThere(LivePage& page) {
  return QTest::qWaitFor([&] { return page.process().isReady() && !page.row().values.empty(); }, patience_ms);
}

QAction* action(LivePage& page, const char* name) { return page.findChild<QAction*>(name); }

/// Types a name into the file dialog that comes next, and lets it overwrite.
void chooseFile(const QString& file) {
  QTimer::singleShot(0, qApp, [file] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    QVERIFY(dialog);
    QTimer::singleShot(0, qApp, [] {
      if (auto* question = qobject_cast<QMessageBox*>(QApplication::activeModalWidget()))
        question->button(QMessageBox::Yes)->click();
    });
    dialog->findChild<QLineEdit*>()->setText(file);
    QTest::keyClick(dialog->findChild<QLineEdit*>(), Qt::Key_Return);
  });
}

}  // namespace

class TestLiveFaults : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs); }

  void aFileThatCannotBecomeAWorldLeavesTheOneThatRuns() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.action("livePlay")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(open.page.row().period > 10, patience_ms);
    const QString bad = open.folder.filePath("bad.json"), log = open.page.log();
    const nlohmann::json bare{{"format", "uchilsim-game-1"}};
    for (const auto& [content, why] :
         {std::pair<std::string, const char*>{"{", "bad.json"},
          {bare.dump(), "a scene"},
          {dogGame("no-such-dog.wrl", "walk"), "no-such-dog.wrl"},
          {dogGame(SOURCE_DIR "/resources/robots/ers7.wrl", "somersault"), "somersault"}}) {
      writeFile(bad.toStdString(), content);
      const long period = open.page.row().period;
      open.page.open(bad);
      QVERIFY2(saidBy(open.page).contains(why) && saidBy(open.page).contains("goes on"), qPrintable(saidBy(open.page)));
      QTRY_VERIFY_WITH_TIMEOUT(open.page.row().period > period, patience_ms);
      QCOMPARE(open.page.file(), open.file);
      QCOMPARE(open.page.log(), log);
    }
  }

  void whatARobotFileLosesIsSaid() {
    QTemporaryDir folder;
    const QString robot = folder.filePath("arm.urdf");
    writeFile(robot.toStdString(),
              "<robot name='arm'><link name='world'/><link name='upper'>"
              "<inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01'/></inertial>"
              "<collision><geometry><mesh filename='package://arm/upper.stl'/></geometry></collision></link>"
              "<joint name='shoulder' type='continuous'><parent link='world'/><child link='upper'/></joint></robot>");
    LivePage page(plugins(), BTR_PROGRAM, folder.filePath("sessions"));
    page.open(robot);
    QVERIFY(isThere(page));
    QTRY_VERIFY_WITH_TIMEOUT(saidBy(page).contains("upper.stl") && saidBy(page).contains("collides with nothing"),
                             patience_ms);
  }

  void everyWorldHasTheSpeedThatIsShown() {
    QTemporaryDir folder;
    const QString told = folder.filePath("told");
    LivePage page(plugins(), programAfter(folder, "tee '" + told + "' | '" BTR_PROGRAM "' \"$@\"; exit"), {});
    const QString game = ballIn(folder);
    page.open(game);
    QVERIFY(isThere(page));
    auto* speed = page.findChild<QComboBox*>("liveSpeed");
    speed->setCurrentIndex(0);
    emit speed->activated(0);
    page.open(game);
    QVERIFY(isThere(page));
    QTRY_VERIFY_WITH_TIMEOUT(QByteArray::fromStdString(readFile(told.toStdString())).contains("\"times\":0.1"),
                             patience_ms);
  }

  void nothingIsOfferedToAWorldThatDied() {
    QTemporaryDir folder;
    const QString number = folder.filePath("pid");
    LivePage page(plugins(), programAfter(folder, "echo $$ > '" + number + "'"), folder.filePath("sessions"));
    page.show();
    page.open(ballIn(folder));
    QVERIFY(isThere(page));
    page.world().select({"ball"});
    const char* const offers[] = {"livePlay", "liveStep", "liveSave",   "liveSaveScene", "liveExperiment",
                                  "liveAdd",  "liveUndo", "liveRemove", "liveDuplicate"};
    page.world().act(ThrowAct{"ball", {0.1, 0, 0}, {0, 0, 0}});
    for (const char* name : offers) QTRY_VERIFY2(action(page, name)->isEnabled(), name);
    QCOMPARE(::kill(pid_t(std::stol(readFile(number.toStdString()))), SIGKILL), 0);
    QTRY_VERIFY2(saidBy(page).contains("crashed"), qPrintable(saidBy(page)));
    for (const char* name : offers) QVERIFY2(!action(page, name)->isEnabled(), name);
    // What was done until then is kept, and the world can be opened again.
    QVERIFY(action(page, "liveSaveLog")->isEnabled());
    QCOMPARE(loadSessionLog(page.log().toStdString()).acts.size(), std::size_t(1));
    page.world().act(ThrowAct{"ball", {0.1, 0, 0}, {0, 0, 0}});
    QVERIFY2(saidBy(page).contains("Reset"), qPrintable(saidBy(page)));
    action(page, "liveReset")->trigger();
    QVERIFY(isThere(page));
    for (const char* name : {"livePlay", "liveStep", "liveSave", "liveAdd"})
      QTRY_VERIFY2(action(page, name)->isEnabled(), name);
  }

  void aWorldGoesOnWhereItsLogHasNoMoreRoom() {
    QTemporaryDir folder;
    // Files of at most 8 blocks of 512 bytes.
    LivePage page(plugins(), programAfter(folder, "trap '' XFSZ; ulimit -f 8"), folder.filePath("sessions"));
    page.open(ballIn(folder));
    QVERIFY(isThere(page));
    QSignalSpy lost(&page.process(), &LiveProcess::logLost);
    for (int i = 0; i < 60; ++i) {
      page.world().act(ThrowAct{"ball", {0.01, 0, 0}, {0, 0, 0}});
      page.process().step(1);
    }
    QTRY_COMPARE_WITH_TIMEOUT(page.row().period, 60L, patience_ms);
    QCOMPARE(lost.count(), 1);
    QVERIFY2(saidBy(page).contains("goes on") && saidBy(page).contains("log ends here"), qPrintable(saidBy(page)));
    // What stands in it is the session's beginning, and plays again.
    const SessionLog log = loadSessionLog(page.log().toStdString());
    QVERIFY(log.acts.size() > 5 && log.acts.size() < 60);
    page.process().end();
    QProcess again;
    again.start(BTR_PROGRAM, {"--json", "live", "--replay", page.log()});
    QVERIFY(again.waitForFinished(patience_ms));
    QCOMPARE(again.exitCode(), 0);
  }

  void aWorldRunsWhereNoLogCanBeWritten() {
    QTemporaryDir folder;
    for (const bool noFolder : {true, false}) {
      const QString logs = noFolder ? "/proc/uchilsim/sessions" : folder.filePath("sessions");
      LivePage page(plugins(), noFolder ? QString(BTR_PROGRAM) : programAfter(folder, "trap '' XFSZ; ulimit -f 0"),
                    logs);
      page.open(ballIn(folder));
      QVERIFY2(isThere(page), qPrintable(saidBy(page)));
      QTRY_VERIFY2(saidBy(page).contains("no log of this session is kept", Qt::CaseInsensitive),
                   qPrintable(saidBy(page)));
      page.process().step(3);
      QTRY_COMPARE_WITH_TIMEOUT(page.row().period, 3L, patience_ms);
      QVERIFY(!action(page, "liveSaveLog")->isEnabled());
      QVERIFY(!action(page, "liveReplaySession")->isEnabled());
    }
  }

  void aLogThatIsSavedOverItselfStays() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.page.process().act(ThrowAct{"ball", {0.6, 0.2, 0.8}, {0, 0, 0}});
    open.page.process().step(1);
    QTRY_COMPARE(open.page.row().period, 1L);
    chooseFile(open.page.log());
    open.action("liveSaveLog")->trigger();
    QCOMPARE(loadSessionLog(open.page.log().toStdString()).acts.size(), std::size_t(1));
    // One that is there and cannot be written stays, too.
    const QString copy = open.folder.filePath("copy.log");
    chooseFile(copy);
    open.action("liveSaveLog")->trigger();
    QCOMPARE(readFile(copy.toStdString()), readFile(open.page.log().toStdString()));
    chooseFile("/proc/uptime");
    open.action("liveSaveLog")->trigger();
    QVERIFY2(saidBy(open.page).contains("/proc/uptime"), qPrintable(saidBy(open.page)));
  }

  void plotsHaveRoomOnASmallScreen() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.page.resize(780, 540);
    open.action("liveShowSignals")->trigger();
    auto* panel = open.page.findChild<SignalsPanel*>();
    QTRY_VERIFY(panel->isVisible());
    QTRY_VERIFY2(panel->findChild<QScrollArea*>()->width() >= 200,
                 qPrintable(QString::number(panel->findChild<QScrollArea*>()->width())));
  }
};

UI_TEST(TestLiveFaults)
#include "test_live_faults.moc"
