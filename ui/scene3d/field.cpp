#include "ui/scene3d/field.h"

#include <cmath>

namespace btr::ui {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr Colour kCarpet{0.16f, 0.46f, 0.24f, 1}, kLine{0.95f, 0.96f, 0.95f, 1}, kWall{0.90f, 0.91f, 0.92f, 1},
    kYellow{0.97f, 0.82f, 0.10f, 1}, kBlue{0.16f, 0.62f, 0.90f, 1}, kPink{0.96f, 0.36f, 0.62f, 1},
    kGreen{0.16f, 0.70f, 0.36f, 1};
constexpr double kLineHeight = 0.0005;

Isometry3d at(double x, double y, double z) { return Isometry3d(Eigen::Translation3d(x, y, z)); }

Colour colourOf(const std::string& text) {
  const unsigned long bits = std::stoul(text.substr(1), nullptr, 16);
  const auto part = [bits](int shift) { return float((bits >> shift) & 0xff) / 255; };
  return {part(16), part(8), part(0), 1};
}

/// A flat rectangle seen from above.
void addPatch(TriangleMesh& mesh, double x0, double y0, double x1, double y1, double z, const Colour& colour) {
  const auto corner = [z](double x, double y) { return Vector3d(x, y, z).cast<float>().eval(); };
  mesh.addQuad(corner(x0, y0), corner(x1, y0), corner(x1, y1), corner(x0, y1), colour);
}

/// Two sides and a back around the mouth, which looks to the field's middle. `side` is +1 or −1 along x.
void addGoal(TriangleMesh& mesh, const FieldSize& size, double side, const Colour& colour) {
  const double x = side * size.length / 2, half = size.goalWidth / 2 + size.goalPanel / 2, z = size.goalHeight / 2;
  for (double y : {-half, half})
    mesh.addBox(at(x + side * size.goalDepth / 2, y, z), {size.goalDepth, size.goalPanel, size.goalHeight}, colour);
  mesh.addBox(at(x + side * (size.goalDepth + size.goalPanel / 2), 0, z),
              {size.goalPanel, size.goalWidth + 2 * size.goalPanel, size.goalHeight}, colour);
  mesh.addBox(at(x + side * size.goalPanel, 0, size.goalHeight - size.goalPanel / 2),
              {2 * size.goalPanel, size.goalWidth, size.goalPanel}, colour);
}

/// A white foot and two colour bands of a quarter each.
void addBeacon(TriangleMesh& mesh, const FieldSize& size, double x, double y, const Colour& lower,
               const Colour& upper) {
  const double band = size.beaconHeight / 4;
  const auto piece = [&](double low, double high, const Colour& colour) {
    Isometry3d pose = at(x, y, (low + high) / 2);
    pose.rotate(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()));
    mesh.addCylinder(pose, size.beaconDiameter / 2, high - low, colour);
  };
  piece(0, 2 * band, kWall);
  piece(2 * band, 3 * band, lower);
  piece(3 * band, 4 * band, upper);
}

}  // namespace

TriangleMesh fieldCarpet(const FieldSize& size) {
  TriangleMesh mesh;
  addPatch(mesh, -size.carpetX, -size.carpetY, size.carpetX, size.carpetY, 0, kCarpet);
  return mesh;
}

TriangleMesh fieldLines(const FieldSize& size) {
  TriangleMesh mesh;
  const double x = size.length / 2, y = size.width / 2, w = size.line;
  const auto frame = [&](double x0, double y0, double x1, double y1) {
    addPatch(mesh, x0, y0, x1, y0 + w, kLineHeight, kLine);
    addPatch(mesh, x0, y1 - w, x1, y1, kLineHeight, kLine);
    addPatch(mesh, x0, y0 + w, x0 + w, y1 - w, kLineHeight, kLine);
    addPatch(mesh, x1 - w, y0 + w, x1, y1 - w, kLineHeight, kLine);
  };
  frame(-x, -y, x, y);
  for (double side : {-1.0, 1.0}) {
    // The area shares its goal line with the border.
    const double inner = side * (x - size.penaltyDepth), edge = side * (x - w), half = size.penaltyWidth / 2;
    addPatch(mesh, std::min(inner, inner + side * w), -half, std::max(inner, inner + side * w), half, kLineHeight,
             kLine);
    for (double end : {-half, half - w})
      addPatch(mesh, std::min(inner + side * w, edge), end, std::max(inner + side * w, edge), end + w, kLineHeight,
               kLine);
    // The halfway line, in two pieces that leave the circle's ring to itself.
    const double from = side * size.circle / 2, to = side * (y - w);
    addPatch(mesh, -w / 2, std::min(from, to), w / 2, std::max(from, to), kLineHeight, kLine);
  }
  addPatch(mesh, -w / 2, -(size.circle / 2 - w), w / 2, size.circle / 2 - w, kLineHeight, kLine);
  mesh.addRing(size.circle / 2 - w, size.circle / 2, kLineHeight, kLine);
  return mesh;
}

TriangleMesh fieldFixtures(const FieldSize& size) {
  TriangleMesh mesh;
  addGoal(mesh, size, -1, kBlue);
  addGoal(mesh, size, 1, kYellow);
  // Pink is on top on one side and below on the other, so that every beacon is unique.
  for (const auto& [x, colour] : {std::pair{-size.beaconX, kBlue}, {0.0, kGreen}, {size.beaconX, kYellow}}) {
    addBeacon(mesh, size, x, size.beaconY, colour, kPink);
    addBeacon(mesh, size, x, -size.beaconY, kPink, colour);
  }
  return mesh;
}

TriangleMesh fieldWall(const FieldSize& size) {
  TriangleMesh mesh;
  const double t = size.wallThickness, h = size.wallHeight;
  for (double side : {-1.0, 1.0}) {
    mesh.addBox(at(side * (size.carpetX + t / 2), 0, h / 2), {t, 2 * size.carpetY, h}, kWall);
    mesh.addBox(at(0, side * (size.carpetY + t / 2), h / 2), {2 * (size.carpetX + t), t, h}, kWall);
  }
  return mesh;
}

TriangleMesh carpetCloth(const CarpetSpec& carpet) {
  TriangleMesh mesh;
  const double x = carpet.size_m[0] / 2, y = carpet.size_m[1] / 2;
  addPatch(mesh, -x, -y, x, y, 0, colourOf(carpet.colour));
  return mesh;
}

TriangleMesh carpetLines(const CarpetSpec& carpet) {
  TriangleMesh mesh;
  const Colour colour = colourOf(carpet.lineColour);
  for (const CarpetSpec::Line& line : carpet.lines) {
    const Eigen::Vector2d from(line.from_m.data()), to(line.to_m.data());
    const Eigen::Vector2d along = (to - from).normalized(),
                          aside = line.width_m / 2 * Eigen::Vector2d(-along.y(), along.x());
    const auto corner = [](const Eigen::Vector2d& p) {
      return Vector3d(p.x(), p.y(), kLineHeight).cast<float>().eval();
    };
    mesh.addQuad(corner(from - aside), corner(to - aside), corner(to + aside), corner(from + aside), colour);
  }
  for (const CarpetSpec::Circle& circle : carpet.circles)
    mesh.addRing(circle.radius_m - circle.width_m, circle.radius_m, kLineHeight, colour,
                 {circle.centre_m[0], circle.centre_m[1]});
  return mesh;
}

TriangleMesh plainFloor(double halfWidth, double z, const Colour& colour) {
  TriangleMesh mesh;
  addPatch(mesh, -halfWidth, -halfWidth, halfWidth, halfWidth, z, colour);
  return mesh;
}

TriangleMesh floorGrid(double halfWidth, const Colour& colour) {
  TriangleMesh mesh;
  const int tenths = static_cast<int>(std::round(halfWidth * 10));
  for (int i = -tenths; i <= tenths; ++i) {
    const double w = i % 5 == 0 ? 0.0016 : 0.0006, p = i / 10.0;
    addPatch(mesh, p - w, -halfWidth, p + w, halfWidth, kLineHeight, colour);
    addPatch(mesh, -halfWidth, p - w, halfWidth, p + w, kLineHeight, colour);
  }
  return mesh;
}

}  // namespace btr::ui
