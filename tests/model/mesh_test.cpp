// Surfaces become triangles of the right area, volume and direction.
#include "core/model/mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/model/model_texts.h"

namespace btr::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

struct Measured {
  double area = 0, volume = 0;
  std::size_t triangles = 0;
};

/// Surface, and the volume by the divergence theorem: positive if the triangles face outwards.
Measured measure(const std::vector<Vector3f>& vertices, const std::vector<std::array<int, 3>>& triangles) {
  Measured result;
  for (const auto& triangle : triangles) {
    const auto at = [&](std::size_t i) {
      return vertices.at(static_cast<std::size_t>(triangle[i])).cast<double>().eval();
    };
    result.area += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
    result.volume += at(0).dot(at(1).cross(at(2))) / 6;
    ++result.triangles;
  }
  return result;
}

Measured measure(const vrml::Polygons& polygons) {
  vrml::MeshEffort effort;
  Measured result;
  for (const auto& mesh : vrml::triangulate(polygons, effort)) {
    const Measured part = measure(mesh.vertices, mesh.triangles);
    result = {result.area + part.area, result.volume + part.volume, result.triangles + part.triangles};
  }
  return result;
}

Measured measure(const std::string& shape) {
  Measured result;
  for (const Shape& each : shapesOf(shape)) {
    EXPECT_EQ(Shape::Kind::mesh, each.kind);
    EXPECT_EQ(each.surface->vertices.size(), each.surface->normals.size());
    const Measured part = measure(each.surface->vertices, each.surface->triangles);
    result = {result.area + part.area, result.volume + part.volume, result.triangles + part.triangles};
  }
  return result;
}

std::string faceSet(const std::string& points, const std::string& indices, const std::string& more = "") {
  return "Shape { geometry IndexedFaceSet { coord Coordinate { point [ " + points + " ] } coordIndex [ " + indices +
         " ] " + more + " } }";
}

TEST(Mesh, SolidsHaveTheVolumeOfTheirFormulaOrALittleLess) {
  EXPECT_NEAR(24, measure(vrml::boxPolygons({2, 3, 4})).volume, 1e-5);
  EXPECT_NEAR(52, measure(vrml::boxPolygons({2, 3, 4})).area, 1e-5);
  const double sphere = measure(vrml::spherePolygons(1)).volume, exact = 4 * M_PI / 3;
  EXPECT_GT(sphere, 0.96 * exact);
  EXPECT_LT(sphere, exact);
  // A prism over a regular 24-gon: area 12·sin(15 degrees)·r².
  const double base = 12 * std::sin(M_PI / 12);
  EXPECT_NEAR(base * 5, measure(vrml::conePolygons(1, 1, 5, true, true, true)).volume, 1e-5);
  EXPECT_NEAR(base * 5 / 3, measure(vrml::conePolygons(1, 0, 5, true, true, false)).volume, 1e-5);
}

TEST(Mesh, ExtrusionOfASquareIsABox) {
  const auto box = measure("Shape { geometry Extrusion { spine [ 0 0 0, 0 3 0 ] } }");
  EXPECT_NEAR(2 * 2 * 3, box.volume, 1e-5);
  EXPECT_NEAR(2 * 4 + 4 * 6, box.area, 1e-5);
}

TEST(Mesh, ExtrusionFollowsScaleTurnAndADirectionAlongX) {
  // A frustum from a 2 x 2 to a 1 x 1 square, lying along x: h/3·(A + B + sqrt(A·B)).
  const auto frustum = measure("Shape { geometry Extrusion { spine [ 0 0 0, 3 0 0 ] scale [ 1 1, 0.5 0.5 ] } }");
  EXPECT_NEAR(3.0 / 3 * (4 + 1 + 2), frustum.volume, 1e-4);
  // A turned square is still a square.
  const auto turned = measure("Shape { geometry Extrusion { spine [ 0 0 0, 0 1 0 ] orientation 0 1 0 0.5 } }");
  EXPECT_NEAR(4, turned.volume, 1e-5);
  // A spine with a corner: the sections at the ends are square to their pieces.
  const auto bent = measure(
      "Shape { geometry Extrusion { convex FALSE spine [ 0 0 0, 0 9 0, 9 9 0 ] crossSection [ 0.1 0.1, 0.1 -0.1, -0.1 "
      "-0.1, -0.1 0.1, 0.1 0.1 ] } }");
  EXPECT_GT(bent.volume, 0.04 * 18 * 0.7);
  EXPECT_LT(bent.volume, 0.04 * 18);
}

TEST(Mesh, ElevationGridFacesUp) {
  const auto shapes = shapesOf(
      "Shape { geometry ElevationGrid { xDimension 3 zDimension 2 xSpacing 2 zSpacing 5 height [ 0 0 0 0 0 0 ] } }");
  const Measured flat = measure(shapes.at(0).surface->vertices, shapes[0].surface->triangles);
  EXPECT_NEAR(4 * 5, flat.area, 1e-6);
  for (const Vector3f& normal : shapes[0].surface->normals) EXPECT_TRUE(normal.isApprox(Vector3f(0, 1, 0)));
}

TEST(Mesh, ConcavePolygonsKeepTheirArea) {
  // An L of area 3, and a star with five points, as one polygon each.
  EXPECT_NEAR(3, measure(faceSet("0 0 0, 2 0 0, 2 1 0, 1 1 0, 1 2 0, 0 2 0", "0 1 2 3 4 5", "convex FALSE")).area,
              1e-6);
  std::string points;
  double area = 0;
  for (int i = 0; i < 10; ++i) {
    const double r = i % 2 ? 0.4 : 1.0, a = M_PI * i / 5;
    points += std::to_string(r * std::cos(a)) + " 0 " + std::to_string(-r * std::sin(a)) + " ";
    area += 0.5 * 0.4 * std::sin(M_PI / 5);
  }
  EXPECT_NEAR(area, measure(faceSet(points, "0 1 2 3 4 5 6 7 8 9", "convex FALSE")).area, 1e-4);
}

TEST(Mesh, ConvexPolygonsOfNCornersGiveNMinusTwoTriangles) {
  EXPECT_EQ(
      4u,
      measure(faceSet("1 0 0, 0.5 0.9 0, -0.5 0.9 0, -1 0 0, -0.5 -0.9 0, 0.5 -0.9 0", "0 1 2 3 4 5 -1")).triangles);
}

TEST(Mesh, ClockwiseFacesAreTurnedRound) {
  const auto normalOf = [](const std::string& more) {
    return shapesOf(faceSet("0 0 0, 1 0 0, 0 1 0", "0 1 2", more)).at(0).surface->normals.at(0);
  };
  EXPECT_TRUE(normalOf("").isApprox(Vector3f(0, 0, 1)));
  EXPECT_TRUE(normalOf("ccw FALSE").isApprox(Vector3f(0, 0, -1)));
}

TEST(Mesh, CreaseAngleDecidesWhichEdgesAreSmooth) {
  // Two faces that meet at 90 degrees: four vertices if the edge is smooth, six if it is sharp.
  const std::string points = "0 0 0, 1 0 0, 0 1 0, 0 0 1", faces = "0 1 2 -1 0 3 1 -1";
  EXPECT_EQ(6u, shapesOf(faceSet(points, faces)).at(0).surface->vertices.size());
  EXPECT_EQ(6u, shapesOf(faceSet(points, faces, "creaseAngle 1.5")).at(0).surface->vertices.size());
  const auto smooth = shapesOf(faceSet(points, faces, "creaseAngle 1.6")).at(0);
  EXPECT_EQ(4u, smooth.surface->vertices.size());
  // Both faces have the same area: the shared edge looks half way between +z and +y.
  EXPECT_TRUE(smooth.surface->normals.at(0).isApprox(Vector3f(0, 1, 1).normalized(), 1e-5f));
}

TEST(Mesh, GivenNormalsAreKept) {
  const auto shape = shapesOf(faceSet("0 0 0, 1 0 0, 0 1 0", "0 1 2",
                                      "normal Normal { vector [ 0 0 2, 1 0 0 ] } normalIndex [ 0 1 0 ]"))
                         .at(0);
  ASSERT_EQ(3u, shape.surface->normals.size());
  EXPECT_TRUE(shape.surface->normals[0].isApprox(Vector3f(0, 0, 1)));
  EXPECT_TRUE(shape.surface->normals[1].isApprox(Vector3f(1, 0, 0)));
}

TEST(Mesh, FacesOfSeveralColoursBecomeShapesOfOneColour) {
  const auto shapes =
      shapesOf(faceSet("0 0 0, 1 0 0, 0 1 0, 1 1 0", "0 1 2 -1 2 1 3 -1 0 1 3 -1",
                       "colorPerVertex FALSE color Color { color [ 1 0 0, 0 0 1 ] } colorIndex [ 0 1 0 ]"));
  ASSERT_EQ(2u, shapes.size());
  EXPECT_EQ(1.f, shapes[0].colour[0]);
  EXPECT_EQ(2u, shapes[0].surface->triangles.size());
  EXPECT_EQ(1.f, shapes[1].colour[2]);
}

TEST(Mesh, ScaledPrimitivesStayPrimitivesWhereTheyCan) {
  const auto scaled = [](const std::string& scale, const std::string& geometry) {
    return shapesOf("Transform { scale " + scale + " children Shape { geometry " + geometry + " } }").at(0);
  };
  EXPECT_EQ(Vector3d(2, 6, 12), scaled("1 2 3", "Box { size 2 3 4 }").size_m);
  EXPECT_EQ(2, scaled("2 2 2", "Sphere { }").size_m.x());
  EXPECT_EQ(Vector3d(2, 6, 0), scaled("2 3 2", "Cylinder { }").size_m);
  EXPECT_EQ(Shape::Kind::mesh, scaled("1 2 3", "Sphere { }").kind);
  EXPECT_EQ(Shape::Kind::mesh, scaled("1 1 2", "Cylinder { }").kind);
  const Shape egg = scaled("1 2 3", "Sphere { }");
  EXPECT_NEAR(
      6, measure(egg.surface->vertices, egg.surface->triangles).volume / measure(vrml::spherePolygons(1)).volume, 1e-4);
}

TEST(Mesh, AMirrorTurnsTheTrianglesSoThatTheyStillFaceOutwards) {
  const auto mirrored = measure("Transform { scale -1 1 1 children Shape { geometry Cone { } } }");
  EXPECT_GT(mirrored.volume, 0);
  EXPECT_NEAR(measure("Shape { geometry Cone { } }").volume, mirrored.volume, 1e-5);
}

TEST(Mesh, TrianglesWithoutAreaAreDropped) {
  EXPECT_TRUE(shapesOf(faceSet("0 0 0, 1 0 0, 2 0 0", "0 1 2 -1 0 0 1 -1")).empty());
}

}  // namespace
}  // namespace btr::test
