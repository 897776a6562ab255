#include <QTest>
#include <cmath>
#include <map>

#include "core/model/robot_model.h"
#include "core/sim/scene.h"
#include "tests/ui/ui_tests.h"
#include "ui/scene3d/mesh_simplify.h"

using namespace btr;
using namespace btr::ui;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

constexpr Colour red{1, 0, 0, 1}, white{1, 1, 1, 1};

std::size_t triangles(const TriangleMesh& mesh) { return mesh.indices.size() / 3; }

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return Vector3d(mesh.positions[mesh.indices[i + k]].cast<double>()); };
    sum += corner(0).dot(corner(1).cross(corner(2))) / 6;
  }
  return sum;
}

double area(const TriangleMesh& mesh, const Colour& colour) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return Vector3d(mesh.positions[mesh.indices[i + k]].cast<double>()); };
    if (mesh.colours[mesh.indices[i]] == colour) sum += (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm() / 2;
  }
  return sum;
}

/// Triangles at each edge, by its two places.
std::map<std::array<long, 6>, int> edges(const TriangleMesh& mesh) {
  std::map<std::array<long, 6>, int> counts;
  const auto place = [&](std::size_t i) {  // [µm]
    const Eigen::Vector3f& at = mesh.positions[mesh.indices[i]];
    return std::array{std::lround(1e6 * at.x()), std::lround(1e6 * at.y()), std::lround(1e6 * at.z())};
  };
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const auto [a, b] = std::minmax({place(i), place(i % 3 == 2 ? i - 2 : i + 1)});
    ++counts[{a[0], a[1], a[2], b[0], b[1], b[2]}];
  }
  return counts;
}

/// A sheet of 20 × 20 squares of 1 cm, whose left half is red.
TriangleMesh sheet() {
  TriangleMesh mesh;
  const auto place = [](int x, int y) { return Eigen::Vector3f(0.01f * float(x), 0.01f * float(y), 0); };
  for (int x = 0; x < 20; ++x)
    for (int y = 0; y < 20; ++y)
      mesh.addQuad(place(x, y), place(x + 1, y), place(x + 1, y + 1), place(x, y + 1), x < 10 ? red : white);
  return mesh;
}

}  // namespace

class TestMeshSimplify : public QObject {
  Q_OBJECT

 private slots:
  void aFlatSheetKeepsItsEdgesAndColours();
  void aBallStaysAsRoundAsAsked();
  void aClosedBodyStaysClosed();
  void cornersKeepTheirNormals();
  void everyRobotGetsSmaller_data();
  void everyRobotGetsSmaller();
  void nothingIsLeftAsItIs();
};

void TestMeshSimplify::aFlatSheetKeepsItsEdgesAndColours() {
  const TriangleMesh mesh = simplified(sheet(), 1e-4);
  QVERIFY2(triangles(mesh) < 40, qPrintable(QString::number(triangles(mesh))));
  QVERIFY(std::abs(area(mesh, red) - 0.02) < 1e-7);
  QVERIFY(std::abs(area(mesh, white) - 0.02) < 1e-7);
  for (const Eigen::Vector3f& normal : mesh.normals) QCOMPARE(normal.z(), 1.f);
}

void TestMeshSimplify::aBallStaysAsRoundAsAsked() {
  TriangleMesh ball;
  const double radius_m = 0.05;
  ball.addSphere(Isometry3d::Identity(), radius_m, white);
  std::size_t before = triangles(ball);
  for (const double error_m : {0.0005, 0.001, 0.002, 0.004}) {
    const TriangleMesh mesh = simplified(ball, error_m);
    QVERIFY(triangles(mesh) < before);
    before = triangles(mesh);
    // Corners stay on the ball; the faces between them sink into it, on average hardly more than was allowed.
    for (const Eigen::Vector3f& place : mesh.positions) QVERIFY(std::abs(place.norm() - radius_m) < 1e-6);
    const double full = 4.0 / 3 * M_PI * std::pow(radius_m, 3),
                 sunk_m = (full - volume(mesh)) / (4 * M_PI * radius_m * radius_m);
    QVERIFY2(sunk_m > 0 && sunk_m < 2 * error_m + 2e-4, qPrintable(QString::number(sunk_m)));
  }
}

void TestMeshSimplify::aClosedBodyStaysClosed() {
  TriangleMesh body;
  body.addCapsule(Isometry3d::Identity(), 0.02, 0.1, white);
  const TriangleMesh mesh = simplified(body, 0.001);
  QVERIFY(triangles(mesh) < triangles(body) / 2);
  for (const auto& [edge, faces] : edges(mesh)) QCOMPARE(faces, 2);
}

void TestMeshSimplify::cornersKeepTheirNormals() {
  TriangleMesh box;
  box.addBox(Isometry3d::Identity(), {0.1, 0.2, 0.3}, white);
  const TriangleMesh mesh = simplified(box, 0.001);
  QCOMPARE(triangles(mesh), triangles(box));  // nothing can be taken from it
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
    const Eigen::Vector3f across = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    for (std::size_t k = 0; k < 3; ++k) QVERIFY((mesh.normals[mesh.indices[i + k]] - across).norm() < 1e-5f);
  }
}

void TestMeshSimplify::everyRobotGetsSmaller_data() {
  QTest::addColumn<QString>("file");
  for (const char* name : {"ers7", "ers210", "ers220"})
    QTest::newRow(name) << QString(SOURCE_DIR "/resources/robots/%1.wrl").arg(name);
}

void TestMeshSimplify::everyRobotGetsSmaller() {
  QFETCH(QString, file);
  SceneSpec scene;
  RobotSpec robot;
  robot.name = "dog";
  robot.model = file.toStdString();
  scene.robots = {robot};
  const ModelSet models = loadModels(scene);
  std::size_t all = 0, left = 0;
  for (const Link& link : models.begin()->second->links) {
    TriangleMesh mesh;
    for (const Shape& shape : link.shapes)
      if (shape.drawn) mesh.addShape(shape, shape.pose, shape.colour);
    const TriangleMesh once = simplified(mesh, 0.0025), again = simplified(mesh, 0.0025);
    QVERIFY(once.indices == again.indices && once.positions == again.positions);
    QVERIFY(mesh.empty() || !once.empty());
    Eigen::AlignedBox3f before, after;
    for (const Eigen::Vector3f& place : mesh.positions) before.extend(place);
    for (const Eigen::Vector3f& place : once.positions) after.extend(place);
    // Every corner of the box around it is where it was, but for a few times the error.
    if (!mesh.empty()) QVERIFY((before.min() - after.min()).cwiseAbs().maxCoeff() < 0.01f);
    if (!mesh.empty()) QVERIFY((before.max() - after.max()).cwiseAbs().maxCoeff() < 0.01f);
    all += triangles(mesh);
    left += triangles(once);
  }
  QVERIFY2(left < all / 3, qPrintable(QString("%1 of %2").arg(left).arg(all)));
}

void TestMeshSimplify::nothingIsLeftAsItIs() { QVERIFY(simplified({}, 0.001).empty()); }

UI_TEST(TestMeshSimplify)
#include "test_mesh_simplify.moc"
