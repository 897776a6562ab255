// btr grid: the whole kick. Learns the cells of a grid, compares the methods, tries interpolated kicks.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/btr_commands.h"
#include "app/cluster/btr_array.h"
#include "app/cluster/btr_cluster.h"
#include "app/progress_line.h"
#include "core/run/grid/grid.h"
#include "core/run/grid/grid_cells.h"
#include "core/run/grid/grid_kicks.h"
#include "core/run/grid/grid_table.h"
#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"

namespace btr::cli {
namespace {

struct GridArguments {
  std::string file, database, csv, cellsCsv, pointsCsv, places;
  std::vector<std::string> methods;
  std::vector<std::uint64_t> seeds;
  Id grid = 0;
  int workers = 0, columns = 21, rows = 21;
  double distance = 0, bearing = 0, direction = 0;
  bool quiet = false, progress = false;
  ArrayArguments array;
};

std::string degrees(double rad) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", rad * 57.295779513082323);
  return text;
}

void showGridProgress(const GridRecord& grid, const GridProgress& p) {
  std::fprintf(
      stderr, "\r%s, seed %llu: %s, %d/%d generations, mean of the cells' best %.3g, %.0f trials/s, left %.0f s \x1b[K",
      grid.method.c_str(), static_cast<unsigned long long>(grid.seed), p.phase.c_str(), p.done, p.total, p.meanBest,
      p.trialsPerSecond, p.secondsLeft > 0 ? p.secondsLeft : 0);
  std::fflush(stderr);
}

std::vector<Parameter> genotypeOf(const Database& db, const PluginHost& host, const GridSummary& summary) {
  const ExperimentSpec spec = experimentFromJson(db.run(summary.rows.front().run).specJson, summary.grid.name, "");
  return host.controller(spec.controller.name)->genotype();
}

void printCells(const GridSummary& s) {
  std::vector<std::vector<std::string>> rows;
  for (const GridRow& row : s.rows) {
    std::string remark = row.failed ? "failed" : "";
    const auto add = [&](const std::string& text) { remark += (remark.empty() ? "" : ", ") + text; };
    if (row.takenFrom) add("has the solution of cell " + std::to_string(row.takenFrom));
    if (row.mirrorOf)
      add("mirror image of cell " + std::to_string(row.mirrorOf) +
          (row.sourceTookFrom ? ", which has the solution of cell " + std::to_string(row.sourceTookFrom) : ""));
    if (row.begunAt) add("begun at cell " + std::to_string(row.begunAt));
    rows.push_back({std::to_string(row.cell), toText(row.task[0]), degrees(row.task[1]), degrees(row.task[2]),
                    brief(row.fitness), brief(row.similarity), std::to_string(row.run), std::to_string(row.individual),
                    remark});
  }
  std::cout << "\ngrid " << s.grid.id << ": " << printable(s.grid.name) << ", " << s.grid.method << ", seed "
            << s.grid.seed << "; fitness in " << s.unit << "\n\n";
  writeOut("", table({"cell", "d [m]", "β [°]", "α [°]", "fitness", "similarity", "run", "individual", ""}, rows));
}

void printMethods(const GridComparison& c, const std::vector<GridSummary>& grids) {
  std::vector<std::vector<std::string>> rows;
  for (const GridMethodRow& m : c.methods) {
    double off = 0, falls = 0;
    int count = 0;
    for (const GridSummary& s : grids)
      if (s.grid.method == m.method && s.figureMeans.contains("off_direction_rad")) {
        off += s.figureMeans.at("off_direction_rad");
        falls += s.figureMeans.at("falls");
        ++count;
      }
    rows.push_back({m.method, std::to_string(m.seeds.size()), interval(m.cells), interval(m.points),
                    interval(m.cellsDifference), interval(m.pointsDifference), interval(m.edges), brief(m.failed),
                    brief(m.taken), count ? degrees(off / count) : "", count ? tenthPercent(falls / count) : ""});
  }
  std::cout << '\n'
            << printable(c.name) << " [" << c.unit
            << "]: mean fitness, ± half of the 95 % interval over the seeds where there are several\n\n";
  writeOut("", table({"method", "seeds", "at the cells", "between them", "cells − first", "between − first",
                      "similarity", "failed", "replaced", "off between [°]", "falls between"},
                     rows));
}

/// Prints and exports what is there of the grids with this hash.
void report(const Database& db, const std::string& sha, const GridArguments& a, Shell& shell) {
  const GridComparison comparison = compareGrids(db, shell.plugins(), sha);
  std::vector<GridSummary> summaries;
  for (const GridRecord& g : db.grids())
    if (g.specSha256 == sha) summaries.push_back(summaryOf(db, shell.plugins(), g.id));
  if (!a.csv.empty()) writeOut(a.csv, methodsCsv(comparison));
  if (shell.json) {
    std::cout << toJsonText(comparison, summaries) << '\n';
    return;
  }
  for (const GridSummary& s : summaries)
    if (!s.rows.empty() && !a.quiet) printCells(s);
  printMethods(comparison, summaries);
}

/// Goes on with the `k`-th of `grids` grids. False if it was stopped.
bool goOn(Database& db, Id id, const GridArguments& a, const ClusterJob& cluster, Shell& shell, std::size_t k,
          std::size_t grids) {
  const GridRecord record = db.grid(id);
  const bool show = isatty(STDERR_FILENO) && !a.quiet && !a.progress;
  GridOptions options;
  options.workers = a.workers;
  options.workforce = cluster.workforce();
  options.progress = [&](const GridProgress& p) {
    if (show) showGridProgress(record, p);
    const double own = p.total ? static_cast<double>(p.done) / p.total : 0;
    const double share = (static_cast<double>(k) + own) / static_cast<double>(grids);
    const std::string stage = record.method + ", " + p.phase;
    if (a.progress) std::fprintf(stderr, "%s %.3f\n", stage.c_str(), share);
    cluster.tellProgress(stage, share, p.trialsPerSecond);
  };
  const RunEnd end = continueGrid(db, shell.plugins(), id, *shell.stop, options);
  if (show) std::fprintf(stderr, "\n");
  if (end == RunEnd::finished) return true;
  shell.exitCode = stoppedEarly;
  std::fprintf(stderr, "btr: stopped; the same command goes on\n");
  return false;
}

/// An element for each seed and method, whose grid has begun in its database.
void gridElsewhere(const GridArguments& a, const GridSpec& spec, Shell& shell) {
  ArrayJob array;
  array.what = "grid";
  array.into = a.database;
  array.workers = std::max(1, a.workers);
  const auto begin = [&](const std::string& folder, ArrayJob& job) {
    for (const std::uint64_t seed : spec.seeds)
      for (const GridSpec::Method method : spec.methods) {
        job.elements.push_back({std::string(toText(method)) + ", seed " + std::to_string(seed),
                                {"grid", "--grid", "1", "--db", "{db}", "--workers", std::to_string(job.workers),
                                 "--quiet", "--places", "{places}"}});
        Database db = Database::open(elementDatabase(folder, job.elements.size()), Database::Mode::create);
        startGrid(db, shell.plugins(), spec, method, seed);
      }
  };
  beginArray(a.array, std::move(array), begin, shell);
}

void runGrid(const GridArguments& a, Shell& shell) {
  ClusterJob cluster(shell, a.database, a.workers);
  if (cluster.isDone()) return;
  cluster.tellTo(a.places);
  GridSpec spec = loadGrid(a.file);
  if (!a.methods.empty()) {
    spec.methods.clear();
    for (const std::string& name : a.methods) spec.methods.push_back(gridMethodFromText(name));
  }
  if (!a.seeds.empty()) spec.seeds = a.seeds;
  if (a.array.isWanted()) return gridElsewhere(a, spec, shell);
  Database db = Database::open(a.database, Database::Mode::create, workingPatience_ms);
  shell.goesOn = true;
  std::string sha;
  const std::size_t grids = spec.seeds.size() * spec.methods.size();
  std::size_t k = 0;
  // Seed by seed: a comparison that is stopped has whole pairs.
  for (const std::uint64_t seed : spec.seeds)
    for (const GridSpec::Method method : spec.methods) {
      const Id id = startGrid(db, shell.plugins(), spec, method, seed);
      sha = db.grid(id).specSha256;
      if (!goOn(db, id, a, cluster, shell, k++, grids)) return;
    }
  if (!a.quiet) cluster.tell();
  report(db, sha, a, shell);
}

/// A stored grid needs its file no more.
void continueStored(const GridArguments& a, Shell& shell) {
  ClusterJob cluster(shell, a.database, a.workers);
  if (cluster.isDone()) return;
  cluster.tellTo(a.places);
  Database db = Database::open(a.database, Database::Mode::readWrite, workingPatience_ms);
  shell.goesOn = true;
  if (goOn(db, a.grid, a, cluster, shell, 0, 1)) report(db, db.grid(a.grid).specSha256, a, shell);
}

void showTable(const GridArguments& a, Shell& shell) {
  const Database db = Database::open(a.database, Database::Mode::readOnly);
  if (a.grid == 0) {
    std::vector<std::string> files;  // hashes of the grid files, in the order of their first grids
    for (const GridRecord& g : db.grids())
      if (std::ranges::find(files, g.specSha256) == files.end()) files.push_back(g.specSha256);
    if (shell.json && files.empty()) std::cout << toJsonText(GridComparison{}, {}) << '\n';
    if ((shell.json || !a.csv.empty()) && files.size() > 1)
      throw InputError(db.path() + ": holds grids of " + std::to_string(files.size()) +
                       " grid files, and --json and --csv are one table; name a grid with --grid");
    for (const std::string& sha : files) report(db, sha, a, shell);
    return;
  }
  const GridSummary summary = summaryOf(db, shell.plugins(), a.grid);
  if (!a.cellsCsv.empty() && !summary.rows.empty())
    writeOut(a.cellsCsv, cellsCsv(summary, genotypeOf(db, shell.plugins(), summary)));
  if (!a.pointsCsv.empty()) writeOut(a.pointsCsv, toCsv(db.gridPoints(a.grid), summary.unit));
  if (shell.json)
    std::cout << toJsonText(GridComparison{summary.grid.name, summary.unit, {}}, {summary}) << '\n';
  else
    printCells(summary);
}

void makeMap(const GridArguments& a, Shell& shell) {
  const Database db = Database::open(a.database, Database::Mode::readOnly);
  ProgressLine line(shell, a.progress);
  const auto map = gridMap(db, shell.plugins(), a.grid, a.distance, a.columns, a.rows, a.workers, *shell.stop,
                           [&](double share) { line("interpolated kicks", share); });
  line.end();
  if (!map) {
    shell.exitCode = stoppedEarly;
    return;
  }
  if (!a.csv.empty()) writeOut(a.csv, toCsv(map->points, map->unit));
  if (shell.json) std::cout << toJsonText(*map) << '\n';
  if (!shell.json && a.csv.empty()) writeOut("", toCsv(map->points, map->unit));
}

void kick(const GridArguments& a, Shell& shell) {
  const Database db = Database::open(a.database, Database::Mode::readOnly);
  const std::array<double, 3> point{a.distance, a.bearing, a.direction};
  const GridKick made = gridKick(db, shell.plugins(), a.grid, point);
  if (!a.csv.empty()) writeOut(a.csv, made.replay.result.trace.toCsv());
  if (shell.json) {
    printJson({{"task", taskOf(point)},
               {"parameters", made.parameters},
               {"fitness", made.replay.fitness},
               {"outcome", toText(made.replay.result.outcome)},
               {"figures", made.figures}});
    return;
  }
  std::cout << nameOfTask(point) << ": fitness " << brief(made.replay.fitness);
  for (const auto& [name, value] : made.figures) std::cout << ", " << name << ' ' << brief(value);
  std::cout << '\n';
}

}  // namespace

void addGridCommands(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<GridArguments>();
  CLI::App* command = app.add_subcommand(
      "grid", "learn an experiment at every point of a grid of tasks, or go on with it, and compare the methods");
  command->require_subcommand(0, 1);
  CLI::Option* file = command->add_option("FILE", a->file, "grid file (.json)");
  command->add_option("--grid", a->grid, "instead of a file: go on with this stored grid")
      ->excludes(file)
      ->transform(wholeNumber(1));
  command->add_option("--db", a->database, "experiment database")->required();
  command->add_option("--workers,--jobs", a->workers, "worker processes (0: as many as processors)")
      ->transform(wholeNumber(0, 1024));
  command->add_option("--method", a->methods, "only this method (repeatable)")->allow_extra_args(false)->needs(file);
  command->add_option("--seed", a->seeds, "instead of the file's seeds (repeatable)")
      ->allow_extra_args(false)
      ->needs(file)
      ->transform(seedNumber());
  CLI::Option* csv = command->add_option("--csv", a->csv,
                                         "write the table to a file (grid, table: methods; map: points; kick: trace)");
  shell.writesFile(command, csv);
  command->add_flag("--quiet", a->quiet, "no progress, no tables of cells");
  addArrayOptions(command, a->array);
  addPlacesOption(command, a->places);
  command->add_flag("--progress", a->progress, "lines \"STAGE SHARE\" on stderr");

  CLI::App* tables = command->add_subcommand("table", "what is stored: cells of each grid, and the methods compared");
  CLI::Option* grid = tables->add_option("--grid", a->grid, "only this grid, with its cells and points");
  grid->transform(wholeNumber(1));
  CLI::Option* cells = tables->add_option("--cells", a->cellsCsv, "with --grid: write its cells to a CSV file");
  shell.writesFile(tables, cells->needs(grid));
  CLI::Option* points =
      tables->add_option("--points", a->pointsCsv, "with --grid: write the kicks between its cells to a CSV file");
  shell.writesFile(tables, points->needs(grid));
  tables->callback([a, &shell] { showTable(*a, shell); });

  CLI::App* map = command->add_subcommand("map", "interpolated kicks at even steps over both angles");
  map->add_option("--grid", a->grid, "number of the grid")->required()->transform(wholeNumber(1));
  map->add_option("--distance-m", a->distance, "distance of the ball")->required()->transform(decimalNumber());
  map->add_option("--columns", a->columns, "bearings of the ball")->transform(wholeNumber(1, 1000));
  map->add_option("--rows", a->rows, "directions of the kick")->transform(wholeNumber(1, 1000));
  map->callback([a, &shell] { makeMap(*a, shell); });

  CLI::App* one = command->add_subcommand("kick", "one interpolated kick");
  one->add_option("--grid", a->grid, "number of the grid")->required()->transform(wholeNumber(1));
  one->add_option("--distance-m", a->distance, "distance of the ball")->required()->transform(decimalNumber());
  one->add_option("--bearing-rad", a->bearing, "direction of the ball, 0 ahead, positive left")
      ->required()
      ->transform(decimalNumber());
  one->add_option("--direction-rad", a->direction, "where it should go")->required()->transform(decimalNumber());
  one->callback([a, &shell] { kick(*a, shell); });

  command->callback([a, command, &shell] {
    if (!command->get_subcommands().empty()) return;
    if (a->file.empty() && a->grid == 0) throw CLI::RequiredError("FILE or --grid");
    a->file.empty() ? continueStored(*a, shell) : runGrid(*a, shell);
  });
}

}  // namespace btr::cli
