#include <QTest>
#include <algorithm>
#include <cmath>

#include "core/model/kinematics.h"
#include "core/sim/scene.h"
#include "tests/ui/small_robot.h"
#include "tests/ui/ui_tests.h"
#include "ui/scene3d/eye_renderer.h"
#include "ui/scene3d/scene_builder.h"

using namespace btr;
using namespace btr::ui;
using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

namespace {

constexpr double ball_m = 0.0425;

Isometry3d at(double x, double y, double z) { return Isometry3d(Translation3d(x, y, z)); }
/// x down, y left.
Isometry3d lookingDown(double x, double y, double z) { return at(x, y, z) * AngleAxisd(M_PI / 2, Vector3d::UnitY()); }

/// 208 × 160 pixels whose middle lies between four of them.
Pinhole eye() { return {}; }

std::size_t pixel(const Pinhole& pinhole, int x, int y) { return std::size_t(y * pinhole.width + x); }

/// A further robot beside a ball of its own scene.
void fill(SceneBuilder& scene, const Vector3d& ball) {
  scene.setGround(Ground::plain);
  scene.setFurtherRobots({test::smallRobot()});
  scene.setBalls({ball_m});
  ScenePose pose;
  pose.balls = {at(ball.x(), ball.y(), ball.z())};
  scene.setPose(pose);
}

PinholePicture looked(EyeRenderer& renderer, const SceneBuilder& scene, const Isometry3d& camera,
                      const RenderOptions& options = {}) {
  PinholePicture picture;
  [&] { QVERIFY2(renderer.look(scene.node(), camera, eye(), options, picture), qPrintable(renderer.problem())); }();
  return picture;
}

}  // namespace

/// What a camera sees, against geometry.
class TestEye : public QObject {
  Q_OBJECT

 private slots:
  void theFloorIsAsFarAsTheCameraIsHigh();
  void aBallCoversTheDiscThatGeometrySays();
  void aPixelShowsThePlaceThatProjectsIntoIt();
  void lightIsTheSquareOfWhatAScreenShows();
  void aHiddenLinkIsNotSeen();
  void linesAreWhereTheCarpetSays();
  void theSameSceneGivesTheSameBits();
  void rowsAloneHaveTheSameBits();
  void theSunCastsAShadowWhereGeometrySays();
  void shadowsCanStayAsTheyWere();
  void fewerTrianglesAreNotSeen();
  void noOpenGlIsSaid();
};

void TestEye::theFloorIsAsFarAsTheCameraIsHigh() {
  SceneBuilder scene;
  fill(scene, {5, 5, ball_m});
  EyeRenderer renderer;
  const PinholePicture picture = looked(renderer, scene, lookingDown(0, 0, 0.7));
  QCOMPARE(picture.depth_m.size(), std::size_t(208 * 160));
  for (std::size_t i = 0; i < picture.depth_m.size(); ++i) {
    QVERIFY(std::abs(picture.depth_m[i] - 0.7) < 6e-4);  // the floor's grid lies half a millimetre above it
    QCOMPARE(picture.object[i], SceneBuilder::groundNumber());
  }
  // Upwards there is nothing but sky.
  const PinholePicture sky = looked(renderer, scene, at(0, 0, 0.7) * AngleAxisd(-M_PI / 2, Vector3d::UnitY()));
  for (std::size_t i = 0; i < sky.depth_m.size(); ++i) {
    QVERIFY(std::isinf(sky.depth_m[i]));
    QCOMPARE(sky.object[i], std::uint16_t(0));
  }
}

void TestEye::aBallCoversTheDiscThatGeometrySays() {
  SceneBuilder scene;
  fill(scene, {0, 0, 0.5});
  EyeRenderer renderer;
  const double away = 0.6;
  const PinholePicture picture = looked(renderer, scene, at(-away, 0, 0.5));
  int seen = 0;
  for (const std::uint16_t object : picture.object) seen += object == scene.ballNumber(0);
  // A sphere on the optical axis is seen under the angle whose sine is r/d.
  const double radius_px = eye().focal_px * std::tan(std::asin(ball_m / away));
  const double disc = M_PI * radius_px * radius_px;
  QVERIFY2(std::abs(seen - disc) < 0.04 * disc, qPrintable(QString("%1 of %2").arg(seen).arg(disc)));
  const float nearest = picture.depth_m[pixel(eye(), 104, 80)];
  QVERIFY(std::abs(nearest - (away - ball_m)) < 1e-3);
}

void TestEye::aPixelShowsThePlaceThatProjectsIntoIt() {
  SceneBuilder scene;
  EyeRenderer renderer;
  // To the left and above: where u = c − f·y/x and v = c − f·z/x say.
  const Vector3d place(0.9, 0.2, -0.12);
  fill(scene, Vector3d(place + Vector3d(0, 0, 0.5)));
  const PinholePicture picture = looked(renderer, scene, at(0, 0, 0.5));
  double u = 0, v = 0;
  int count = 0;
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 208; ++x)
      if (picture.object[pixel(eye(), x, y)] == scene.ballNumber(0)) {
        u += x;
        v += y;
        ++count;
      }
  QVERIFY(count > 100);
  const Pinhole p = eye();
  QVERIFY(std::abs(u / count - (p.centreX_px - p.focal_px * place.y() / place.x())) < 0.6);
  QVERIFY(std::abs(v / count - (p.centreY_px - p.focal_px * place.z() / place.x())) < 0.6);
}

void TestEye::lightIsTheSquareOfWhatAScreenShows() {
  SceneBuilder scene;
  fill(scene, {0, 0, 0.2});
  RenderOptions options;
  options.supersampling = 1;
  // The same frustum for both.
  ViewCamera camera;
  camera.focus = {0, 0, 0.1};
  camera.fieldOfView = 2 * std::atan(80 / eye().focal_px);
  OffscreenRenderer screen;
  const QImage shown = screen.render(scene.node(), camera, {208, 160}, options);
  Isometry3d pose = at(camera.eye().x(), camera.eye().y(), camera.eye().z());
  pose.linear() =
      (AngleAxisd(camera.azimuth + M_PI, Vector3d::UnitZ()) * AngleAxisd(camera.elevation, Vector3d::UnitY()))
          .toRotationMatrix();
  EyeRenderer renderer;
  const PinholePicture picture = looked(renderer, scene, pose, options);
  // The background mixes by the picture's height, edges fall between samples: what is off is counted.
  int off = 0;
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 208; ++x) {
      const QColor colour = shown.pixelColor(x, y);
      const float* light = &picture.rgb[3 * pixel(eye(), x, y)];
      const double shades[3] = {colour.redF(), colour.greenF(), colour.blueF()};
      for (int i = 0; i < 3; ++i) off += std::abs(std::sqrt(light[i]) - shades[i]) > 1.5 / 255;
    }
  QVERIFY2(off < 3 * 208 * 160 / 100, qPrintable(QString::number(off)));
}

void TestEye::aHiddenLinkIsNotSeen() {
  SceneBuilder scene;
  fill(scene, {5, 5, ball_m});
  ScenePose pose;
  pose.balls = {at(5, 5, ball_m)};
  pose.others = {std::vector<Isometry3d>(test::smallRobot()->links.size(), at(0, 0, 0.5))};
  scene.setPose(pose);
  EyeRenderer renderer;
  const auto seen = [&] {
    const PinholePicture picture = looked(renderer, scene, at(-1, 0, 0.5));
    return std::ranges::count(picture.object, scene.furtherNumber(0));
  };
  QVERIFY(seen() > 100);
  scene.hideLink(std::pair{std::size_t(0), std::size_t(0)});  // the body, larger than all the rest
  const auto fewer = seen();
  scene.hideLink(std::nullopt);
  QVERIFY(fewer < seen());
}

void TestEye::linesAreWhereTheCarpetSays() {
  CarpetSpec carpet;
  carpet.size_m = {2, 2};
  carpet.colour = "#00ff00";
  carpet.lines = {{{0.1, -0.5}, {0.1, 0.5}, 0.04}};
  carpet.circles = {{{-0.3, 0}, 0.1, 0.04}};
  SceneBuilder scene;
  fill(scene, {5, 5, ball_m});
  scene.setCarpet(carpet);
  EyeRenderer renderer;
  const double height = 1;
  const PinholePicture picture = looked(renderer, scene, lookingDown(0, 0, height));
  // Seen from above with the optical axis down, the world's x goes up in the picture and its y to the left.
  const auto isLine = [&](double x, double y) {
    const int u = int(std::lround(eye().centreX_px - eye().focal_px * y / height));
    const int v = int(std::lround(eye().centreY_px - eye().focal_px * x / height));
    const float* light = &picture.rgb[3 * pixel(eye(), u, v)];
    return light[0] > 0.5f * light[1];
  };
  QVERIFY(isLine(0.1, 0) && isLine(0.1, 0.4) && isLine(0.1, -0.4));
  QVERIFY(!isLine(0.06, 0) && !isLine(0.14, 0) && !isLine(0, 0));
  QVERIFY(isLine(-0.22, 0) && isLine(-0.38, 0) && isLine(-0.3, 0.08) && !isLine(-0.3, 0));
}

void TestEye::theSameSceneGivesTheSameBits() {
  SceneBuilder scene;
  fill(scene, {0, 0, 0.2});
  EyeRenderer one, other;
  const PinholePicture a = looked(one, scene, at(-1, 0, 0.3));
  SceneBuilder again;
  fill(again, {0, 0, 0.2});
  const PinholePicture b = looked(other, again, at(-1, 0, 0.3));
  QVERIFY(a.rgb == b.rgb);
  QVERIFY(a.depth_m == b.depth_m);
  QVERIFY(a.object == b.object);
}

void TestEye::rowsAloneHaveTheSameBits() {
  SceneBuilder scene;
  fill(scene, {0, 0, 0.2});
  EyeRenderer renderer;
  const PinholePicture whole = looked(renderer, scene, at(-1, 0, 0.3));
  for (const int samples : {1, 2}) {
    RenderOptions options;
    options.supersampling = samples;
    const PinholePicture all = looked(renderer, scene, at(-1, 0, 0.3), options);
    for (const PictureRows rows : {PictureRows{0, 40}, {50, 110}, {159, 159}}) {
      PinholePicture part = whole;
      std::ranges::fill(part.rgb, -1.f);
      QVERIFY(renderer.look(scene.node(), at(-1, 0, 0.3), eye(), options, part, rows));
      for (int y = 0; y < 160; ++y)
        for (std::size_t i = pixel(eye(), 0, y); i < pixel(eye(), 0, y + 1); ++i) {
          const bool drawn = y >= rows.first && y <= rows.last;
          for (std::size_t c = 0; c < 3; ++c) QCOMPARE(part.rgb[3 * i + c], drawn ? all.rgb[3 * i + c] : -1.f);
          if (drawn) QVERIFY(part.depth_m[i] == all.depth_m[i] && part.object[i] == all.object[i]);
        }
    }
  }
}

namespace {

/// Light on the floor at a place, seen from above at (0, 0, 2).
float lightAt(const PinholePicture& picture, double x, double y) {
  const int u = int(std::lround(eye().centreX_px - eye().focal_px * y / 2));
  const int v = int(std::lround(eye().centreY_px - eye().focal_px * x / 2));
  return picture.rgb[3 * pixel(eye(), u, v) + 1];
}

/// Where the middle of a thing's shadow lies on the floor.
Vector3d shadowOf(const Vector3d& thing) { return thing - thing.z() / sunDirection().z() * sunDirection(); }

}  // namespace

void TestEye::theSunCastsAShadowWhereGeometrySays() {
  SceneBuilder scene;
  const Vector3d ball(0.1, -0.2, 0.4);
  fill(scene, ball);
  EyeRenderer renderer;
  RenderOptions lit;
  lit.shadows = false;
  const Isometry3d above = lookingDown(0, 0, 2);
  const PinholePicture dark = looked(renderer, scene, above), bright = looked(renderer, scene, above, lit);
  const Vector3d middle = shadowOf(ball);
  QVERIFY(lightAt(dark, middle.x(), middle.y()) < 0.7f * lightAt(bright, middle.x(), middle.y()));
  // Across the sun's way a shadow is as wide as the ball.
  const Vector3d across = sunDirection().cross(Vector3d::UnitZ()).normalized();
  const Vector3d inside = middle + 0.75 * ball_m * across, outside = middle + 1.5 * ball_m * across;
  QVERIFY(lightAt(dark, inside.x(), inside.y()) < 0.8f * lightAt(bright, inside.x(), inside.y()));
  QVERIFY(lightAt(dark, outside.x(), outside.y()) > 0.98f * lightAt(bright, outside.x(), outside.y()));
}

void TestEye::shadowsCanStayAsTheyWere() {
  SceneBuilder scene;
  const Vector3d before(0.1, -0.2, 0.4), after(-0.2, 0.1, 0.4);
  fill(scene, before);
  EyeRenderer renderer;
  const Isometry3d above = lookingDown(0, 0, 2);
  RenderOptions options;
  options.sameShadows = true;
  const auto isDark = [&](const PinholePicture& picture, const Vector3d& thing) {
    const Vector3d middle = shadowOf(thing);
    return lightAt(picture, middle.x(), middle.y()) < 0.7f * lightAt(picture, 0.5, 0.5);
  };
  const PinholePicture first = looked(renderer, scene, above, options);  // there are none before
  QVERIFY(isDark(first, before) && !isDark(first, after));
  fill(scene, after);
  const PinholePicture same = looked(renderer, scene, lookingDown(0, 0, 2), options);
  QVERIFY(isDark(same, before) && !isDark(same, after));
  const PinholePicture anew = looked(renderer, scene, above);
  QVERIFY(!isDark(anew, before) && isDark(anew, after));
}

void TestEye::fewerTrianglesAreNotSeen() {
  SceneSpec spec;
  RobotSpec robot;
  robot.name = "dog";
  robot.model = SOURCE_DIR "/resources/robots/ers7.wrl";
  spec.robots = {robot};
  const auto model = loadModels(spec).begin()->second;
  SceneBuilder all, fewer;
  fewer.setLevels(true);
  for (SceneBuilder* scene : {&all, &fewer}) {
    scene->setGround(Ground::plain);
    scene->setFurtherRobots({model});
    ScenePose pose;
    pose.others = {forwardKinematics(*model, at(0, 0, 0.2), std::vector<double>(model->joints.size(), 0.0))};
    scene->setPose(pose);
  }
  EyeRenderer renderer;
  for (const double away_m : {0.4, 0.8, 1.6, 3.0}) {
    const PinholePicture a = looked(renderer, all, at(-away_m, 0, 0.2)),
                         b = looked(renderer, fewer, at(-away_m, 0, 0.2));
    int ofDog = 0, off = 0;
    double light = 0;
    for (std::size_t i = 0; i < a.object.size(); ++i) {
      const bool inOne = a.object[i] == all.furtherNumber(0), inOther = b.object[i] == all.furtherNumber(0);
      ofDog += inOne;
      off += inOne != inOther;
      for (std::size_t c = 0; c < 3; ++c) light += std::abs(a.rgb[3 * i + c] - b.rgb[3 * i + c]);
    }
    QVERIFY2(ofDog > 100, qPrintable(QString::number(ofDog)));
    // The outline has about 6 √area pixels, of which few fall to the other side.
    QVERIFY2(off < 1.5 * std::sqrt(ofDog), qPrintable(QString("%1 of %2 at %3 m").arg(off).arg(ofDog).arg(away_m)));
    QVERIFY2(light / 3 < 0.05 * ofDog, qPrintable(QString("%1 of %2 at %3 m").arg(light / 3).arg(ofDog).arg(away_m)));
  }
}

void TestEye::noOpenGlIsSaid() {
  SceneBuilder scene;
  EyeRenderer renderer([](QString& problem) {
    problem = "no driver on this machine";
    return std::unique_ptr<GlContext>();
  });
  PinholePicture picture;
  QVERIFY(!renderer.look(scene.node(), at(0, 0, 1), eye(), {}, picture));
  QCOMPARE(renderer.problem(), QString("no driver on this machine"));
}

UI_TEST(TestEye)
#include "test_eye.moc"
