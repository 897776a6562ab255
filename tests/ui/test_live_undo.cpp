// Undo and redo of whatever hands did to a running world: one step a drag, with its name on the button.
#include <QAction>
#include <QSignalSpy>
#include <QSlider>
#include <cmath>

#include "tests/ui/open_live_page.h"
#include "tests/ui/ui_tests.h"
#include "ui/live/panels/slider_form.h"

using namespace btr;
using namespace btr::ui;

namespace {

double offAlong(OpenPage& open, const std::string& object, int axis, double wanted) {
  return std::abs(open.page.world().poseOf(object).translation()[axis] - wanted);
}

}  // namespace

class TestLiveUndo : public QObject {
  Q_OBJECT
 private slots:
  // The program says which words it knows.
  void initTestCase() {
    OpenPage open;
    QVERIFY(open.isThere());
    QSignalSpy refused(&open.page.process(), &LiveProcess::refused);
    open.page.process().undo();
    QTRY_COMPARE(refused.count(), 1);  // there is nothing to undo yet
    if (refused[0][0].toString().contains("play, pause")) QSKIP("btr live --steered cannot undo");
  }

  void aDragOfTwoObjectsIsOneStep() {
    OpenPage open;
    QVERIFY(open.isThere());
    QAction *undo = open.action("liveUndo"), *redo = open.action("liveRedo");
    QVERIFY(!undo->isEnabled() && !redo->isEnabled());
    open.select("ball");
    open.tree()->setCurrentItem(open.tree()->itemOf("crate"), 0, QItemSelectionModel::Select);
    for (int i = 1; i <= 10; ++i) emit open.page.view().ledTo("ball", {0.1 + 0.02 * i, 0, 0.0425});
    emit open.page.view().letGo("ball");
    QTRY_VERIFY(offAlong(open, "ball", 0, 0.3) < 1e-9 && offAlong(open, "crate", 0, 0.3) < 1e-9);
    QTRY_VERIFY(undo->isEnabled());
    QVERIFY(undo->toolTip().contains("move"));
    QTest::keyClick(&open.page.view(), Qt::Key_Z, Qt::ControlModifier);
    QTRY_VERIFY(offAlong(open, "ball", 0, 0.1) < 1e-9 && offAlong(open, "crate", 0, 0.1) < 1e-9);
    QTRY_VERIFY(!undo->isEnabled() && redo->isEnabled());
    QTest::keyClick(&open.page.view(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    QTRY_VERIFY(offAlong(open, "ball", 0, 0.3) < 1e-9 && offAlong(open, "crate", 0, 0.3) < 1e-9);
  }

  void whatWasTakenAwayOrDuplicatedComesBack() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.select("ball");
    open.action("liveRemove")->trigger();
    QTRY_COMPARE(open.count(), std::size_t(2));
    QTRY_VERIFY(open.action("liveUndo")->isEnabled());
    open.action("liveUndo")->trigger();
    QTRY_COMPARE(open.count(), std::size_t(3));
    QTRY_VERIFY(open.page.world().isReady());
    QVERIFY(offAlong(open, "ball", 0, 0.1) < 1e-9);
    open.select("dog");
    open.action("liveDuplicate")->trigger();
    QTRY_COMPARE(open.count(), std::size_t(4));
    open.action("liveUndo")->trigger();
    QTRY_COMPARE(open.count(), std::size_t(3));
  }

  void aSliderGoesBackInOneStep() {
    OpenPage open;
    QVERIFY(open.isThere());
    open.select("dog");
    auto* form = open.page.findChild<SliderForm*>("liveTuning");
    auto* slider = form->findChild<QSlider*>("slider.length_m");
    const double before = form->value("length_m");
    slider->setSliderDown(true);
    for (int step = 550; step <= 900; step += 50) slider->setValue(step);
    slider->setSliderDown(false);
    QVERIFY(std::abs(form->value("length_m") - before) > 0.01);
    QTRY_VERIFY(open.action("liveUndo")->isEnabled());
    open.action("liveUndo")->trigger();
    QTRY_COMPARE(form->value("length_m"), before);
    QTRY_VERIFY(!open.action("liveUndo")->isEnabled());
    open.action("liveRedo")->trigger();
    QTRY_VERIFY(std::abs(form->value("length_m") - before) > 0.01);
  }

  // The window shows what the session has, not what was done here.
  void whatIsUndoneIsNoLongerHeldOrPulled() {
    OpenPage open;
    QVERIFY(open.isThere());
    LiveWorld& world = open.page.world();
    QSignalSpy refused(&open.page.process(), &LiveProcess::refused);
    open.action("livePlay")->trigger();
    QTRY_VERIFY_WITH_TIMEOUT(open.page.row().period > 5, 20000);
    open.select("crate");
    QTest::keyClick(&open.page.view(), Qt::Key_Right);
    QCOMPARE(world.pulls().size(), std::size_t(1));
    QTRY_VERIFY(open.action("liveUndo")->isEnabled());
    open.action("liveUndo")->trigger();
    QTRY_VERIFY(world.pulls().empty());
    QTest::keyClick(&open.page.view(), Qt::Key_Escape);  // nothing is let go that nobody holds
    world.act(HoldAct{"dog", "LF_J1", 0.3, std::nullopt});
    QCOMPARE(world.held("dog").size(), std::size_t(1));
    QTRY_VERIFY(open.action("liveUndo")->isEnabled());
    open.action("liveUndo")->trigger();
    QTRY_VERIFY(world.held("dog").empty());
    open.action("liveRedo")->trigger();
    QTRY_COMPARE(world.held("dog"), (Values{{"LF_J1", 0.3}}));
    QCOMPARE(refused.count(), 0);
  }

  void aKeyThatRepeatsAsksForNoMoreThanThereIs() {
    OpenPage open;
    QVERIFY(open.isThere());
    QSignalSpy refused(&open.page.process(), &LiveProcess::refused);
    for (int i = 1; i <= 4; ++i) {
      emit open.page.view().ledTo("ball", {0.1 + 0.05 * i, 0, 0.0425});
      emit open.page.view().letGo("ball");
    }
    QTRY_VERIFY(offAlong(open, "ball", 0, 0.3) < 1e-9 && open.action("liveUndo")->isEnabled());
    for (int i = 0; i < 10; ++i) QTest::keyClick(&open.page.view(), Qt::Key_Z, Qt::ControlModifier);
    QTRY_VERIFY(offAlong(open, "ball", 0, 0.1) < 1e-9 && !open.action("liveUndo")->isEnabled());
    for (int i = 0; i < 10; ++i) QTest::keyClick(&open.page.view(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    QTRY_VERIFY(offAlong(open, "ball", 0, 0.3) < 1e-9 && !open.action("liveRedo")->isEnabled());
    QCOMPARE(refused.count(), 0);
  }
};

UI_TEST(TestLiveUndo)
#include "test_live_undo.moc"
