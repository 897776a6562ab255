// Views and robots' cameras beside a running world.
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QFile>
#include <QImage>
#include <QMenu>
#include <cmath>

#include "tests/ui/open_live_page.h"
#include "tests/ui/ui_tests.h"
#include "ui/live/drawn/extra_view.h"
#include "ui/live/drawn/live_trails.h"
#include "ui/live/eyes/eye_picture.h"
#include "ui/live/live_desk.h"
#include "ui/live/panels/eye_panel.h"

using namespace btr;
using namespace btr::ui;

namespace {

constexpr int patience_ms = 20000;

LiveRow rowAt(double time_s, double x) {
  LiveRow row;
  row.values = {time_s, x, 0, 0.04, 1, 0, 0, 0};
  return row;
}

}  // namespace

class TestLiveViews : public QObject {
  Q_OBJECT

 private slots:
  // Whose file it is knows how large its robot is: it is seen whole and picked by any of its parts.
  void aRobotLargerThanADogIsSeenWholeAndPickedByItsHand() {
    OpenPage open;
    QVERIFY(open.isThere());
    const QString file = open.folder.filePath("arm.urdf");
    const std::string body =
        "<inertial><mass value='5'/><inertia ixx='1' iyy='1' izz='1'/></inertial>"
        "<visual><origin xyz='0 0 0.5'/><geometry><box size='0.1 0.1 1'/></geometry></visual>";
    writeFile(file.toStdString(),
              "<robot name='arm'><link name='world'/><link name='upper'>" + body + "</link><link name='hand'>" + body +
                  "</link><joint name='shoulder' type='continuous'><parent link='world'/><child link='upper'/></joint>"
                  "<joint name='elbow' type='continuous'><parent link='upper'/><child link='hand'/>"
                  "<origin xyz='0 0 1'/></joint></robot>");
    open.page.open(file);
    QTRY_VERIFY_WITH_TIMEOUT(open.page.world().indexOf("robot") >= 0 && !open.page.row().values.empty(), 20000);
    LiveView& view = open.page.view();
    QTRY_VERIFY(view.camera().distance > 2);
    for (const double z : {0.0, 1.0, 2.0}) {
      const auto pixel = view.camera().project({0, 0, z}, view.size());
      QVERIFY(pixel && QRectF(view.rect()).contains(*pixel));
    }
    const auto hand = view.camera().project({0, 0, 1.8}, view.size());
    QCOMPARE(view.objectAt(*hand), open.page.world().indexOf("robot"));
    QCOMPARE(view.objectAt(*hand + QPointF(60, 0)), -1);
    view.setCamera({});
    view.goHome();
    QVERIFY(view.camera().distance > 2);
  }

  void aRobotsCameraShowsFrames();
  void aStageChangesThePicture();
  void viewsFollowTheirObjects();
  void contactsComeWhileTheyAreDrawn();
  void viewsAreSavedWithTheGame();
  void trailsAreWaysThatWereGone();
};

void TestLiveViews::aRobotsCameraShowsFrames() {
  OpenPage open;
  QTRY_VERIFY_WITH_TIMEOUT(open.page.world().isReady(), patience_ms);
  EyePanel* eye = open.page.desk().addEye();
  QCOMPARE(eye->robot(), QString("dog"));
  // While the world waits there is a picture, too.
  QTRY_VERIFY_WITH_TIMEOUT(!eye->picture().frame().image.isNull(), patience_ms);
  QCOMPARE(eye->picture().frame().image.size(), QSize(208, 160));
  open.page.process().play(true);
  const auto first = eye->picture().frame().number;
  QTRY_VERIFY_WITH_TIMEOUT(eye->picture().frame().number > first + 5, patience_ms);
  const ShownFrame& frame = eye->picture().frame();
  QVERIFY(std::abs(frame.time_s - double(frame.number) / 30) < 1e-9);
  const QString file = open.folder.filePath("eye.png");
  QVERIFY(eye->savePicture(file));
  QCOMPARE(QImage(file).size(), QSize(208, 160));
}

void TestLiveViews::aStageChangesThePicture() {
  OpenPage open;
  QTRY_VERIFY_WITH_TIMEOUT(open.page.world().isReady(), patience_ms);
  EyePanel* eye = open.page.desk().addEye();
  QTRY_VERIFY_WITH_TIMEOUT(!eye->picture().frame().image.isNull(), patience_ms);
  const QImage with = eye->picture().frame().image;
  for (const CameraStage stage : {CameraStage::noise, CameraStage::vignetting, CameraStage::colour}) {
    auto* on = eye->findChild<QCheckBox*>("stage_" + QString::fromStdString(nameOf(stage)));
    QVERIFY(on && on->isChecked());
    const QImage before = eye->picture().frame().image;
    on->click();
    QTRY_VERIFY_WITH_TIMEOUT(eye->picture().frame().image != before, patience_ms);
  }
  for (const CameraStage stage : {CameraStage::noise, CameraStage::vignetting, CameraStage::colour})
    eye->setStage(stage, true);
  QTRY_COMPARE_WITH_TIMEOUT(eye->picture().frame().image, with, patience_ms);  // the same frame, the same noise
}

void TestLiveViews::viewsFollowTheirObjects() {
  OpenPage open;
  QTRY_VERIFY_WITH_TIMEOUT(open.page.world().isReady(), patience_ms);
  ExtraView* top = open.page.desk().addView();
  ExtraView* aboard = open.page.desk().addView();
  top->setMode(ViewMode::top);
  top->setObject("ball");
  aboard->setMode(ViewMode::aboard);
  aboard->setObject("dog");
  QCOMPARE(open.page.desk().views().size(), 2);
  open.page.process().play(true);
  QTRY_VERIFY_WITH_TIMEOUT(open.page.row().period > 60, patience_ms);
  open.page.process().play(false);
  QTRY_VERIFY_WITH_TIMEOUT(!open.page.row().playing, patience_ms);
  const LiveWorld& world = open.page.world();
  QVERIFY((top->view().camera().focus - world.poseOf("ball").translation()).norm() < 1e-9);
  QVERIFY(top->view().camera().elevation > 1.5);
  QVERIFY((aboard->view().camera().focus - world.poseOf("dog").translation()).norm() < 1e-9);
  QVERIFY(!aboard->view().picture({200, 150}).isNull());
}

void TestLiveViews::contactsComeWhileTheyAreDrawn() {
  OpenPage open;
  QTRY_VERIFY_WITH_TIMEOUT(open.page.world().isReady(), patience_ms);
  QVERIFY(open.page.row().contacts.empty());
  open.page.view().markAction(Mark::contacts)->trigger();
  open.page.process().step(25);
  QTRY_VERIFY_WITH_TIMEOUT(!open.page.row().contacts.empty(), patience_ms);
  double up_n = 0;
  for (const WorldMarks::Contact& contact : open.page.row().contacts) up_n += contact.force_n.z();
  QVERIFY(up_n > 0);
  open.page.view().markAction(Mark::contacts)->trigger();
  open.page.process().step(1);
  QTRY_VERIFY_WITH_TIMEOUT(open.page.row().contacts.empty(), patience_ms);
}

void TestLiveViews::viewsAreSavedWithTheGame() {
  OpenPage open;
  QTRY_VERIFY_WITH_TIMEOUT(open.page.world().isReady(), patience_ms);
  ExtraView* view = open.page.desk().addView();
  view->setMode(ViewMode::follow);
  view->setObject("ball");
  EyePanel* eye = open.page.desk().addEye();
  eye->setStage(CameraStage::noise, false);
  ViewCamera camera = open.page.view().camera();
  camera.distance = 2.5;
  open.page.view().setCamera(camera);
  const QString later = open.folder.filePath("later.json");
  open.page.process().save(later, open.page.desk().state());
  QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(later), patience_ms);

  LivePage other(plugins(), BTR_PROGRAM, {});
  other.open(later);
  QTRY_VERIFY_WITH_TIMEOUT(other.world().isReady(), patience_ms);
  QTRY_COMPARE_WITH_TIMEOUT(other.desk().views().size(), 1, patience_ms);
  QCOMPARE(other.desk().eyes().size(), 1);
  QCOMPARE(other.desk().views()[0]->mode(), ViewMode::follow);
  QCOMPARE(other.desk().views()[0]->object(), QString("ball"));
  QVERIFY(!other.desk().eyes()[0]->camera()[CameraStage::noise].on);
  QCOMPARE(other.view().camera().distance, 2.5);
  // What nobody can read is left out.
  other.desk().restore(R"({"docks": [{"view": 3}, {"eye": {"camera": "none"}}, 7], "camera": [], "layout": "x"})");
  other.desk().restore("no JSON");
}

void TestLiveViews::trailsAreWaysThatWereGone() {
  Game game;
  game.scene.balls = {BallSpec{"ball"}};
  std::vector<std::string> channels{"time_s"};
  for (const char* part : {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"})
    channels.push_back(std::string("ball.") + part);
  const LiveScene scene(game, {}, channels);
  LiveTrails trails;
  for (int i = 0; i <= 100; ++i) trails.add(scene, rowAt(0.01 * i, 0.0015 * i));  // 0.15 m/s
  QCOMPARE(trails.ways().size(), std::size_t(1));
  QCOMPARE(trails.ways()[0].size(), std::size_t(34));  // a place every 3 rows: 4.5 mm
  trails.add(scene, rowAt(1.01, 5));                   // put elsewhere
  QCOMPARE(trails.ways()[0].size(), std::size_t(1));
  trails.add(scene, rowAt(0, 0));  // time goes back
  QCOMPARE(trails.ways()[0].size(), std::size_t(1));
  for (int i = 1; i < 4000; ++i) trails.add(scene, rowAt(0.01 * i, 0.005 * i));
  QVERIFY(trails.ways()[0].size() <= LiveTrails::mostPlaces);
}

UI_TEST(TestLiveViews)
#include "test_live_views.moc"
