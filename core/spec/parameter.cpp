#include "core/spec/parameter.h"

#include <array>
#include <charconv>
#include <cmath>

#include "core/spec/error.h"
#include "core/spec/require.h"

namespace btr {
namespace {

std::string allowedBy(const Parameter& parameter) {
  if (!parameter.choices.empty()) {
    std::string words = "one of ";
    for (std::size_t i = 0; i < parameter.choices.size(); ++i) words += (i ? ", " : "") + parameter.choices[i];
    return words;
  }
  const std::string range = toText(parameter.minimum) + " to " + toText(parameter.maximum);
  return (parameter.integer ? "whole numbers " : "") + range + (parameter.unit.empty() ? "" : " " + parameter.unit);
}

}  // namespace

const Parameter* find(std::span<const Parameter> declared, const std::string& name) {
  for (const Parameter& parameter : declared)
    if (parameter.name == name) return &parameter;
  return nullptr;
}

double valueOf(std::span<const Parameter> declared, const Values& values, const std::string& name) {
  const Parameter* parameter = find(declared, name);
  require(parameter != nullptr, "a parameter is declared before its value is asked for");
  const auto given = values.find(name);
  return given != values.end() ? given->second : parameter->byDefault;
}

void check(const Parameter& parameter, double value, const std::string& place) {
  const bool whole = parameter.integer || !parameter.choices.empty();
  const bool allowed = std::isfinite(value) && value >= parameter.minimum && value <= parameter.maximum &&
                       (!whole || value == std::floor(value)) &&
                       (parameter.choices.empty() || value < static_cast<double>(parameter.choices.size()));
  if (!allowed) throw InputError(place, toText(value), allowedBy(parameter));
}

std::vector<double> resolve(std::span<const Parameter> declared, const Values& values, const std::string& place) {
  for (const auto& [name, value] : values) {
    const Parameter* parameter = find(declared, name);
    if (!parameter) {
      std::string names;
      for (const Parameter& other : declared) names += (names.empty() ? "" : ", ") + other.name;
      throw InputError(place, "\"" + name + "\"", names.empty() ? "there are no settings" : "known names: " + names);
    }
    check(*parameter, value, place + "/" + name);
  }
  std::vector<double> resolved;
  resolved.reserve(declared.size());
  for (const Parameter& parameter : declared) resolved.push_back(valueOf(declared, values, parameter.name));
  return resolved;
}

std::string toText(double value) {
  std::array<char, 32> text;
  // 100000 rather than 1e+05.
  const bool plain = value == std::floor(value) && std::abs(value) < 1e9;
  const auto end = plain ? std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed).ptr
                         : std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::optional<double> toNumber(const std::string& text) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (text.size() > 1 && *begin == '+' && begin[1] != '-') ++begin;
  double value = 0;
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return {};
  return value;
}

}  // namespace btr
