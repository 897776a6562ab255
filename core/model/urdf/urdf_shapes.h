#pragma once
#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/model/mesh_file.h"
#include "core/model/urdf/urdf_xml.h"

namespace btr {

/// Materials, <visual> and <collision> of a URDF file. Meshes are read once for all who name them.
class UrdfShapes {
 public:
  /// Without a source, mesh files are not read.
  UrdfShapes(UrdfXml& xml, MeshSource meshes) : xml_(xml), meshes_(std::move(meshes)) {}

  void readMaterial(const UrdfXml::Element& element) { colourOf(element); }
  /// Appends what a <visual> or <collision> of that link is made of. What cannot be read is a warning: a robot may come
  /// without its mesh files.
  void read(const UrdfXml::Element& element, const std::string& link, std::vector<Shape>& shapes);
  /// After the last of a link: where none of its visuals could be read, its collision shapes are drawn.
  void finish(const std::string& link, std::vector<Shape>& shapes);

 private:
  using Colour = std::array<float, 4>;
  /// A <visual> that cannot be read.
  struct Unseen {
    const UrdfXml::Element* element;
    std::string why;
    std::optional<Colour> colour;
  };
  std::optional<Colour> colourOf(const UrdfXml::Element& material);
  void addMesh(const UrdfXml::Element& mesh, const std::string& link, Shape shape, std::optional<Colour> colour,
               std::vector<Shape>& shapes);
  const std::vector<MeshPart>& partsOf(const std::string& name, const Eigen::Vector3d& scale);

  UrdfXml& xml_;
  MeshSource meshes_;
  std::map<std::string, Colour> materials_;
  std::map<std::tuple<std::string, double, double, double>, std::vector<MeshPart>> known_;  ///< by name and scale
  std::vector<Unseen> unseen_;                                                              ///< of the present link
  std::size_t triangles_ = 0;                                                               ///< of all mesh files
};

}  // namespace btr
