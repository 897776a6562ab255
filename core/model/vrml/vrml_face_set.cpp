// IndexedFaceSet with its coordinates, normals and colours.
#include <cmath>
#include <map>

#include "core/model/vrml/vrml_shapes.h"

namespace btr::vrml {
namespace {

using Eigen::Vector3f;
constexpr std::size_t mostColours = 64;  // of one face set; each makes a shape

std::vector<Vector3f> triples(const Node* node, const char* field) {
  std::vector<Vector3f> result;
  const Value* value = node ? node->find(field) : nullptr;
  if (!value) return result;
  result.reserve(value->packed.size() / 3);
  for (std::size_t i = 0; i + 2 < value->packed.size(); i += 3)
    result.emplace_back(value->packed[i], value->packed[i + 1], value->packed[i + 2]);
  return result;
}

const std::vector<std::int32_t>* indices(const Node& geometry, const char* field) {
  const Value* value = geometry.find(field);
  return value && !value->integers.empty() ? &value->integers : nullptr;
}

}  // namespace

Polygons ShapeReader::faceSet(const Node& geometry, std::vector<std::array<float, 4>>& palette, const Shape& look) {
  Polygons result;
  const Node* coordinate = nodeField(geometry, "coord");
  if (!coordinate) {
    document_.warn(geometry.file, geometry.line, "an IndexedFaceSet without coord: there is no shape",
                   Warning::Loss::collision);
    return result;
  }
  result.points = triples(coordinate, "point");
  result.counterClockwise = flagField(geometry, "ccw", true);
  result.convex = flagField(geometry, "convex", true);
  result.creaseAngle = static_cast<float>(realField(document_, geometry, "creaseAngle", 0));

  // Faces; of each kept corner and face it is remembered where the file had it, for normals and colours.
  std::vector<std::size_t> cornerAt, faceAt;
  std::size_t dropped = 0, tooShort = 0, faceNumber = 0;
  const auto* list = indices(geometry, "coordIndex");
  const std::vector<std::int32_t> coordIndex = list ? *list : std::vector<std::int32_t>{};
  for (std::size_t begin = 0; begin < coordIndex.size(); ++faceNumber) {
    std::size_t end = begin;
    bool good = true;
    for (; end < coordIndex.size() && coordIndex[end] >= 0; ++end)
      good = good && static_cast<std::size_t>(coordIndex[end]) < result.points.size();
    if (end < coordIndex.size() && coordIndex[end] < -1) good = false;
    if (!good) {
      ++dropped;
    } else if (end - begin < 3) {
      tooShort += end > begin;
    } else {
      for (std::size_t i = begin; i < end; ++i) {
        result.corners.push_back(coordIndex[i]);
        cornerAt.push_back(i);
      }
      result.endFace();
      faceAt.push_back(faceNumber);
    }
    begin = end + 1;
  }
  if (dropped)
    document_.warn(geometry.file, geometry.line,
                   std::to_string(dropped) + " faces were dropped: their coordIndex is outside the " +
                       std::to_string(result.points.size()) + " points",
                   Warning::Loss::collision);
  if (tooShort)
    document_.warn(geometry.file, geometry.line,
                   std::to_string(tooShort) + " faces of fewer than 3 corners were dropped");
  readNormals(geometry, result, cornerAt, faceAt);
  readColours(geometry, result, cornerAt, faceAt, palette, look);
  return result;
}

void ShapeReader::readNormals(const Node& geometry, Polygons& polygons, const std::vector<std::size_t>& cornerAt,
                              const std::vector<std::size_t>& faceAt) {
  const Node* node = nodeField(geometry, "normal");
  if (!node) return;
  std::vector<Vector3f> normals = triples(node, "vector");
  for (Vector3f& normal : normals) {
    if (normal.allFinite() && normal.stableNorm() > 0) {
      normal.stableNormalize();
      continue;
    }
    document_.warn(node->file, node->line, "a normal is not a direction: the normals are computed instead");
    return;
  }
  const bool perVertex = flagField(geometry, "normalPerVertex", true);
  const auto* index = indices(geometry, "normalIndex");
  std::vector<std::int32_t> corners;
  corners.reserve(polygons.corners.size());
  for (std::size_t face = 0; face < polygons.faces(); ++face)
    for (std::size_t c = polygons.start[face]; c < polygons.start[face + 1]; ++c) {
      const std::size_t at = perVertex ? cornerAt[c] : faceAt[face];
      std::int64_t normal = perVertex ? polygons.corners[c] : static_cast<std::int64_t>(at);
      if (index) normal = at < index->size() ? (*index)[at] : -1;
      if (normal < 0 || normal >= static_cast<std::int64_t>(normals.size())) {
        document_.warn(geometry.file, geometry.line, "a normalIndex is out of range: the normals are computed instead");
        return;
      }
      corners.push_back(static_cast<std::int32_t>(normal));
    }
  polygons.normals = std::move(normals);
  polygons.cornerNormals = std::move(corners);
}

void ShapeReader::readColours(const Node& geometry, Polygons& polygons, const std::vector<std::size_t>& cornerAt,
                              const std::vector<std::size_t>& faceAt, std::vector<std::array<float, 4>>& palette,
                              const Shape& look) {
  const Node* node = nodeField(geometry, "color");
  if (!node) return;
  const std::vector<Vector3f> colours = triples(node, "color");
  const bool perVertex = flagField(geometry, "colorPerVertex", true);
  const auto* index = indices(geometry, "colorIndex");

  // A shape has one colour: faces are grouped by theirs, a face with several takes its first corner's.
  std::map<std::array<float, 3>, int> known;
  std::vector<int> faces;
  for (std::size_t face = 0; face < polygons.faces(); ++face) {
    const std::size_t corner = polygons.start[face], at = perVertex ? cornerAt[corner] : faceAt[face];
    std::int64_t which = perVertex ? polygons.corners[corner] : static_cast<std::int64_t>(at);
    if (index) which = at < index->size() ? (*index)[at] : -1;
    if (which < 0 || which >= static_cast<std::int64_t>(colours.size())) {
      document_.warn(geometry.file, geometry.line, "a colorIndex is out of range: the colours were dropped");
      return;
    }
    const Vector3f& colour = colours[static_cast<std::size_t>(which)];
    const auto [entry, isNew] = known.try_emplace({colour.x(), colour.y(), colour.z()}, static_cast<int>(known.size()));
    if (known.size() > mostColours) {
      document_.warn(geometry.file, geometry.line,
                     "more than " + std::to_string(mostColours) + " colours in one IndexedFaceSet were dropped");
      return;
    }
    faces.push_back(entry->second);
  }
  palette.resize(known.size());
  const auto clamp = [](float c) { return std::min(std::max(c, 0.f), 1.f); };
  for (const auto& [colour, number] : known)
    palette[static_cast<std::size_t>(number)] = {clamp(colour[0]), clamp(colour[1]), clamp(colour[2]), look.colour[3]};
  polygons.faceColours = std::move(faces);
}

}  // namespace btr::vrml
