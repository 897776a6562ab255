// The page of a running world, through its widgets and with the real program: what hands did plays again bit for bit.
#include <QAction>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QMenu>
#include <QProcess>
#include <QPushButton>
#include <QSet>
#include <QSignalSpy>
#include <QSlider>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <QToolButton>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/spec/json_reader.h"
#include "tests/ui/open_live_page.h"
#include "tests/ui/ui_tests.h"
#include "ui/common/look/message_banner.h"

using namespace btr;
using namespace btr::ui;

namespace {

QAction* entry(QMenu* menu, const QString& text) {
  for (QAction* action : menu->actions())
    if (action->text() == text) return action;
  return nullptr;
}

}  // namespace

class TestLivePage : public QObject {
  Q_OBJECT
 private slots:
  // 1280 × 720 with a frame, menus and a title leaves this much.
  void theWholePageFitsASmallScreen() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.select("dog");
    constexpr int room = 540;
    QTRY_VERIFY2(open.page.minimumSizeHint().height() <= room,
                 qPrintable(QString::number(open.page.minimumSizeHint().height())));
  }

  void whoOpenedAWorldPlaysItByKey() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.page.activateWindow();
    QTRY_VERIFY(QApplication::activeWindow() == open.page.window());
    open.tree()->setFocus();
    open.page.open(open.file);
    QTRY_COMPARE(QApplication::focusWidget(), static_cast<QWidget*>(&open.page.view()));
    QVERIFY(open.isThere());
    QTRY_VERIFY(open.action("livePlay")->isEnabled());
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Space);
    QTRY_VERIFY(open.page.row().playing);
  }

  void everyButtonIsReachedWithoutAMouse() {
    OpenPage open;
    open.page.resize(1400, 600);
    QVERIFY(open.isThere());
    open.page.activateWindow();
    open.page.view().setFocus();
    QTRY_COMPARE(QApplication::focusWidget(), static_cast<QWidget*>(&open.page.view()));
    QSet<QWidget*> reached;
    for (QWidget* at = &open.page.view(); at && !reached.contains(at); at = QApplication::focusWidget()) {
      reached.insert(at);
      QTest::keyClick(at, Qt::Key_Tab);
    }
    for (const char* name :
         {"liveOpen", "livePlay", "liveStep", "liveReset", "liveAdd", "liveSaves", "liveShowSignals", "liveViews"}) {
      const QList<QObject*> shown = open.action(name)->associatedObjects();
      QVERIFY2(std::any_of(shown.begin(), shown.end(),
                           [&](QObject* each) { return reached.contains(qobject_cast<QToolButton*>(each)); }),
               name);
    }
    // Space opens a menu.
    QMenu* things = open.action("liveAdd")->menu();
    bool opened = false;
    connect(things, &QMenu::aboutToShow, this, [&] {
      opened = true;
      QTimer::singleShot(0, things, &QMenu::close);
    });
    for (QObject* each : open.action("liveAdd")->associatedObjects())
      if (auto* button = qobject_cast<QToolButton*>(each)) QTest::keyClick(button, Qt::Key_Space);
    QTRY_VERIFY(opened);
  }

  void aFileThatIsNoWorldLeavesTheOneThatIsThere() {
    OpenPage open;
    QVERIFY(open.isThere());
    QTemporaryDir folder;
    QFile log(folder.filePath("session.log"));
    QVERIFY(log.open(QIODevice::WriteOnly));
    log.write("{\"format\":\"uchilsim-log-1\",\"version\":\"0.2.0\"}\n{\"act\":\"pull\",\"period\":2}\n");
    log.close();
    const auto said = [&] { return open.page.findChild<MessageBanner*>()->text(); };
    open.page.openIfWorld(log.fileName());
    QVERIFY2(said().contains("session.log:1") && said().contains("game_sha256"), qPrintable(said()));
    open.page.openIfWorld(SOURCE_DIR "/resources/experiments/kick.json");
    QVERIFY2(said().contains("kick.json") && said().contains("session logs"), qPrintable(said()));
    QVERIFY(open.action("livePlay")->isEnabled());
    QVERIFY(open.isThere());
  }

  void buttonsStayWhereTheyAreWhileTheWorldPlays() {
    OpenPage open;
    QVERIFY(open.isThere());
    const auto* clock = open.page.findChild<QLabel*>("liveClock");
    const int width = clock->width(), left = clock->mapTo(&open.page, QPoint()).x();
    open.action("livePlay")->trigger();
    QTRY_VERIFY(clock->text().contains(QChar(0xd7)));
    QCOMPARE(clock->width(), width);
    QCOMPARE(clock->mapTo(&open.page, QPoint()).x(), left);
  }

  void playsStepsAndWaits() {
    OpenPage open;
    QVERIFY2(open.isThere(), qPrintable(open.page.findChild<MessageBanner*>()->text()));
    QCOMPARE(open.page.row().period, 0L);
    QVERIFY(!open.page.row().playing);
    QCOMPARE(open.count(), std::size_t(3));
    open.action("liveStep")->trigger();
    QTRY_COMPARE(open.page.row().period, 1L);
    QTest::keyClick(&open.page.view(), Qt::Key_Period);
    QTRY_COMPARE(open.page.row().period, 2L);
    QTest::keyClick(&open.page.view(), Qt::Key_Space);
    QTRY_VERIFY(open.page.row().playing);
    QTRY_VERIFY_WITH_TIMEOUT(open.page.row().period > 60, 20000);
    QTest::keyClick(&open.page.view(), Qt::Key_Space);
    QTRY_VERIFY(!open.page.row().playing);
    const long at = open.page.row().period;
    open.action("liveReset")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(!open.page.row().values.empty() && open.page.row().period == 0, 20000);
    QVERIFY(at > 60);
  }

  void whatIsUnderTheMouseIsPickedAndLed() {
    OpenPage open;
    QVERIFY(open.isThere());
    LiveView& view = open.page.view();
    const auto pixel = [&](double x, double y, double z) {
      const auto at = view.camera().project({x, y, z}, view.size());
      return at ? at->toPoint() : QPoint(-1, -1);
    };
    const QPoint ball = pixel(0.1, 0, 0.0425);
    QVERIFY(view.rect().contains(ball));
    QTest::mouseClick(&view, Qt::LeftButton, {}, ball);
    QCOMPARE(view.selected(), std::string("ball"));
    QCOMPARE(open.tree()->selectedItems().value(0)->text(0), QString("ball"));
    // Led while the world waits: it is put there.
    const QPoint there = pixel(0.1, -0.2, 0.0425);
    QTest::mousePress(&view, Qt::LeftButton, {}, ball);
    QTest::mouseMove(&view, there);
    QTest::mouseRelease(&view, Qt::LeftButton, {}, there);
    QTRY_VERIFY(std::abs(open.page.findChild<QDoubleSpinBox*>("liveY")->value() + 0.2) < 0.02);
    // A crate is picked anywhere on it, and not beside it.
    QCOMPARE(view.objectAt(pixel(0.05, 0.31, 0.09)), open.page.world().indexOf("crate"));
    QCOMPARE(view.objectAt(pixel(0.1, 0.55, 0.0)), -1);
    // Where nothing is the view turns.
    const double azimuth = view.camera().azimuth;
    QTest::mousePress(&view, Qt::LeftButton, {}, QPoint(5, 5));
    QTest::mouseMove(&view, QPoint(60, 5));
    QTest::mouseRelease(&view, Qt::LeftButton, {}, QPoint(60, 5));
    QVERIFY(view.camera().azimuth != azimuth);
  }

  void whatHandsDidPlaysAgainBitForBit() {
    OpenPage open;
    QVERIFY(open.isThere());
    LivePage& page = open.page;
    open.action("livePlay")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(page.row().period > 10, 20000);

    open.select("ball");
    QCOMPARE(page.view().selected(), std::string("ball"));
    page.findChild<QPushButton*>("liveThrow")->click();
    QMenu* things = open.action("liveAdd")->menu();
    entry(things, "Box that can be pushed")->trigger();
    QTRY_COMPARE(open.count(), std::size_t(4));
    QTRY_COMPARE(page.view().selected(), std::string("box"));
    emit page.view().ledTo("box", {0.2, 0.2, 0.3});
    const long led = page.row().period;
    QTRY_VERIFY_WITH_TIMEOUT(page.row().period > led + 20, 20000);
    emit page.view().letGo("box");

    open.select("dog");
    auto* slider = page.findChild<QSlider*>("slider.length_m");
    QVERIFY(slider);
    slider->setValue(slider->value() > 500 ? 200 : 800);
    const long tuned = page.row().period;
    QTRY_VERIFY_WITH_TIMEOUT(page.row().period > tuned + 20, 20000);
    auto* controller = page.findChild<QComboBox*>("liveController");
    controller->setCurrentIndex(0);
    emit controller->activated(0);
    open.select("crate");
    open.action("liveRemove")->trigger();
    QTRY_COMPARE(open.count(), std::size_t(3));
    open.action("livePlay")->trigger();
    QTRY_VERIFY(!page.row().playing);
    const QString saved = open.folder.filePath("later/game.json");
    QDir().mkpath(QFileInfo(saved).path());
    QSignalSpy done(&page.process(), &LiveProcess::saved);
    page.process().save(saved);
    QTRY_COMPARE(done.count(), 1);
    page.process().end();
    QCOMPARE(page.findChild<MessageBanner*>()->text().section(':', 0, 0), QString("Saved"));

    QProcess again;
    again.start(BTR_PROGRAM, {"--json", "live", open.file, "--replay", page.log()});
    QVERIFY(again.waitForFinished(60000));
    const nlohmann::json result = nlohmann::json::parse(again.readAllStandardOutput().toStdString());
    QVERIFY2(result.value("identical", false), result.dump().c_str());
    const std::string log = readFile(page.log().toStdString());
    for (const char* act : {"throw", "add", "pull", "let_go", "parameter", "controller", "remove", "checkpoint"})
      QVERIFY2(log.find("\"act\":\"" + std::string(act) + "\"") != std::string::npos, act);
    // What was saved opens again, and goes on.
    QProcess later;
    later.start(BTR_PROGRAM, {"--json", "live", saved, "--seconds", "0.5"});
    QVERIFY(later.waitForFinished(60000));
    QCOMPARE(later.exitCode(), 0);
  }

  void whatCannotBeOpenedIsSaidInOneSentence() {
    QTemporaryDir folder;
    LivePage page(plugins(), BTR_PROGRAM, {});
    auto* banner = page.findChild<MessageBanner*>();
    for (const auto& [content, why] : {std::pair{"{", "broken.json"},
                                       {R"({"format": "uchilsim-game-1"})", "a scene, or the path of a scene file"},
                                       {R"({"format": "uchilsim-grid-1"})", "uchilsim-game-1"}}) {
      const QString file = folder.filePath("broken.json");
      writeFile(file.toStdString(), content);
      banner->clear();
      page.open(file);
      QTRY_VERIFY_WITH_TIMEOUT(banner->text().contains(why), 10000);
      QVERIFY(!page.findChild<QAction*>("livePlay")->isEnabled());
    }
    LivePage lost(plugins(), folder.filePath("no-such-program"), {});
    lost.open(folder.filePath("broken.json"));
    QTRY_VERIFY(lost.findChild<MessageBanner*>()->text().contains("cannot be started"));
  }

  void aWorldThatStopsIsShownAsItWas() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.page.process().act(ThrowAct{"ball", {49, 0, 0}, {0, 0, 0}});
    open.page.process().setSpeed(0);
    open.page.process().play(true);
    QTRY_VERIFY_WITH_TIMEOUT(!open.page.row().fault.isEmpty(), 20000);
    QVERIFY(open.page.findChild<MessageBanner*>()->text().contains("The world stopped"));
    QVERIFY(!open.action("livePlay")->isEnabled());
    open.action("liveReset")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(open.action("livePlay")->isEnabled() && open.page.row().fault.isEmpty(), 20000);
  }
};

UI_TEST(TestLivePage)
#include "test_live_page.moc"
