#include "core/run/grid/grid_kicks.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "core/run/export.h"
#include "core/run/grid/grid_cells.h"
#include "core/run/setup/evaluator.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

std::string nameOf(const Database& database, Id grid) {
  return "grid " + std::to_string(grid) + " of " + database.path();
}

/// The experiment and simulator of a grid's cells; the task is any cell's.
struct Base {
  GridSpec spec;
  PreparedExperiment prepared;
  SimulatorSpec simulator;
};
Base baseOf(const Database& database, const PluginHost& host, Id grid) {
  for (const GridCellRecord& cell : database.gridCells(grid))
    if (cell.run != 0)
      return {storedGrid(database.grid(grid).specJson, nameOf(database, grid)),
              prepareFromRun(database.run(cell.run), host), database.latestSimulator(cell.run).simulator};
  throw InputError(nameOf(database, grid) + ": none of its cells has a run");
}

std::vector<double> evenly(const std::vector<double>& axis, int count) {
  if (axis.size() == 1) return axis;
  std::vector<double> values;
  for (int k = 0; k < count; ++k)
    values.push_back(k == count - 1 && count > 1
                         ? axis.back()
                         : axis.front() + (axis.back() - axis.front()) * (count > 1 ? double(k) / (count - 1) : 0.5));
  return values;
}

/// `ofCells`: the cells' kicks, in their order. Adds nothing where the fitness tells no way.
void addCellsWays(GridMap& map, const GridSpec& spec, std::span<const TrialReply> ofCells) {
  const Parameter way{cellsWay, "m", "way of the cells' kicks", 0, std::numeric_limits<double>::max()};
  std::vector<std::vector<double>> ways;
  for (const TrialReply& reply : ofCells) {
    const auto found = reply.figures.find("way_m");
    ways.push_back({found == reply.figures.end() ? 0 : found->second});
  }
  const VectorGrid expected(spec.axes, {way}, std::move(ways));
  for (GridPoint& point : map.points)
    if (point.figures.contains("way_m")) point.figures[cellsWay] = expected.at(point.task, GridSpec::axisNames).front();
}

}  // namespace

VectorGrid solvedGrid(const Database& database, const PluginHost& host, Id grid) {
  const GridSpec spec = storedGrid(database.grid(grid).specJson, nameOf(database, grid));
  const std::vector<GridSolution> solutions = database.gridSolutions(grid);
  const std::size_t cells = database.gridCells(grid).size();
  if (solutions.size() < cells)
    throw InputError(nameOf(database, grid) + ": " + std::to_string(solutions.size()) + " of its " +
                     std::to_string(cells) + " cells have a solution; kicks are interpolated when all have one");
  std::vector<std::vector<double>> vectors;
  for (const GridSolution& solution : solutions) vectors.push_back(database.individual(solution.individual).parameters);
  const RunRecord run = database.run(database.gridCells(grid).front().run);
  const ExperimentSpec experiment = experimentFromJson(run.specJson, nameOf(database, grid), "");
  return VectorGrid(spec.axes, host.controller(experiment.controller.name)->genotype(), std::move(vectors));
}

GridKick gridKick(const Database& database, const PluginHost& host, Id grid, const std::array<double, 3>& point) {
  GridKick kick;
  kick.parameters = solvedGrid(database, host, grid).at(point, GridSpec::axisNames);
  const Base base = baseOf(database, host, grid);
  const PreparedExperiment prepared = base.prepared.withTask(taskOf(point));
  const Scene scene = prepared.scene(base.simulator);
  kick.balls = scene.balls;
  Replay& r = kick.replay;
  r.result = prepared.trial(scene, kick.parameters, 1, true);
  r.fitness = r.storedFitness = prepared.fitnessOf(r.result);
  r.sha256 = r.result.trace.sha256();
  r.robots = robotsOf(scene);
  kick.figures = prepared.figuresOf(r.result);
  return kick;
}

std::optional<GridMap> gridMap(const Database& database, const PluginHost& host, Id grid, double distance_m,
                               int columns, int rows, int workers, const StopFlag& stop,
                               const std::function<void(double)>& done) {
  const VectorGrid kicks = solvedGrid(database, host, grid);
  const Base base = baseOf(database, host, grid);
  GridMap map;
  map.distance_m = distance_m;
  map.bearings_rad = evenly(base.spec.axes[1], columns);
  map.directions_rad = evenly(base.spec.axes[2], rows);
  map.unit = base.prepared.fitness->unit();
  std::vector<TrialJob> jobs;
  for (const double bearing : map.bearings_rad)
    for (const double direction : map.directions_rad) {
      GridPoint point;
      point.number = static_cast<int>(map.points.size()) + 1;
      point.task = {distance_m, bearing, direction};
      point.parameters = kicks.at(point.task, GridSpec::axisNames);
      jobs.push_back({base.simulator, point.parameters, 1, false, taskOf(point.task)});
      map.points.push_back(std::move(point));
    }
  // The cells' own kicks, which say what is to be expected between them.
  const std::vector<GridCell> cells = cellsOf(base.spec);
  for (const GridCell& cell : cells)
    jobs.push_back({base.simulator, kicks.at(cell.task, GridSpec::axisNames), 1, false, taskOf(cell.task)});
  Evaluator evaluator(base.prepared, workers);
  const auto replies = evaluator.evaluate(jobs, stop, [&](std::size_t count) {
    if (done) done(static_cast<double>(count) / static_cast<double>(jobs.size()));
  });
  if (!replies) return std::nullopt;
  for (std::size_t k = 0; k < map.points.size(); ++k) {
    map.points[k].fitness = (*replies)[k].fitness;
    map.points[k].outcome = (*replies)[k].outcome;
    map.points[k].figures = (*replies)[k].figures;
  }
  addCellsWays(map, base.spec, std::span(*replies).subspan(map.points.size()));
  return map;
}

std::string toJsonText(const GridMap& map) {
  nlohmann::json points = nlohmann::json::array();
  for (const GridPoint& p : map.points)
    points.push_back({{"fitness", p.fitness},
                      {"outcome", p.outcome},
                      {"figures", toJson(p.figures, {})},
                      {"parameters", p.parameters}});
  return nlohmann::json{{"format", "uchilsim-grid-map-1"},
                        {"distance_m", map.distance_m},
                        {"bearings_rad", map.bearings_rad},
                        {"directions_rad", map.directions_rad},
                        {"unit", map.unit},
                        {"points", points}}
      .dump(1);
}

GridMap gridMapFromJson(const std::string& text, const std::string& place) {
  JsonReader reader = JsonReader::parse(text, place);
  reader.word("format", {"uchilsim-grid-map-1"});
  GridMap map;
  map.distance_m = reader.number("distance_m", -1e9, 1e9);
  map.bearings_rad = reader.numberList("bearings_rad");
  map.directions_rad = reader.numberList("directions_rad");
  map.unit = reader.text("unit");
  reader.array("points", [&](JsonReader read) {
    GridPoint point;
    const std::size_t k = map.points.size();
    if (map.directions_rad.empty() || k >= map.bearings_rad.size() * map.directions_rad.size())
      read.refuse("fitness", "one point for each bearing and direction");
    point.number = static_cast<int>(k) + 1;
    point.task = {map.distance_m, map.bearings_rad[k / map.directions_rad.size()],
                  map.directions_rad[k % map.directions_rad.size()]};
    point.fitness = read.number("fitness", -1e300, 1e300);
    point.outcome = read.text("outcome");
    point.figures = read.anyValues("figures");
    point.parameters = read.numberList("parameters");
    read.finish();
    map.points.push_back(std::move(point));
  });
  if (map.points.size() != map.bearings_rad.size() * map.directions_rad.size())
    reader.refuse("points", "one point for each bearing and direction");
  reader.finish();
  return map;
}

std::string toCsv(const std::vector<GridPoint>& points, const std::string& unit) {
  std::set<std::string> figures;
  for (const GridPoint& p : points)
    for (const auto& [name, value] : p.figures) figures.insert(name);
  std::string text = "distance_m,bearing_rad,direction_rad,fitness" + unitSuffix(unit) + ",outcome";
  for (const std::string& name : figures) text += "," + name;
  text += '\n';
  for (const GridPoint& p : points) {
    text += toText(p.task[0]) + "," + toText(p.task[1]) + "," + toText(p.task[2]) + "," + toText(p.fitness) + "," +
            p.outcome;
    for (const std::string& name : figures) {
      const auto found = p.figures.find(name);
      text += "," + (found == p.figures.end() ? std::string() : toText(found->second));
    }
    text += '\n';
  }
  return text;
}

}  // namespace btr
