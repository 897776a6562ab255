#include "core/model/urdf/urdf_xml.h"

#include <algorithm>

#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

/// Finite numbers in an attribute, separated by blanks.
std::vector<double> numbersIn(const std::string& text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n", at);
    if (begin == std::string::npos) break;
    const std::size_t end = std::min(text.find_first_of(" \t\r\n", begin), text.size());
    const auto number = toNumber(text.substr(begin, end - begin));
    if (!number) return {};
    numbers.push_back(*number);
    at = end;
  }
  return numbers;
}

}  // namespace

void UrdfXml::fail(int line, const std::string& message) const { throw InputError(place_, line, message); }

void UrdfXml::warn(const Element& element, const std::string& text, Warning::Loss loss, const std::string& at) {
  if (loss != Warning::Loss::none || warnings_.size() < 200)
    warnings_.push_back({element.GetLineNum(), text, loss, at});
}

std::string UrdfXml::attribute(const Element& element, const char* name) const {
  const char* value = element.Attribute(name);
  if (!value || !*value) fail(element, "<" + std::string(element.Name()) + "> needs the attribute " + name);
  if (std::string(value).size() > budget_.identifier)
    fail(element,
         std::string(name) + " longer than " + std::to_string(budget_.identifier) + " characters is not allowed");
  return value;
}

std::vector<double> UrdfXml::numbers(const Element& element, const char* name, std::size_t count) const {
  const std::string text = attribute(element, name);
  auto result = numbersIn(text);
  if (result.size() != count)
    fail(element, std::string(name) + "=\"" + shown(text) + "\" is not allowed; " + std::to_string(count) +
                      (count == 1 ? " finite number is expected" : " finite numbers are expected"));
  return result;
}

std::optional<double> UrdfXml::numberIfAny(const Element* element, const char* name) const {
  if (!element || !element->Attribute(name)) return std::nullopt;
  return number(*element, name);
}

double UrdfXml::positive(const Element& element, const char* name) const {
  const double value = number(element, name);
  if (!(value > 0))
    fail(element, std::string(name) + " " + toText(value) + " is not allowed; greater than 0 is expected");
  return value;
}

std::optional<double> UrdfXml::notNegativeIfAny(const Element* element, const char* name, const std::string& of) const {
  const auto value = numberIfAny(element, name);
  if (value && *value < 0)
    fail(*element, of + ": " + name + " " + toText(*value) + " is not allowed; 0 or more is expected");
  return value;
}

Eigen::Vector3d UrdfXml::vector(const Element& element, const char* name) const {
  const auto values = numbers(element, name, 3);
  return {values[0], values[1], values[2]};
}

Eigen::Isometry3d UrdfXml::originOf(const Element& parent) const {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  const Element* origin = parent.FirstChildElement("origin");
  if (!origin) return result;
  if (origin->Attribute("xyz")) result.translation() = vector(*origin, "xyz");
  if (origin->Attribute("rpy")) {
    const Vector3d rpy = vector(*origin, "rpy");
    result.linear() = (AngleAxisd(rpy.z(), Vector3d::UnitZ()) * AngleAxisd(rpy.y(), Vector3d::UnitY()) *
                       AngleAxisd(rpy.x(), Vector3d::UnitX()))
                          .toRotationMatrix();
  }
  return result;
}

}  // namespace btr
