#include <QAction>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QWheelEvent>
#include <cmath>
#include <limits>

#include "core/model/kinematics.h"
#include "tests/ui/small_robot.h"
#include "tests/ui/ui_tests.h"
#include "ui/scene3d/field.h"
#include "ui/scene3d/link_marks.h"
#include "ui/scene3d/scene_view.h"
#include "ui/scene3d/triangle_mesh.h"

using namespace btr;
using namespace btr::ui;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

constexpr QSize kSize(320, 240);
constexpr double kBall = 0.0425;

Isometry3d at(double x, double y, double z) { return Isometry3d(Eigen::Translation3d(x, y, z)); }

/// The small robot's body 0.2 m above the carpet, its arm ahead, a ball on the carpet in front.
ScenePose somePose(const Vector3d& ball = {0.3, 0, kBall}) {
  ScenePose pose;
  pose.links = forwardKinematics(*test::smallRobot(), at(0, 0, 0.2), std::vector{0.0, 0.0});
  pose.balls = {at(ball.x(), ball.y(), ball.z())};
  return pose;
}

void fill(SceneBuilder& scene) {
  scene.setRobot(test::smallRobot());
  scene.setBalls({kBall});
  scene.setPose(somePose());
}

QColor pixelAt(const QImage& image, const ViewCamera& camera, const Vector3d& point) {
  const auto pixel = camera.project(point, image.size());
  return pixel ? image.pixelColor(pixel->toPoint()) : QColor();
}

bool isOrange(const QColor& c) {
  return c.red() > 140 && c.hsvHue() >= 8 && c.hsvHue() <= 40 && c.hsvSaturation() > 110;
}
bool isGreen(const QColor& c) { return c.green() > 1.4 * c.red() && c.green() > 1.3 * c.blue(); }
bool isWhite(const QColor& c) { return c.red() > 190 && c.green() > 190 && c.blue() > 190; }
bool isRed(const QColor& c) { return c.red() > 2 * c.green() && c.red() > 2 * c.blue(); }
bool isBlue(const QColor& c) { return c.blue() > 1.5 * c.red() && c.blue() > 1.3 * c.green(); }

/// Counts how often a picture is drawn.
class CountingContext final : public GlContext {
 public:
  CountingContext(std::unique_ptr<GlContext> inner, int& count) : inner_(std::move(inner)), count_(count) {}
  bool makeCurrent() override {
    ++count_;
    return inner_->makeCurrent();
  }
  void release() override { inner_->release(); }

 private:
  std::unique_ptr<GlContext> inner_;
  int& count_;
};

std::unique_ptr<GlContext> noOpenGl(QString& problem) {
  problem = "no driver on this machine";
  return nullptr;
}

}  // namespace

class TestScene3d : public QObject {
  Q_OBJECT

 private slots:
  void cameraProjectsItsFocusToTheMiddle();
  void cameraProjectsByTheRuleOfSimilarTriangles();
  void orbitKeepsTheDistance();
  void panMovesTheFocusWithTheMouse();
  void zoomGoesByFactorsAndStopsAtItsLimits();
  void aCameraGoesAlongBeforeAPointLeavesThePicture();
  void meshesTurnTheirTrianglesOutwards();
  void borderLinesAreFieldSizedAnd25mmWide();
  void ballRobotAndFieldAppearWhereTheyAreProjected();
  void sameSceneGivesTheSamePicture();
  void anotherRendererGivesTheSamePicture();
  void pictureHasTheSizeAskedFor();
  void movingTheBallMovesItsPixels();
  void turningAJointMovesItsLink();
  void shadowDarkensTheGroundBehindTheBallAlone();
  void jacketChangesBetweenRedAndBlue();
  void wireframeLetsTheFieldShowThrough();
  void collisionShapesAreOutlined();
  void transparentBodiesLetTheFieldShine();
  void pointsLeaveFacesOpen();
  void marksComeAndGo();
  void contactForcesAreTenMillimetresANewton();
  void ghostIsTranslucent();
  void poseThatIsNoNumberIsNotDrawn();
  void darkThemeDarkensSkyAndFloor();
  void viewDrawsOnlyWhenSomethingChanged();
  void viewWithoutOpenGlSaysSo();
  void mouseOrbitsPansAndZooms();
  void keysSwitchWhatTheyPromise();
  void followKeepsTheBallInTheMiddle();
  void theRobotIsKeptInViewUntilTheUserLooksElsewhere();
  void savesAPngWithItsTexts();
};

void TestScene3d::cameraProjectsItsFocusToTheMiddle() {
  ViewCamera camera;
  camera.focus = {0.4, -0.3, 0.1};
  const auto pixel = camera.project(camera.focus, kSize);
  QVERIFY(pixel);
  QVERIFY(std::abs(pixel->x() - 160) < 1e-9 && std::abs(pixel->y() - 120) < 1e-9);
  QVERIFY(!camera.project(camera.eye() + (camera.eye() - camera.focus), kSize));
}

void TestScene3d::cameraProjectsByTheRuleOfSimilarTriangles() {
  // Looking along +x from the origin's level: y to the left, z up; half the height is distance·tan(fov/2).
  ViewCamera camera;
  camera.focus = {0, 0, 0};
  camera.distance = 2;
  camera.azimuth = std::numbers::pi;
  camera.elevation = 0;
  const double halfHeight_m = 2 * std::tan(camera.fieldOfView / 2);
  const auto pixel = camera.project({0, 0.1, 0.2}, kSize);
  QVERIFY(std::abs(pixel->x() - (160 - 120 * 0.1 / halfHeight_m)) < 1e-9);
  QVERIFY(std::abs(pixel->y() - (120 - 120 * 0.2 / halfHeight_m)) < 1e-9);
}

void TestScene3d::orbitKeepsTheDistance() {
  ViewCamera camera;
  const ViewCamera before = camera;
  camera.orbit({50, -20});
  QVERIFY(std::abs((camera.eye() - camera.focus).norm() - before.distance) < 1e-12);
  QVERIFY((camera.eye() - before.eye()).norm() > 0.1);
  camera.orbit({0, 1e6});
  QVERIFY(camera.elevation <= 1.55);
}

void TestScene3d::panMovesTheFocusWithTheMouse() {
  ViewCamera camera;
  const Vector3d point = camera.focus;
  camera.pan({30, -12}, kSize.height());
  const auto pixel = camera.project(point, kSize);
  QVERIFY(std::abs(pixel->x() - 190) < 1e-6);
  QVERIFY(std::abs(pixel->y() - 108) < 1e-6);
}

void TestScene3d::zoomGoesByFactorsAndStopsAtItsLimits() {
  ViewCamera camera;
  const double before = camera.distance;
  camera.zoom(2);
  QVERIFY(std::abs(camera.distance - before / (1.15 * 1.15)) < 1e-12);
  camera.zoom(1000);
  QCOMPARE(camera.distance, 0.08);
  camera.zoom(-1000);
  QCOMPARE(camera.distance, 15.0);
}

void TestScene3d::aCameraGoesAlongBeforeAPointLeavesThePicture() {
  for (const double azimuth : {-0.9, 0.4, 2.5}) {
    ViewCamera camera;
    camera.azimuth = azimuth;
    const ViewCamera before = camera;
    camera.keepInView(camera.focus + Vector3d(0.05, 0, 0), kSize);
    QVERIFY(camera == before);  // near the middle
    Vector3d walker = camera.focus;
    double largest_m = 0;
    for (int i = 0; i < 400; ++i) {  // 4 m
      walker += Vector3d(0.008, 0.006, 0);
      const Vector3d was = camera.focus;
      camera.keepInView(walker, kSize);
      largest_m = std::max(largest_m, (camera.focus - was).norm());
      const auto pixel = camera.project(walker, kSize);
      QVERIFY(pixel && QRectF(0, 0, kSize.width(), kSize.height()).contains(*pixel));
    }
    QVERIFY(largest_m < 0.05);  // it does not jump
    QCOMPARE(camera.focus.z(), before.focus.z());
    QCOMPARE(camera.distance, before.distance);
    // Far away at once, in front or behind.
    for (const double side : {20.0, -20.0}) {
      camera.keepInView({side, side, 0.1}, kSize);
      const auto pixel = camera.project({side, side, 0.1}, kSize);
      QVERIFY(pixel && QRectF(0, 0, kSize.width(), kSize.height()).contains(*pixel));
    }
  }
}

void TestScene3d::meshesTurnTheirTrianglesOutwards() {
  // A closed body around the origin: every face and every normal looks away from it, and Gauss gives the volume.
  Shape tetrahedron;
  tetrahedron.kind = Shape::Kind::mesh;
  tetrahedron.surface = std::make_shared<const Surface>(
      Surface{{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}, {}});
  const double pi = std::numbers::pi;
  const std::tuple<Shape, double, double> bodies[] = {
      {test::makeShape(Shape::Kind::box, {0, 0, 0}, {1, 2, 3}, {}), 6, 1e-5},
      {test::makeShape(Shape::Kind::sphere, {0, 0, 0}, {1, 0, 0}, {}), 4 * pi / 3, 0.02},
      {test::makeShape(Shape::Kind::cylinder, {0, 0, 0}, {1, 2, 0}, {}), 2 * pi, 0.02},
      {test::makeShape(Shape::Kind::capsule, {0, 0, 0}, {1, 2, 0}, {}), 2 * pi + 4 * pi / 3, 0.02},
      {tetrahedron, 8.0 / 3, 1e-5}};
  for (const auto& [shape, volume, tolerance] : bodies) {
    TriangleMesh mesh;
    mesh.addShape(shape, Isometry3d::Identity(), {1, 1, 1, 1});
    double sum = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const auto& a = mesh.positions[mesh.indices[i]];
      const auto& b = mesh.positions[mesh.indices[i + 1]];
      const auto& c = mesh.positions[mesh.indices[i + 2]];
      sum += a.dot(b.cross(c)) / 6;
      for (int corner = 0; corner < 3; ++corner) {
        const unsigned vertex = mesh.indices[i + corner];
        QVERIFY(mesh.normals[vertex].dot(mesh.positions[vertex]) > 0);
        QVERIFY(std::abs(mesh.normals[vertex].norm() - 1) < 1e-5);
      }
    }
    QVERIFY2(std::abs(sum / volume - 1) < tolerance, qPrintable(QString::number(sum)));
  }
}

void TestScene3d::borderLinesAreFieldSizedAnd25mmWide() {
  const TriangleMesh lines = fieldLines(FieldSize{});
  Eigen::Vector3f low = lines.positions.front(), high = low;
  double area = 0;
  for (std::size_t i = 0; i < lines.indices.size(); i += 3) {
    const auto& a = lines.positions[lines.indices[i]];
    const auto& b = lines.positions[lines.indices[i + 1]];
    const auto& c = lines.positions[lines.indices[i + 2]];
    area += (b - a).cross(c - a).norm() / 2;
    for (const auto& p : {a, b, c}) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  QVERIFY(((high - low).head<2>() - Eigen::Vector2f(4.2f, 2.7f)).norm() < 1e-5);
  // Border, halfway line, two areas and the ring (a polygon of 96 sides), 25 mm wide and nowhere drawn twice.
  const double w = 0.025, ring = 48 * std::sin(std::numbers::pi / 48) * (0.15 * 0.15 - 0.125 * 0.125);
  const double border = 4.2 * 2.7 - (4.2 - 2 * w) * (2.7 - 2 * w), halfway = w * (2.7 - 2 * w - 2 * w);
  const double penalty = w * 0.90 + 2 * w * (0.45 - 2 * w);
  QVERIFY2(std::abs(area - (border + halfway + 2 * penalty + ring)) < 1e-4, qPrintable(QString::number(area)));
}

void TestScene3d::ballRobotAndFieldAppearWhereTheyAreProjected() {
  SceneBuilder scene;
  fill(scene);
  OffscreenRenderer renderer;
  ViewCamera camera;
  const QImage image = renderer.render(scene.node(), camera, kSize, scene.renderOptions());
  QVERIFY2(!image.isNull(), qPrintable(renderer.problem()));
  QVERIFY(isOrange(pixelAt(image, camera, {0.3, 0, kBall})));
  QVERIFY(isWhite(pixelAt(image, camera, {0, -0.05, 0.2})));
  QVERIFY(isGreen(pixelAt(image, camera, {0.3, -0.25, 0})));
  QVERIFY(isWhite(pixelAt(image, camera, {0, -0.40, 0})));  // the halfway line
}

void TestScene3d::sameSceneGivesTheSamePicture() {
  SceneBuilder scene;
  fill(scene);
  OffscreenRenderer renderer;
  ViewCamera camera, other;
  other.orbit({200, 30});
  const QImage first = renderer.render(scene.node(), camera, kSize);
  const QImage between = renderer.render(scene.node(), other, QSize(200, 300));
  const QImage again = renderer.render(scene.node(), camera, kSize);
  QVERIFY(!first.isNull());
  QVERIFY(between.copy(0, 0, 200, 240) != first.copy(0, 0, 200, 240));
  QCOMPARE(again, first);
}

void TestScene3d::anotherRendererGivesTheSamePicture() {
  SceneBuilder scene, copy;
  fill(scene);
  fill(copy);
  OffscreenRenderer one;
  const QImage first = one.render(scene.node(), {}, kSize);
  {
    OffscreenRenderer two;
    QCOMPARE(two.render(copy.node(), {}, kSize), first);
    QCOMPARE(two.render(scene.node(), {}, kSize), first);  // two renderers may show one scene
  }
  QCOMPARE(one.render(scene.node(), {}, kSize), first);  // and one outlives the other
}

void TestScene3d::pictureHasTheSizeAskedFor() {
  SceneBuilder scene;
  fill(scene);
  OffscreenRenderer renderer;
  for (const QSize& size : {QSize(1, 1), QSize(333, 17), QSize(640, 480), QSize(64, 900)})
    for (int samples : {1, 2}) {
      RenderOptions options;
      options.supersampling = samples;
      QCOMPARE(renderer.render(scene.node(), {}, size, options).size(), size);
    }
}

void TestScene3d::movingTheBallMovesItsPixels() {
  SceneBuilder scene;
  fill(scene);
  OffscreenRenderer renderer;
  const ViewCamera camera;
  scene.setPose(somePose({0.35, -0.12, kBall}));
  const QImage moved = renderer.render(scene.node(), camera, kSize);
  QVERIFY(isOrange(pixelAt(moved, camera, {0.35, -0.12, kBall})));
  QVERIFY(!isOrange(pixelAt(moved, camera, {0.3, 0, kBall})));
}

void TestScene3d::turningAJointMovesItsLink() {
  SceneBuilder scene;
  fill(scene);
  OffscreenRenderer renderer;
  const ViewCamera camera;
  // The arm's middle points ahead; turned by +90° about −y it points up.
  const Vector3d ahead(0.15, -0.015, 0.2), up(0.1, -0.015, 0.285);
  const QImage before = renderer.render(scene.node(), camera, kSize);
  ScenePose pose = somePose();
  pose.links = forwardKinematics(*test::smallRobot(), at(0, 0, 0.2), std::vector{std::numbers::pi / 2, 0.0});
  scene.setPose(pose);
  const QImage after = renderer.render(scene.node(), camera, kSize);
  QVERIFY(isGreen(pixelAt(before, camera, up)) && !isGreen(pixelAt(after, camera, up)));
  QVERIFY(!isGreen(pixelAt(before, camera, ahead)) && isGreen(pixelAt(after, camera, ahead)));
}

void TestScene3d::shadowDarkensTheGroundBehindTheBallAlone() {
  SceneBuilder scene;
  scene.setBalls({kBall});
  ScenePose pose;
  const Vector3d ball(0.3, 0, 0.20);  // in the air, so that its shadow lies beside it
  pose.balls = {at(ball.x(), ball.y(), ball.z())};
  scene.setPose(pose);
  OffscreenRenderer renderer;
  const ViewCamera camera;
  RenderOptions with, without;
  without.shadows = false;
  const QImage dark = renderer.render(scene.node(), camera, kSize, with);
  const QImage lit = renderer.render(scene.node(), camera, kSize, without);
  QCOMPARE(renderer.render(scene.node(), camera, kSize, with), dark);
  const Vector3d sun = sunDirection(), shadow = ball - sun * (ball.z() / sun.z());
  QVERIFY(isGreen(pixelAt(lit, camera, shadow)));
  QVERIFY(pixelAt(dark, camera, shadow).green() < 0.8 * pixelAt(lit, camera, shadow).green());
  const Vector3d elsewhere = 2 * Vector3d(ball.x(), ball.y(), 0) - shadow;
  QVERIFY(std::abs(pixelAt(dark, camera, elsewhere).green() - pixelAt(lit, camera, elsewhere).green()) <= 1);
}

void TestScene3d::jacketChangesBetweenRedAndBlue() {
  SceneBuilder scene;
  fill(scene);
  OffscreenRenderer renderer;
  const ViewCamera camera;
  const Vector3d back(-0.03, 0, 0.26);
  QVERIFY(isRed(pixelAt(renderer.render(scene.node(), camera, kSize), camera, back)));
  scene.setJacket("blue");
  QVERIFY(isBlue(pixelAt(renderer.render(scene.node(), camera, kSize), camera, back)));
  scene.setJacket("red");
  QVERIFY(isRed(pixelAt(renderer.render(scene.node(), camera, kSize), camera, back)));
}

void TestScene3d::wireframeLetsTheFieldShowThrough() {
  SceneBuilder scene;
  fill(scene);
  OffscreenRenderer renderer;
  const ViewCamera camera;
  const QImage solid = renderer.render(scene.node(), camera, kSize);
  scene.setSurfaces(Surfaces::wireframe);
  const QImage wire = renderer.render(scene.node(), camera, kSize);
  const Vector3d side(-0.05, -0.05, 0.215);  // off the face's diagonal
  QVERIFY(isWhite(pixelAt(solid, camera, side)));
  QVERIFY(!isWhite(pixelAt(wire, camera, side)));
  scene.setSurfaces(Surfaces::shaded);
  QCOMPARE(renderer.render(scene.node(), camera, kSize), solid);
}

void TestScene3d::collisionShapesAreOutlined() {
  SceneBuilder scene;
  fill(scene);
  OffscreenRenderer renderer;
  const ViewCamera camera;
  const QImage without = renderer.render(scene.node(), camera, kSize);
  scene.setMark(Mark::collision, true);
  const QImage with = renderer.render(scene.node(), camera, kSize);
  // The middle of the body's lower right edge.
  const QColor edge = pixelAt(with, camera, {0, -0.05, 0.15});
  QVERIFY(edge.red() > edge.green() + 40 && edge.blue() > edge.green() + 20);
  scene.setMark(Mark::collision, false);
  QCOMPARE(renderer.render(scene.node(), camera, kSize), without);
}

void TestScene3d::transparentBodiesLetTheFieldShine() {
  SceneBuilder scene;
  fill(scene);
  OffscreenRenderer renderer;
  const ViewCamera camera;
  const QImage solid = renderer.render(scene.node(), camera, kSize);
  scene.setSurfaces(Surfaces::transparent);
  const QImage clear = renderer.render(scene.node(), camera, kSize);
  const Vector3d side(-0.05, -0.05, 0.215);
  const QColor body = pixelAt(clear, camera, side);
  QVERIFY(isWhite(pixelAt(solid, camera, side)));
  QVERIFY2(!isWhite(body) && body.green() > body.red() + 10, qPrintable(body.name()));  // the carpet's green in it
  scene.setSurfaces(Surfaces::shaded);
  QCOMPARE(renderer.render(scene.node(), camera, kSize), solid);
}

void TestScene3d::pointsLeaveFacesOpen() {
  SceneBuilder scene;
  fill(scene);
  OffscreenRenderer renderer;
  const ViewCamera camera;
  scene.setSurfaces(Surfaces::points);
  const QImage points = renderer.render(scene.node(), camera, kSize);
  QVERIFY(!isWhite(pixelAt(points, camera, {-0.05, -0.05, 0.215})));
  // The body's near upper corner.
  const auto corner = camera.project({0.1, -0.05, 0.25}, kSize);
  QVERIFY(corner);
  bool any = false;
  for (int dx = -2; dx <= 2; ++dx)
    for (int dy = -2; dy <= 2; ++dy) any |= !isGreen(points.pixelColor(corner->toPoint() + QPoint(dx, dy)));
  QVERIFY(any);
}

void TestScene3d::marksComeAndGo() {
  SceneBuilder scene;
  fill(scene);
  WorldMarks marks;
  marks.contacts = {{{0.3, 0, 0}, {0, 0, 5}}};
  marks.trails = {{{0.f, 0.f, 0.01f}, {0.3f, 0.1f, 0.01f}}};
  scene.setWorldMarks(marks);
  OffscreenRenderer renderer;
  const ViewCamera camera;
  const QImage without = renderer.render(scene.node(), camera, kSize);
  for (std::size_t i = 0; i < kMarks; ++i) {
    if (Mark(i) == Mark::centres) continue;  // this robot has no masses
    scene.setMark(Mark(i), true);
    QVERIFY2(renderer.render(scene.node(), camera, kSize) != without, qPrintable(QString::number(i)));
    scene.setMark(Mark(i), false);
    QCOMPARE(renderer.render(scene.node(), camera, kSize), without);
  }
  scene.setMark(Mark::axes, true);
  const QImage axes = renderer.render(scene.node(), camera, kSize);
  // The first joint's axis lies along y through (0.1, 0, 0.2), and shows through the body.
  const auto middle = camera.project({0.1, -0.03, 0.2}, kSize);
  QVERIFY(middle);
  bool blue = false;
  for (int dx = -2; dx <= 2; ++dx)
    for (int dy = -2; dy <= 2; ++dy) {
      const QColor colour = axes.pixelColor(middle->toPoint() + QPoint(dx, dy));
      blue |= colour.blue() > colour.red() + 60;
    }
  QVERIFY(blue);
}

void TestScene3d::contactForcesAreTenMillimetresANewton() {
  const LineSegments lines = contactLines({{{1, 2, 0}, {0, 0, 8}}, {{0, 0, 0}, {300, 0, 0}}});
  const auto longest = [&](std::size_t from, std::size_t to) {
    float most = 0;
    for (std::size_t i = from; i < to; i += 2) most = std::max(most, (lines[i + 1] - lines[i]).norm());
    return most;
  };
  QCOMPARE(lines.size(), std::size_t(16));
  QVERIFY(std::abs(longest(0, 8) - 0.08f) < 1e-6f);
  QVERIFY(std::abs(longest(8, 16) - 0.3f) < 1e-6f);  // bounded
}

void TestScene3d::ghostIsTranslucent() {
  SceneBuilder scene;
  fill(scene);
  OffscreenRenderer renderer;
  const ViewCamera camera;
  const QImage without = renderer.render(scene.node(), camera, kSize);
  Ghost ghost;
  ghost.colour = QColor(0, 0, 255, 128);
  ghost.pose = somePose({0.1, -0.3, kBall});
  scene.setGhosts({ghost});
  const QImage with = renderer.render(scene.node(), camera, kSize);
  const QColor before = pixelAt(without, camera, {0.1, -0.3, kBall}), after = pixelAt(with, camera, {0.1, -0.3, kBall});
  QVERIFY(isGreen(before));
  QVERIFY(after.blue() > before.blue() + 30);
  QVERIFY(after.green() > 20 && after.green() < before.green());  // the carpet still shows
  QVERIFY(isOrange(pixelAt(with, camera, {0.3, 0, kBall})));
  // Moved, not added; then gone.
  ghost.pose = somePose({0.3, -0.3, kBall});
  scene.setGhosts({ghost});
  QCOMPARE(pixelAt(renderer.render(scene.node(), camera, kSize), camera, {0.1, -0.3, kBall}), before);
  scene.setGhosts({});
  QCOMPARE(renderer.render(scene.node(), camera, kSize), without);
}

void TestScene3d::poseThatIsNoNumberIsNotDrawn() {
  SceneBuilder scene, empty;
  fill(scene);
  ScenePose pose = somePose({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  for (auto& link : pose.links) link.translation().x() = std::numeric_limits<double>::infinity();
  scene.setPose(pose);
  OffscreenRenderer renderer;
  QCOMPARE(renderer.render(scene.node(), {}, kSize), renderer.render(empty.node(), {}, kSize));
}

void TestScene3d::darkThemeDarkensSkyAndFloor() {
  SceneView view;
  view.setGround(Ground::plain);
  const QImage light = view.picture(kSize);
  QPalette palette;
  palette.setColor(QPalette::Window, QColor(30, 30, 34));
  view.setPalette(palette);
  const QImage dark = view.picture(kSize);
  for (const QPoint& point : {QPoint(5, 5), QPoint(160, 235)})
    QVERIFY(dark.pixelColor(point).lightness() < light.pixelColor(point).lightness() - 60);
}

void TestScene3d::viewDrawsOnlyWhenSomethingChanged() {
  int drawn = 0;
  {
    SceneView view(nullptr, [&drawn](QString& problem) -> std::unique_ptr<GlContext> {
      return std::make_unique<CountingContext>(createGlContext(problem), drawn);
    });
    view.resize(kSize);
    const QImage first = view.grab().toImage();
    const int once = drawn;
    QVERIFY(once > 0);
    QCOMPARE(view.grab().toImage(), first);
    QCOMPARE(drawn, once);
    view.setCaption({"only the text is new"});
    QVERIFY(view.grab().toImage() != first);
    QCOMPARE(drawn, once);
    view.setCamera(ViewCamera{.distance = 2});
    view.grab();
    QVERIFY(drawn > once);
  }
}

void TestScene3d::viewWithoutOpenGlSaysSo() {
  SceneView view(nullptr, noOpenGl);
  view.setRobot(test::smallRobot());
  view.setPose(somePose());
  view.resize(kSize);
  const QImage image = view.grab().toImage();
  QCOMPARE(view.problem(), QString("no driver on this machine"));
  QVERIFY(!view.savePicture("never-written.png"));
  // Words in the window's text colour stand there.
  int textPixels = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) textPixels += image.pixelColor(x, y) != image.pixelColor(0, 0);
  QVERIFY(textPixels > 200);
}

void TestScene3d::mouseOrbitsPansAndZooms() {
  SceneView view;
  view.resize(kSize);
  const ViewCamera before = view.camera();
  QSignalSpy changes(&view, &SceneView::cameraChanged);
  const auto drag = [&](Qt::MouseButton button, Qt::KeyboardModifiers modifiers) {
    QTest::mousePress(&view, button, modifiers, {100, 100});
    QMouseEvent move(QEvent::MouseMove, QPointF(130, 110), view.mapToGlobal(QPointF(130, 110)), Qt::NoButton, button,
                     modifiers);
    QApplication::sendEvent(&view, &move);
    QTest::mouseRelease(&view, button, modifiers, {130, 110});
  };
  drag(Qt::LeftButton, {});
  ViewCamera expected = before;
  expected.orbit({30, 10});
  QCOMPARE(view.camera(), expected);
  drag(Qt::LeftButton, Qt::ShiftModifier);
  expected.pan({30, 10}, kSize.height());
  QCOMPARE(view.camera(), expected);
  drag(Qt::MiddleButton, {});
  expected.pan({30, 10}, kSize.height());
  QCOMPARE(view.camera(), expected);
  QWheelEvent wheel(QPointF(50, 50), view.mapToGlobal(QPointF(50, 50)), {}, QPoint(0, 120), Qt::NoButton, {},
                    Qt::NoScrollPhase, false);
  QApplication::sendEvent(&view, &wheel);
  expected.zoom(1);
  QCOMPARE(view.camera(), expected);
  QCOMPARE(changes.count(), 4);
}

void TestScene3d::keysSwitchWhatTheyPromise() {
  SceneView view;
  view.setCamera(ViewCamera{.distance = 3});
  QTest::keyClick(&view, Qt::Key_H);
  QCOMPARE(view.camera(), ViewCamera());
  QVERIFY(view.shadowsAction()->isChecked());
  QTest::keyClick(&view, Qt::Key_S);
  QVERIFY(!view.shadowsAction()->isChecked());
  QTest::keyClick(&view, Qt::Key_W);
  QVERIFY(view.wireframeAction()->isChecked());
  QTest::keyClick(&view, Qt::Key_B);
  QVERIFY(view.collisionAction()->isChecked());
  QTest::keyClick(&view, Qt::Key_J);
  QVERIFY(view.jacketAction()->isChecked());
  for (auto expected : {SceneView::Follow::robot, SceneView::Follow::ball, SceneView::Follow::nothing}) {
    QTest::keyClick(&view, Qt::Key_F);
    QCOMPARE(view.follow(), expected);
  }
}

void TestScene3d::followKeepsTheBallInTheMiddle() {
  SceneView view;
  view.setRobot(test::smallRobot());
  view.setBalls({kBall});
  view.setFollow(SceneView::Follow::ball);
  for (double x : {0.3, 0.9, 1.7}) {
    view.setPose(somePose({x, 0.1, kBall}));
    QVERIFY(isOrange(view.picture(kSize).pixelColor(160, 120)));
  }
  view.setFollow(SceneView::Follow::robot);
  QVERIFY((view.camera().focus - Vector3d(0, 0, 0.2)).norm() < 1e-12);
}

void TestScene3d::theRobotIsKeptInViewUntilTheUserLooksElsewhere() {
  SceneView view;
  view.resize(kSize);
  view.setRobot(test::smallRobot());
  const auto walkTo = [&view](double x) {
    ScenePose pose = somePose();
    for (auto& link : pose.links) link.translation().x() += x;
    view.setPose(pose);
    return view.camera().project(pose.links.front().translation(), kSize);
  };
  const QRectF picture(0, 0, kSize.width(), kSize.height());
  const auto sees = [&picture](const std::optional<QPointF>& pixel) { return pixel && picture.contains(*pixel); };
  for (double x = 0; x < 3; x += 0.01) QVERIFY(sees(walkTo(x)));
  QVERIFY(view.keepsInView());
  // Turned and nearer, it is still kept.
  QWheelEvent wheel(QPointF(50, 50), view.mapToGlobal(QPointF(50, 50)), {}, QPoint(0, 120), Qt::NoButton, {},
                    Qt::NoScrollPhase, false);
  QApplication::sendEvent(&view, &wheel);
  QVERIFY(sees(walkTo(3.3)));
  // Moved aside: the user looks at something else.
  QTest::mousePress(&view, Qt::MiddleButton, {}, {100, 100});
  QMouseEvent move(QEvent::MouseMove, QPointF(130, 110), view.mapToGlobal(QPointF(130, 110)), Qt::NoButton,
                   Qt::MiddleButton, {});
  QApplication::sendEvent(&view, &move);
  QTest::mouseRelease(&view, Qt::MiddleButton, {}, {130, 110});
  QVERIFY(!view.keepsInView());
  const ViewCamera his = view.camera();
  QVERIFY(!sees(walkTo(9)));
  QCOMPARE(view.camera(), his);
  // Home begins anew, and the key switches it.
  view.goHome();
  QVERIFY(sees(walkTo(12)));
  QTest::keyClick(&view, Qt::Key_V);
  QVERIFY(!sees(walkTo(0)));
}

void TestScene3d::savesAPngWithItsTexts() {
  QTemporaryDir folder;
  SceneView view;
  view.resize(kSize);
  view.setBadges({{"stand-in reality", Badge::Tone::standIn}});
  const QString path = folder.filePath("view.png");
  QVERIFY(view.savePicture(path));
  QCOMPARE(QImage(path).convertToFormat(QImage::Format_RGB32), view.picture(kSize));
  view.setBadges({});
  QVERIFY(QImage(path).convertToFormat(QImage::Format_RGB32) != view.picture(kSize));
  QVERIFY(!view.savePicture(folder.filePath("no/such/folder/view.png")));
}

UI_TEST(TestScene3d)
#include "test_scene3d.moc"
