// Reads single fields of nodes.
#include "core/model/vrml/vrml_shapes.h"

namespace btr::vrml {
namespace {

/// The field's numbers if there are at least `count`; nullptr if the field is absent or empty.
const double* numbersOf(const Document& document, const Node& node, const char* field, std::size_t count) {
  const Value* value = node.find(field);
  if (!value) return nullptr;
  const bool empty = value->numbers.empty() && isMany(value->type);
  if (empty && value->packed.empty() && value->integers.empty() && value->texts.empty() && value->nodes.empty())
    return nullptr;
  if (value->numbers.size() < count)
    document.fail(node, node.kind() + "." + field + ": " + std::to_string(count) + " numbers are expected");
  return value->numbers.data();
}

}  // namespace

double realField(const Document& document, const Node& node, const char* field, double byDefault) {
  const Value* value = node.find(field);
  if (value && !value->integers.empty()) return value->integers.front();
  const double* numbers = numbersOf(document, node, field, 1);
  return numbers ? numbers[0] : byDefault;
}

int integerField(const Document& document, const Node& node, const char* field, int byDefault) {
  const Value* value = node.find(field);
  if (!value) return byDefault;
  if (value->integers.empty()) document.fail(node, node.kind() + "." + field + ": a whole number is expected");
  return value->integers.front();
}

bool flagField(const Node& node, const char* field, bool byDefault) {
  const Value* value = node.find(field);
  return value && !value->integers.empty() ? value->integers.front() != 0 : byDefault;
}

std::string textField(const Node& node, const char* field) {
  const Value* value = node.find(field);
  return value && !value->texts.empty() ? value->texts.front() : "";
}

Eigen::Vector3d vectorField(const Document& document, const Node& node, const char* field,
                            const Eigen::Vector3d& byDefault) {
  const double* numbers = numbersOf(document, node, field, 3);
  return numbers ? Eigen::Vector3d(numbers[0], numbers[1], numbers[2]) : byDefault;
}

Eigen::Quaterniond rotationField(const Document& document, const Node& node, const char* field) {
  const double* numbers = numbersOf(document, node, field, 4);
  if (!numbers) return Eigen::Quaterniond::Identity();
  const Eigen::Vector3d axis(numbers[0], numbers[1], numbers[2]);
  // A zero axis is common for "no rotation".
  const double length = axis.stableNorm();
  if (!(length > 0)) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(numbers[3], axis / length));
}

const Node* nodeField(const Node& node, const char* field) {
  const Value* value = node.find(field);
  return value && !value->nodes.empty() ? value->nodes.front() : nullptr;
}

Eigen::Affine3d transformOf(const Document& document, const Node& node) {
  const Eigen::Vector3d centre = vectorField(document, node, "center", Eigen::Vector3d::Zero());
  const Eigen::Vector3d scale = vectorField(document, node, "scale", Eigen::Vector3d::Ones());
  const Eigen::Quaterniond orientation = rotationField(document, node, "scaleOrientation");
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  result.translate(vectorField(document, node, "translation", Eigen::Vector3d::Zero()));
  result.translate(centre);
  result.rotate(rotationField(document, node, "rotation"));
  if (scale != Eigen::Vector3d::Ones()) result.rotate(orientation).scale(scale).rotate(orientation.conjugate());
  result.translate(-centre);
  return result;
}

}  // namespace btr::vrml
