#include "core/spec/carpet_spec.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "core/spec/json_reader.h"

namespace btr {
namespace {

constexpr double furthest_m = 100;

std::array<double, 2> placeFrom(JsonReader& reader, const std::string& key) {
  const std::vector<double> numbers = reader.numbers(key, 2);
  for (const double number : numbers)
    if (std::abs(number) > furthest_m) reader.refuse(key, "two numbers of at most 100 m");
  return {numbers[0], numbers[1]};
}

}  // namespace

std::string colourFromReader(JsonReader& reader, const std::string& key, const std::string& byDefault) {
  const std::string colour = reader.text(key, byDefault);
  const auto hexadecimal = [](unsigned char c) { return std::isxdigit(c) != 0; };
  if (colour.size() != 7 || colour[0] != '#' || !std::all_of(colour.begin() + 1, colour.end(), hexadecimal))
    reader.refuse(key, "# and six hexadecimal digits, as #8c8c96");
  return colour;
}

CarpetSpec carpetFromReader(JsonReader reader) {
  CarpetSpec carpet;
  carpet.size_m = placeFrom(reader, "size_m");
  if (carpet.size_m[0] <= 0 || carpet.size_m[1] <= 0) reader.refuse("size_m", "two lengths above 0 m");
  carpet.colour = colourFromReader(reader, "colour", carpet.colour);
  carpet.lineColour = colourFromReader(reader, "line_colour", carpet.lineColour);
  reader.array("lines", [&](JsonReader entry) {
    CarpetSpec::Line line;
    line.from_m = placeFrom(entry, "from_m");
    line.to_m = placeFrom(entry, "to_m");
    line.width_m = entry.number("width_m", 0.001, 1, line.width_m);
    if (line.from_m == line.to_m) entry.refuse("to_m", "another place than from_m");
    entry.finish();
    carpet.lines.push_back(line);
  });
  reader.array("circles", [&](JsonReader entry) {
    CarpetSpec::Circle circle;
    circle.centre_m = placeFrom(entry, "centre_m");
    circle.radius_m = entry.number("radius_m", 0.001, furthest_m);
    circle.width_m = entry.number("width_m", 0.001, 1, circle.width_m);
    if (circle.width_m > circle.radius_m) entry.refuse("width_m", "at most radius_m");
    entry.finish();
    carpet.circles.push_back(circle);
  });
  reader.finish();
  return carpet;
}

nlohmann::json toJson(const CarpetSpec& carpet) {
  nlohmann::json document{{"size_m", carpet.size_m},
                          {"colour", carpet.colour},
                          {"line_colour", carpet.lineColour},
                          {"lines", nlohmann::json::array()},
                          {"circles", nlohmann::json::array()}};
  for (const CarpetSpec::Line& line : carpet.lines)
    document["lines"].push_back({{"from_m", line.from_m}, {"to_m", line.to_m}, {"width_m", line.width_m}});
  for (const CarpetSpec::Circle& circle : carpet.circles)
    document["circles"].push_back(
        {{"centre_m", circle.centre_m}, {"radius_m", circle.radius_m}, {"width_m", circle.width_m}});
  return document;
}

}  // namespace btr
