#include "core/spec/grid_spec.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/spec/comparison_spec.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/spec_head.h"

namespace btr {
namespace {

const std::vector<std::string> methodNames{"independent", "contamination", "similarity"};

constexpr std::size_t mostCells = 1000;

/// Values of one axis: strictly ascending, and symmetric about 0 where `symmetric`.
std::vector<double> axisFrom(JsonReader& reader, const char* key, bool symmetric) {
  std::vector<double> values = reader.numberList(key);
  if (values.empty() || values.size() > 100) reader.refuse(key, "1 to 100 numbers");
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(values[i] > values[i - 1])) reader.refuse(key, "numbers in ascending order, each once");
  if (!std::ranges::all_of(values, [](double v) { return v > -1e9 && v < 1e9; })) reader.refuse(key, "finite numbers");
  for (std::size_t i = 0; symmetric && i < values.size(); ++i)
    if (values[i] != -values[values.size() - 1 - i])
      reader.refuse(key, "numbers that are symmetric about 0, as long as \"mirrored\" is \"derived\"");
  return values;
}

GridSpec read(JsonReader reader, bool stored) {
  GridSpec grid;
  grid.name = nameOfSpec(reader, "uchilsim-grid-1");
  grid.experiment = filledText(reader, "experiment", "the path of an experiment file");
  grid.mirroredDerived = reader.word("mirrored", {"derived", "learned"}, "derived") == "derived";
  std::size_t cells = 1;
  for (std::size_t axis = 0; axis < grid.axes.size(); ++axis) {
    grid.axes[axis] = axisFrom(reader, GridSpec::axisKeys[axis], axis > 0 && grid.mirroredDerived);
    cells *= grid.axes[axis].size();
  }
  if (cells > mostCells)
    throw InputError(reader.place() + " axes", std::to_string(cells) + " cells",
                     "at most " + std::to_string(mostCells));
  if (!stored) {
    for (const std::string& name : reader.texts("methods")) {
      const auto found = std::ranges::find(methodNames, name);
      const auto method = static_cast<GridSpec::Method>(found - methodNames.begin());
      if (found == methodNames.end() || std::ranges::count(grid.methods, method) > 0)
        reader.refuse("methods", "independent, contamination, similarity, each once");
      grid.methods.push_back(method);
    }
    if (grid.methods.empty()) reader.refuse("methods", "at least one of independent, contamination, similarity");
    grid.seeds = seedsFrom(reader);
  }
  grid.settings = reader.values("settings", gridParameters());
  reader.finish();
  return grid;
}

nlohmann::json toJson(const GridSpec& grid) {
  nlohmann::json document{{"format", "uchilsim-grid-1"},
                          {"name", grid.name},
                          {"experiment", grid.experiment},
                          {"mirrored", grid.mirroredDerived ? "derived" : "learned"},
                          {"settings", toJson(grid.settings, gridParameters())}};
  for (std::size_t axis = 0; axis < grid.axes.size(); ++axis) document[GridSpec::axisKeys[axis]] = grid.axes[axis];
  return document;
}

}  // namespace

const char* toText(GridSpec::Method method) { return methodNames[static_cast<std::size_t>(method)].c_str(); }

GridSpec::Method gridMethodFromText(const std::string& text) {
  const auto found = std::ranges::find(methodNames, text);
  if (found == methodNames.end())
    throw InputError("method", "\"" + text + "\"", "independent, contamination or similarity");
  return static_cast<GridSpec::Method>(found - methodNames.begin());
}

const std::vector<Parameter>& gridParameters() {
  static const std::vector<Parameter> parameters{
      {"generations", "", "generations of each cell", 1, 1e6, 100, {}, true},
      {"failure_threshold", "", "a cell whose best fitness stays below it has failed, in the fitness' unit", -1e6, 1e6,
       0.3},
      {"replace_failed",
       "",
       "whether a failed cell may take the solution of the neighbour that does best in it",
       0,
       1,
       1,
       {},
       false,
       {"no", "yes"}},
      {"contamination_share", "", "of a population that begins as copies of a neighbour's good point", 0, 1, 0.8},
      {"contamination_flip", "", "probability that a bit of such a copy flips", 0, 0.5, 0.05},
      {"similarity_strength", "", "the factor of fitness is the similarity to the neighbours to this power", 0, 100, 2},
      {"points", "", "points between the cells at which interpolated kicks are tried", 0, 1e5, 200, {}, true},
  };
  return parameters;
}

GridSpec gridFromJson(const std::string& text, const std::string& place) {
  GridSpec grid = read(JsonReader::parse(text, place), false);
  grid.file = place;
  return grid;
}

GridSpec loadGrid(const std::string& path) { return gridFromJson(readFile(path), path); }

std::string toJsonText(const GridSpec& grid) { return toJson(grid).dump(2) + "\n"; }

std::string gridFileText(const GridSpec& grid) {
  nlohmann::json document = toJson(grid);
  document["seeds"] = grid.seeds;
  document["methods"] = nlohmann::json::array();
  for (const GridSpec::Method method : grid.methods) document["methods"].push_back(toText(method));
  return document.dump(2) + "\n";
}

GridSpec storedGrid(const std::string& text, const std::string& place) {
  GridSpec grid = read(JsonReader::parse(text, place), true);
  grid.file = place;
  return grid;
}

}  // namespace btr
