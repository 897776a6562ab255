#pragma once
#include <vector>

#include "core/model/mesh.h"
#include "core/model/vrml/vrml_tree.h"

namespace btr::vrml {

/// Fields of nodes with VRML's defaults. A field of an unfitting type (a PROTO may declare anything) is an InputError.
double realField(const Document& document, const Node& node, const char* field, double byDefault);
int integerField(const Document& document, const Node& node, const char* field, int byDefault);
bool flagField(const Node& node, const char* field, bool byDefault);
std::string textField(const Node& node, const char* field);
Eigen::Vector3d vectorField(const Document& document, const Node& node, const char* field,
                            const Eigen::Vector3d& byDefault);
Eigen::Quaterniond rotationField(const Document& document, const Node& node, const char* field);
const Node* nodeField(const Node& node, const char* field);
/// A node's Transform fields as one map (VRML97 4.10): translation, center, rotation, scaleOrientation, scale.
Eigen::Affine3d transformOf(const Document& document, const Node& node);

/// Makes shapes of Shape nodes. Counts the triangles of the whole file.
class ShapeReader {
 public:
  ShapeReader(Document& document, const ModelBudget& budget) : document_(document), budget_(budget) {}

  /// Appends what the node shows, carried to the link's frame by `toLink`. Boxes, spheres and cylinders stay what they
  /// are unless a scale makes another body of them.
  void read(const Node& shape, const Eigen::Affine3d& toLink, std::vector<Shape>& shapes);

 private:
  void readPrimitive(const Node& geometry, const Eigen::Affine3d& toLink, const Shape& look,
                     std::vector<Shape>& shapes);
  Polygons faceSet(const Node& geometry, std::vector<std::array<float, 4>>& palette, const Shape& look);
  void readNormals(const Node& geometry, Polygons& polygons, const std::vector<std::size_t>& cornerAt,
                   const std::vector<std::size_t>& faceAt);
  void readColours(const Node& geometry, Polygons& polygons, const std::vector<std::size_t>& cornerAt,
                   const std::vector<std::size_t>& faceAt, std::vector<std::array<float, 4>>& palette,
                   const Shape& look);
  Polygons elevationGrid(const Node& geometry);
  Polygons extrusion(const Node& geometry);
  void emit(const Polygons& polygons, const std::vector<std::array<float, 4>>& palette, const Eigen::Affine3d& toLink,
            const Shape& look, const Node& geometry, std::vector<Shape>& shapes);
  Shape lookOf(const Node& shape);

  Document& document_;
  const ModelBudget& budget_;
  std::size_t triangles_ = 0;
  MeshEffort effort_;
  bool saidTexture_ = false;
};

}  // namespace btr::vrml
