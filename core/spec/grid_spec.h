#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/spec/parameter.h"

namespace btr {

/// Experiments that differ in their task only, one for each point of a grid: the whole kick of the UCHILSIM papers
/// ("format": "uchilsim-grid-1"). The axes are settings of the experiment's controller.
struct GridSpec {
  static constexpr std::array<const char*, 3> axisNames{"distance_m", "bearing_rad", "direction_rad"};
  static constexpr std::array<const char*, 3> axisKeys{"distances_m", "bearings_rad", "directions_rad"};
  enum class Method { independent, contamination, similarity };

  std::string name;
  std::string experiment;                   ///< path of the experiment's file, relative to the grid's
  std::array<std::vector<double>, 3> axes;  ///< d [m], β and α [rad, 0 ahead, positive left]; each strictly ascending
  bool mirroredDerived =
      true;  ///< cells to the right are those to the left with the legs exchanged; else all are learned
  std::vector<Method> methods;       ///< each once
  std::vector<std::uint64_t> seeds;  ///< each once
  Values settings;                   ///< gridParameters()
  std::string file;                  ///< where it was read from; not part of the JSON
};

const char* toText(GridSpec::Method method);
GridSpec::Method gridMethodFromText(const std::string& text);  ///< throws InputError

/// generations, failure_threshold, replace_failed, contamination_share, contamination_flip, similarity_strength,
/// points.
const std::vector<Parameter>& gridParameters();

/// Throws InputError: file, key, value, what is allowed.
GridSpec gridFromJson(const std::string& text, const std::string& place);
GridSpec loadGrid(const std::string& path);
/// What all methods and seeds have in common, as it is stored: without both.
std::string toJsonText(const GridSpec& grid);
/// A whole grid file.
std::string gridFileText(const GridSpec& grid);
/// The way back from toJsonText(): no methods, no seeds.
GridSpec storedGrid(const std::string& text, const std::string& place);

}  // namespace btr
