#include "core/run/grid/grid.h"

#include <algorithm>
#include <filesystem>

#include "core/run/grid/grid_work.h"
#include "core/run/setup/run_lock.h"
#include "core/spec/error.h"
#include "core/spec/sha256.h"

namespace btr {
namespace {

/// The experiment of a grid's cells: its run is learning alone, as long as the grid says.
ExperimentSpec experimentOf(const GridSpec& grid, GridSpec::Method method) {
  const std::filesystem::path folder = std::filesystem::path(grid.file).parent_path();
  ExperimentSpec experiment = loadExperiment((folder / grid.experiment).string());
  experiment.name = grid.name + " (" + toText(method) + ")";
  const double generations = valueOf(gridParameters(), grid.settings, "generations");
  for (const char* name : {"first_generations", "next_generations", "total_generations"})
    experiment.stages[name] = generations;
  experiment.reality = "person";
  experiment.realityOptions = {};
  experiment.realityLearner = {};
  experiment.realitySettings.clear();
  experiment.recordings = {};
  return experiment;
}

std::vector<Parameter> axesOf(const GridSpec& grid, const Controller& controller, const std::string& name) {
  const std::vector<Parameter> settings = controller.settings();
  std::vector<Parameter> axes;
  for (const char* axis : GridSpec::axisNames) {
    const Parameter* parameter = find(settings, axis);
    if (!parameter)
      throw InputError(grid.file + " /experiment", "the controller " + name,
                       std::string("one with the setting ") + axis + ", as kick has");
    axes.push_back(*parameter);
  }
  return axes;
}

void checkAxes(const GridSpec& grid, const Controller& controller, const std::string& name) {
  const std::vector<Parameter> axes = axesOf(grid, controller, name);
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
    for (const double value : grid.axes[axis]) check(axes[axis], value, grid.file + " /" + GridSpec::axisKeys[axis]);
  if (!grid.mirroredDerived) return;
  const std::vector<Parameter> genotype = controller.genotype();
  try {
    mirrorImage(genotype, std::vector<double>(genotype.size()));
  } catch (const InputError&) {
    throw InputError(grid.file + " /mirrored", "\"derived\" with the controller " + name, "\"learned\"");
  }
}

}  // namespace

GridStart gridStart(const PreparedExperiment& base, const GridSpec& spec, GridSpec::Method method, Id experiment,
                    std::uint64_t seed, const GridCell& cell, const std::optional<SearchStart>& start) {
  PreparedExperiment prepared = base.withTask(taskOf(cell.task));
  prepared.specInWords.name = spec.name + " (" + toText(method) + "): " + nameOfTask(cell.task);
  prepared.specInWords.start = start;
  GridStart begun;
  begun.cell = cell.number;
  // The same chance for a cell whatever the method: their differences are the methods'.
  const std::uint64_t own = Random::forPurpose(seed, "grid cell", static_cast<std::uint64_t>(cell.number)).next() >> 11;
  begun.run = makeRunRecord(prepared, experiment, own);
  begun.simulator = firstSimulator(prepared);
  begun.note = nameOfTask(cell.task) + ", seed " + std::to_string(seed);
  if (cell.mirrorOf) begun.note += ", mirror image of cell " + std::to_string(cell.mirrorOf);
  return begun;
}

std::vector<Parameter> axisParameters(const PluginHost& host, const GridSpec& spec) {
  const std::string experiment = (std::filesystem::path(spec.file).parent_path() / spec.experiment).string();
  const std::string name = loadExperiment(experiment).controller.name;
  return axesOf(spec, *host.controller(name), name);
}

Id startGrid(Database& database, const PluginHost& host, const GridSpec& spec, GridSpec::Method method,
             std::uint64_t seed) {
  const ExperimentSpec experiment = experimentOf(spec, method);
  checkAxes(spec, *host.controller(experiment.controller.name), experiment.controller.name);
  const PreparedExperiment base = prepareFromFiles(experiment, host);
  RunRecord record = makeRunRecord(base, 0, seed);
  GridRecord grid;
  grid.name = spec.name;
  grid.method = toText(method);
  grid.seed = seed;
  grid.specJson = toJsonText(spec);
  // What the runs depend on but for the method, which stands beside it.
  PreparedExperiment plain = base;
  plain.specInWords.name = spec.name;
  grid.specSha256 = sha256(grid.specJson + makeRunRecord(plain, 0, seed).specSha256);
  if (const auto known = database.findGrid(grid.specSha256, grid.method, seed)) return *known;

  ExperimentRecord all;
  all.name = experiment.name;
  all.specJson = record.specJson;
  const auto same = database.findExperiment(all.specJson);
  grid.experiment = same.value_or(0);

  const std::vector<GridCell> cells = cellsOf(spec);
  std::vector<GridCellRecord> records;
  for (const GridCell& cell : cells) records.push_back({cell.number, cell.task, cell.mirrorOf, 0, 0, 0});
  // Those that wait for nobody begin at once: of contamination the first, else all that learn.
  std::vector<GridStart> first;
  const int only = method == GridSpec::Method::contamination ? wavesOf(cells).front().front() : 0;
  for (const GridCell& cell : cells)
    if (cell.mirrorOf == 0 && (only == 0 || cell.number == only))
      first.push_back(gridStart(base, spec, method, grid.experiment, seed, cell, experiment.start));
  return same ? database.addGrid(grid, records, first) : database.addGrid(all, grid, records, first);
}

RunEnd continueGrid(Database& database, const PluginHost& host, Id grid, const StopFlag& stop,
                    const GridOptions& options) {
  database.grid(grid);  // an unknown grid leaves no lock file
  if (isGridFinished(database, grid)) return RunEnd::finished;
  const RunLock lock(database.path(), grid, "grid", [&] {
    for (const GridCellRecord& cell : database.gridCells(grid))
      if (cell.run != 0) database.requestStop(cell.run, false);
  });
  GridWork work(database, host, grid, stop, options);
  if (work.learn() && work.settle() && work.tryPoints()) {
    work.progress.phase = "finished";
    work.publish(true);
    return RunEnd::finished;
  }
  for (const GridCellRecord& cell : database.gridCells(grid))
    if (cell.run != 0 && database.run(cell.run).state != RunState::finished)
      database.setRunState(cell.run, RunState::stopped, "stopped; its grid goes on with btr grid");
  return RunEnd::stopped;
}

bool isGridActive(const std::string& databasePath, Id grid) { return RunLock::isHeld(databasePath, grid, "grid"); }

bool isGridFinished(const Database& database, Id grid) {
  const GridSpec spec = storedGrid(database.grid(grid).specJson, "grid " + std::to_string(grid));
  const double points = valueOf(gridParameters(), spec.settings, "points");
  return database.gridSolutions(grid).size() == database.gridCells(grid).size() &&
         database.gridPoints(grid).size() >= static_cast<std::size_t>(points);
}

}  // namespace btr
