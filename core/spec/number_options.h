#pragma once
#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "core/spec/parameter.h"

// Numbers on a command line, read as strictly as in files: the whole text, decimal, within its bounds. What the parser
// of options reads by itself would also be "", "0x10", "010" as 8, or −1 as a very large number.
namespace btr::cli {

/// The checked number goes on as decimal digits that read back as the same value.
template <class Number, class Read>
CLI::Validator numberOption(Number minimum, Number maximum, const std::string& allowed, const Read& read) {
  const auto check = [=](std::string& text) -> std::string {
    const std::optional<Number> value = read(text);
    if (!value || *value < minimum || *value > maximum)
      return "\"" + text.substr(0, 40) + (text.size() > 40 ? "…" : "") + "\" is not allowed; " + allowed;
    char digits[64];
    if constexpr (std::is_floating_point_v<Number>)
      text.assign(digits, std::to_chars(digits, digits + sizeof digits, *value, std::chars_format::scientific, 20).ptr);
    else
      text.assign(digits, std::to_chars(digits, digits + sizeof digits, *value).ptr);
    return "";
  };
  return {check, allowed, ""};
}

template <class Whole>
CLI::Validator anyWholeNumber(Whole minimum, Whole maximum) {
  const bool open = maximum == std::numeric_limits<Whole>::max();
  const std::string allowed = "whole numbers " + std::string(open ? "from " : "") + std::to_string(minimum) +
                              (open ? "" : " to " + std::to_string(maximum));
  return numberOption<Whole>(minimum, maximum, allowed, [](const std::string& text) -> std::optional<Whole> {
    Whole value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return value;
  });
}

/// For a transform() of an option that is an int or an id.
inline CLI::Validator wholeNumber(std::int64_t minimum,
                                  std::int64_t maximum = std::numeric_limits<std::int64_t>::max()) {
  return anyWholeNumber(minimum, maximum);
}

/// For a transform() of a seed: 64 bits without a sign.
inline CLI::Validator seedNumber() {
  return anyWholeNumber<std::uint64_t>(0, std::numeric_limits<std::uint64_t>::max());
}

/// For a transform() of a finite number with a decimal point.
inline CLI::Validator decimalNumber(double minimum = std::numeric_limits<double>::lowest(),
                                    double maximum = std::numeric_limits<double>::max()) {
  const bool open = maximum == std::numeric_limits<double>::max();
  return numberOption<double>(
      minimum, maximum, open ? "a finite number" : "numbers " + toText(minimum) + " to " + toText(maximum), toNumber);
}

}  // namespace btr::cli
