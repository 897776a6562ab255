#pragma once
#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "core/model/load_model.h"

namespace btr {

/// Reads attributes of a URDF file; every refusal is an InputError "FILE:LINE: …". Gathers what was left out.
class UrdfXml {
 public:
  using Element = tinyxml2::XMLElement;

  UrdfXml(std::string place, const ModelBudget& budget) : place_(std::move(place)), budget_(budget) {}

  const std::string& place() const { return place_; }
  const ModelBudget& budget() const { return budget_; }

  [[noreturn]] void fail(int line, const std::string& message) const;
  [[noreturn]] void fail(const Element& element, const std::string& message) const {
    fail(element.GetLineNum(), message);
  }
  /// Of warnings that change nothing the first 200 are kept.
  void warn(const Element& element, const std::string& text, Warning::Loss loss = Warning::Loss::none,
            const std::string& at = "");
  void ignore(const Element& element) { warn(element, "<" + shown(element.Name()) + "> was ignored"); }
  std::vector<Warning> takeWarnings() { return std::move(warnings_); }

  /// A text of the file as a message may hold it.
  static std::string shown(const std::string& text) {
    constexpr std::size_t most = 100;
    return text.size() > most ? std::string(text, 0, most).append("...") : text;
  }

  std::string attribute(const Element& element, const char* name) const;
  std::vector<double> numbers(const Element& element, const char* name, std::size_t count) const;
  double number(const Element& element, const char* name) const { return numbers(element, name, 1)[0]; }
  std::optional<double> numberIfAny(const Element* element, const char* name) const;
  double positive(const Element& element, const char* name) const;
  std::optional<double> notNegativeIfAny(const Element* element, const char* name, const std::string& of) const;
  Eigen::Vector3d vector(const Element& element, const char* name) const;
  /// Of the element's <origin>, the identity without one.
  Eigen::Isometry3d originOf(const Element& parent) const;

 private:
  std::string place_;
  const ModelBudget& budget_;
  std::vector<Warning> warnings_;
};

}  // namespace btr
