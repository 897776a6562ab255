#include "core/model/vrml/vrml_shapes.h"

#include <algorithm>
#include <cmath>

namespace btr::vrml {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Splits a map into a rotation and lengths along the rotated axes, if it is made of these alone.
bool splitScale(const Affine3d& map, Eigen::Isometry3d& pose, Vector3d& scale) {
  Matrix3d columns = map.linear();
  scale = columns.colwise().norm();
  if (!(scale.minCoeff() > 0) || !scale.allFinite()) return false;
  for (int i = 0; i < 3; ++i) columns.col(i) /= scale(i);
  if (!(columns.transpose() * columns).isIdentity(1e-6)) return false;
  // A mirrored box is the same box.
  if (columns.determinant() < 0) columns.col(2) *= -1;
  pose = Eigen::Isometry3d::Identity();
  pose.linear() = columns;
  pose.translation() = map.translation();
  return true;
}

bool near(double a, double b) { return std::abs(a - b) <= 1e-6 * std::max(std::abs(a), std::abs(b)); }

void needPositive(const Document& document, const Node& node, const char* what, double value) {
  if (!(value > 0)) document.fail(node, node.kind() + "." + what + " must be greater than 0");
}

}  // namespace

Shape ShapeReader::lookOf(const Node& shape) {
  Shape look;
  const Node* appearance = nodeField(shape, "appearance");
  if (!appearance) return look;
  if (nodeField(*appearance, "texture") && !saidTexture_) {
    saidTexture_ = true;
    document_.warn(appearance->file, appearance->line, "textures are not drawn");
  }
  const Node* material = nodeField(*appearance, "material");
  if (!material) return look;
  Vector3d colour = vectorField(document_, *material, "diffuseColor", Vector3d::Constant(0.8));
  if (colour.isZero()) colour = vectorField(document_, *material, "emissiveColor", Vector3d::Zero());
  const double opacity = 1 - realField(document_, *material, "transparency", 0);
  for (int i = 0; i < 3; ++i)
    look.colour[static_cast<std::size_t>(i)] = static_cast<float>(std::clamp(colour(i), 0., 1.));
  look.colour[3] = static_cast<float>(std::clamp(opacity, 0., 1.));
  return look;
}

void ShapeReader::read(const Node& shape, const Affine3d& toLink, std::vector<Shape>& shapes) {
  const Node* geometry = nodeField(shape, "geometry");
  if (!geometry) return;
  const Shape look = lookOf(shape);
  const std::string& kind = geometry->kind();
  std::vector<std::array<float, 4>> palette;
  if (kind == "Box" || kind == "Sphere" || kind == "Cylinder" || kind == "Cone")
    readPrimitive(*geometry, toLink, look, shapes);
  else if (kind == "IndexedFaceSet") {
    const Polygons faces = faceSet(*geometry, palette, look);
    emit(faces, palette, toLink, look, *geometry, shapes);
  } else if (kind == "ElevationGrid")
    emit(elevationGrid(*geometry), palette, toLink, look, *geometry, shapes);
  else if (kind == "Extrusion")
    emit(extrusion(*geometry), palette, toLink, look, *geometry, shapes);
  else
    document_.warn(geometry->file, geometry->line, kind + " is not drawn");
}

void ShapeReader::readPrimitive(const Node& geometry, const Affine3d& toLink, const Shape& look,
                                std::vector<Shape>& shapes) {
  const std::string& kind = geometry.kind();
  Shape shape = look;
  Vector3d scale;
  const bool plain = splitScale(toLink, shape.pose, scale);
  Polygons polygons;
  bool keeps = plain;
  if (kind == "Box") {
    const Vector3d size = vectorField(document_, geometry, "size", Vector3d::Constant(2));
    needPositive(document_, geometry, "size", size.minCoeff());
    shape.kind = Shape::Kind::box;
    shape.size_m = size.cwiseProduct(scale);
    if (!keeps) polygons = boxPolygons(size);
  } else if (kind == "Sphere") {
    const double radius = realField(document_, geometry, "radius", 1);
    needPositive(document_, geometry, "radius", radius);
    shape.kind = Shape::Kind::sphere;
    keeps = plain && near(scale.x(), scale.y()) && near(scale.y(), scale.z());
    shape.size_m = Vector3d(radius * scale.x(), 0, 0);
    if (!keeps) polygons = spherePolygons(radius);
  } else {
    const bool cone = kind == "Cone";
    const char* radiusName = cone ? "bottomRadius" : "radius";
    const double radius = realField(document_, geometry, radiusName, 1);
    const double height = realField(document_, geometry, "height", 2);
    needPositive(document_, geometry, radiusName, radius);
    needPositive(document_, geometry, "height", height);
    shape.kind = Shape::Kind::cylinder;
    keeps = plain && !cone && near(scale.x(), scale.z());
    shape.size_m = Vector3d(radius * scale.x(), height * scale.y(), 0);
    if (!keeps)
      polygons = conePolygons(radius, cone ? 0 : radius, height, flagField(geometry, "side", true),
                              flagField(geometry, "bottom", true), !cone && flagField(geometry, "top", true));
  }
  if (!keeps) return emit(polygons, {}, toLink, look, geometry, shapes);
  if (!shape.size_m.allFinite() || !shape.pose.matrix().allFinite())
    document_.fail(geometry, kind + " is larger than a number can say");
  shapes.push_back(std::move(shape));
}

void ShapeReader::emit(const Polygons& polygons, const std::vector<std::array<float, 4>>& palette,
                       const Affine3d& toLink, const Shape& look, const Node& geometry, std::vector<Shape>& shapes) {
  // A face of n corners becomes n − 2 triangles: the budget is checked before they are made.
  for (std::size_t face = 0; face < polygons.faces(); ++face)
    triangles_ += std::max<std::size_t>(polygons.start[face + 1] - polygons.start[face], 2) - 2;
  if (triangles_ > budget_.triangles)
    document_.fail(geometry,
                   "more than " + std::to_string(budget_.triangles) + " triangles in the file are not allowed");

  const bool mirrored = toLink.linear().determinant() < 0;
  const Matrix3d forNormals = toLink.linear().inverse().transpose();
  const bool wasShort = effort_.wasShort;
  for (Mesh& mesh : triangulate(polygons, effort_)) {
    Shape shape = look;
    shape.kind = Shape::Kind::mesh;
    shape.pose = Eigen::Isometry3d::Identity();
    if (mesh.colour >= 0) shape.colour = palette[static_cast<std::size_t>(mesh.colour)];
    for (Eigen::Vector3f& vertex : mesh.vertices) {
      vertex = (toLink * vertex.cast<double>()).cast<float>();
      if (!vertex.allFinite()) document_.fail(geometry, geometry.kind() + " is larger than a number can say");
    }
    for (Eigen::Vector3f& normal : mesh.normals) {
      const Vector3d turned = forNormals * normal.cast<double>();
      normal = (turned.allFinite() && turned.norm() > 0 ? turned.normalized() : Vector3d::UnitZ().eval()).cast<float>();
    }
    if (mirrored)
      for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    shape.surface = std::make_shared<const Surface>(
        Surface{std::move(mesh.vertices), std::move(mesh.triangles), std::move(mesh.normals)});
    shapes.push_back(std::move(shape));
  }
  if (effort_.wasShort && !wasShort)
    document_.warn(geometry.file, geometry.line, "polygons with too many corners are cut as if they were convex");
}

Polygons ShapeReader::elevationGrid(const Node& geometry) {
  Polygons grid;
  const std::int64_t columns = integerField(document_, geometry, "xDimension", 0);
  const std::int64_t rows = integerField(document_, geometry, "zDimension", 0);
  const double xSpacing = realField(document_, geometry, "xSpacing", 1);
  const double zSpacing = realField(document_, geometry, "zSpacing", 1);
  const Value* heights = geometry.find("height");
  const std::int64_t count = heights ? static_cast<std::int64_t>(heights->numbers.size()) : 0;
  if (columns < 0 || rows < 0 || columns * rows != count)
    document_.fail(geometry, "ElevationGrid has " + std::to_string(count) + " heights; xDimension times zDimension (" +
                                 std::to_string(columns) + " x " + std::to_string(rows) + ") are expected");
  for (std::int64_t row = 0; row < rows; ++row)
    for (std::int64_t column = 0; column < columns; ++column)
      grid.points.push_back(Vector3d(static_cast<double>(column) * xSpacing,
                                     heights->numbers[static_cast<std::size_t>(row * columns + column)],
                                     static_cast<double>(row) * zSpacing)
                                .cast<float>());
  for (std::int64_t row = 0; row + 1 < rows; ++row)
    for (std::int64_t column = 0; column + 1 < columns; ++column) {
      const auto first = static_cast<std::int32_t>(row * columns + column);
      const auto below = static_cast<std::int32_t>(first + columns);
      grid.addFace({first, below, below + 1, first + 1});
    }
  grid.counterClockwise = flagField(geometry, "ccw", true);
  grid.creaseAngle = static_cast<float>(realField(document_, geometry, "creaseAngle", 0));
  if (nodeField(geometry, "color"))
    document_.warn(geometry.file, geometry.line, "the colours of an ElevationGrid are not drawn");
  return grid;
}

Polygons ShapeReader::extrusion(const Node& geometry) {
  ExtrusionData data;
  const auto pairs = [&](const char* field, std::vector<Eigen::Vector2f>& into) {
    const Value* value = geometry.find(field);
    for (std::size_t i = 0; value && i + 1 < value->packed.size(); i += 2)
      into.emplace_back(value->packed[i], value->packed[i + 1]);
  };
  pairs("crossSection", data.crossSection);
  if (data.crossSection.empty()) data.crossSection = {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}, {1, 1}};
  pairs("scale", data.scale);
  if (const Value* spine = geometry.find("spine"))
    for (std::size_t i = 0; i + 2 < spine->packed.size(); i += 3)
      data.spine.emplace_back(spine->packed[i], spine->packed[i + 1], spine->packed[i + 2]);
  else
    data.spine = {{0, 0, 0}, {0, 1, 0}};
  if (const Value* turns = geometry.find("orientation"))
    for (std::size_t i = 0; i + 3 < turns->numbers.size(); i += 4) {
      const Vector3d axis(turns->numbers[i], turns->numbers[i + 1], turns->numbers[i + 2]);
      const double length = axis.stableNorm();
      data.orientation.push_back(length > 0
                                     ? Eigen::Quaternionf(Eigen::AngleAxisf(static_cast<float>(turns->numbers[i + 3]),
                                                                            (axis / length).cast<float>()))
                                     : Eigen::Quaternionf::Identity());
    }
  data.beginCap = flagField(geometry, "beginCap", true);
  data.endCap = flagField(geometry, "endCap", true);

  // Points are the product of two lists: counted before they are made.
  if (data.spine.size() * data.crossSection.size() > budget_.triangles)
    document_.fail(geometry,
                   "more than " + std::to_string(budget_.triangles) + " triangles in the file are not allowed");
  Polygons result = extrude(data);
  result.counterClockwise = flagField(geometry, "ccw", true);
  result.convex = flagField(geometry, "convex", true);
  result.creaseAngle = static_cast<float>(realField(document_, geometry, "creaseAngle", 0));
  return result;
}

}  // namespace btr::vrml
