#pragma once
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace btr {

class JsonReader;

/// How the floor looks: a carpet around the world's origin with painted lines and circles. Only eyes and cameras see
/// it. Places in the world's x and y [m]; colours are #rrggbb.
struct CarpetSpec {
  struct Line {
    std::array<double, 2> from_m{}, to_m{};  ///< along its middle
    double width_m = 0.025;
    bool operator==(const Line&) const = default;
  };
  struct Circle {
    std::array<double, 2> centre_m{};
    double radius_m = 0.15;  ///< to the outer edge
    double width_m = 0.025;
    bool operator==(const Circle&) const = default;
  };
  std::array<double, 2> size_m{2, 2};
  std::string colour = "#2e7d32", lineColour = "#f2f2f2";
  std::vector<Line> lines;
  std::vector<Circle> circles;
  bool operator==(const CarpetSpec&) const = default;
};

/// Throws InputError.
CarpetSpec carpetFromReader(JsonReader reader);
nlohmann::json toJson(const CarpetSpec& carpet);

/// A colour written as # and six hexadecimal digits; refuses anything else.
std::string colourFromReader(JsonReader& reader, const std::string& key, const std::string& byDefault);

}  // namespace btr
