#include "core/model/urdf/urdf_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/model/drawing_loss.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr {

using Eigen::Vector3d;

std::optional<UrdfShapes::Colour> UrdfShapes::colourOf(const UrdfXml::Element& material) {
  const char* name = material.Attribute("name");
  if (const auto* colour = material.FirstChildElement("color")) {
    const auto values = xml_.numbers(*colour, "rgba", 4);
    Colour result{};
    for (std::size_t i = 0; i < 4; ++i) result[i] = static_cast<float>(std::clamp(values[i], 0., 1.));
    if (name) materials_[name] = result;
    return result;
  }
  const auto known = name ? materials_.find(name) : materials_.end();
  return known == materials_.end() ? std::nullopt : std::optional(known->second);
}

void UrdfShapes::read(const UrdfXml::Element& element, const std::string& link, std::vector<Shape>& shapes) {
  Shape shape;
  shape.drawn = std::string(element.Name()) == "visual";
  shape.collides = !shape.drawn;
  shape.pose = xml_.originOf(element);
  std::optional<Colour> colour;
  if (const auto* material = element.FirstChildElement("material")) colour = colourOf(*material);
  if (colour) shape.colour = *colour;
  const auto* geometry = element.FirstChildElement("geometry");
  const auto* body = geometry ? geometry->FirstChildElement() : nullptr;
  if (!body) xml_.fail(element, "<" + std::string(element.Name()) + "> needs a <geometry>");
  const std::string kind = body->Name();
  if (kind == "mesh") return addMesh(*body, link, shape, colour, shapes);
  const std::string who = "link " + UrdfXml::shown(link) + ": the geometry <" + UrdfXml::shown(kind) + "> ";
  const auto leaveOut = [&](const std::string& why) {
    shape.drawn ? xml_.warn(*body, who + why + "; it is not drawn")
                : xml_.warn(*body, who + why + "; it collides with nothing", Warning::Loss::collision, link);
  };
  bool extends = true;  // in every direction; frames are marked with what is flat, and nothing touches it
  const auto length = [&](const char* name) {
    const double value = xml_.number(*body, name);
    if (value < 0) xml_.fail(*body, who + name + " " + toText(value) + " is not allowed; 0 or more is expected");
    extends = extends && value > 0;
    return value;
  };
  if (kind == "box") {
    shape.kind = Shape::Kind::box;
    shape.size_m = xml_.vector(*body, "size");
    if (shape.size_m.minCoeff() < 0) xml_.fail(*body, who + "must not have a size below 0");
    extends = shape.size_m.minCoeff() > 0;
  } else if (kind == "sphere") {
    shape.kind = Shape::Kind::sphere;
    shape.size_m = {length("radius"), 0, 0};
  } else if (kind == "cylinder" || kind == "capsule") {
    // URDF's lie along z, ours along y.
    shape.kind = kind == "cylinder" ? Shape::Kind::cylinder : Shape::Kind::capsule;
    const double radius = length("radius");
    shape.size_m = {radius, length("length"), 0};
    shape.pose.rotate(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()));
  } else if (shape.drawn) {
    unseen_.push_back({body, who + "is not known", colour});
    return;
  } else {
    return leaveOut("is not known");
  }
  if (!extends) return leaveOut("has a size of 0");
  shapes.push_back(std::move(shape));
}

void UrdfShapes::finish(const std::string& link, std::vector<Shape>& shapes) {
  const std::vector<Unseen> unseen = std::exchange(unseen_, {});
  if (unseen.empty()) return;
  const bool stands = std::ranges::none_of(shapes, &Shape::drawn) && !shapes.empty();
  for (Shape& shape : shapes) {
    if (!stands) break;
    shape.drawn = true;
    if (unseen.front().colour) shape.colour = *unseen.front().colour;
  }
  for (const Unseen& each : unseen)
    xml_.warn(*each.element, each.why + std::string(stands ? drawingLoss::byCollision : drawingLoss::notDrawn),
              Warning::Loss::none, link);
}

const std::vector<MeshPart>& UrdfShapes::partsOf(const std::string& name, const Vector3d& scale) {
  const std::tuple key{name, scale.x(), scale.y(), scale.z()};
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  if (!meshes_) throw InputError("mesh \"" + UrdfXml::shown(name) + "\" was not read");
  auto parts = readMesh(meshes_(name), scale, xml_.budget().triangles - triangles_);
  for (const MeshPart& part : parts) triangles_ += part.triangles.size();
  return known_.emplace(key, std::move(parts)).first->second;
}

void UrdfShapes::addMesh(const UrdfXml::Element& mesh, const std::string& link, Shape shape,
                         std::optional<Colour> colour, std::vector<Shape>& shapes) {
  shape.kind = Shape::Kind::mesh;
  const std::string name = xml_.attribute(mesh, "filename");
  const Vector3d scale = mesh.Attribute("scale") ? xml_.vector(mesh, "scale") : Vector3d(Vector3d::Ones());
  if (!(scale.cwiseAbs().minCoeff() > 0)) xml_.fail(mesh, "scale must not be 0");
  const std::vector<MeshPart>* parts = nullptr;
  try {
    parts = &partsOf(name, scale);
  } catch (const InputError& error) {
    const std::string text = "link " + UrdfXml::shown(link) + ": " + error.what();
    if (shape.drawn)
      unseen_.push_back({&mesh, text, colour});
    else
      xml_.warn(mesh, text + "; it collides with nothing", Warning::Loss::collision, link);
    return;
  }
  if (shape.drawn) {
    for (const MeshPart& part : *parts) {
      Shape drawn = shape;
      drawn.surface = std::make_shared<const Surface>(Surface{part.vertices, part.triangles, {}});
      if (!colour && part.colour) drawn.colour = *part.colour;
      shapes.push_back(std::move(drawn));
    }
    return;
  }
  // What collides is the hull of the whole file.
  Surface all;
  for (const MeshPart& part : *parts) {
    const auto first = static_cast<int>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const auto& corners : part.triangles)
      all.triangles.push_back({corners[0] + first, corners[1] + first, corners[2] + first});
  }
  shape.surface = std::make_shared<const Surface>(std::move(all));
  shapes.push_back(std::move(shape));
}

}  // namespace btr
