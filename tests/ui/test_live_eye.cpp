#include <QTest>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/camera/camera_spec.h"
#include "core/model/kinematics.h"
#include "core/spec/error.h"
#include "tests/ui/ui_tests.h"
#include "ui/live/drawn/view_mode.h"
#include "ui/live/eyes/live_eye.h"

using namespace btr;
using namespace btr::ui;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

constexpr double period_s = 0.008;

/// An ERS-7 that stands 0.2 m high at the origin and looks along x, and a ball.
struct DogAndBall {
  Game game;
  ModelSet models;
  std::vector<std::string> channels{"time_s"};

  DogAndBall() {
    RobotSpec robot;
    robot.name = "dog";
    robot.model = SOURCE_DIR "/resources/robots/ers7.wrl";
    BallSpec ball;
    ball.name = "ball";
    game.scene.floor = FloorSpec();
    game.scene.robots = {robot};
    game.scene.balls = {ball};
    models = loadModels(game.scene);
    for (const char* part : {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"}) {
      channels.push_back(std::string("dog.base.") + part);
    }
    for (const char* part : {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"})
      channels.push_back(std::string("ball.") + part);
  }

  LiveRow row(double time_s, const Vector3d& ball) const {
    LiveRow row;
    row.values = {time_s, 0, 0, 0.2, 1, 0, 0, 0, ball.x(), ball.y(), ball.z(), 1, 0, 0, 0};
    row.playing = true;
    return row;
  }

  /// Joints at zero.
  Isometry3d cameraPose(const CameraSpec& camera) const {
    const RobotModel& model = *models.begin()->second;
    const auto links = forwardKinematics(model, Isometry3d(Eigen::Translation3d(0, 0, 0.2)),
                                         std::vector<double>(model.joints.size(), 0.0));
    const auto& p = camera.mount.position_m;
    const auto& q = camera.mount.orientation_wxyz;
    return links.at(static_cast<std::size_t>(model.findLink(camera.mount.link))) *
           Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
  }
};

/// The ERS-7's, all stages off: a camera without errors.
CameraSpec plainCamera() {
  CameraSpec camera = loadCamera(SOURCE_DIR "/resources/cameras/ers7.json");
  for (StageSettings& stage : camera.stages) stage.on = false;
  return camera;
}

const SeenObject* seen(const EyeFrame& frame, const LiveEye& eye, const std::string& name) {
  for (const SeenObject& object : frame.picture.truth.seen)
    if (eye.objects().at(object.object - 1u) == name) return &object;
  return nullptr;
}

}  // namespace

class TestLiveEye : public QObject {
  Q_OBJECT

 private slots:
  void framesComeAtTheCamerasRate();
  void theBallIsWhereItProjectsTo();
  void aFrameStandsBetweenRows();
  void timeThatGoesBackBeginsAnew();
  void theSameRowsGiveTheSameBytes();
  void whatIsNotThereIsNamed();
  void viewsGoWithTheWorld();
  void aViewsCameraIsReadBack();
};

void TestLiveEye::framesComeAtTheCamerasRate() {
  const DogAndBall world;
  LiveEye eye(world.game, world.models, world.channels, "dog", plainCamera());
  std::vector<double> times;
  for (int i = 0; i <= 125; ++i) {
    eye.add(world.row(i * period_s, {1, 0, 0.3}));
    while (const auto frame = eye.next()) {
      QCOMPARE(frame->number, std::uint64_t(times.size()));
      times.push_back(frame->time_s);
    }
  }
  QCOMPARE(times.size(), std::size_t(31));  // at 0, 1/30 … 1 s
  for (std::size_t i = 0; i < times.size(); ++i) QCOMPARE(times[i], double(i) / 30);
}

void TestLiveEye::theBallIsWhereItProjectsTo() {
  const DogAndBall world;
  const CameraSpec camera = plainCamera();
  LiveEye eye(world.game, world.models, world.channels, "dog", camera);
  const Isometry3d pose = world.cameraPose(camera);
  const Vector3d ball = pose * Vector3d(0.8, 0.1, -0.08);
  eye.add(world.row(0, ball));
  const auto frame = eye.next();
  QVERIFY(frame);
  const SeenObject* told = seen(*frame, eye, "ball");
  QVERIFY(told);
  QVERIFY(std::abs(told->centreX_px - (camera.centreX_px - camera.focal_px * 0.1 / 0.8)) < 0.7);
  QVERIFY(std::abs(told->centreY_px - (camera.centreY_px + camera.focal_px * 0.08 / 0.8)) < 0.7);
  QVERIFY(!seen(*frame, eye, "dog") || seen(*frame, eye, "dog")->pixels < 208 * 160 / 10);  // not its own head
}

void TestLiveEye::aFrameStandsBetweenRows() {
  const DogAndBall world;
  const CameraSpec camera = plainCamera();
  LiveEye eye(world.game, world.models, world.channels, "dog", camera);
  const Isometry3d pose = world.cameraPose(camera);
  const double speed_m_s = 2;  // to the left: 13 px from frame to frame
  const auto place = [&](double time_s) { return pose * Vector3d(1, speed_m_s * (time_s - 0.1), 0); };
  int compared = 0;
  for (int i = 0; i <= 25; ++i) {
    eye.add(world.row(i * period_s, place(i * period_s)));
    while (const auto frame = eye.next()) {
      const SeenObject* told = seen(*frame, eye, "ball");
      QVERIFY(told);
      const double left_m = speed_m_s * (frame->time_s - 0.1);
      QVERIFY(std::abs(told->centreX_px - (camera.centreX_px - camera.focal_px * left_m)) < 0.7);
      ++compared;
    }
  }
  QCOMPARE(compared, 7);
}

void TestLiveEye::timeThatGoesBackBeginsAnew() {
  const DogAndBall world;
  LiveEye eye(world.game, world.models, world.channels, "dog", plainCamera());
  for (int i = 0; i <= 25; ++i) eye.add(world.row(1 + i * period_s, {1, 0, 0.3}));
  QCOMPARE(eye.next()->number, std::uint64_t(30));
  eye.add(world.row(0, {1, 0, 0.3}));
  QCOMPARE(eye.next()->number, std::uint64_t(0));
  QVERIFY(!eye.next());
}

void TestLiveEye::theSameRowsGiveTheSameBytes() {
  const DogAndBall world;
  const CameraSpec camera = loadCamera(SOURCE_DIR "/resources/cameras/ers7.json");
  const auto bytes = [&] {
    LiveEye eye(world.game, world.models, world.channels, "dog", camera);
    std::vector<std::uint8_t> all;
    for (int i = 0; i <= 20; ++i) {
      eye.add(world.row(i * period_s, {0.8 + 0.1 * i * period_s, 0, 0.2}));
      while (const auto frame = eye.next()) all.insert(all.end(), frame->picture.rgb.begin(), frame->picture.rgb.end());
    }
    return all;
  };
  const auto once = bytes();
  QVERIFY(once.size() >= std::size_t(4 * 208 * 160 * 3));
  QVERIFY(once == bytes());
}

void TestLiveEye::whatIsNotThereIsNamed() {
  const DogAndBall world;
  const auto refused = [&](const std::string& robot, const CameraSpec& camera) {
    try {
      LiveEye(world.game, world.models, world.channels, robot, camera);
    } catch (const InputError& error) {
      return QString::fromStdString(error.what());
    }
    return QString();
  };
  const QString noRobot = refused("cat", plainCamera());
  QVERIFY2(noRobot.contains("cat") && noRobot.contains("dog"), qPrintable(noRobot));
  CameraSpec camera = plainCamera();
  camera.mount.link = "TROLLEY";
  const QString noLink = refused("dog", camera);
  QVERIFY2(noLink.contains("TROLLEY"), qPrintable(noLink));
}

void TestLiveEye::viewsGoWithTheWorld() {
  const DogAndBall world;
  const LiveScene scene(world.game, world.models, world.channels);
  const LiveRow row = world.row(0, {1, 2, 0.3});
  const ViewCamera before;
  QVERIFY(cameraFor(ViewMode::free, "ball", before, scene, row) == before);
  const ViewCamera follows = cameraFor(ViewMode::follow, "ball", before, scene, row);
  QVERIFY(follows.focus.isApprox(Vector3d(1, 2, 0.3)));
  QCOMPARE(follows.azimuth, before.azimuth);
  // The dog looks along x: whoever looks over its shoulder stands on its −x side.
  const ViewCamera aboard = cameraFor(ViewMode::aboard, "dog", before, scene, row);
  QVERIFY(std::abs(std::abs(aboard.azimuth) - M_PI) < 1e-9);
  const ViewCamera top = cameraFor(ViewMode::top, "ball", before, scene, row);
  QVERIFY(top.eye().z() > 0.9 * before.distance);
  QVERIFY((top.eye() - top.focus).head<2>().norm() < 0.05 * before.distance);
  QVERIFY(cameraFor(ViewMode::follow, "nobody", before, scene, row) == before);
}

void TestLiveEye::aViewsCameraIsReadBack() {
  ViewCamera camera;
  camera.focus = {1, -2, 0.5};
  camera.distance = 3;
  camera.azimuth = 1;
  camera.elevation = 0.5;
  QVERIFY(viewCameraFrom(toJson(camera)) == camera);
  nlohmann::json strange{{"focus_m", {1, "two", nullptr}}, {"distance_m", 1e9}, {"elevation_rad", "up"}};
  const ViewCamera read = viewCameraFrom(strange);
  QCOMPARE(read.distance, 15.0);
  QCOMPARE(read.elevation, ViewCamera().elevation);
}

UI_TEST(TestLiveEye)
#include "test_live_eye.moc"
